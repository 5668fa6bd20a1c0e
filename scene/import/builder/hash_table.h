// SPDX-License-Identifier: MIT
// Indices that are found by hashes, for names and keys of which a file may have many.
#ifndef SCENE_HASH_TABLE_H
#define SCENE_HASH_TABLE_H

#include "import.h"

struct scene_hash_entry {
    uint32_t hash, index; ///< index is UINT32_MAX where the entry is free
};

/// A zeroed struct is an empty table.
struct scene_hash_table {
    struct scene_hash_entry *entries;
    size_t capacity, count; ///< capacity is 0 or a power of two
};

uint32_t scene_hash_bytes(const void *bytes, size_t size);
/// Return the next index that was added with this hash. `place` starts as SIZE_MAX. Return UINT32_MAX where there is
/// none more. The caller compares what the index stands for.
uint32_t scene_hash_next(const struct scene_hash_table *table, uint32_t hash, size_t *place);
void scene_hash_add(struct scene_import *import, struct scene_hash_table *table, uint32_t hash,
                    uint32_t index);

#endif
