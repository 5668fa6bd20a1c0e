// SPDX-License-Identifier: MIT
// Memory of a context: the allocation hooks, and how many bytes came from them. It stands below everything else and
// knows nothing of a context, so that arenas, pools and threads can be built on it without one.
#ifndef RHW_MEMORY_H
#define RHW_MEMORY_H

#include <stdatomic.h>

#include "rhw/base.h"

struct rhw_memory {
    struct rhw_allocator allocator; // never NULL inside
    // Bytes; written by every thread that allocates, which happens when an arena grows, not per draw.
    _Atomic size_t used, peak;
};

// The hooks as the definition of a context gave them; zeroed means the default ones.
struct rhw_allocator rhw_allocator_or_default(struct rhw_allocator allocator);

// Memory through the allocation hook, counted. Safe from every thread. `alignment` is a power of two of at
// most 4096. Contents are undefined; NULL when the hook has none. `size` 0 gives a valid block.
void *rhw_memory_allocate(struct rhw_memory *memory, size_t size, size_t alignment);
// The same with zeros. Large blocks of the default hooks are so already, and take no memory until they are touched.
void *rhw_memory_allocate_zeroed(struct rhw_memory *memory, size_t size, size_t alignment);
// `size` as it was given to allocate. A NULL `block` is allowed.
void rhw_memory_release(struct rhw_memory *memory, void *block, size_t size);

#endif
