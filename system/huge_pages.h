// SPDX-License-Identifier: MIT
// Large blocks of memory on huge pages, which cost a 512th of the page faults.
#ifndef SYSTEM_HUGE_PAGES_H
#define SYSTEM_HUGE_PAGES_H

#include <stddef.h>

/// Asks for huge pages where a block that is to be written has whole pages of 2 MiB. The block stays as it is, and what
/// is not written takes no memory but for the rest of its page. Nothing happens for small blocks, and where the system
/// refuses or has none.
void system_huge_pages_prefer(void *block, size_t size);

/// Lets malloc take blocks of less than 32 MiB from `size` bytes, 248 MiB at most, that are asked for on huge pages. A
/// page fault costs 1.4 µs for 4 KiB and 90 µs for 2 MiB, and what is freed serves the next block. Not for a process
/// that lives long, as nothing goes back to the system. Nothing happens under a sanitizer, and where the C library is
/// not glibc.
void system_huge_pages_prefer_heap(size_t size);

#endif
