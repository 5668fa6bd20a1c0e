// SPDX-License-Identifier: MIT
// Memory from the operating system, which the allocation hooks stand on. pages_posix.c and pages_windows.c implement
// it.
#ifndef RHW_PAGES_H
#define RHW_PAGES_H

#include <stddef.h>

// This is 1 where a large block can be pages of its own, which come zeroed and take memory only where they are touched.
#if defined(__linux__) || defined(_WIN32)
#define RHW_HAS_PAGES 1
#else
#define RHW_HAS_PAGES 0
#endif

// Return `size` zeroed bytes that begin on a page. Return NULL where there are none.
void *rhw_pages_map(size_t size);
// Give pages back. `size` is the size that was given to rhw_pages_map.
void rhw_pages_unmap(void *block, size_t size);

// Call malloc or free, with an alignment that is a power of two and at least a pointer's.
void *rhw_heap_allocate(size_t size, size_t alignment);
void rhw_heap_release(void *block);

#endif
