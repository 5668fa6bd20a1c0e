// SPDX-License-Identifier: MIT
// These functions are the integer arithmetic of 8 lanes that C's operators lack or leave undefined: division, counts of
// bits and their order. A lane of an rhw_int counts as unsigned where a name ends in `uint`. shader_bits_one.h has them
// for one integer. shader.h includes this header.
#ifndef RHW_SHADER_INTEGER_H
#define RHW_SHADER_INTEGER_H

#include "shader_math.h"

#if RHW_HAS_LANES

RHW_QUIET_BEGIN

// Division ------------------------------------------------------------------------------------------
// A quotient of two integers of 32 bits lies at least 2^-32 of itself from the next whole number, unless it is one, and
// a double keeps 2^-53. So the quotient in double, without its fraction, is exact.

typedef int64_t rhw_long4 __attribute__((vector_size(32)));

// Return 4 integers as doubles.
static inline rhw_double4 rhw_double_from_int4(rhw_int4 a)
{
    return __builtin_convertvector(a, rhw_double4);
}

/// Return a / b for signed integers, towards zero. As in WGSL, a divisor of 0 gives a, and −2^31 / −1 gives −2^31.
static inline rhw_int rhw_divide_int(rhw_int a, rhw_int b)
{
    const rhw_int overflow = rhw_equal_int(a, rhw_splat_int(INT32_MIN)) & rhw_equal_int(b, rhw_splat_int(-1));
    union rhw_lanes x, y;
    x.i = a;
    y.i = rhw_select_int(rhw_equal_int(b, rhw_splat_int(0)) | overflow, rhw_splat_int(1), b);
    for (int i = 0; i < 2; i++) {
        const rhw_double4 quotient = rhw_double_from_int4(x.half_i[i]) / rhw_double_from_int4(y.half_i[i]);
        x.half_i[i] = __builtin_convertvector(quotient, rhw_int4);
    }
    return x.i;
}

/// Return the remainder of a / b for signed integers. It has the sign of a. A divisor of 0, and −2^31 / −1, give 0.
static inline rhw_int rhw_remainder_int(rhw_int a, rhw_int b)
{
    const rhw_int none = rhw_equal_int(b, rhw_splat_int(0));
    const rhw_uint product = (rhw_uint)rhw_divide_int(a, b) * (rhw_uint)b; // may wrap
    return ~none & (rhw_int)((rhw_uint)a - product);
}

/// Return a / b for unsigned integers, without its fraction. As in WGSL, a divisor of 0 gives a.
static inline rhw_int rhw_divide_uint(rhw_int a, rhw_int b)
{
    // Conversions are of signed integers alone: 2^31 is taken away before, and added again. A quotient from 2^31 on
    // goes in two parts.
    union rhw_lanes x, y;
    x.i = a ^ INT32_MIN;
    y.i = rhw_select_int(rhw_equal_int(b, rhw_splat_int(0)), rhw_splat_int(1), b) ^ INT32_MIN;
    const rhw_double4 two_31 = {2147483648.0, 2147483648.0, 2147483648.0, 2147483648.0};
    for (int i = 0; i < 2; i++) {
        const rhw_double4 divisor = rhw_double_from_int4(y.half_i[i]) + two_31;
        const rhw_double4 quotient = (rhw_double_from_int4(x.half_i[i]) + two_31) / divisor;
        const rhw_double4 upper = (rhw_double4)((rhw_long4)(quotient >= two_31) & (rhw_long4)two_31);
        const rhw_int4 lower = __builtin_convertvector(quotient - upper, rhw_int4);
        x.half_i[i] = lower | __builtin_convertvector(upper * 0.5, rhw_int4) << 1;
    }
    return x.i;
}

/// Return the remainder of a / b for unsigned integers. A divisor of 0 gives 0.
static inline rhw_int rhw_remainder_uint(rhw_int a, rhw_int b)
{
    const rhw_int none = rhw_equal_int(b, rhw_splat_int(0));
    const rhw_uint product = (rhw_uint)rhw_divide_uint(a, b) * (rhw_uint)b;
    return ~none & (rhw_int)((rhw_uint)a - product);
}

// Bits ----------------------------------------------------------------------------------------------

/// Return how many bits of a are set.
static inline rhw_int rhw_bit_count(rhw_int a)
{
    rhw_uint x = (rhw_uint)a;
    x = x - ((x >> 1) & 0x55555555u);
    x = (x & 0x33333333u) + ((x >> 2) & 0x33333333u);
    x = (x + (x >> 4)) & 0x0f0f0f0fu;
    return (rhw_int)((x * 0x01010101u) >> 24);
}

/// Return the bits of a in the opposite order: bit 0 becomes bit 31.
static inline rhw_int rhw_bit_reverse(rhw_int a)
{
    rhw_uint x = (rhw_uint)a;
    x = (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
    x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
    x = (x >> 4 & 0x0f0f0f0fu) | (x & 0x0f0f0f0fu) << 4;
    x = (x >> 8 & 0x00ff00ffu) | (x & 0x00ff00ffu) << 8;
    return (rhw_int)(x >> 16 | x << 16);
}

/// Return the number of the lowest bit of a that is set, and −1 for 0.
static inline rhw_int rhw_find_lsb(rhw_int a)
{
    const rhw_uint x = (rhw_uint)a;
    const rhw_int below = rhw_bit_count((rhw_int)(~x & (x - 1u)));
    return rhw_select_int(rhw_equal_int(a, rhw_splat_int(0)), rhw_splat_int(-1), below);
}

/// Return the number of the highest bit of a that is set, and −1 for 0.
static inline rhw_int rhw_find_msb_uint(rhw_int a)
{
    rhw_uint x = (rhw_uint)a;
    x |= x >> 1;
    x |= x >> 2;
    x |= x >> 4;
    x |= x >> 8;
    x |= x >> 16;
    return rhw_bit_count((rhw_int)x) - 1;
}

/// Return the number of the highest bit of a signed integer that differs from its sign, and −1 for 0 and −1.
static inline rhw_int rhw_find_msb_int(rhw_int a)
{
    return rhw_find_msb_uint(a ^ (a >> 31));
}

RHW_QUIET_END

#endif

#endif
