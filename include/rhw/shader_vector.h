// SPDX-License-Identifier: MIT
// The arithmetic of 8 lanes that C's operators lack: comparison, selection, rounding, conversion. Included by shader.h;
// shader_scalar.h lets plain numbers stand in the place of lanes. All of it is IEEE 754 arithmetic without contraction,
// hence the same bits on every instruction set. Intrinsics, and halves of 4 lanes, appear where compilers turn the plain
// form into scalar code: gcc 12 does for most of what stands here unless it has AVX.
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

/// 8 lanes seen as registers of 16 bytes. Local to the headers of rhw.
union rhw_lanes {
    rhw_float f;
    rhw_int i;
    rhw_float4 half[2];
    rhw_int4 half_i[2];
};

// Making lanes --------------------------------------------------------------------------------------

/// All 8 lanes equal.
static inline rhw_float rhw_splat(float value)
{
#if defined(__AVX2__)
    const rhw_float lanes = {value, value, value, value, value, value, value, value};
    return lanes;
#else
    // gcc 12 stores the plain form lane by lane and loads what it stored, which stalls.
    const rhw_float4 half = {value, value, value, value};
    union rhw_lanes x;
    x.half[0] = x.half[1] = half;
    return x.f;
#endif
}

/// All 8 lanes equal.
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

/// 0, 1, .. 7.
static inline rhw_int rhw_lane_numbers(void)
{
    const rhw_int lanes = {0, 1, 2, 3, 4, 5, 6, 7};
    return lanes;
}

// Comparison and selection --------------------------------------------------------------------------
// The operators `<`, `<=`, .. give the same masks; gcc 12 without AVX makes scalar code of them.

/// a < b lane by lane: −1 or 0. Any comparison with NaN gives 0.
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

/// a ≤ b.
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

/// a = b; 0 for NaN, so `rhw_equal(a, a)` tells numbers from NaN.
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

/// a > b.
static inline rhw_int rhw_greater(rhw_float a, rhw_float b)
{
    return rhw_less(b, a);
}

/// a ≥ b.
static inline rhw_int rhw_greater_equal(rhw_float a, rhw_float b)
{
    return rhw_less_equal(b, a);
}

/// The opposite of rhw_equal: −1 for NaN.
static inline rhw_int rhw_not_equal(rhw_float a, rhw_float b)
{
    return ~rhw_equal(a, b);
}

/// a < b of signed integers.
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

/// a = b of integers.
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

/// a where mask is −1, b where it is 0. What another mask gives depends on the instruction set: compare first.
static inline rhw_float rhw_select(rhw_int mask, rhw_float a, rhw_float b)
{
#if defined(__AVX2__)
    return (rhw_float)_mm256_blendv_ps((__m256)b, (__m256)a, (__m256)mask);
#else
    return (rhw_float)((mask & (rhw_int)a) | (~mask & (rhw_int)b));
#endif
}

/// rhw_select of integers.
static inline rhw_int rhw_select_int(rhw_int mask, rhw_int a, rhw_int b)
{
#if defined(__AVX2__)
    return (rhw_int)_mm256_blendv_ps((__m256)b, (__m256)a, (__m256)mask);
#else
    return (mask & a) | (~mask & b);
#endif
}

/// Bit i is set where lane i of the mask is −1.
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

/// Whether the mask is −1 in a lane.
static inline bool rhw_any(rhw_int mask)
{
    return rhw_mask_bits(mask) != 0;
}

/// Whether the mask is −1 in every lane.
static inline bool rhw_all(rhw_int mask)
{
    return rhw_mask_bits(mask) == 0xff;
}

/// a where a < b, else b: b when either is NaN, b when both are zeros.
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

/// a where a > b, else b: b when either is NaN, b when both are zeros.
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

/// The smaller of two signed integers.
static inline rhw_int rhw_min_int(rhw_int a, rhw_int b)
{
#if defined(__AVX2__)
    return (rhw_int)_mm256_min_epi32((__m256i)a, (__m256i)b);
#else
    return rhw_select_int(rhw_less_int(a, b), a, b);
#endif
}

/// The larger of two signed integers.
static inline rhw_int rhw_max_int(rhw_int a, rhw_int b)
{
#if defined(__AVX2__)
    return (rhw_int)_mm256_max_epi32((__m256i)a, (__m256i)b);
#else
    return rhw_select_int(rhw_less_int(a, b), b, a);
#endif
}

/// Within low..high; NaN gives low.
static inline rhw_float rhw_clamp(rhw_float a, rhw_float low, rhw_float high)
{
    return rhw_min(rhw_max(a, low), high);
}

/// Within 0..1; NaN and −0 give 0.
static inline rhw_float rhw_saturate(rhw_float a)
{
    return rhw_clamp(a, rhw_splat(0.0f), rhw_splat(1.0f));
}

// Conversion ----------------------------------------------------------------------------------------
// A cast, (rhw_int)a, keeps the bits of 8 lanes where it converts the value of one number; these say which is meant.

/// The bits of each lane, unchanged.
static inline rhw_int rhw_bits_from_float(rhw_float a)
{
    return (rhw_int)a;
}

/// The floats that have these bits.
static inline rhw_float rhw_float_from_bits(rhw_int a)
{
    return (rhw_float)a;
}

/// The nearest float of a signed integer, ties to even.
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

/// Truncates; the value must lie within −2^31 ≤ a < 2^31 in every lane whose result is used. One
/// instruction where rhw_int_from_float takes five.
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
    // Rubbish lanes become 0 first: the conversion of what does not fit is undefined in C.
    const rhw_int fits = rhw_less_equal(rhw_splat(-2147483648.0f), a) & rhw_less(a, rhw_splat(2147483648.0f));
    union rhw_lanes x;
    x.i = (rhw_int)a & fits;
    x.half_i[0] = __builtin_convertvector(x.half[0], rhw_int4);
    x.half_i[1] = __builtin_convertvector(x.half[1], rhw_int4);
    return x.i;
#endif
}

/// Truncates towards zero. Below −2^31 gives −2^31, from 2^31 on gives 2^31 − 1, NaN gives 0.
static inline rhw_int rhw_int_from_float(rhw_float a)
{
    const rhw_int above = rhw_less_equal(rhw_splat(2147483648.0f), a);
    const rhw_int below = rhw_less(a, rhw_splat(-2147483648.0f));
    const rhw_int number = rhw_equal(a, a);
    const rhw_int inside = rhw_int_from_float_unchecked((rhw_float)((rhw_int)a & number & ~above & ~below));
    return inside | (above & INT32_MAX) | (below & INT32_MIN);
}

// Sign and rounding ---------------------------------------------------------------------------------

/// The magnitude: the sign bit cleared, of NaN too.
static inline rhw_float rhw_abs(rhw_float a)
{
    return (rhw_float)((rhw_int)a & 0x7fffffff);
}

/// The magnitude of `a` with the sign of `sign`.
static inline rhw_float rhw_copysign(rhw_float a, rhw_float sign)
{
    return (rhw_float)(((rhw_int)a & 0x7fffffff) | ((rhw_int)sign & INT32_MIN));
}

/// −1, 0 or 1; NaN gives 0.
static inline rhw_float rhw_sign(rhw_float a)
{
    const rhw_int one = (rhw_int)rhw_splat(1.0f);
    const rhw_int other = rhw_less(rhw_splat(0.0f), a) | rhw_less(a, rhw_splat(0.0f));
    return (rhw_float)(other & (one | ((rhw_int)a & INT32_MIN)));
}

/// Towards zero.
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
    // From 2^23 on every float is whole; the comparison is false for NaN, which passes through.
    const rhw_int small = rhw_less(rhw_abs(a), rhw_splat(8388608.0f));
    const rhw_float whole = rhw_float_from_int(rhw_int_from_float_unchecked((rhw_float)((rhw_int)a & small)));
    return rhw_select(small, rhw_copysign(whole, a), a);
#endif
}

/// The largest whole number ≤ a.
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

/// The smallest whole number ≥ a.
static inline rhw_float rhw_ceil(rhw_float a)
{
#if defined(__AVX2__)
    return (rhw_float)_mm256_ceil_ps((__m256)a);
#else
    return -rhw_floor(-a);
#endif
}

/// The nearest whole number, ties to even.
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
    // Adding 2^23 leaves no room for a fraction, and the addition rounds as wanted.
    const rhw_float magnitude = rhw_abs(a);
    const rhw_int small = rhw_less(magnitude, rhw_splat(8388608.0f));
    return rhw_select(small, rhw_copysign((magnitude + 8388608.0f) - 8388608.0f, a), a);
#endif
}

/// a − floor(a): 0 ≤ result ≤ 1 (1 where a is negative and tiny).
static inline rhw_float rhw_fract(rhw_float a)
{
    return a - rhw_floor(a);
}

/// a + (b − a) · t.
static inline rhw_float rhw_mix(rhw_float a, rhw_float b, rhw_float t)
{
    return a + (b - a) * t;
}

/// 0 up to edge0, 1 from edge1 on, 3t² − 2t³ between them; edge0 < edge1.
static inline rhw_float rhw_smoothstep(rhw_float edge0, rhw_float edge1, rhw_float a)
{
    const rhw_float t = rhw_saturate((a - edge0) / (edge1 - edge0));
    return t * t * (3.0f - 2.0f * t);
}

/// Correctly rounded.
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

/// 1 / sqrt(a) by an IEEE square root and division: at most 1.5 ULP off.
static inline rhw_float rhw_rsqrt(rhw_float a)
{
    return 1.0f / rhw_sqrt(a);
}

RHW_QUIET_END

#endif

#endif
