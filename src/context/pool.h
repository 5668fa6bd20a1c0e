// SPDX-License-Identifier: MIT
// A pool has items that programs name by index and generation, and people by a label. Items live in chunks of doubling
// size, so that growth never moves one and a pointer stays good while its id is live. A slot's generation counts up
// when its item is removed, so that an old id is told from the item that took its place.
//
// An item that a pass being recorded needs is retired instead of removed: its id is stale at once, and the item stays
// until the pass has ended.
#ifndef RHW_POOL_H
#define RHW_POOL_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct rhw_memory;

enum {
    RHW_LABEL_SIZE = 64,           // bytes that are kept of a label, with the zero at the end
    RHW_POOL_FIRST_CHUNK_LOG2 = 4, // items; chunk k holds 2^(4 + k)
    RHW_POOL_CHUNKS = 24           // chunks of 2^28 items, far more than memory holds
};

// Copy as much of a label as fits, in whole characters of UTF-8. NULL becomes "".
void rhw_label_copy(char copy[RHW_LABEL_SIZE], const char *label);

struct rhw_pool {
    const char *noun; // "buffer", for messages
    size_t item_size; // bytes, rounded up to 32
    uint32_t slots;   // slots that were ever used; the next new index is slots + 1
    uint32_t free;    // index of the first free slot, 0: none
    uint32_t retired; // index of the first retired item, 0: none
    void *chunks[RHW_POOL_CHUNKS];
    _Atomic bool is_growing; // a thread takes a new slot, or a view of the pool
    struct rhw_pool *viewed; // the pool that a view is of; NULL: it is no view
};

// Make an empty pool. This allocates nothing.
void rhw_pool_init(struct rhw_pool *pool, const char *noun, size_t item_size);
// Release the pool's memory. The caller has released what the items own.
void rhw_pool_destroy(struct rhw_memory *memory, struct rhw_pool *pool);
// Return a new zeroed item, aligned to 32, with a copy of the label, which may be NULL. Return NULL when out of memory.
// Index 0 and generation 0 are never given out.
void *rhw_pool_add(struct rhw_memory *memory, struct rhw_pool *pool, const char *label, uint32_t *index,
                   uint32_t *generation);
// Remove the live item at `index`.
void rhw_pool_remove(struct rhw_memory *memory, struct rhw_pool *pool, uint32_t index);
// Make the id of the live item at `index` stale, and keep the item until it is unretired.
void rhw_pool_retire(struct rhw_memory *memory, struct rhw_pool *pool, uint32_t index);
// Leave a retired copy of a live item, whose contents the caller then replaces. Return false when out of memory.
bool rhw_pool_retire_copy(struct rhw_memory *memory, struct rhw_pool *pool, uint32_t index);
// Return any retired item, or NULL. Its slot is free from now on; the caller releases its contents before the next
// rhw_pool_add.
void *rhw_pool_unretire(struct rhw_pool *pool);
// Return the live item at an index, and its generation.
void *rhw_pool_item(const struct rhw_pool *pool, uint32_t index);
uint32_t rhw_pool_generation(const struct rhw_pool *pool, uint32_t index);
// Make `view` a pool that finds the items of `pool` as they are now. Every thread may call this while another one adds
// items. Nothing is added to a view, and it is not destroyed.
void rhw_pool_view(struct rhw_pool *view, struct rhw_pool *pool);
// Return the label of a live item, or NULL where it has none.
const char *rhw_pool_label(const struct rhw_pool *pool, uint32_t index);
// Return the label of the last item that was destroyed at `index`, if it had that generation. Return NULL where it had
// no label. `index` must have been given out.
const char *rhw_pool_stale_label(const struct rhw_pool *pool, uint32_t index, uint32_t generation);
// Return the item. Return NULL when the id is null, was never given out, or is stale.
void *rhw_pool_get(const struct rhw_pool *pool, uint32_t index, uint32_t generation);
// Note that a pass, by its generation, uses the live item.
void rhw_pool_use(const struct rhw_pool *pool, uint32_t index, uint32_t pass_generation);
// Return the last pass that used the item, or 0 if none did.
uint32_t rhw_pool_last_use(const struct rhw_pool *pool, uint32_t index);
// Walk the live items: return the first one after *index and update *index. Return NULL at the end. Start with 0.
void *rhw_pool_next(const struct rhw_pool *pool, uint32_t *index);

#endif
