// SPDX-License-Identifier: MIT
// A pool of items that are named by index and generation. Items live in chunks of doubling size, so that
// growth never moves one and a pointer stays good while its id is live. A slot's generation counts up when
// its item is removed, so that an old id is told from the item that took its place.
#ifndef RHW_RESOURCE_H
#define RHW_RESOURCE_H

#include <stddef.h>
#include <stdint.h>

struct rhw_memory;

enum {
    RHW_POOL_FIRST_CHUNK_LOG2 = 4, // items; chunk k holds 2^(4 + k)
    RHW_POOL_CHUNKS = 24           // 2^28 items, far more than memory holds
};

struct rhw_pool {
    const char *noun; // "buffer", for messages
    size_t item_size; // bytes, rounded up to 32
    uint32_t slots;   // slots that were ever used; the next new index is slots + 1
    uint32_t free;    // index of the first free slot, 0: none
    void *chunks[RHW_POOL_CHUNKS];
};

// Allocates nothing.
void rhw_pool_init(struct rhw_pool *pool, const char *noun, size_t item_size);
// Releases the pool's memory; what items own is released before.
void rhw_pool_destroy(struct rhw_memory *memory, struct rhw_pool *pool);
// A new zeroed item, aligned to 16; NULL when out of memory. Index 0 and generation 0 are never given out.
void *rhw_pool_add(struct rhw_memory *memory, struct rhw_pool *pool, uint32_t *index, uint32_t *generation);
// `index` must be live.
void rhw_pool_remove(struct rhw_pool *pool, uint32_t index);
// NULL when the id is null, was never given out, or is stale.
void *rhw_pool_get(const struct rhw_pool *pool, uint32_t index, uint32_t generation);
// Notes that a pass, by its generation, uses the live item.
void rhw_pool_use(const struct rhw_pool *pool, uint32_t index, uint32_t pass_generation);
// The last pass that did; 0: none yet.
uint32_t rhw_pool_last_use(const struct rhw_pool *pool, uint32_t index);
// Walks the live items: the first one after *index, which is updated; NULL at the end. Start with 0.
void *rhw_pool_next(const struct rhw_pool *pool, uint32_t *index);

#endif
