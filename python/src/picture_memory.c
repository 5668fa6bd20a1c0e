// SPDX-License-Identifier: MIT
// The system gives memory by pages, which it clears and maps one by one as they are touched: a tenth of the time of a
// small picture with depth and ids. So a few blocks are kept, of any context and thread. There is no lock, as one that
// another thread holds while the process forks would stay held in the child: who takes a block empties its place first.
#include "picture_memory.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>

enum {
    PLACES = 16,
    LEAST_SIZE = 1 << 16, // what is smaller malloc keeps itself
    MOST_BYTES = 1 << 26  // of all that are kept
};

// What stands in a block while it is kept.
struct kept {
    size_t size;
};

static struct kept *_Atomic places[PLACES];
static atomic_size_t bytes;

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

static void drop_all(void)
{
    for (int i = 0; i < PLACES; i++) {
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
    return malloc(size);
}

void python_picture_release(void *block, size_t size)
{
    if (!block || size < LEAST_SIZE || size > MOST_BYTES) {
        free(block);
        return;
    }
    struct kept *const kept = block;
    kept->size = size;
    if (atomic_fetch_add(&bytes, size) + size > MOST_BYTES) {
        drop_all(); // pictures of other sizes than those of late, most likely
    }
    if (!put(kept)) {
        drop_all();
        if (!put(kept)) {
            drop(kept);
        }
    }
}
