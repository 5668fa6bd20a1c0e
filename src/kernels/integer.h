// SPDX-License-Identifier: MIT
// The lesser and the greater of two integers: C has no function for them.
#ifndef RHW_INTEGER_H
#define RHW_INTEGER_H

static inline int min_int(int a, int b)
{
    return a < b ? a : b;
}

static inline int max_int(int a, int b)
{
    return a > b ? a : b;
}

#endif
