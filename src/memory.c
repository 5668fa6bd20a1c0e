// SPDX-License-Identifier: MIT
// Allocation hooks, the default ones among them, and counting.
//
// Large blocks of the default hooks are pages of the system's own, not malloc's: those come zeroed and take memory only
// where they are touched, so a texture that is created costs nothing until it is drawn or written. They go back when
// they are released.
#include "memory.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>
#if defined(__linux__)
#include <sys/mman.h>
#endif

enum {
    HUGE_PAGE = 2 << 20,     // bytes
    LARGEST_PAGE = 64 << 10, // bytes; of the systems that Linux runs on
    LARGEST_ALIGNMENT = 4096 // bytes; what base.h promises to allocation hooks
};

// Whether a block of the default hooks has pages of its own.
static bool has_own_pages(size_t size)
{
#if defined(__linux__)
    return size >= HUGE_PAGE;
#else
    (void)size;
    return false;
#endif
}

#if defined(__linux__)
// Bytes of the pages that hold `size`.
static size_t pages_size(size_t size)
{
    return (size + LARGEST_PAGE - 1) & ~(size_t)(LARGEST_PAGE - 1);
}

// Targets, arenas and large buffers are walked from end to end by every frame: on huge pages they cost a 512th of the
// page faults and TLB misses.
static void *map_pages(size_t size)
{
    if (size > SIZE_MAX - HUGE_PAGE - LARGEST_PAGE) {
        return NULL;
    }
    // As much more as it takes to begin on a huge page; what lies around that is given back.
    const size_t whole = pages_size(size) + HUGE_PAGE;
    unsigned char *const mapped =
        mmap(NULL, whole, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapped == MAP_FAILED) {
        return NULL;
    }
    const size_t before = -(uintptr_t)mapped % HUGE_PAGE, behind = HUGE_PAGE - before;
    unsigned char *const block = mapped + before;
    if (before != 0) {
        (void)munmap(mapped, before);
    }
    (void)munmap(block + pages_size(size), behind);
#if defined(MADV_HUGEPAGE)
    (void)madvise(block, size & ~(size_t)(HUGE_PAGE - 1), MADV_HUGEPAGE); // advice; may be refused
#endif
    return block;
}
#endif

static void *allocate_default(void *user, size_t size, size_t alignment)
{
    (void)user;
#if defined(__linux__)
    if (has_own_pages(size)) {
        return map_pages(size);
    }
#endif
    void *block = NULL;
    const size_t least = alignment < sizeof(void *) ? sizeof(void *) : alignment;
    return posix_memalign(&block, least, size) == 0 ? block : NULL;
}

static void release_default(void *user, void *block, size_t size)
{
    (void)user;
#if defined(__linux__)
    if (has_own_pages(size)) {
        (void)munmap(block, pages_size(size));
        return;
    }
#endif
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
