// SPDX-License-Identifier: MIT
// These functions are the arithmetic of 8 lanes that C's operators lack: comparison, selection, rounding and
// conversion. All of it is IEEE 754 arithmetic without contraction, so it gives the same bits on every instruction set.
// With shader_scalar.h a plain number may stand in place of lanes. shader.h includes this header.
//
// Intrinsics, and halves of 4 lanes, stand where compilers turn the plain form into scalar code. gcc 12 makes scalar
// code of most of these functions unless it has AVX.
#ifndef RHW_SHADER_VECTOR_H
#define RHW_SHADER_VECTOR_H

#include "shader_lanes.h"

#if RHW_HAS_LANES

#if defined(__AVX2__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

#include <stdbool.h>
#include <string.h>

RHW_QUIET_BEGIN

/// 8 lanes seen as two registers of 16 bytes. Only the headers of rhw use it.
union rhw_lanes {
    rhw_float f;
    rhw_int i;
    rhw_float4 half[2];
    rhw_int4 half_i[2];
};

// Making lanes --------------------------------------------------------------------------------------

/// Return 8 lanes that are equal to `value`.
static inline rhw_float rhw_splat(float value)
{
#if defined(__AVX2__)
    const rhw_float lanes = {value, value, value, value, value, value, value, value};
    return lanes;
#else
    // gcc 12 would store the plain form lane by lane and load the lanes back, which stalls.
    const rhw_float4 half = {value, value, value, value};
    union rhw_lanes x;
    x.half[0] = x.half[1] = half;
    return x.f;
#endif
}

/// Return 8 integer lanes that are equal to `value`.
static inline rhw_int rhw_splat_int(int32_t value)
{
#if defined(__AVX2__)
    const rhw_int lanes = {value, value, value, value, value, value, value, value};
    return lanes;
#else
    const rhw_int4 half = {value, value, value, value};
    union rhw_lanes x;
    x.half_i[0] = x.half_i[1] = half;
    return x.i;
#endif
}

/// Return 0, 1, 2, 3, 4, 5, 6, 7.
static inline rhw_int rhw_lane_numbers(void)
{
    const rhw_int lanes = {0, 1, 2, 3, 4, 5, 6, 7};
    return lanes;
}

// Comparison and selection --------------------------------------------------------------------------
// C's operators < and <= give the same masks as these functions, but gcc 12 without AVX makes scalar code of them. A
// mask is −1 in lanes where the comparison holds and 0 in the others. NaN gives 0, but −1 in rhw_not_equal.

/// Return the mask of a < b.
static inline rhw_int rhw_less(rhw_float a, rhw_float b)
{
#if defined(__AVX2__)
    return (rhw_int)_mm256_cmp_ps((__m256)a, (__m256)b, _CMP_LT_OQ);
#else
    union rhw_lanes x, y;
    x.f = a;
    y.f = b;
    x.half_i[0] = x.half[0] < y.half[0];
    x.half_i[1] = x.half[1] < y.half[1];
    return x.i;
#endif
}

/// Return the mask of a ≤ b.
static inline rhw_int rhw_less_equal(rhw_float a, rhw_float b)
{
#if defined(__AVX2__)
    return (rhw_int)_mm256_cmp_ps((__m256)a, (__m256)b, _CMP_LE_OQ);
#else
    union rhw_lanes x, y;
    x.f = a;
    y.f = b;
    x.half_i[0] = x.half[0] <= y.half[0];
    x.half_i[1] = x.half[1] <= y.half[1];
    return x.i;
#endif
}

/// Return the mask of a = b. rhw_equal(a, a) is 0 where a is NaN.
static inline rhw_int rhw_equal(rhw_float a, rhw_float b)
{
#if defined(__AVX2__)
    return (rhw_int)_mm256_cmp_ps((__m256)a, (__m256)b, _CMP_EQ_OQ);
#else
    union rhw_lanes x, y;
    x.f = a;
    y.f = b;
    x.half_i[0] = x.half[0] == y.half[0];
    x.half_i[1] = x.half[1] == y.half[1];
    return x.i;
#endif
}

/// Return the mask of a > b.
static inline rhw_int rhw_greater(rhw_float a, rhw_float b)
{
    return rhw_less(b, a);
}

/// Return the mask of a ≥ b.
static inline rhw_int rhw_greater_equal(rhw_float a, rhw_float b)
{
    return rhw_less_equal(b, a);
}

/// Return the opposite of rhw_equal: −1 where a and b differ or one of them is NaN.
static inline rhw_int rhw_not_equal(rhw_float a, rhw_float b)
{
    return ~rhw_equal(a, b);
}

/// Return the mask of a < b for signed integers.
static inline rhw_int rhw_less_int(rhw_int a, rhw_int b)
{
#if defined(__AVX2__)
    return (rhw_int)_mm256_cmpgt_epi32((__m256i)b, (__m256i)a);
#else
    union rhw_lanes x, y;
    x.i = a;
    y.i = b;
    x.half_i[0] = x.half_i[0] < y.half_i[0];
    x.half_i[1] = x.half_i[1] < y.half_i[1];
    return x.i;
#endif
}

/// Return the mask of a = b for integers.
static inline rhw_int rhw_equal_int(rhw_int a, rhw_int b)
{
#if defined(__AVX2__)
    return (rhw_int)_mm256_cmpeq_epi32((__m256i)a, (__m256i)b);
#else
    union rhw_lanes x, y;
    x.i = a;
    y.i = b;
    x.half_i[0] = x.half_i[0] == y.half_i[0];
    x.half_i[1] = x.half_i[1] == y.half_i[1];
    return x.i;
#endif
}

/// Return a where mask is −1 and b where mask is 0. The result of another mask depends on the instruction set, so make
/// masks by comparison.
static inline rhw_float rhw_select(rhw_int mask, rhw_float a, rhw_float b)
{
#if defined(__AVX2__)
    return (rhw_float)_mm256_blendv_ps((__m256)b, (__m256)a, (__m256)mask);
#else
    return (rhw_float)((mask & (rhw_int)a) | (~mask & (rhw_int)b));
#endif
}

/// Return a where mask is −1 and b where mask is 0, for integers. The result of another mask depends on the instruction
/// set, so make masks by comparison.
static inline rhw_int rhw_select_int(rhw_int mask, rhw_int a, rhw_int b)
{
#if defined(__AVX2__)
    return (rhw_int)_mm256_blendv_ps((__m256)b, (__m256)a, (__m256)mask);
#else
    return (mask & a) | (~mask & b);
#endif
}

/// Return an integer whose bit i is set if lane i of the mask is −1.
static inline int rhw_mask_bits(rhw_int mask)
{
#if defined(__AVX2__)
    return _mm256_movemask_ps((__m256)mask);
#elif defined(__SSE2__)
    union rhw_lanes x;
    x.i = mask;
    return _mm_movemask_ps((__m128)x.half[0]) | _mm_movemask_ps((__m128)x.half[1]) << 4;
#elif defined(__wasm_simd128__)
    union rhw_lanes x;
    x.i = mask;
    return (int)(wasm_i32x4_bitmask((v128_t)x.half_i[0]) | wasm_i32x4_bitmask((v128_t)x.half_i[1]) << 4);
#else
    const rhw_int bit = {1, 2, 4, 8, 16, 32, 64, 128};
    union rhw_lanes x;
    x.i = mask & bit;
    const rhw_int4 half = x.half_i[0] | x.half_i[1];
#if defined(__aarch64__)
    return vaddvq_s32((int32x4_t)half);
#else
    return half[0] | half[1] | half[2] | half[3];
#endif
#endif
}

/// Return true if the mask is −1 in at least one lane.
static inline bool rhw_any(rhw_int mask)
{
    return rhw_mask_bits(mask) != 0;
}

/// Return true if the mask is −1 in every lane.
static inline bool rhw_all(rhw_int mask)
{
    return rhw_mask_bits(mask) == 0xff;
}

/// Return a where a < b, and b elsewhere. The result is b if one of them is NaN or both are zeros.
static inline rhw_float rhw_min(rhw_float a, rhw_float b)
{
#if defined(__AVX2__)
    return (rhw_float)_mm256_min_ps((__m256)a, (__m256)b);
#elif defined(__SSE2__)
    union rhw_lanes x, y;
    x.f = a;
    y.f = b;
    x.half[0] = (rhw_float4)_mm_min_ps((__m128)x.half[0], (__m128)y.half[0]);
    x.half[1] = (rhw_float4)_mm_min_ps((__m128)x.half[1], (__m128)y.half[1]);
    return x.f;
#elif defined(__wasm_simd128__)
    union rhw_lanes x, y;
    x.f = a;
    y.f = b;
    x.half[0] = (rhw_float4)wasm_f32x4_pmin((v128_t)y.half[0], (v128_t)x.half[0]);
    x.half[1] = (rhw_float4)wasm_f32x4_pmin((v128_t)y.half[1], (v128_t)x.half[1]);
    return x.f;
#else
    return rhw_select(rhw_less(a, b), a, b);
#endif
}

/// Return a where a > b, and b elsewhere. The result is b if one of them is NaN or both are zeros.
static inline rhw_float rhw_max(rhw_float a, rhw_float b)
{
#if defined(__AVX2__)
    return (rhw_float)_mm256_max_ps((__m256)a, (__m256)b);
#elif defined(__SSE2__)
    union rhw_lanes x, y;
    x.f = a;
    y.f = b;
    x.half[0] = (rhw_float4)_mm_max_ps((__m128)x.half[0], (__m128)y.half[0]);
    x.half[1] = (rhw_float4)_mm_max_ps((__m128)x.half[1], (__m128)y.half[1]);
    return x.f;
#elif defined(__wasm_simd128__)
    union rhw_lanes x, y;
    x.f = a;
    y.f = b;
    x.half[0] = (rhw_float4)wasm_f32x4_pmax((v128_t)y.half[0], (v128_t)x.half[0]);
    x.half[1] = (rhw_float4)wasm_f32x4_pmax((v128_t)y.half[1], (v128_t)x.half[1]);
    return x.f;
#else
    return rhw_select(rhw_less(b, a), a, b);
#endif
}

/// Return the smaller of two signed integers.
static inline rhw_int rhw_min_int(rhw_int a, rhw_int b)
{
#if defined(__AVX2__)
    return (rhw_int)_mm256_min_epi32((__m256i)a, (__m256i)b);
#else
    return rhw_select_int(rhw_less_int(a, b), a, b);
#endif
}

/// Return the larger of two signed integers.
static inline rhw_int rhw_max_int(rhw_int a, rhw_int b)
{
#if defined(__AVX2__)
    return (rhw_int)_mm256_max_epi32((__m256i)a, (__m256i)b);
#else
    return rhw_select_int(rhw_less_int(a, b), b, a);
#endif
}

/// Return a clamped to low..high. NaN gives low.
static inline rhw_float rhw_clamp(rhw_float a, rhw_float low, rhw_float high)
{
    return rhw_min(rhw_max(a, low), high);
}

/// Return a clamped to 0..1. NaN and −0 give 0.
static inline rhw_float rhw_saturate(rhw_float a)
{
    return rhw_clamp(a, rhw_splat(0.0f), rhw_splat(1.0f));
}

// Conversion ----------------------------------------------------------------------------------------
// C's cast (rhw_int)a keeps the bits of 8 lanes, though (int32_t)a converts the value of one number. The names of these
// functions say which of the two they do.

/// Return the bits of each lane, unchanged.
static inline rhw_int rhw_bits_from_float(rhw_float a)
{
    return (rhw_int)a;
}

/// Return the floats that have these bits.
static inline rhw_float rhw_float_from_bits(rhw_int a)
{
    return (rhw_float)a;
}

/// Return the float nearest to a signed integer, ties to even.
static inline rhw_float rhw_float_from_int(rhw_int a)
{
#if defined(__AVX2__)
    return __builtin_convertvector(a, rhw_float);
#else
    union rhw_lanes x;
    x.i = a;
    x.half[0] = __builtin_convertvector(x.half_i[0], rhw_float4);
    x.half[1] = __builtin_convertvector(x.half_i[1], rhw_float4);
    return x.f;
#endif
}

/// Return a truncated towards zero. a must lie within −2^31 ≤ a < 2^31 in every lane whose result is used. This takes
/// one instruction where rhw_int_from_float takes five.
static inline rhw_int rhw_int_from_float_unchecked(rhw_float a)
{
#if defined(__AVX2__)
    return (rhw_int)_mm256_cvttps_epi32((__m256)a);
#elif defined(__SSE2__)
    union rhw_lanes x;
    x.f = a;
    x.half_i[0] = (rhw_int4)_mm_cvttps_epi32((__m128)x.half[0]);
    x.half_i[1] = (rhw_int4)_mm_cvttps_epi32((__m128)x.half[1]);
    return x.i;
#else
    // Lanes that do not fit become 0 first, because C does not define their conversion.
    const rhw_int fits = rhw_less_equal(rhw_splat(-2147483648.0f), a) & rhw_less(a, rhw_splat(2147483648.0f));
    union rhw_lanes x;
    x.i = (rhw_int)a & fits;
    x.half_i[0] = __builtin_convertvector(x.half[0], rhw_int4);
    x.half_i[1] = __builtin_convertvector(x.half[1], rhw_int4);
    return x.i;
#endif
}

/// Return a truncated towards zero. Numbers below −2^31 give −2^31, numbers from 2^31 on give 2^31 − 1, and NaN gives
/// 0.
static inline rhw_int rhw_int_from_float(rhw_float a)
{
    const rhw_int above = rhw_less_equal(rhw_splat(2147483648.0f), a);
    const rhw_int below = rhw_less(a, rhw_splat(-2147483648.0f));
    const rhw_int number = rhw_equal(a, a);
    const rhw_int inside = rhw_int_from_float_unchecked((rhw_float)((rhw_int)a & number & ~above & ~below));
    return inside | (above & INT32_MAX) | (below & INT32_MIN);
}

// Sign and rounding ---------------------------------------------------------------------------------

/// Return the magnitude of a: a with the sign bit cleared, also if it is NaN.
static inline rhw_float rhw_abs(rhw_float a)
{
    return (rhw_float)((rhw_int)a & 0x7fffffff);
}

/// Return the magnitude of `a` with the sign of `sign`.
static inline rhw_float rhw_copysign(rhw_float a, rhw_float sign)
{
    return (rhw_float)(((rhw_int)a & 0x7fffffff) | ((rhw_int)sign & INT32_MIN));
}

/// Return −1, 0 or 1 as a is negative, zero or positive. NaN gives 0.
static inline rhw_float rhw_sign(rhw_float a)
{
    const rhw_int one = (rhw_int)rhw_splat(1.0f);
    const rhw_int other = rhw_less(rhw_splat(0.0f), a) | rhw_less(a, rhw_splat(0.0f));
    return (rhw_float)(other & (one | ((rhw_int)a & INT32_MIN)));
}

/// Return a rounded to a whole number towards zero.
static inline rhw_float rhw_trunc(rhw_float a)
{
#if defined(__AVX2__)
    return (rhw_float)_mm256_round_ps((__m256)a, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
#elif defined(__aarch64__)
    union rhw_lanes x;
    x.f = a;
    x.half[0] = vrndq_f32(x.half[0]);
    x.half[1] = vrndq_f32(x.half[1]);
    return x.f;
#elif defined(__wasm_simd128__)
    union rhw_lanes x;
    x.f = a;
    x.half[0] = (rhw_float4)wasm_f32x4_trunc((v128_t)x.half[0]);
    x.half[1] = (rhw_float4)wasm_f32x4_trunc((v128_t)x.half[1]);
    return x.f;
#else
    // From 2^23 on every float is whole. The comparison is false for NaN, which passes through.
    const rhw_int small = rhw_less(rhw_abs(a), rhw_splat(8388608.0f));
    const rhw_float whole = rhw_float_from_int(rhw_int_from_float_unchecked((rhw_float)((rhw_int)a & small)));
    return rhw_select(small, rhw_copysign(whole, a), a);
#endif
}

/// Return the largest whole number ≤ a.
static inline rhw_float rhw_floor(rhw_float a)
{
#if defined(__AVX2__)
    return (rhw_float)_mm256_floor_ps((__m256)a);
#elif defined(__aarch64__)
    union rhw_lanes x;
    x.f = a;
    x.half[0] = vrndmq_f32(x.half[0]);
    x.half[1] = vrndmq_f32(x.half[1]);
    return x.f;
#elif defined(__wasm_simd128__)
    union rhw_lanes x;
    x.f = a;
    x.half[0] = (rhw_float4)wasm_f32x4_floor((v128_t)x.half[0]);
    x.half[1] = (rhw_float4)wasm_f32x4_floor((v128_t)x.half[1]);
    return x.f;
#else
    const rhw_float whole = rhw_trunc(a);
    return rhw_select(rhw_less(a, whole), whole - 1.0f, whole);
#endif
}

/// Return the smallest whole number ≥ a.
static inline rhw_float rhw_ceil(rhw_float a)
{
#if defined(__AVX2__)
    return (rhw_float)_mm256_ceil_ps((__m256)a);
#else
    return -rhw_floor(-a);
#endif
}

/// Return the nearest whole number, ties to even.
static inline rhw_float rhw_round(rhw_float a)
{
#if defined(__AVX2__)
    return (rhw_float)_mm256_round_ps((__m256)a, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
#elif defined(__aarch64__)
    union rhw_lanes x;
    x.f = a;
    x.half[0] = vrndnq_f32(x.half[0]);
    x.half[1] = vrndnq_f32(x.half[1]);
    return x.f;
#elif defined(__wasm_simd128__)
    union rhw_lanes x;
    x.f = a;
    x.half[0] = (rhw_float4)wasm_f32x4_nearest((v128_t)x.half[0]);
    x.half[1] = (rhw_float4)wasm_f32x4_nearest((v128_t)x.half[1]);
    return x.f;
#else
    // A sum with 2^23 has no room for a fraction, and the addition rounds to nearest, ties to even.
    const rhw_float magnitude = rhw_abs(a);
    const rhw_int small = rhw_less(magnitude, rhw_splat(8388608.0f));
    return rhw_select(small, rhw_copysign((magnitude + 8388608.0f) - 8388608.0f, a), a);
#endif
}

/// Return a − floor(a). It lies in 0 ≤ result ≤ 1; it is 1 if a is negative and tiny.
static inline rhw_float rhw_fract(rhw_float a)
{
    return a - rhw_floor(a);
}

/// Return a + (b − a) · t.
static inline rhw_float rhw_mix(rhw_float a, rhw_float b, rhw_float t)
{
    return a + (b - a) * t;
}

/// Return 0 where a is at most edge0, 1 where a is at least edge1, and 3t² − 2t³ between them, with t growing from 0 to
/// 1. edge0 must be below edge1.
static inline rhw_float rhw_smoothstep(rhw_float edge0, rhw_float edge1, rhw_float a)
{
    const rhw_float t = rhw_saturate((a - edge0) / (edge1 - edge0));
    return t * t * (3.0f - 2.0f * t);
}

/// Return the square root of a, correctly rounded.
static inline rhw_float rhw_sqrt(rhw_float a)
{
#if defined(__AVX2__)
    return (rhw_float)_mm256_sqrt_ps((__m256)a);
#elif defined(__SSE2__)
    union rhw_lanes x;
    x.f = a;
    x.half[0] = (rhw_float4)_mm_sqrt_ps((__m128)x.half[0]);
    x.half[1] = (rhw_float4)_mm_sqrt_ps((__m128)x.half[1]);
    return x.f;
#elif defined(__aarch64__)
    union rhw_lanes x;
    x.f = a;
    x.half[0] = vsqrtq_f32(x.half[0]);
    x.half[1] = vsqrtq_f32(x.half[1]);
    return x.f;
#elif defined(__wasm_simd128__)
    union rhw_lanes x;
    x.f = a;
    x.half[0] = (rhw_float4)wasm_f32x4_sqrt((v128_t)x.half[0]);
    x.half[1] = (rhw_float4)wasm_f32x4_sqrt((v128_t)x.half[1]);
    return x.f;
#else
    for (int i = 0; i < RHW_LANES; i++) {
        a[i] = __builtin_sqrtf(a[i]);
    }
    return a;
#endif
}

/// Return 1 / sqrt(a) by an IEEE square root and an IEEE division. The error is at most 1.5 ULP.
static inline rhw_float rhw_rsqrt(rhw_float a)
{
    return 1.0f / rhw_sqrt(a);
}

RHW_QUIET_END

#endif

#endif
