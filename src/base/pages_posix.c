// SPDX-License-Identifier: MIT
// Pages of Linux, and the heap of every POSIX system.
#if defined(__linux__) && !defined(_DEFAULT_SOURCE)
#define _DEFAULT_SOURCE // for MAP_ANONYMOUS
#endif
#include "pages.h"

#include <stdint.h>
#include <stdlib.h>
#if defined(__linux__)
#include <sys/mman.h>

enum {
    HUGE_PAGE = 2 << 20, // bytes
    ENOUGH = 512 << 10,  // bytes that are worth a huge page
    // Bytes of the largest page of the systems that Linux runs on.
    LARGEST_PAGE = 64 << 10
};

// Return the bytes of the pages that hold `size`. What is left behind the last whole huge page gets another one where
// that costs less than its page faults, of which each takes 1.4 µs for 4 KiB and 90 µs for 2 MiB, and makes the block
// no more than half as large again.
static size_t pages_size(size_t size)
{
    const size_t rest = size % HUGE_PAGE;
    const size_t page = rest >= ENOUGH && HUGE_PAGE - rest <= size / 2 ? HUGE_PAGE : LARGEST_PAGE;
    return (size + page - 1) & ~(page - 1);
}

// Every frame walks targets, arenas and large buffers from end to end. On huge pages they cost a 512th of the page
// faults and TLB misses.
void *rhw_pages_map(size_t size)
{
    if (size > SIZE_MAX - 2 * HUGE_PAGE) {
        return NULL;
    }
    // Map as much more as it takes to begin on a huge page. What lies around the block is given back.
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
    // The system may refuse this advice.
    (void)madvise(block, pages_size(size) & ~(size_t)(HUGE_PAGE - 1), MADV_HUGEPAGE);
#endif
    return block;
}

void rhw_pages_unmap(void *block, size_t size)
{
    (void)munmap(block, pages_size(size));
}

#else

void *rhw_pages_map(size_t size)
{
    (void)size;
    return NULL;
}

void rhw_pages_unmap(void *block, size_t size)
{
    (void)block;
    (void)size;
}

#endif

void *rhw_heap_allocate(size_t size, size_t alignment)
{
    void *block = NULL;
    return posix_memalign(&block, alignment, size) == 0 ? block : NULL;
}

void rhw_heap_release(void *block)
{
    free(block);
}
