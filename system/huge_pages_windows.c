// SPDX-License-Identifier: MIT
// See huge_pages.h. Huge pages of Windows need a privilege that programs do not have.
#include "huge_pages.h"

void system_huge_pages_prefer(void *block, size_t size)
{
    (void)block;
    (void)size;
}

void system_huge_pages_prefer_heap(size_t size)
{
    (void)size;
}
