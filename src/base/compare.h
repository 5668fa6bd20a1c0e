// SPDX-License-Identifier: MIT
// The comparisons of a depth test. Samplers that compare use them too.
#ifndef RHW_COMPARE_H
#define RHW_COMPARE_H

#include "simd.h"

// Return the lanes for which `a compare b` holds.
RHW_INLINE i32x8 compare_lanes(enum rhw_compare compare, f32x8 a, f32x8 b)
{
    switch (compare) {
    case RHW_COMPARE_NEVER: return i32x8_splat(0);
    case RHW_COMPARE_LESS: return rhw_less(a, b);
    case RHW_COMPARE_EQUAL: return rhw_equal(a, b);
    case RHW_COMPARE_LESS_EQUAL: return rhw_less_equal(a, b);
    case RHW_COMPARE_GREATER: return rhw_less(b, a);
    case RHW_COMPARE_NOT_EQUAL: return ~rhw_equal(a, b);
    case RHW_COMPARE_GREATER_EQUAL: return rhw_less_equal(b, a);
    default: return i32x8_splat(-1);
    }
}

// Return the lanes of four for which `a compare b` holds.
RHW_INLINE i32x4 compare_lanes4(enum rhw_compare compare, f32x4 a, f32x4 b)
{
    const i32x4 none = {0, 0, 0, 0};
    switch (compare) {
    case RHW_COMPARE_NEVER: return none;
    case RHW_COMPARE_LESS: return a < b;
    case RHW_COMPARE_EQUAL: return a == b;
    case RHW_COMPARE_LESS_EQUAL: return a <= b;
    case RHW_COMPARE_GREATER: return a > b;
    case RHW_COMPARE_NOT_EQUAL: return a != b;
    case RHW_COMPARE_GREATER_EQUAL: return a >= b;
    default: return ~none;
    }
}

// Return true if `a compare b` holds for two numbers.
RHW_INLINE bool compare_numbers(enum rhw_compare compare, float a, float b)
{
    switch (compare) {
    case RHW_COMPARE_NEVER: return false;
    case RHW_COMPARE_LESS: return a < b;
    case RHW_COMPARE_EQUAL: return a == b;
    case RHW_COMPARE_LESS_EQUAL: return a <= b;
    case RHW_COMPARE_GREATER: return a > b;
    case RHW_COMPARE_NOT_EQUAL: return a != b;
    case RHW_COMPARE_GREATER_EQUAL: return a >= b;
    default: return true;
    }
}

#endif
