// SPDX-License-Identifier: MIT
// The allocating functions of the C library, as the driver calls them: they are counted, and some may fail. The program
// defines malloc and its like, which stand before those of the library. Calls from elsewhere are passed on.
#ifndef TEST_SCARCE_MALLOC_H
#define TEST_SCARCE_MALLOC_H

#include <stdbool.h>

// Count from 0, and let call `fail_at` of the driver fail, with all that follow it if `stays`. -1 lets none fail. The
// driver has been loaded.
void scarce_malloc_begin(int fail_at, bool stays);

// Return how many calls there were, and let none fail any more.
int scarce_malloc_end(void);

#endif
