// SPDX-License-Identifier: MIT
// Storage of vertices and indices.
#ifndef RHW_BUFFER_H
#define RHW_BUFFER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rhw/types.h"

struct rhw_context;
struct rhw_memory;

// Readable zero bytes after the end of every buffer: a kernel may load whole vectors at the last byte.
enum { RHW_BUFFER_PADDING = 64 };

// Bytes that a pass uses, in its arena (buffer_use.h).
struct rhw_used_range {
    struct rhw_used_range *next;
    size_t first, end;
};

struct rhw_buffer_data {
    unsigned char *bytes; // aligned to a cache line
    size_t size;          // as the user gave it, without padding
    // The pass in which it last got other memory, and the draws that were recorded before and read the old one.
    uint32_t renewed_pass, renewed_draws;
    bool is_callers;                // `bytes` is the program's memory
    bool is_mapped, is_map_written; // see rhw_buffer_map; the second: not for reading alone
    size_t map_first, map_end;      // the bytes that are
    // The last passes that read it, whose shader functions may write it, and that write it by transform feedback, by
    // generation; and in those which bytes.
    uint32_t read_pass, stored_pass, captured_pass;
    struct rhw_used_range *read, *stored, *captured;
};

// Releases what the item owns.
void rhw_buffer_data_release(struct rhw_memory *memory, struct rhw_buffer_data *data);

// Reports bytes that the buffer does not have.
bool rhw_buffer_check_range(const struct rhw_context *context, rhw_buffer buffer,
                            const struct rhw_buffer_data *data, size_t offset, size_t size,
                            const char *where);

// Bytes and padding, zeroed, or undefined when something will be copied there; NULL when out of memory.
unsigned char *rhw_buffer_allocate(struct rhw_memory *memory, size_t size, bool zeroed);

#endif
