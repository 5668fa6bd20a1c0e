// SPDX-License-Identifier: MIT
// The system gives memory by pages, which it clears and maps one by one as they are touched: a tenth of the time of a
// small picture with depth and ids, and a third of that of a step of a training. So a few blocks are kept, of any
// context and thread. There is no lock, as one that another thread holds while the process forks would stay held in the
// child: who takes a block empties its place first.
#include "picture_memory.h"

#include "machine.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum {
    CACHE_LINE = 64,
    PLACES = 32,
    LEAST_SIZE = 1 << 16, // what is smaller malloc keeps itself
    // Bytes of all that are kept. Two pictures of 2048 by 2048 pixels with what a step of a training makes of them are
    // 568 MiB.
    LEAST_LIMIT = 256 << 20,
    MOST_LIMIT = 640 << 20,
    PART_OF_MEMORY = 32
};

// What stands in a block while it is kept.
struct kept {
    size_t size;
};

static struct kept *_Atomic places[PLACES];
static atomic_size_t bytes;
static atomic_uint turn;

// Bytes that may be kept on this machine. The system is asked when a block may first be kept. Threads that ask at the
// same time are told the same.
static size_t limit(void)
{
    static atomic_size_t asked; // 0: not yet
    size_t most = atomic_load(&asked);
    if (most == 0) {
        const size_t part = system_machine_memory() / PART_OF_MEMORY;
        most = part < LEAST_LIMIT ? LEAST_LIMIT : part < MOST_LIMIT ? part : MOST_LIMIT;
        atomic_store(&asked, most);
    }
    return most;
}

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

// Drops blocks, those of the first places first, until at most so many bytes are kept.
static void shrink(size_t most)
{
    for (int i = 0; i < PLACES && atomic_load(&bytes) > most; i++) {
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
    if (size > SIZE_MAX - CACHE_LINE) {
        return NULL;
    }
    const size_t whole = (size / CACHE_LINE + 1) * CACHE_LINE;
    void *const block = aligned_alloc(CACHE_LINE, whole);
    if (block || atomic_load(&bytes) == 0) {
        return block;
    }
    shrink(0); // what is kept may be what is missing
    return aligned_alloc(CACHE_LINE, whole);
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
    if (!block || size < LEAST_SIZE || size > limit()) {
        free(block);
        return;
    }
    struct kept *const kept = block;
    kept->size = size;
    shrink(limit() - size);
    atomic_fetch_add(&bytes, size);
    if (!put(kept)) { // one gives way, and each in its turn: sizes that are wanted no more go so
        struct kept *const other = atomic_exchange(&places[atomic_fetch_add(&turn, 1) % PLACES], kept);
        if (other) {
            drop(other);
        }
    }
}
