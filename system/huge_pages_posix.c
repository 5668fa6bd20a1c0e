// SPDX-License-Identifier: MIT
// See huge_pages.h. Only Linux is asked: elsewhere the system decides by itself.
#if defined(__linux__) && !defined(_DEFAULT_SOURCE)
#define _DEFAULT_SOURCE // for madvise
#endif
#include "huge_pages.h"

#include <stdint.h>
#if defined(__linux__)
#include <sys/mman.h>
#endif
#if defined(__GLIBC__)
#include <malloc.h>
#include <stdlib.h>
#include <unistd.h>
#endif

#include "sanitizer.h"

void system_huge_pages_prefer(void *block, size_t size)
{
#if defined(MADV_HUGEPAGE)
    enum { HUGE_PAGE = 2 << 20, LEAST = 2 * HUGE_PAGE }; // bytes
    if (size >= LEAST) {
        const size_t before = -(uintptr_t)block % HUGE_PAGE;
        (void)madvise((char *)block + before, (size - before) & ~(size_t)(HUGE_PAGE - 1), MADV_HUGEPAGE);
    }
#else
    (void)block;
    (void)size;
#endif
}

// Sanitizers have a heap of their own. In a child of a process with threads it may wait for ever when large blocks are
// freed: it looks after what was freed before, under a lock that a thread of the parent held.
void system_huge_pages_prefer_heap(size_t size)
{
#if defined(MADV_HUGEPAGE) && defined(__GLIBC__) && !SYSTEM_SANITIZED
    enum { PAGE = 4096, BLOCK = 31 << 20, LARGEST = 32 << 20, BLOCKS = 8 }; // bytes; blocks
    // Blocks up to the largest size that glibc allows come from the heap, and what is freed stays in it.
    (void)mallopt(M_MMAP_THRESHOLD, LARGEST);
    (void)mallopt(M_TRIM_THRESHOLD, 1 << 30);
    (void)mallopt(M_ARENA_MAX, 1); // threads have no heaps of their own
    void *blocks[BLOCKS] = {NULL};
    char *const first = (char *)sbrk(0) - (uintptr_t)sbrk(0) % PAGE;
    for (size_t i = 0; i < BLOCKS && size > 0; i++) {
        const size_t part = size < BLOCK ? size : BLOCK;
        blocks[i] = malloc(part);
        size -= part;
    }
    char *const end = sbrk(0);
    for (size_t i = 0; i < BLOCKS; i++) {
        free(blocks[i]);
    }
    if (end > first) {
        (void)madvise(first, (size_t)(end - first), MADV_HUGEPAGE);
    }
#else
    (void)size;
#endif
}
