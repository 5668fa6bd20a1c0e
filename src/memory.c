// SPDX-License-Identifier: MIT
// Allocation hooks, the default ones among them, and counting.
#include "memory.h"

#include <assert.h>
#include <stdlib.h>
#if defined(__linux__)
#include <sys/mman.h>
#endif

enum {
    HUGE_PAGE = 2 << 20,     // bytes
    LARGEST_ALIGNMENT = 4096 // bytes; what base.h promises to allocation hooks
};

// Targets, arenas and large buffers are walked from end to end by every frame: on huge pages they cost a
// 512th of the page faults and TLB misses.
static void *allocate_default(void *user, size_t size, size_t alignment)
{
    (void)user;
    const bool large = size >= HUGE_PAGE;
    size_t align = alignment < sizeof(void *) ? sizeof(void *) : alignment;
    if (large) {
        align = HUGE_PAGE;
    }
    void *block = NULL;
    if (posix_memalign(&block, align, size) != 0) {
        return NULL;
    }
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (large) {
        (void)madvise(block, size & ~(size_t)(HUGE_PAGE - 1), MADV_HUGEPAGE); // advice; may be refused
    }
#endif
    return block;
}

static void release_default(void *user, void *block, size_t size)
{
    (void)user;
    (void)size;
    free(block);
}

struct rhw_allocator rhw_allocator_or_default(struct rhw_allocator allocator)
{
    if (allocator.allocate == NULL) {
        return (struct rhw_allocator){allocate_default, release_default, NULL};
    }
    return allocator;
}

// Hooks never see a size of 0, whose meaning differs between allocators.
static size_t hook_size(size_t size)
{
    return size == 0 ? 1 : size;
}

static void count_allocation(struct rhw_memory *memory, size_t size)
{
    const size_t used = atomic_fetch_add_explicit(&memory->used, size, memory_order_relaxed) + size;
    size_t peak = atomic_load_explicit(&memory->peak, memory_order_relaxed);
    while (peak < used && !atomic_compare_exchange_weak_explicit(
                              &memory->peak, &peak, used, memory_order_relaxed, memory_order_relaxed)) {
        continue;
    }
}

void *rhw_memory_allocate(struct rhw_memory *memory, size_t size, size_t alignment)
{
    assert(alignment != 0 && (alignment & (alignment - 1)) == 0 && alignment <= LARGEST_ALIGNMENT);
    const struct rhw_allocator *const allocator = &memory->allocator;
    void *const block = allocator->allocate(allocator->user, hook_size(size), alignment);
    if (block != NULL) {
        count_allocation(memory, hook_size(size));
    }
    return block;
}

void rhw_memory_release(struct rhw_memory *memory, void *block, size_t size)
{
    if (block == NULL) {
        return;
    }
    atomic_fetch_sub_explicit(&memory->used, hook_size(size), memory_order_relaxed);
    memory->allocator.release(memory->allocator.user, block, hook_size(size));
}
