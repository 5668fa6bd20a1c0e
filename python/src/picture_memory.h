// SPDX-License-Identifier: MIT
// Memory of pictures and of what rhw.diff works with, kept for the next ones when nobody looks at it any more.
#ifndef PYTHON_PICTURE_MEMORY_H
#define PYTHON_PICTURE_MEMORY_H

#include <stddef.h>

/// A block that was kept, or a new one, at the start of a cache line; free() may have it in either case. On any thread,
/// with or without the interpreter's lock. NULL without memory.
void *python_picture_allocate(size_t size);
/// Keeps a block of python_picture_allocate that has at least `size` bytes, or frees it. It may be NULL.
void python_picture_release(void *block, size_t size);
/// The first, zeroed.
void *python_picture_allocate_zeroed(size_t size);

#endif
