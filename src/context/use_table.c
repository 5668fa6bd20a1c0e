// SPDX-License-Identifier: MIT
// The table is a hash table with open addressing that is half full at most.
#include "use_table.h"

#include <string.h>

#include "base/arena.h"

enum { FIRST_PLACES = 32 };

// Return the place of an item, or the free place where it would be. The table has places.
static struct rhw_use *place_of(const struct rhw_use_table *table, const void *item)
{
    const uint64_t hash = (uint64_t)(uintptr_t)item * 0x9e3779b97f4a7c15u;
    uint32_t place = (uint32_t)(hash >> 32) & (table->places - 1);
    while (table->uses[place].item && table->uses[place].item != item) {
        place = (place + 1) & (table->places - 1);
    }
    return &table->uses[place];
}

struct rhw_use *rhw_use_table_find(const struct rhw_use_table *table, const void *item)
{
    struct rhw_use *const use = table->places != 0 ? place_of(table, item) : NULL;
    return use && use->item ? use : NULL;
}

// Double the table. Return false when out of memory.
static bool grow(struct rhw_use_table *table, struct rhw_arena *arena)
{
    const uint32_t places = table->places == 0 ? FIRST_PLACES : 2 * table->places;
    struct rhw_use_table larger = {
        rhw_arena_alloc(arena, places * sizeof *table->uses, _Alignof(struct rhw_use)), table->count, places};
    if (!larger.uses) {
        return false;
    }
    memset(larger.uses, 0, places * sizeof *larger.uses);
    for (uint32_t i = 0; i < table->places; i++) {
        if (table->uses[i].item) {
            *place_of(&larger, table->uses[i].item) = table->uses[i];
        }
    }
    *table = larger;
    return true;
}

struct rhw_use *rhw_use_table_note(struct rhw_use_table *table, struct rhw_arena *arena,
                                   const struct rhw_pool *pool, uint32_t index, uint32_t moves)
{
    const void *const item = rhw_pool_item(pool, index);
    if (2 * (table->count + 1) > table->places && !grow(table, arena)) {
        return NULL;
    }
    struct rhw_use *const use = place_of(table, item);
    if (!use->item) {
        *use = (struct rhw_use){.item = item,
                                .pool = pool->viewed ? pool->viewed : pool,
                                .index = index,
                                .generation = rhw_pool_generation(pool, index),
                                .moves = moves};
        table->count++;
    }
    return use;
}
