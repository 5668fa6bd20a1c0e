// SPDX-License-Identifier: MIT
// The system gives memory by pages, which it clears and maps one by one as they are touched: a tenth of the time of a
// small picture with depth and ids, and a third of that of a step of a training. So a few blocks are kept, of any context and thread. There is no lock, as one that
// another thread holds while the process forks would stay held in the child: who takes a block empties its place first.
#include "picture_memory.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum {
    CACHE_LINE = 64,
    PLACES = 32,
    LEAST_SIZE = 1 << 16, // what is smaller malloc keeps itself
    MOST_BYTES = 1 << 28 // of all that are kept: two pictures of 2048 by 2048 pixels and what belongs to them
};

// What stands in a block while it is kept.
struct kept {
    size_t size;
};

static struct kept *_Atomic places[PLACES];
static atomic_size_t bytes;
static atomic_uint turn;

static bool put(struct kept *block)
{
    for (int i = 0; i < PLACES; i++) {
        struct kept *nothing = NULL;
        if (atomic_compare_exchange_strong(&places[i], &nothing, block)) {
            return true;
        }
    }
    return false;
}

static void drop(struct kept *block)
{
    atomic_fetch_sub(&bytes, block->size);
    free(block);
}

// Drops blocks, those of the first places first, until so many bytes more may be kept.
static void make_room(size_t size)
{
    for (int i = 0; i < PLACES && atomic_load(&bytes) + size > MOST_BYTES; i++) {
        struct kept *const block = atomic_exchange(&places[i], NULL);
        if (block) {
            drop(block);
        }
    }
}

void *python_picture_allocate(size_t size)
{
    for (int i = 0; i < PLACES; i++) {
        struct kept *const block = atomic_exchange(&places[i], NULL);
        if (block && block->size == size) {
            atomic_fetch_sub(&bytes, size);
            return block;
        }
        if (block && !put(block)) {
            drop(block);
        }
    }
    return size <= SIZE_MAX - CACHE_LINE ? aligned_alloc(CACHE_LINE, (size / CACHE_LINE + 1) * CACHE_LINE)
                                         : NULL;
}

void *python_picture_allocate_zeroed(size_t size)
{
    void *const block = python_picture_allocate(size);
    if (block) {
        memset(block, 0, size);
    }
    return block;
}

void python_picture_release(void *block, size_t size)
{
    if (!block || size < LEAST_SIZE || size > MOST_BYTES) {
        free(block);
        return;
    }
    struct kept *const kept = block;
    kept->size = size;
    make_room(size);
    atomic_fetch_add(&bytes, size);
    if (!put(kept)) { // one gives way, and each in its turn: sizes that are wanted no more go so
        struct kept *const other = atomic_exchange(&places[atomic_fetch_add(&turn, 1) % PLACES], kept);
        if (other) {
            drop(other);
        }
    }
}
