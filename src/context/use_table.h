// SPDX-License-Identifier: MIT
// What a recording uses of the pools of its context. A pass that is run when it ends notes its uses in the things
// themselves. Recordings note them here, because they may be made by several threads at once, and because each run
// looks at all of them again. The table and what it points at lie in the arena of the recorded pass.
#ifndef RHW_USE_TABLE_H
#define RHW_USE_TABLE_H

#include "base/range_set.h"
#include "pool.h"

struct rhw_arena;

enum { RHW_USED_RANGES = 3 }; // sets of bytes, one for each enum rhw_buffer_use

// The use of a live item.
struct rhw_use {
    const void *item; // NULL: the place in the table is free
    const struct rhw_pool *pool;
    uint32_t index, generation;
    uint32_t moves; // how often the item had got other memory when it was used first
    struct rhw_range_set used[RHW_USED_RANGES]; // bytes of a buffer
    // A bit for each level of a texture: levels that are read, and written as storage images.
    uint32_t read_levels, stored_levels;
    bool is_sampled;
};

// A zeroed table is empty.
struct rhw_use_table {
    struct rhw_use *uses;   // by a hash of the item's address, then the next free place
    uint32_t count, places; // `places` is 0 or a power of two
};

// Return the use of an item. Return NULL if it has none.
struct rhw_use *rhw_use_table_find(const struct rhw_use_table *table, const void *item);
// Return the use of the live item at `index`, which is new where the item has none. It moves when the next one is made.
// Return NULL when out of memory.
struct rhw_use *rhw_use_table_note(struct rhw_use_table *table, struct rhw_arena *arena,
                                   const struct rhw_pool *pool, uint32_t index, uint32_t moves);

#endif
