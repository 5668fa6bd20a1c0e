// SPDX-License-Identifier: MIT
// A chunk of a pool is one block: its slots come first, then its items.
#include "pool.h"

#include <assert.h>
#include <string.h>

#include "base/constants.h"
#include "base/memory.h"
#include "base/thread.h"

struct slot {
    // Generation of the item that is live or, when none is, of the next one. It is aligned, so that the items behind
    // the slots are aligned.
    _Alignas(32) uint32_t generation;
    // LIVE, or the index of the next free or retired slot; 0 in the last one.
    uint32_t next_free;
    uint32_t used; // generation of the last pass that recorded a use; 0: none yet
    char *label;   // NULL: none
    // The label of the item that lived here before, for messages about its id. NULL: none.
    char *last_label;
};

static const uint32_t live = UINT32_MAX;

enum { ITEM_ALIGNMENT = 32 }; // bytes of 8 lanes

struct place {
    int chunk;
    uint32_t offset;
};

static uint32_t chunk_capacity(int chunk)
{
    return 1u << (RHW_POOL_FIRST_CHUNK_LOG2 + chunk);
}

// Return where an index lies. Chunk k holds the indices that start at 1 + 2^4·(2^k − 1); adding 2^4 − 1 makes its first
// one 2^(4 + k).
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

// Keep other threads out of `slots` and `chunks`. It is for a few instructions, so others spin.
static void begin_growing(struct rhw_pool *pool)
{
    while (atomic_exchange_explicit(&pool->is_growing, true, memory_order_acquire)) {
        rhw_cpu_relax();
    }
}

static void end_growing(struct rhw_pool *pool)
{
    atomic_store_explicit(&pool->is_growing, false, memory_order_release);
}

void rhw_pool_view(struct rhw_pool *view, struct rhw_pool *pool)
{
    begin_growing(pool);
    rhw_pool_init(view, pool->noun, pool->item_size);
    view->viewed = pool;
    view->slots = pool->slots;
    memcpy(view->chunks, pool->chunks, sizeof view->chunks);
    end_growing(pool);
}

void *rhw_pool_item(const struct rhw_pool *pool, uint32_t index)
{
    return item_at(pool, index);
}

uint32_t rhw_pool_generation(const struct rhw_pool *pool, uint32_t index)
{
    return slot_at(pool, index)->generation;
}

void rhw_pool_init(struct rhw_pool *pool, const char *noun, size_t item_size)
{
    *pool = (struct rhw_pool){.noun = noun,
                              .item_size = (item_size + ITEM_ALIGNMENT - 1) & ~(size_t)(ITEM_ALIGNMENT - 1)};
}

static void release_label(struct rhw_memory *memory, char *label)
{
    rhw_memory_release(memory, label, label != NULL ? strlen(label) + 1 : 0);
}

void rhw_label_copy(char copy[RHW_LABEL_SIZE], const char *label)
{
    const char *const end = label == NULL ? NULL : memchr(label, 0, RHW_LABEL_SIZE);
    size_t length = label == NULL ? 0 : end == NULL ? RHW_LABEL_SIZE : (size_t)(end - label);
    if (length == RHW_LABEL_SIZE) {
        // Go back to where a character begins. A character has 4 bytes at most.
        do {
            length--;
        } while (length > RHW_LABEL_SIZE - 4 && ((unsigned char)label[length] & 0xc0) == 0x80);
    }
    if (length != 0) {
        memcpy(copy, label, length);
    }
    copy[length] = 0;
}

// Copy a label into a slot. Return false when out of memory.
static bool copy_label(struct rhw_memory *memory, struct slot *slot, const char *label)
{
    char copy[RHW_LABEL_SIZE];
    rhw_label_copy(copy, label);
    slot->label = NULL;
    if (copy[0] == 0) {
        return true;
    }
    const size_t size = strlen(copy) + 1;
    slot->label = rhw_memory_allocate(memory, size, 1);
    if (slot->label == NULL) {
        return false;
    }
    memcpy(slot->label, copy, size);
    return true;
}

void rhw_pool_destroy(struct rhw_memory *memory, struct rhw_pool *pool)
{
    for (uint32_t index = 1; index <= pool->slots; index++) {
        release_label(memory, slot_at(pool, index)->label);
        release_label(memory, slot_at(pool, index)->last_label);
    }
    for (int i = 0; i < RHW_POOL_CHUNKS && pool->chunks[i] != NULL; i++) {
        rhw_memory_release(memory, pool->chunks[i], chunk_size(pool, i));
    }
    rhw_pool_init(pool, pool->noun, pool->item_size);
}

static void free_slot(struct rhw_pool *pool, uint32_t index)
{
    slot_at(pool, index)->next_free = pool->free;
    pool->free = index;
}

// Return the index of a slot that no id names. Return 0 when out of memory.
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
    void *block = pool->chunks[place.chunk];
    if (block == NULL) {
        block = rhw_memory_allocate(memory, chunk_size(pool, place.chunk), RHW_CACHE_LINE);
        if (block == NULL) {
            return 0;
        }
    }
    begin_growing(pool);
    pool->chunks[place.chunk] = block;
    pool->slots = index;
    *slot_at(pool, index) = (struct slot){.generation = 1};
    end_growing(pool);
    return index;
}

void *rhw_pool_add(struct rhw_memory *memory, struct rhw_pool *pool, const char *label, uint32_t *index,
                   uint32_t *generation)
{
    const uint32_t taken = take_slot(memory, pool);
    if (taken == 0) {
        return NULL;
    }
    struct slot *const slot = slot_at(pool, taken);
    if (!copy_label(memory, slot, label)) {
        free_slot(pool, taken);
        return NULL;
    }
    slot->next_free = live;
    slot->used = 0;
    *index = taken;
    *generation = slot->generation;
    return memset(item_at(pool, taken), 0, pool->item_size);
}

// End the life of an item. From here on its id is stale.
static struct slot *end_life(struct rhw_memory *memory, struct rhw_pool *pool, uint32_t index)
{
    struct slot *const slot = slot_at(pool, index);
    assert(slot->next_free == live);
    release_label(memory, slot->last_label);
    slot->last_label = slot->label;
    slot->label = NULL;
    slot->next_free = 0;
    slot->generation++;
    return slot;
}

// Put a slot back into use. After 2^32 lives it rests for good: an id of its first life must stay stale.
static void reuse_slot(struct rhw_pool *pool, uint32_t index)
{
    if (slot_at(pool, index)->generation != 0) {
        free_slot(pool, index);
    }
}

void rhw_pool_remove(struct rhw_memory *memory, struct rhw_pool *pool, uint32_t index)
{
    end_life(memory, pool, index);
    reuse_slot(pool, index);
}

void rhw_pool_retire(struct rhw_memory *memory, struct rhw_pool *pool, uint32_t index)
{
    end_life(memory, pool, index)->next_free = pool->retired;
    pool->retired = index;
}

bool rhw_pool_retire_copy(struct rhw_memory *memory, struct rhw_pool *pool, uint32_t index)
{
    uint32_t copy, generation;
    void *const item = rhw_pool_add(memory, pool, NULL, &copy, &generation);
    if (item == NULL) {
        return false;
    }
    memcpy(item, item_at(pool, index), pool->item_size);
    rhw_pool_retire(memory, pool, copy);
    return true;
}

void *rhw_pool_unretire(struct rhw_pool *pool)
{
    const uint32_t index = pool->retired;
    if (index == 0) {
        return NULL;
    }
    pool->retired = slot_at(pool, index)->next_free;
    reuse_slot(pool, index);
    return item_at(pool, index);
}

const char *rhw_pool_label(const struct rhw_pool *pool, uint32_t index)
{
    return slot_at(pool, index)->label;
}

const char *rhw_pool_stale_label(const struct rhw_pool *pool, uint32_t index, uint32_t generation)
{
    const struct slot *const slot = slot_at(pool, index);
    return generation + 1 == slot->generation ? slot->last_label : NULL;
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
