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
