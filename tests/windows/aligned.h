// SPDX-License-Identifier: MIT
// Aligned memory as C11 and POSIX have it, for tests that ask for some: on Windows it has a function of its own that
// releases it. Included before such a test's own headers; all that it allocates comes from here.
#ifndef TEST_ALIGNED_H
#define TEST_ALIGNED_H

#include <malloc.h>
#include <stdlib.h>
#include <string.h>

static inline int aligned_take(void **memory, size_t alignment, size_t size)
{
    *memory = _aligned_malloc(size, alignment);
    return *memory == NULL;
}

static inline void *aligned_zeroed(size_t size)
{
    void *const memory = _aligned_malloc(size, 16);
    return memory ? memset(memory, 0, size) : NULL;
}

#define posix_memalign                 aligned_take
#define aligned_alloc(alignment, size) _aligned_malloc(size, alignment)
#define calloc(count, size)            aligned_zeroed((count) * (size))
#define free(memory)                   _aligned_free(memory)

#endif
