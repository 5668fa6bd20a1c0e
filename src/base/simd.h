// SPDX-License-Identifier: MIT
// Wide types for kernels: 8 floats, 8 ints, 8 doubles, on the compiler's vector types. Arithmetic is written
// with operators; what has no operator, or compiles badly from one, is wrapped here and in simd_layout.h, and
// nothing else of the library uses intrinsics. Every wrapper gives the same bits on every instruction set.
#ifndef RHW_SIMD_H
#define RHW_SIMD_H

#include <string.h>

#include "rhw/shader.h"

#if defined(__SSE2__)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

#define RHW_INLINE static inline __attribute__((always_inline))

typedef rhw_float f32x8;
typedef rhw_int i32x8;
typedef rhw_float4 f32x4;
typedef uint32_t u32x8 __attribute__((vector_size(32)));
// An i16x16 has 16 numbers of 16 bits: two in each lane of an i32x8.
typedef int16_t i16x16 __attribute__((vector_size(32)));

// An f64x8 has 8 doubles in two halves: no instruction set below AVX-512 has them in one register, and gcc spills
// 64-byte vectors on the others.
typedef double f64x4 __attribute__((vector_size(32)));
typedef int64_t i64x4 __attribute__((vector_size(32)));
typedef uint64_t u64x4 __attribute__((vector_size(32)));
typedef rhw_int4 i32x4;
typedef int32_t i32x2 __attribute__((vector_size(8)));
typedef int64_t i64x2 __attribute__((vector_size(16)));
typedef struct f64x8 {
    f64x4 lo, hi;
} f64x8;

static const i32x8 rhw_lane_index = {0, 1, 2, 3, 4, 5, 6, 7};

RHW_INLINE f32x8 f32x8_splat(float v)
{
    return rhw_splat(v);
}

RHW_INLINE i32x8 i32x8_splat(int32_t v)
{
    return rhw_splat_int(v);
}

RHW_INLINE u64x4 u64x4_load(const void *p)
{
    u64x4 v;
    memcpy(&v, p, sizeof v);
    return v;
}

RHW_INLINE void u64x4_store(void *p, u64x4 v)
{
    memcpy(p, &v, sizeof v);
}

RHW_INLINE i32x4 i32x4_load(const void *p)
{
    i32x4 v;
    memcpy(&v, p, sizeof v);
    return v;
}

RHW_INLINE f64x4 f64x4_splat(double v)
{
#if defined(__AVX2__)
    return (f64x4){v, v, v, v};
#else
    const rhw_double2 halves[2] = {{v, v}, {v, v}};
    f64x4 lanes;
    memcpy(&lanes, halves, sizeof lanes);
    return lanes;
#endif
}

RHW_INLINE f64x8 f64x8_splat(double v)
{
    return (f64x8){f64x4_splat(v), f64x4_splat(v)};
}

RHW_INLINE f32x8 f32x8_load(const void *p)
{
    f32x8 v;
    memcpy(&v, p, sizeof v);
    return v;
}

RHW_INLINE void f32x8_store(void *p, f32x8 v)
{
    memcpy(p, &v, sizeof v);
}

RHW_INLINE i32x8 i32x8_load(const void *p)
{
    i32x8 v;
    memcpy(&v, p, sizeof v);
    return v;
}

RHW_INLINE void i32x8_store(void *p, i32x8 v)
{
    memcpy(p, &v, sizeof v);
}

// This is 1 where f32x8_fused is an instruction.
#if defined(__AVX2__)
enum { F32_FUSES = 1 };
#else
enum { F32_FUSES = 0 };
#endif

// Return a · b + c, rounded once where F32_FUSES is 1, and twice elsewhere: a caller has to prove that its result is
// the same. The instruction is written out because a compiler that is allowed fused operations (-mfma) could make more
// of them than this one. cpu.c leaves processors that have AVX2 without it to the baseline.
RHW_INLINE f32x8 f32x8_fused(f32x8 a, f32x8 b, f32x8 c)
{
#if defined(__AVX2__)
    __asm__("vfmadd213ps %2, %1, %0" : "+x"(a) : "x"(b), "x"(c));
    return a;
#else
    return a * b + c;
#endif
}

// Return a where the mask is −1, and b where it is 0.
RHW_INLINE f32x8 f32x8_select(i32x8 mask, f32x8 a, f32x8 b)
{
    return rhw_select(mask, a, b);
}

RHW_INLINE f32x4 f32x4_select(i32x4 mask, f32x4 a, f32x4 b)
{
#if defined(__AVX2__)
    return (f32x4)_mm_blendv_ps((__m128)b, (__m128)a, (__m128)mask);
#else
    return (f32x4)((mask & (i32x4)a) | (~mask & (i32x4)b));
#endif
}

// Return the second of equal values, and the second when one is NaN: SSE's minps does that.
RHW_INLINE f32x8 f32x8_min(f32x8 a, f32x8 b)
{
    return rhw_min(a, b);
}

RHW_INLINE f32x8 f32x8_max(f32x8 a, f32x8 b)
{
    return rhw_max(a, b);
}

RHW_INLINE i32x8 i32x8_min(i32x8 a, i32x8 b)
{
    return rhw_min_int(a, b);
}

RHW_INLINE i32x8 i32x8_max(i32x8 a, i32x8 b)
{
    return rhw_max_int(a, b);
}

// Return the sign bits of the lanes, with lane 0 in bit 0.
RHW_INLINE unsigned i32x8_sign_bits(i32x8 v)
{
#if defined(__AVX2__)
    return (unsigned)_mm256_movemask_ps((__m256)v);
#elif defined(__SSE2__)
    __m128 half[2];
    memcpy(half, &v, sizeof v);
    return (unsigned)_mm_movemask_ps(half[0]) | (unsigned)_mm_movemask_ps(half[1]) << 4;
#else
    return (unsigned)rhw_mask_bits(v >> 31);
#endif
}

RHW_INLINE unsigned i32x4_sign_bits(i32x4 v)
{
#if defined(__SSE2__)
    return (unsigned)_mm_movemask_ps((__m128)v);
#else
    const i32x4 bit = {1, 2, 4, 8};
    const i32x4 bits = v >> 31 & bit;
    return (unsigned)(bits[0] | bits[1] | bits[2] | bits[3]);
#endif
}

// Return the sign bits of 8 vectors, with those of the first in the lowest byte.
RHW_INLINE uint64_t i32x8_sign_bits_of_rows(const i32x8 row[8])
{
#if defined(__AVX2__)
    // Packing saturates, so that signs stay. Each step joins halves of 16 bytes: 4 lanes of 4 rows, twice, are put in
    // order.
    const __m256i order = _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7);
    uint32_t bits[2];
    for (int i = 0; i < 2; i++) {
        const i32x8 *const four = row + 4 * i;
        const __m256i bytes = _mm256_packs_epi16(_mm256_packs_epi32((__m256i)four[0], (__m256i)four[1]),
                                                 _mm256_packs_epi32((__m256i)four[2], (__m256i)four[3]));
        bits[i] = (uint32_t)_mm256_movemask_epi8(_mm256_permutevar8x32_epi32(bytes, order));
    }
    return bits[0] | (uint64_t)bits[1] << 32;
#else
    uint64_t bits = 0;
    for (int i = 0; i < 8; i++) {
        bits |= (uint64_t)i32x8_sign_bits(row[i]) << (8 * i);
    }
    return bits;
#endif
}

// Return 8 bytes as numbers. gcc 12 makes a vector conversion of them one by one.
RHW_INLINE i32x8 i32x8_load_bytes(const uint8_t *p)
{
#if defined(__AVX2__)
    return (i32x8)_mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)(const void *)p));
#elif defined(__SSE2__)
    const __m128i zero = _mm_setzero_si128();
    const __m128i words = _mm_unpacklo_epi8(_mm_loadl_epi64((const __m128i *)(const void *)p), zero);
    const __m128i halves[2] = {_mm_unpacklo_epi16(words, zero), _mm_unpackhi_epi16(words, zero)};
    i32x8 v;
    memcpy(&v, halves, sizeof v);
    return v;
#else
    typedef uint8_t bytes8 __attribute__((vector_size(8)));
    bytes8 v;
    memcpy(&v, p, sizeof v);
    return __builtin_convertvector(v, i32x8);
#endif
}

// Return 8 numbers of 16 bits without a sign.
RHW_INLINE i32x8 i32x8_load_shorts(const void *p)
{
#if defined(__AVX2__)
    return (i32x8)_mm256_cvtepu16_epi32(_mm_loadu_si128(p));
#else
    typedef uint16_t shorts8 __attribute__((vector_size(16)));
    shorts8 shorts;
    memcpy(&shorts, p, sizeof shorts);
    const shorts8 zero = {0};
    const shorts8 halves[2] = {__builtin_shufflevector(shorts, zero, 0, 8, 1, 9, 2, 10, 3, 11),
                               __builtin_shufflevector(shorts, zero, 4, 12, 5, 13, 6, 14, 7, 15)};
    i32x8 v; // machines are little-endian
    memcpy(&v, halves, sizeof v);
    return v;
#endif
}

// Store the low 16 bits of each lane.
RHW_INLINE void i32x8_store_shorts(void *p, i32x8 a)
{
#if defined(__SSE2__)
    // Packing takes numbers with a sign, so these are given the sign of their 16 bits.
    __m128i halves[2];
    a = (a << 16) >> 16;
    memcpy(halves, &a, sizeof a);
    _mm_storeu_si128(p, _mm_packs_epi32(halves[0], halves[1]));
#else
    typedef uint16_t shorts8 __attribute__((vector_size(16)));
    const shorts8 shorts = __builtin_convertvector(a, shorts8);
    memcpy(p, &shorts, sizeof shorts);
#endif
}

// Store the low 8 bits of each lane.
RHW_INLINE void i32x8_store_low_bytes(void *p, i32x8 a)
{
#if defined(__SSE2__)
    __m128i halves[2];
    a = a & 0xff;
    memcpy(halves, &a, sizeof a);
    const __m128i shorts = _mm_packs_epi32(halves[0], halves[1]);
    _mm_storel_epi64(p, _mm_packus_epi16(shorts, shorts));
#else
    typedef uint8_t bytes8 __attribute__((vector_size(8)));
    const bytes8 bytes = __builtin_convertvector(a, bytes8);
    memcpy(p, &bytes, sizeof bytes);
#endif
}

// Return the lanes as 8 bytes, with lane 0 in the lowest. Each lane is 0 .. 255.
RHW_INLINE uint64_t i32x8_to_bytes(i32x8 v)
{
    uint64_t bytes;
#if defined(__SSE2__)
    __m128i half[2];
    memcpy(half, &v, sizeof v);
    const __m128i words = _mm_packs_epi32(half[0], half[1]);
    _mm_storel_epi64((__m128i *)(void *)&bytes, _mm_packus_epi16(words, words));
#else
    typedef uint8_t bytes8 __attribute__((vector_size(8)));
    const bytes8 narrow = __builtin_convertvector(v, bytes8);
    memcpy(&bytes, &narrow, sizeof bytes);
#endif
    return bytes;
}

// Count bytes up or down by one, wrapping, in 8 rows of 8 bytes that lie `stride` apart. Bytes whose bit is set are
// counted; bits are ordered as by i32x8_sign_bits_of_rows.
RHW_INLINE void count_bytes_of_rows(uint8_t *p, size_t stride, uint64_t bits, bool up)
{
#if defined(__AVX2__)
    const __m256i bit = _mm256_set1_epi64x((int64_t)0x8040201008040201);
    const __m256i row = _mm256_setr_epi64x(0, 0x0101010101010101, 0x0202020202020202, 0x0303030303030303);
    for (int i = 0; i < 2; i++) {
        const __m256i all = _mm256_shuffle_epi8(_mm256_set1_epi32((int32_t)(bits >> (32 * i))), row);
        const __m256i set = _mm256_cmpeq_epi8(_mm256_and_si256(all, bit), bit); // −1 where the bit is set
        int64_t word[4];
        for (int k = 0; k < 4; k++) {
            memcpy(&word[k], p + (size_t)k * stride, sizeof *word);
        }
        const __m256i bytes = _mm256_setr_epi64x(word[0], word[1], word[2], word[3]);
        const __m256i counted = up ? _mm256_sub_epi8(bytes, set) : _mm256_add_epi8(bytes, set);
        const __m128i half[2] = {_mm256_castsi256_si128(counted), _mm256_extracti128_si256(counted, 1)};
        for (int k = 0; k < 2; k++) {
            _mm_storel_epi64((__m128i *)(void *)p, half[k]);
            _mm_storel_epi64((__m128i *)(void *)(p + stride), _mm_unpackhi_epi64(half[k], half[k]));
            p += 2 * stride;
        }
    }
#else
    const uint64_t ones = 0x0101010101010101, high = 0x80 * ones;
    for (int i = 0; i < 8; i++) {
        // Byte i of this has bit i alone.
        const uint64_t apart = (bits >> (8 * i) & 0xff) * ones & 0x8040201008040201;
        const uint64_t count = (apart + 0x7f * ones) >> 7 & ones;
        uint64_t bytes; // no carry passes between them
        memcpy(&bytes, p, sizeof bytes);
        bytes = up ? ((bytes & ~high) + count) ^ (bytes & high) : ((bytes | high) - count) ^ (~bytes & high);
        memcpy(p, &bytes, sizeof bytes);
        p += stride;
    }
#endif
}

// Return 2^n, for n of 0 .. 30.
RHW_INLINE i32x8 i32x8_power2(i32x8 n)
{
#if defined(__AVX2__)
    return (i32x8)_mm256_sllv_epi32(_mm256_set1_epi32(1), (__m256i)n);
#else
    // The sum is a float's exponent.
    return rhw_int_from_float_unchecked((f32x8)((n + i32x8_splat(127)) << 23));
#endif
}

// Return −1 in the lanes whose bit is set.
RHW_INLINE i32x8 i32x8_from_bits(unsigned bits)
{
    const i32x8 bit = {1, 2, 4, 8, 16, 32, 64, 128};
    return rhw_equal_int(i32x8_splat((int32_t)bits) & bit, bit);
}

RHW_INLINE i32x4 i32x4_from_bits(unsigned bits)
{
    const i32x4 bit = {1, 2, 4, 8}, all = {(int32_t)bits, (int32_t)bits, (int32_t)bits, (int32_t)bits};
    return (all & bit) == bit;
}

// Return −1 where a < b, and 0 where not or where one is NaN. gcc 12 without AVX makes scalar code of the operator.
RHW_INLINE i64x4 f64x4_less(f64x4 a, f64x4 b)
{
#if defined(__AVX2__)
    return a < b;
#else
    rhw_double2 x[2], y[2];
    memcpy(x, &a, sizeof x);
    memcpy(y, &b, sizeof y);
    const i64x2 halves[2] = {x[0] < y[0], x[1] < y[1]};
    i64x4 mask;
    memcpy(&mask, halves, sizeof mask);
    return mask;
#endif
}

RHW_INLINE f64x8 f64x8_add(f64x8 a, f64x8 b)
{
    return (f64x8){a.lo + b.lo, a.hi + b.hi};
}

RHW_INLINE f64x8 f64x8_sub(f64x8 a, f64x8 b)
{
    return (f64x8){a.lo - b.lo, a.hi - b.hi};
}

RHW_INLINE f64x8 f64x8_mul(f64x8 a, f64x8 b)
{
    return (f64x8){a.lo * b.lo, a.hi * b.hi};
}

RHW_INLINE f64x8 f64x8_div(f64x8 a, f64x8 b)
{
    return (f64x8){a.lo / b.lo, a.hi / b.hi};
}

// Return square roots, correctly rounded.
RHW_INLINE f64x8 f64x8_sqrt(f64x8 v)
{
    return (f64x8){rhw_sqrt_double(v.lo), rhw_sqrt_double(v.hi)};
}

// Return floats as doubles. This is exact.
RHW_INLINE f64x8 f64x8_from_f32x8(f32x8 v)
{
    const struct rhw_double8 wide = rhw_to_double(v);
    return (f64x8){wide.low, wide.high};
}

// Return integers as doubles. This is exact.
RHW_INLINE f64x8 f64x8_from_i32x8(i32x8 v)
{
#if defined(__AVX2__)
    return (f64x8){(f64x4)_mm256_cvtepi32_pd(_mm256_castsi256_si128((__m256i)v)),
                   (f64x4)_mm256_cvtepi32_pd(_mm256_extracti128_si256((__m256i)v, 1))};
#elif defined(__SSE2__)
    __m128i half[2];
    memcpy(half, &v, sizeof v);
    const __m128d quarter[4] = {
        _mm_cvtepi32_pd(half[0]), _mm_cvtepi32_pd(_mm_unpackhi_epi64(half[0], half[0])),
        _mm_cvtepi32_pd(half[1]), _mm_cvtepi32_pd(_mm_unpackhi_epi64(half[1], half[1]))};
    f64x8 result;
    memcpy(&result, quarter, sizeof result);
    return result;
#elif defined(__wasm_simd128__)
    v128_t half[2];
    memcpy(half, &v, sizeof v);
    const v128_t wide[4] = {wasm_f64x2_convert_low_i32x4(half[0]),
                            wasm_f64x2_convert_low_i32x4(wasm_i64x2_shuffle(half[0], half[0], 1, 0)),
                            wasm_f64x2_convert_low_i32x4(half[1]),
                            wasm_f64x2_convert_low_i32x4(wasm_i64x2_shuffle(half[1], half[1], 1, 0))};
    f64x8 result;
    memcpy(&result, wide, sizeof result);
    return result;
#else
    i32x2 quarter[4];
    rhw_double2 wide[4];
    memcpy(quarter, &v, sizeof v);
    for (int i = 0; i < 4; i++) {
        wide[i] = __builtin_convertvector(quarter[i], rhw_double2);
    }
    f64x8 result;
    memcpy(&result, wide, sizeof result);
    return result;
#endif
}

// Return floats, rounded to nearest, ties to even.
RHW_INLINE f32x8 f32x8_from_f64x8(f64x8 v)
{
    return rhw_from_double((struct rhw_double8){v.lo, v.hi});
}

RHW_INLINE f32x4 f32x4_from_f64x4(f64x4 v)
{
#if defined(__AVX2__)
    return (f32x4)_mm256_cvtpd_ps((__m256d)v);
#else
    return (f32x4){(float)v[0], (float)v[1], (float)v[2], (float)v[3]};
#endif
}

// Return the nearest integers, ties to even, for |v| < 2^51. Adding 1.5·2^52 leaves an integer in the low bits of the
// significand, whatever instruction set adds.
RHW_INLINE i32x8 i32x8_round_f64x8(f64x8 v)
{
    const f64x4 magic = f64x4_splat(6755399441055744.0);
    const i64x4 lo = (i64x4)(v.lo + magic), hi = (i64x4)(v.hi + magic);
// gcc takes the lanes one by one.
#if defined(__AVX2__)
    const __m256 low_words = _mm256_shuffle_ps((__m256)lo, (__m256)hi, 0x88);
    return (i32x8)_mm256_permute4x64_epi64((__m256i)low_words, 0xD8);
#elif defined(__SSE2__)
    __m128 q[4];
    memcpy(q, &lo, sizeof lo);
    memcpy(q + 2, &hi, sizeof hi);
    const __m128 low_words[2] = {_mm_shuffle_ps(q[0], q[1], 0x88), _mm_shuffle_ps(q[2], q[3], 0x88)};
    i32x8 r;
    memcpy(&r, low_words, sizeof r);
    return r;
#else
    i32x4 q[4];
    memcpy(q, &lo, sizeof lo);
    memcpy(q + 2, &hi, sizeof hi);
    const i32x4 low_words[2] = {__builtin_shufflevector(q[0], q[1], 0, 2, 4, 6),
                                __builtin_shufflevector(q[2], q[3], 0, 2, 4, 6)};
    return i32x8_load(low_words);
#endif
}

// Return v clamped. NaN becomes low.
RHW_INLINE f64x8 f64x8_clamp(f64x8 v, double low, double high)
{
// max and min give their second operand when one is NaN.
#if defined(__AVX2__)
    const __m256d l = _mm256_set1_pd(low), h = _mm256_set1_pd(high);
    v.lo = (f64x4)_mm256_min_pd(_mm256_max_pd((__m256d)v.lo, l), h);
    v.hi = (f64x4)_mm256_min_pd(_mm256_max_pd((__m256d)v.hi, l), h);
    return v;
#elif defined(__SSE2__)
    const __m128d l = _mm_set1_pd(low), h = _mm_set1_pd(high);
    __m128d quarter[4];
    memcpy(quarter, &v, sizeof v);
    for (int i = 0; i < 4; i++) {
        quarter[i] = _mm_min_pd(_mm_max_pd(quarter[i], l), h);
    }
    memcpy(&v, quarter, sizeof v);
    return v;
#else
    const f64x4 l = f64x4_splat(low), h = f64x4_splat(high);
    const i64x4 a = f64x4_less(l, v.lo), b = f64x4_less(l, v.hi);
    v.lo = (f64x4)((a & (i64x4)v.lo) | (~a & (i64x4)l));
    v.hi = (f64x4)((b & (i64x4)v.hi) | (~b & (i64x4)l));
    const i64x4 c = f64x4_less(v.lo, h), d = f64x4_less(v.hi, h);
    v.lo = (f64x4)((c & (i64x4)v.lo) | (~c & (i64x4)h));
    v.hi = (f64x4)((d & (i64x4)v.hi) | (~d & (i64x4)h));
    return v;
#endif
}

// Return integers as doubles. This is exact.
RHW_INLINE f64x4 f64x4_from_i32x4(i32x4 v)
{
#if defined(__AVX2__)
    return __builtin_convertvector(v, f64x4);
#else
    i32x2 half[2];
    memcpy(half, &v, sizeof v);
    const rhw_double2 wide[2] = {__builtin_convertvector(half[0], rhw_double2),
                                 __builtin_convertvector(half[1], rhw_double2)};
    f64x4 result;
    memcpy(&result, wide, sizeof result);
    return result;
#endif
}

// Return v where the mask is −1, and 0 where it is 0.
RHW_INLINE f64x4 f64x4_keep(f64x4 v, i64x4 mask)
{
    return (f64x4)((i64x4)v & mask);
}

RHW_INLINE f64x4 f64x4_select(i64x4 mask, f64x4 a, f64x4 b)
{
    return (f64x4)(((i64x4)a & mask) | ((i64x4)b & ~mask));
}

RHW_INLINE f64x4 f64x4_min(f64x4 a, f64x4 b)
{
    return f64x4_select(f64x4_less(a, b), a, b);
}

RHW_INLINE f64x4 f64x4_max(f64x4 a, f64x4 b)
{
    return f64x4_select(f64x4_less(b, a), a, b);
}

RHW_INLINE f64x4 f64x4_abs(f64x4 v)
{
    return (f64x4)((i64x4)v & INT64_MAX);
}

#endif
