// SPDX-License-Identifier: MIT
// These functions take floats of 8 lanes apart and put them together: exponents and fractions, and several small
// numbers in one integer, as GLSL and WGSL have them. Component 0 stands in the lowest bits. shader_bits_one.h has them
// for one float. shader.h includes this header.
#ifndef RHW_SHADER_PACK_H
#define RHW_SHADER_PACK_H

#include "shader_math.h"

#if RHW_HAS_LANES

RHW_QUIET_BEGIN

// Exponents -----------------------------------------------------------------------------------------

/// Return a · 2^n, rounded once, for any n.
static inline rhw_float rhw_ldexp(rhw_float a, rhw_int n)
{
    // From 300 on every result is 0 or infinity. The powers are floats, and the products are exact in double.
    const rhw_int count = rhw_max_int(rhw_min_int(n, rhw_splat_int(300)), rhw_splat_int(-300));
    const rhw_int first = count >> 2, others = count - 2 * first;
    const struct rhw_double8 twice = rhw_to_double(rhw_power_of_two(first));
    const struct rhw_double8 once = rhw_to_double(rhw_power_of_two(others >> 1));
    const struct rhw_double8 rest = rhw_to_double(rhw_power_of_two(others - (others >> 1)));
    struct rhw_double8 x = rhw_to_double(a);
    x.low = x.low * (twice.low * twice.low) * (once.low * rest.low);
    x.high = x.high * (twice.high * twice.high) * (once.high * rest.high);
    return rhw_from_double(x);
}

/// Split a into a fraction with 0.5 ≤ |fraction| < 1, which is returned, and `*exponent`, so that a is fraction ·
/// 2^exponent. 0, infinity and NaN are their own fraction, with the exponent 0.
static inline rhw_float rhw_frexp(rhw_float a, rhw_int *exponent)
{
    const rhw_float magnitude = rhw_abs(a);
    const rhw_int tiny = rhw_less(magnitude, rhw_splat(1.17549435e-38f)); // a is denormal or 0
    const rhw_int bits = (rhw_int)rhw_select(tiny, a * 16777216.0f, a);
    const rhw_int plain = rhw_less(rhw_splat(0.0f), magnitude) & rhw_less(magnitude, rhw_infinity());
    *exponent = plain & ((bits >> 23 & 0xff) - 126 + (tiny & -24));
    return rhw_select(plain, (rhw_float)((bits & (INT32_MIN | 0x7fffff)) | 0x3f000000), a);
}

/// Split a into a whole number, `*whole`, towards zero, and the rest, which is returned. Both have the sign of a. The
/// rest of infinity is 0.
static inline rhw_float rhw_modf(rhw_float a, rhw_float *whole)
{
    *whole = rhw_trunc(a);
    const rhw_float rest = rhw_select(rhw_equal(rhw_abs(a), rhw_infinity()), rhw_splat(0.0f), a - *whole);
    return rhw_select(rhw_equal(a, a), rhw_copysign(rest, a), a);
}

// Normalized numbers --------------------------------------------------------------------------------

/// Return 4 numbers of 0..1 in 8 bits each: 255 times the clamped number, rounded to nearest, ties to even. NaN gives
/// 0.
static inline rhw_int rhw_pack_unorm4x8(const rhw_float v[4])
{
    rhw_int packed = rhw_splat_int(0);
    for (int i = 0; i < 4; i++) {
        packed |= rhw_int_from_float_unchecked(rhw_round(rhw_saturate(v[i]) * 255.0f)) << (8 * i);
    }
    return packed;
}

/// Return 4 numbers of −1..1 in 8 bits each: 127 times the clamped number, rounded to nearest, ties to even. NaN
/// gives −127.
static inline rhw_int rhw_pack_snorm4x8(const rhw_float v[4])
{
    rhw_int packed = rhw_splat_int(0);
    for (int i = 0; i < 4; i++) {
        const rhw_float clamped = rhw_clamp(v[i], rhw_splat(-1.0f), rhw_splat(1.0f));
        packed |= (rhw_int_from_float_unchecked(rhw_round(clamped * 127.0f)) & 0xff) << (8 * i);
    }
    return packed;
}

/// Return 2 numbers of 0..1 in 16 bits each: 65535 times the clamped number, rounded to nearest, ties to even. NaN
/// gives 0.
static inline rhw_int rhw_pack_unorm2x16(const rhw_float v[2])
{
    rhw_int packed = rhw_splat_int(0);
    for (int i = 0; i < 2; i++) {
        packed |= rhw_int_from_float_unchecked(rhw_round(rhw_saturate(v[i]) * 65535.0f)) << (16 * i);
    }
    return packed;
}

/// Return 2 numbers of −1..1 in 16 bits each: 32767 times the clamped number, rounded to nearest, ties to even. NaN
/// gives −32767.
static inline rhw_int rhw_pack_snorm2x16(const rhw_float v[2])
{
    rhw_int packed = rhw_splat_int(0);
    for (int i = 0; i < 2; i++) {
        const rhw_float clamped = rhw_clamp(v[i], rhw_splat(-1.0f), rhw_splat(1.0f));
        packed |= (rhw_int_from_float_unchecked(rhw_round(clamped * 32767.0f)) & 0xffff) << (16 * i);
    }
    return packed;
}

/// Set `v` to the 4 numbers of 0..1 that rhw_pack_unorm4x8 packs, each over 255.
static inline void rhw_unpack_unorm4x8(rhw_int a, rhw_float v[4])
{
    for (int i = 0; i < 4; i++) {
        v[i] = rhw_float_from_int(a >> (8 * i) & 0xff) / 255.0f;
    }
}

/// Set `v` to the 4 numbers of −1..1 that rhw_pack_snorm4x8 packs, each over 127. −128 gives −1 too.
static inline void rhw_unpack_snorm4x8(rhw_int a, rhw_float v[4])
{
    for (int i = 0; i < 4; i++) {
        const rhw_int field = (rhw_int)((rhw_uint)a << (24 - 8 * i)) >> 24;
        v[i] = rhw_max(rhw_float_from_int(field) / 127.0f, rhw_splat(-1.0f));
    }
}

/// Set `v` to the 2 numbers of 0..1 that rhw_pack_unorm2x16 packs, each over 65535.
static inline void rhw_unpack_unorm2x16(rhw_int a, rhw_float v[2])
{
    for (int i = 0; i < 2; i++) {
        v[i] = rhw_float_from_int(a >> (16 * i) & 0xffff) / 65535.0f;
    }
}

/// Set `v` to the 2 numbers of −1..1 that rhw_pack_snorm2x16 packs, each over 32767. −32768 gives −1 too.
static inline void rhw_unpack_snorm2x16(rhw_int a, rhw_float v[2])
{
    for (int i = 0; i < 2; i++) {
        const rhw_int field = (rhw_int)((rhw_uint)a << (16 - 16 * i)) >> 16;
        v[i] = rhw_max(rhw_float_from_int(field) / 32767.0f, rhw_splat(-1.0f));
    }
}

// Half floats ---------------------------------------------------------------------------------------

/// Return the bits of the half float nearest to a, ties to even, in the lower 16 bits. From 65520 on it is infinity.
/// NaN gives 0x7e00.
static inline rhw_int rhw_half_bits_from_float(rhw_float a)
{
    const rhw_int sign = (rhw_int)a >> 16 & 0x8000;
    const rhw_float magnitude = rhw_abs(a);
    const rhw_int bits = (rhw_int)magnitude;
    // A sum with 0.5 keeps just the bits that a denormal half has, and rounds to them.
    const rhw_int small = (rhw_int)((rhw_uint)(rhw_int)(magnitude + 0.5f) - 0x3f000000u);
    const rhw_int normal =
        (rhw_int)((rhw_uint)bits - 0x38000000u + 0xfffu + (rhw_uint)(bits >> 13 & 1)) >> 13;
    rhw_int half = rhw_select_int(rhw_less(magnitude, rhw_splat(6.10351562e-05f)), small, normal);
    half = rhw_select_int(rhw_less(magnitude, rhw_splat(65520.0f)), half, rhw_splat_int(0x7c00));
    return rhw_select_int(rhw_equal(a, a), half | sign, rhw_splat_int(0x7e00));
}

/// Return the float that the lower 16 bits are as a half float.
static inline rhw_float rhw_float_from_half_bits(rhw_int a)
{
    const rhw_int magnitude = a & 0x7fff;
    const rhw_int normal = (magnitude << 13) + 0x38000000;
    const rhw_float small = rhw_float_from_int(magnitude) * 5.9604644775390625e-08f;
    rhw_float value = rhw_select(rhw_less_int(magnitude, rhw_splat_int(0x400)), small, (rhw_float)normal);
    value = rhw_select(rhw_less_int(magnitude, rhw_splat_int(0x7c00)), value, rhw_infinity());
    value = rhw_select(rhw_less_int(rhw_splat_int(0x7c00), magnitude), rhw_nan(), value);
    return (rhw_float)((rhw_int)value | (a & 0x8000) << 16);
}

/// Return 2 numbers as half floats.
static inline rhw_int rhw_pack_half2x16(const rhw_float v[2])
{
    return rhw_half_bits_from_float(v[0]) | rhw_half_bits_from_float(v[1]) << 16;
}

/// Set `v` to the 2 numbers that rhw_pack_half2x16 packs.
static inline void rhw_unpack_half2x16(rhw_int a, rhw_float v[2])
{
    v[0] = rhw_float_from_half_bits(a);
    v[1] = rhw_float_from_half_bits(a >> 16);
}

RHW_QUIET_END

#endif

#endif
