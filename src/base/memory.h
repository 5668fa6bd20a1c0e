// SPDX-License-Identifier: MIT
// Memory of a context: the allocation hooks, and how many bytes came from them. This file stands below everything else
// and knows nothing of a context, so that arenas, pools and threads can be built on it without one.
#ifndef RHW_MEMORY_H
#define RHW_MEMORY_H

#include <stdatomic.h>

#include "rhw/base.h"

struct rhw_memory {
    struct rhw_allocator allocator; // its hooks are never NULL
    // Bytes. Every thread that allocates writes them; that happens when an arena grows, not per draw.
    _Atomic size_t used, peak;
};

// Return the hooks that the definition of a context gave, or the default ones where it gave zeros.
struct rhw_allocator rhw_allocator_or_default(struct rhw_allocator allocator);

// Allocate memory through the hook, and count it. Every thread may call this. `alignment` is a power of two of at most
// 4096. The contents are undefined. Return NULL when the hook has no memory. A `size` of 0 gives a valid block.
void *rhw_memory_allocate(struct rhw_memory *memory, size_t size, size_t alignment);
// Allocate memory like rhw_memory_allocate, filled with zeros. Large blocks of the default hooks come zeroed, and take
// no memory until they are touched.
void *rhw_memory_allocate_zeroed(struct rhw_memory *memory, size_t size, size_t alignment);
// Give a block back. `size` is the size that was given when it was allocated. `block` may be NULL.
void rhw_memory_release(struct rhw_memory *memory, void *block, size_t size);

#endif
