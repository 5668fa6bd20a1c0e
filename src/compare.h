// SPDX-License-Identifier: MIT
// The comparisons of a depth test, which comparing samplers make too.
#ifndef RHW_COMPARE_H
#define RHW_COMPARE_H

#include "simd.h"

// Gives the lanes for which `a compare b` holds.
RHW_INLINE i8 compare_lanes(enum rhw_compare compare, f8 a, f8 b)
{
    switch (compare) {
    case RHW_COMPARE_NEVER: return i8_splat(0);
    case RHW_COMPARE_LESS: return rhw_less(a, b);
    case RHW_COMPARE_EQUAL: return rhw_equal(a, b);
    case RHW_COMPARE_LESS_EQUAL: return rhw_less_equal(a, b);
    case RHW_COMPARE_GREATER: return rhw_less(b, a);
    case RHW_COMPARE_NOT_EQUAL: return ~rhw_equal(a, b);
    case RHW_COMPARE_GREATER_EQUAL: return rhw_less_equal(b, a);
    default: return i8_splat(-1);
    }
}

#endif
