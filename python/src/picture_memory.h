// SPDX-License-Identifier: MIT
// Memory of pictures, kept for the next ones when nobody looks at it any more.
#ifndef PYTHON_PICTURE_MEMORY_H
#define PYTHON_PICTURE_MEMORY_H

#include <stddef.h>

/// A block that was kept, or one of malloc; free() may have it in either case. On any thread, with or without the
/// interpreter's lock. NULL without memory.
void *python_picture_allocate(size_t size);
/// Keeps a block of malloc that has at least `size` bytes, or frees it. It may be NULL.
void python_picture_release(void *block, size_t size);

#endif
