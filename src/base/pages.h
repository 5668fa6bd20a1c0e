// SPDX-License-Identifier: MIT
// Memory from the operating system, below the allocation hooks: pages_posix.c, pages_windows.c.
#ifndef RHW_PAGES_H
#define RHW_PAGES_H

#include <stddef.h>

// Whether a large block can be pages of its own, zeroed and taking memory only where they are touched.
#if defined(__linux__) || defined(_WIN32)
#define RHW_HAS_PAGES 1
#else
#define RHW_HAS_PAGES 0
#endif

// `size` zeroed bytes on a page; NULL where there are none.
void *rhw_pages_map(size_t size);
// `size` as it was given to map.
void rhw_pages_unmap(void *block, size_t size);

// malloc and free, at an alignment that is a power of two and at least a pointer's.
void *rhw_heap_allocate(size_t size, size_t alignment);
void rhw_heap_release(void *block);

#endif
