// SPDX-License-Identifier: MIT
// Allocation goes through hooks, of which the default ones stand here, and is counted.
//
// Large blocks of the default hooks are pages of the system's own instead of malloc's. Pages come zeroed and take
// memory only where they are touched, so a texture that is created costs nothing until it is drawn or written. Pages go
// back to the system when they are released.
#include "memory.h"

#include <assert.h>
#include <string.h>

#include "pages.h"

enum {
    LARGE_BLOCK = 1 << 20,   // bytes, half of a huge page
    LARGEST_ALIGNMENT = 4096 // bytes; base.h promises this alignment to allocation hooks
};

// Return true if a block of the default hooks has pages of its own.
static bool has_own_pages(size_t size)
{
    return RHW_HAS_PAGES && size >= LARGE_BLOCK;
}

static void *allocate_default(void *user, size_t size, size_t alignment)
{
    (void)user;
    const size_t least = alignment < sizeof(void *) ? sizeof(void *) : alignment;
    return has_own_pages(size) ? rhw_pages_map(size) : rhw_heap_allocate(size, least);
}

static void release_default(void *user, void *block, size_t size)
{
    (void)user;
    if (has_own_pages(size)) {
        rhw_pages_unmap(block, size);
    } else {
        rhw_heap_release(block);
    }
}

struct rhw_allocator rhw_allocator_or_default(struct rhw_allocator allocator)
{
    if (allocator.allocate == NULL) {
        return (struct rhw_allocator){allocate_default, release_default, NULL};
    }
    return allocator;
}

// Return the size that hooks see. It is never 0, which allocators take differently.
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

void *rhw_memory_allocate_zeroed(struct rhw_memory *memory, size_t size, size_t alignment)
{
    void *const block = rhw_memory_allocate(memory, size, alignment);
    const bool is_zero = memory->allocator.allocate == allocate_default && has_own_pages(hook_size(size));
    if (block != NULL && !is_zero) {
        memset(block, 0, size);
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
