// SPDX-License-Identifier: MIT
// Pools. A chunk is one block: its slots, then its items.
#include "resource.h"

#include <assert.h>
#include <string.h>

#include "constants.h"
#include "memory.h"

struct slot {
    uint32_t generation; // of the item that is live or, when none is, of the next one
    uint32_t next_free;  // LIVE, or the index of the next free slot (0: the last)
    uint32_t used;       // generation of the last pass that recorded a use; 0: none yet
    uint32_t padding;    // to 16 bytes, so that the items behind the slots are aligned
};

static const uint32_t live = UINT32_MAX;

enum { ITEM_ALIGNMENT = 32 }; // of 8 lanes

struct place {
    int chunk;
    uint32_t offset;
};

static uint32_t chunk_capacity(int chunk)
{
    return 1u << (RHW_POOL_FIRST_CHUNK_LOG2 + chunk);
}

// Chunk k holds the indices that start at 1 + 2^4·(2^k − 1); adding 2^4 − 1 makes its first one 2^(4 + k).
static struct place place_of(uint32_t index)
{
    const uint32_t n = index - 1 + (1u << RHW_POOL_FIRST_CHUNK_LOG2);
    const int log2 = 31 - __builtin_clz(n);
    return (struct place){log2 - RHW_POOL_FIRST_CHUNK_LOG2, n - (1u << log2)};
}

static struct slot *slot_at(const struct rhw_pool *pool, uint32_t index)
{
    const struct place place = place_of(index);
    return (struct slot *)pool->chunks[place.chunk] + place.offset;
}

static void *item_at(const struct rhw_pool *pool, uint32_t index)
{
    const struct place place = place_of(index);
    unsigned char *const block = pool->chunks[place.chunk];
    return block + chunk_capacity(place.chunk) * sizeof(struct slot) + place.offset * pool->item_size;
}

static size_t chunk_size(const struct rhw_pool *pool, int chunk)
{
    return chunk_capacity(chunk) * (sizeof(struct slot) + pool->item_size);
}

void rhw_pool_init(struct rhw_pool *pool, const char *noun, size_t item_size)
{
    *pool = (struct rhw_pool){.noun = noun,
                              .item_size = (item_size + ITEM_ALIGNMENT - 1) & ~(size_t)(ITEM_ALIGNMENT - 1)};
}

void rhw_pool_destroy(struct rhw_memory *memory, struct rhw_pool *pool)
{
    for (int i = 0; i < RHW_POOL_CHUNKS && pool->chunks[i] != NULL; i++) {
        rhw_memory_release(memory, pool->chunks[i], chunk_size(pool, i));
    }
    rhw_pool_init(pool, pool->noun, pool->item_size);
}

// The index of a slot that no id names; 0 when out of memory.
static uint32_t take_slot(struct rhw_memory *memory, struct rhw_pool *pool)
{
    if (pool->free != 0) {
        const uint32_t index = pool->free;
        pool->free = slot_at(pool, index)->next_free;
        return index;
    }
    const uint32_t index = pool->slots + 1;
    const struct place place = place_of(index);
    if (place.chunk == RHW_POOL_CHUNKS) {
        return 0;
    }
    if (pool->chunks[place.chunk] == NULL) {
        void *const block = rhw_memory_allocate(memory, chunk_size(pool, place.chunk), RHW_CACHE_LINE);
        if (block == NULL) {
            return 0;
        }
        pool->chunks[place.chunk] = block;
    }
    pool->slots = index;
    slot_at(pool, index)->generation = 1;
    return index;
}

void *rhw_pool_add(struct rhw_memory *memory, struct rhw_pool *pool, uint32_t *index, uint32_t *generation)
{
    const uint32_t taken = take_slot(memory, pool);
    if (taken == 0) {
        return NULL;
    }
    struct slot *const slot = slot_at(pool, taken);
    slot->next_free = live;
    slot->used = 0;
    *index = taken;
    *generation = slot->generation;
    return memset(item_at(pool, taken), 0, pool->item_size);
}

void rhw_pool_remove(struct rhw_pool *pool, uint32_t index)
{
    struct slot *const slot = slot_at(pool, index);
    assert(slot->next_free == live);
    slot->generation++;
    slot->next_free = 0;
    // After 2^32 lives a slot rests for good: an id of its first life must stay stale.
    if (slot->generation == 0) {
        return;
    }
    slot->next_free = pool->free;
    pool->free = index;
}

void *rhw_pool_get(const struct rhw_pool *pool, uint32_t index, uint32_t generation)
{
    if (index == 0 || index > pool->slots) {
        return NULL;
    }
    const struct slot *const slot = slot_at(pool, index);
    return slot->next_free == live && slot->generation == generation ? item_at(pool, index) : NULL;
}

void rhw_pool_use(const struct rhw_pool *pool, uint32_t index, uint32_t pass_generation)
{
    slot_at(pool, index)->used = pass_generation;
}

uint32_t rhw_pool_last_use(const struct rhw_pool *pool, uint32_t index)
{
    return slot_at(pool, index)->used;
}

void *rhw_pool_next(const struct rhw_pool *pool, uint32_t *index)
{
    while (*index < pool->slots) {
        ++*index;
        if (slot_at(pool, *index)->next_free == live) {
            return item_at(pool, *index);
        }
    }
    return NULL;
}
