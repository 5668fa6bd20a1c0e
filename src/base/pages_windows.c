// SPDX-License-Identifier: MIT
// Pages and heap of Windows.
#include "pages.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <malloc.h>

void *rhw_pages_map(size_t size)
{
    return VirtualAlloc(NULL, size, MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE);
}

void rhw_pages_unmap(void *block, size_t size)
{
    (void)size;
    (void)VirtualFree(block, 0, MEM_RELEASE);
}

void *rhw_heap_allocate(size_t size, size_t alignment)
{
    return _aligned_malloc(size, alignment);
}

void rhw_heap_release(void *block)
{
    _aligned_free(block);
}
