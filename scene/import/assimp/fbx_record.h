// SPDX-License-Identifier: MIT
// The records of a binary FBX. Each says where in the file it ends, has values, and then records of its own.
#ifndef SCENE_IMPORT_FBX_RECORD_H
#define SCENE_IMPORT_FBX_RECORD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SCENE_FBX_HEADER = 27 }; ///< place of the first record

struct scene_fbx_bytes {
    const unsigned char *bytes;
    size_t size;
    size_t word; ///< bytes of the numbers in the head of a record
};

/// A record, with places in the file.
struct scene_fbx_record {
    uint64_t end, count; ///< where it ends; how many values it has
    size_t name, name_length;
    size_t values, children; ///< where they begin
};

/// Return true if a file begins as a binary FBX does.
bool scene_fbx_has_mark(const char *bytes, size_t size);
/// Return true if a file is a binary FBX with room for records.
bool scene_fbx_is_binary(const char *bytes, size_t size, struct scene_fbx_bytes *file);
/// Return a number of some bytes, the lowest first.
uint64_t scene_fbx_number(const unsigned char *bytes, size_t size);
/// Return the bytes of a record's head, which its name follows.
size_t scene_fbx_head(const struct scene_fbx_bytes *file);
/// Read the head of a record that ends at `limit` or before. Return false if it is not as it should be. The record that
/// ends a list has an end of 0.
bool scene_fbx_read_record(const struct scene_fbx_bytes *file, size_t place, size_t limit,
                           struct scene_fbx_record *record);
/// Return true if a record has the name.
bool scene_fbx_is_named(const struct scene_fbx_bytes *file, const struct scene_fbx_record *record,
                        const char *name);
/// Return where the value at `place` ends. Return 0 if it does not end before `limit`.
size_t scene_fbx_value_end(const struct scene_fbx_bytes *file, size_t place, size_t limit);
/// Return where the text of a string begins, and its length. Return 0 if the value at `place` is none.
size_t scene_fbx_string_at(const struct scene_fbx_bytes *file, size_t place, size_t limit, size_t *length);

#endif
