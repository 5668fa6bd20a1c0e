// SPDX-License-Identifier: MIT
// How numbers lie in lanes: rows and columns, bytes and 16-bit halves within a lane, 16-bit floats, lanes from other
// lanes and from tables. Every wrapper gives the same bits on every instruction set, like those of simd.h.
#ifndef RHW_SIMD_LAYOUT_H
#define RHW_SIMD_LAYOUT_H

#include "half.h"
#include "simd.h"

#if defined(__SSE2__)
// 8 lanes as registers.
union lanes {
    f32x8 f;
    i32x8 i;
    __m128 half[2];
    __m128i half_i[2];
#if defined(__AVX2__)
    __m256 full;
#endif
};
#endif

// Rows and columns ----------------------------------------------------------------------------------

// Turn 4 rows of 4 floats into columns.
RHW_INLINE void f32x4_transpose(f32x4 m[4])
{
    const f32x4 a = __builtin_shufflevector(m[0], m[1], 0, 4, 1, 5),
                b = __builtin_shufflevector(m[0], m[1], 2, 6, 3, 7);
    const f32x4 c = __builtin_shufflevector(m[2], m[3], 0, 4, 1, 5),
                d = __builtin_shufflevector(m[2], m[3], 2, 6, 3, 7);
    m[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
    m[1] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
    m[2] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
    m[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

// Return the lower, or the upper, 4 lanes of a and behind them those of b.
RHW_INLINE f32x8 f32x8_join_low(f32x8 a, f32x8 b)
{
#if defined(__AVX2__)
    return (f32x8)_mm256_permute2f128_ps((__m256)a, (__m256)b, 0x20);
#else
    f32x4 low[2];
    memcpy(&low[0], &a, sizeof low[0]);
    memcpy(&low[1], &b, sizeof low[1]);
    return f32x8_load(low);
#endif
}

RHW_INLINE f32x8 f32x8_join_high(f32x8 a, f32x8 b)
{
#if defined(__AVX2__)
    return (f32x8)_mm256_permute2f128_ps((__m256)a, (__m256)b, 0x31);
#else
    f32x4 high[2];
    memcpy(&high[0], (const char *)&a + sizeof high[0], sizeof high[0]);
    memcpy(&high[1], (const char *)&b + sizeof high[1], sizeof high[1]);
    return f32x8_load(high);
#endif
}

// Repeat lanes: spread[i] has lane i four times, and behind it lane i + 4 four times.
RHW_INLINE void f32x8_spread(f32x8 v, f32x8 spread[4])
{
#if defined(__AVX2__)
    spread[0] = (f32x8)_mm256_permute_ps((__m256)v, 0x00);
    spread[1] = (f32x8)_mm256_permute_ps((__m256)v, 0x55);
    spread[2] = (f32x8)_mm256_permute_ps((__m256)v, 0xAA);
    spread[3] = (f32x8)_mm256_permute_ps((__m256)v, 0xFF);
#else
    for (int i = 0; i < 4; i++) {
        const f32x4 halves[2] = {{v[i], v[i], v[i], v[i]}, {v[i + 4], v[i + 4], v[i + 4], v[i + 4]}};
        spread[i] = f32x8_load(halves);
    }
#endif
}

// Turn 8 rows of 4 floats into 4 vectors of one component each. row[i] has rows i and i + 4.
RHW_INLINE void f32x8_columns(const f32x8 row[4], f32x8 column[4])
{
#if defined(__AVX2__)
    __m256 t[4];
    for (int i = 0; i < 2; i++) {
        t[2 * i] = _mm256_unpacklo_ps((__m256)row[2 * i], (__m256)row[2 * i + 1]);
        t[2 * i + 1] = _mm256_unpackhi_ps((__m256)row[2 * i], (__m256)row[2 * i + 1]);
    }
    column[0] = (f32x8)_mm256_shuffle_ps(t[0], t[2], 0x44);
    column[1] = (f32x8)_mm256_shuffle_ps(t[0], t[2], 0xEE);
    column[2] = (f32x8)_mm256_shuffle_ps(t[1], t[3], 0x44);
    column[3] = (f32x8)_mm256_shuffle_ps(t[1], t[3], 0xEE);
#else
    f32x4 low[4], high[4];
    for (int i = 0; i < 4; i++) {
        memcpy(&low[i], &row[i], sizeof low[i]);
        memcpy(&high[i], (const char *)&row[i] + sizeof low[i], sizeof high[i]);
    }
    f32x4_transpose(low);
    f32x4_transpose(high);
    for (int c = 0; c < 4; c++) {
        const f32x4 halves[2] = {low[c], high[c]};
        column[c] = f32x8_load(halves);
    }
#endif
}

// Turn 8 rows of 4 floats into 4 vectors of one component each.
RHW_INLINE void f32x4_columns(const f32x4 row[8], f32x8 column[4])
{
    f32x8 pair[4];
    for (int i = 0; i < 4; i++) {
#if defined(__AVX2__)
        // gcc would store the halves and load the whole, which waits for both stores.
        pair[i] = (f32x8)_mm256_set_m128((__m128)row[i + 4], (__m128)row[i]);
#else
        const f32x4 both[2] = {row[i], row[i + 4]};
        pair[i] = f32x8_load(both);
#endif
    }
    f32x8_columns(pair, column);
}

// Turn 4 vectors of one component each into 8 rows of 4 floats.
RHW_INLINE void f32x4_rows(const f32x8 column[4], f32x4 row[8])
{
#if defined(__AVX2__)
    const __m256 a = _mm256_unpacklo_ps((__m256)column[0], (__m256)column[1]),
                 b = _mm256_unpackhi_ps((__m256)column[0], (__m256)column[1]);
    const __m256 c = _mm256_unpacklo_ps((__m256)column[2], (__m256)column[3]),
                 d = _mm256_unpackhi_ps((__m256)column[2], (__m256)column[3]);
    const __m256 pair[4] = {_mm256_shuffle_ps(a, c, 0x44), _mm256_shuffle_ps(a, c, 0xEE),
                            _mm256_shuffle_ps(b, d, 0x44), _mm256_shuffle_ps(b, d, 0xEE)};
    for (int i = 0; i < 4; i++) {
        row[i] = (f32x4)_mm256_castps256_ps128(pair[i]);
        row[i + 4] = (f32x4)_mm256_extractf128_ps(pair[i], 1);
    }
#else
    for (int i = 0; i < 4; i++) {
        memcpy(&row[i], &column[i], sizeof row[i]);
        memcpy(&row[i + 4], (const char *)&column[i] + sizeof row[i], sizeof row[i]);
    }
    f32x4_transpose(row);
    f32x4_transpose(row + 4);
#endif
}

// Load 4 floats at each of 8 places, as 4 vectors of one component each.
RHW_INLINE void f32x8_load_columns(const void *const place[8], f32x8 column[4])
{
    f32x4 row[8];
    for (int i = 0; i < 8; i++) {
        memcpy(&row[i], place[i], sizeof row[i]);
    }
    f32x4_columns(row, column);
}

// Turn 4 vectors of 4 quantities each into 4 vectors of one quantity each.
RHW_INLINE void f64x4_transpose(f64x4 m[4])
{
    const f64x4 a = __builtin_shufflevector(m[0], m[1], 0, 4, 2, 6),
                b = __builtin_shufflevector(m[0], m[1], 1, 5, 3, 7);
    const f64x4 c = __builtin_shufflevector(m[2], m[3], 0, 4, 2, 6),
                d = __builtin_shufflevector(m[2], m[3], 1, 5, 3, 7);
    m[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
    m[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
    m[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
    m[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

// Turn 8 vectors of one component each into 8 vectors of one lane each.
RHW_INLINE void f32x8_transpose(f32x8 m[8])
{
#if defined(__AVX2__)
    // No memcpy leads to or from these: gcc would keep them in memory.
    __m256 r[8], t[8];
    for (int i = 0; i < 4; i++) {
        t[2 * i] = _mm256_unpacklo_ps((__m256)m[2 * i], (__m256)m[2 * i + 1]);
        t[2 * i + 1] = _mm256_unpackhi_ps((__m256)m[2 * i], (__m256)m[2 * i + 1]);
    }
    for (int i = 0; i < 2; i++) {
        r[4 * i + 0] = _mm256_shuffle_ps(t[4 * i], t[4 * i + 2], 0x44);
        r[4 * i + 1] = _mm256_shuffle_ps(t[4 * i], t[4 * i + 2], 0xEE);
        r[4 * i + 2] = _mm256_shuffle_ps(t[4 * i + 1], t[4 * i + 3], 0x44);
        r[4 * i + 3] = _mm256_shuffle_ps(t[4 * i + 1], t[4 * i + 3], 0xEE);
    }
    for (int i = 0; i < 4; i++) {
        m[i] = (f32x8)_mm256_permute2f128_ps(r[i], r[i + 4], 0x20);
        m[i + 4] = (f32x8)_mm256_permute2f128_ps(r[i], r[i + 4], 0x31);
    }
#else
    f32x4 q[2][2][4]; // indexed by half of the rows and half of the columns
    for (int i = 0; i < 8; i++) {
        memcpy(&q[i / 4][0][i % 4], &m[i], sizeof(f32x4));
        memcpy(&q[i / 4][1][i % 4], (const char *)&m[i] + sizeof(f32x4), sizeof(f32x4));
    }
    for (int i = 0; i < 4; i++) {
        f32x4_transpose(q[i / 2][i % 2]);
    }
    for (int i = 0; i < 8; i++) {
        const f32x4 halves[2] = {q[0][i / 4][i % 4], q[1][i / 4][i % 4]};
        m[i] = f32x8_load(halves);
    }
#endif
}

// Bytes and 16-bit floats ----------------------------------------------------------------------------

// Convert four channels of 4 texels for i32x8_bytes_from_f32x8.
#if defined(__aarch64__)
RHW_INLINE i32x4 i32x4_bytes_from_f32x4(const f32x4 channel[4])
{
    int16x4_t narrow[4];
    for (int i = 0; i < 4; i++) { // the conversion saturates, and gives 0 for NaN
        narrow[i] = vqmovn_s32(vcvtnq_s32_f32((float32x4_t)channel[i]));
    }
    const uint8x16_t bytes = vcombine_u8(vqmovun_s16(vcombine_s16(narrow[0], narrow[1])),
                                         vqmovun_s16(vcombine_s16(narrow[2], narrow[3])));
    return (i32x4)__builtin_shufflevector(bytes, bytes, 0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15);
}
#elif defined(__wasm_simd128__)
RHW_INLINE i32x4 i32x4_bytes_from_f32x4(const f32x4 channel[4])
{
    v128_t rounded[4];
    for (int i = 0; i < 4; i++) { // the conversion saturates, and gives 0 for NaN
        rounded[i] = wasm_i32x4_trunc_sat_f32x4(wasm_f32x4_nearest((v128_t)channel[i]));
    }
    const v128_t bytes = wasm_u8x16_narrow_i16x8(wasm_i16x8_narrow_i32x4(rounded[0], rounded[1]),
                                                 wasm_i16x8_narrow_i32x4(rounded[2], rounded[3]));
    return (i32x4)wasm_i8x16_shuffle(bytes, bytes, 0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15);
}
#endif

// Return four channels of 8 texels, with byte 0 of each from channel 0. Values have to be below 2^31. They are rounded
// to nearest, ties to even; values below 0 give 0, and values above 255 give 255.
RHW_INLINE i32x8 i32x8_bytes_from_small_f32x8(const f32x8 channel[4])
{
#if defined(__AVX2__)
    __m256i rounded[4];
    for (int i = 0; i < 4; i++) {
        rounded[i] = _mm256_cvtps_epi32((__m256)channel[i]);
    }
    const __m256i bytes = _mm256_packus_epi16(_mm256_packs_epi32(rounded[0], rounded[1]),
                                              _mm256_packs_epi32(rounded[2], rounded[3]));
    const __m256i order = _mm256_setr_epi8(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15, //
                                           0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15);
    return (i32x8)_mm256_shuffle_epi8(bytes, order);
#elif defined(__aarch64__) || defined(__wasm_simd128__)
    f32x4 part[2][4];
    for (int i = 0; i < 4; i++) {
        memcpy(&part[0][i], &channel[i], sizeof(f32x4));
        memcpy(&part[1][i], (const char *)&channel[i] + sizeof(f32x4), sizeof(f32x4));
    }
    const i32x4 halves[2] = {i32x4_bytes_from_f32x4(part[0]), i32x4_bytes_from_f32x4(part[1])};
    return i32x8_load(halves);
#else
    // From 2^23 on floats have no fraction: adding it rounds, and leaves the integer in the low bits.
    i32x8 texel = i32x8_splat(0);
    for (int i = 0; i < 4; i++) {
        const f32x8 value = f32x8_min(f32x8_max(channel[i], f32x8_splat(0.0f)), f32x8_splat(255.0f));
        texel |= ((i32x8)(value + f32x8_splat(0x1p23f)) & 0xff) << (8 * i);
    }
    return texel;
#endif
}

// Return four channels of 8 texels like i32x8_bytes_from_small_f32x8, of any values. NaN gives 0.
RHW_INLINE i32x8 i32x8_bytes_from_f32x8(const f32x8 channel[4])
{
#if defined(__AVX2__)
    const __m256 most = _mm256_set1_ps(255.0f);
    f32x8 small[4];
    // The minimum of NaN is the second operand, and its integer is INT32_MIN.
    for (int i = 0; i < 4; i++) {
        small[i] = (f32x8)_mm256_min_ps(most, (__m256)channel[i]);
    }
    return i32x8_bytes_from_small_f32x8(small);
#else
    return i32x8_bytes_from_small_f32x8(channel);
#endif
}

// Convert 16-bit floats, which stand in the lower halves of the lanes with zero above, like rhw_half_to_float. Read as
// floats, the shifted bits are 2^112 times too small, denormals included; infinity and NaN get the exponent that the
// product lacks, NaN its quiet bit.
RHW_INLINE f32x8 f32x8_from_half(i32x8 half)
{
#if defined(__F16C__) && defined(__AVX2__)
    const __m256i lanes = (__m256i)half;
    return (f32x8)_mm256_cvtph_ps(
        _mm_packus_epi32(_mm256_castsi256_si128(lanes), _mm256_extracti128_si256(lanes, 1)));
#else
    const i32x8 magnitude = half & 0x7fff;
    const i32x8 finite = (i32x8)((f32x8)(magnitude << 13) * 0x1p112f);
    const i32x8 special = rhw_less_int(i32x8_splat(0x7bff), magnitude),
                nan = rhw_less_int(i32x8_splat(0x7c00), magnitude);
    return (f32x8)(finite | (special & 0x7f800000) | (nan & 0x400000) | ((half & 0x8000) << 16));
#endif
}

// Convert 8 16-bit floats that lie side by side.
RHW_INLINE f32x8 f32x8_from_halves(i32x4 halves)
{
#if defined(__F16C__) && defined(__AVX2__)
    return (f32x8)_mm256_cvtph_ps((__m128i)halves);
#else
    // These are the even ones and the odd ones.
    const i32x4 low = halves & 0xffff, high = (halves >> 16) & 0xffff;
#if defined(__SSE2__)
    const __m128i pairs[2] = {_mm_unpacklo_epi32((__m128i)low, (__m128i)high),
                              _mm_unpackhi_epi32((__m128i)low, (__m128i)high)};
    return f32x8_from_half(i32x8_load(pairs));
#else
    const i32x4 pairs[2] = {__builtin_shufflevector(low, high, 0, 4, 1, 5),
                            __builtin_shufflevector(low, high, 2, 6, 3, 7)};
    return f32x8_from_half(i32x8_load(pairs));
#endif
#endif
}

// Convert floats to 16-bit floats in the lower halves of the lanes, rounded to nearest, ties to even.
RHW_INLINE i32x8 i32x8_half_from_f32x8(f32x8 value)
{
#if defined(__F16C__) && defined(__AVX2__)
    return (i32x8)_mm256_cvtepu16_epi32(_mm256_cvtps_ph((__m256)value, _MM_FROUND_TO_NEAREST_INT));
#else
    i32x8 half;
    for (int i = 0; i < RHW_LANES; i++) {
        half[i] = rhw_half_from_float(value[i]);
    }
    return half;
#endif
}

// Two 16-bit halves in each lane ---------------------------------------------------------------------

// Return (a · b + 2^14) >> 15 of signed 16-bit numbers. The numbers of `b` are not negative.
RHW_INLINE i16x16 i16x16_scale(i16x16 a, i16x16 b)
{
#if defined(__AVX2__)
    return (i16x16)_mm256_mulhrs_epi16((__m256i)a, (__m256i)b);
#elif defined(__SSE2__)
    union lanes x, y;
    x.i = (i32x8)a;
    y.i = (i32x8)b;
    for (int i = 0; i < 2; i++) { // an average with 0 is (n + 1) >> 1
        const __m128i high = _mm_mulhi_epi16(x.half_i[i], y.half_i[i]);
        const __m128i low = _mm_srli_epi16(_mm_mullo_epi16(x.half_i[i], y.half_i[i]), 14);
        x.half_i[i] = _mm_add_epi16(_mm_add_epi16(high, high), _mm_avg_epu16(low, _mm_setzero_si128()));
    }
    return (i16x16)x.i;
#elif defined(__aarch64__)
    int16x8_t x[2], y[2];
    memcpy(x, &a, sizeof x);
    memcpy(y, &b, sizeof y);
    for (int i = 0; i < 2; i++) { // (2·a·b + 2^15) >> 16
        x[i] = vqrdmulhq_s16(x[i], y[i]);
    }
    memcpy(&a, x, sizeof a);
    return a;
#elif defined(__wasm_simd128__)
    v128_t x[2], y[2];
    memcpy(x, &a, sizeof x);
    memcpy(y, &b, sizeof y);
    for (int i = 0; i < 2; i++) {
        x[i] = wasm_i16x8_q15mulr_sat(x[i], y[i]);
    }
    memcpy(&a, x, sizeof a);
    return a;
#else
    const i32x8 x = (i32x8)a, y = (i32x8)b, half = i32x8_splat(1 << 14);
    const i32x8 low = ((x << 16 >> 16) * (y << 16 >> 16) + half) >> 15,
                high = ((x >> 16) * (y >> 16) + half) >> 15;
    return (i16x16)((low & 0xffff) | (high << 16));
#endif
}

// Return the sum of the products of each lane's halves with the halves of b's lane. No half is negative.
RHW_INLINE i32x8 i32x8_dot_halves(i32x8 a, i32x8 b)
{
#if defined(__AVX2__)
    return (i32x8)_mm256_madd_epi16((__m256i)a, (__m256i)b);
#elif defined(__SSE2__)
    union lanes x, y;
    x.i = a;
    y.i = b;
    x.half_i[0] = _mm_madd_epi16(x.half_i[0], y.half_i[0]);
    x.half_i[1] = _mm_madd_epi16(x.half_i[1], y.half_i[1]);
    return x.i;
#else
    return (a & 0xffff) * (b & 0xffff) + (a >> 16) * (b >> 16);
#endif
}

// Return the lower half of each lane in both halves, shifted one to the right.
RHW_INLINE i32x8 i32x8_halve_lower(i32x8 a)
{
#if defined(__AVX2__)
    const __m256i lower = _mm256_setr_epi8(0, 1, 0, 1, 4, 5, 4, 5, 8, 9, 8, 9, 12, 13, 12, 13, //
                                           0, 1, 0, 1, 4, 5, 4, 5, 8, 9, 8, 9, 12, 13, 12, 13);
    return (i32x8)_mm256_srli_epi16(_mm256_shuffle_epi8((__m256i)a, lower), 1);
#else
    const i32x8 half = (a >> 1) & 0x7fff;
    return half | (half << 16);
#endif
}

// Return the upper halves of `a` in the upper halves, and the upper halves of `b` in the lower ones.
RHW_INLINE i32x8 i32x8_join_upper(i32x8 a, i32x8 b)
{
#if defined(__AVX2__)
    return (i32x8)_mm256_blend_epi16(_mm256_srli_epi32((__m256i)b, 16), (__m256i)a, 0xaa);
#else
    return (a & ~0xffff) | (i32x8)((u32x8)b >> 16);
#endif
}

// Return how much every half, as an unsigned number, is above its half of `limit`, and 0 where it is not above.
RHW_INLINE i32x8 i32x8_over_halves(i32x8 a, i32x8 limit)
{
#if defined(__AVX2__)
    return (i32x8)_mm256_subs_epu16((__m256i)a, (__m256i)limit);
#elif defined(__SSE2__)
    union lanes x, y;
    x.i = a;
    y.i = limit;
    x.half_i[0] = _mm_subs_epu16(x.half_i[0], y.half_i[0]);
    x.half_i[1] = _mm_subs_epu16(x.half_i[1], y.half_i[1]);
    return x.i;
#else
    const i32x8 lower = (a & 0xffff) - (limit & 0xffff),
                upper = (i32x8)((u32x8)a >> 16) - (i32x8)((u32x8)limit >> 16);
    return (lower & ~(lower >> 31)) | (upper & ~(upper >> 31)) << 16;
#endif
}

RHW_INLINE bool i32x8_any_bit(i32x8 bits)
{
#if defined(__AVX2__)
    return !_mm256_testz_si256((__m256i)bits, (__m256i)bits);
#elif defined(__SSE2__)
    union lanes x;
    x.i = bits;
    const __m128i either = _mm_or_si128(x.half_i[0], x.half_i[1]);
    return _mm_movemask_epi8(_mm_cmpeq_epi8(either, _mm_setzero_si128())) != 0xffff;
#else
    return rhw_any(~rhw_equal_int(bits, i32x8_splat(0)));
#endif
}

// Return true if a bit of `bits` is set that is set in `mask` too.
RHW_INLINE bool i32x8_any_of(i32x8 bits, i32x8 mask)
{
#if defined(__AVX2__)
    return !_mm256_testz_si256((__m256i)bits, (__m256i)mask);
#else
    return i32x8_any_bit(bits & mask);
#endif
}

// The factors take the lower byte of each half, or the upper one, times 128 or −128: pmaddubsw has signed factors.
#if defined(__AVX2__)
enum { I8_WIDENS_NEGATED = 1 };
#else
enum { I8_WIDENS_NEGATED = 0 };
#endif

RHW_INLINE i32x8 i32x8_widen_lower(i32x8 bytes)
{
#if defined(__AVX2__)
    return (i32x8)_mm256_maddubs_epi16((__m256i)bytes, _mm256_set1_epi16(0x0080));
#else
    return (bytes << 7) & 0x7f807f80;
#endif
}

RHW_INLINE i32x8 i32x8_widen_upper(i32x8 bytes)
{
#if defined(__AVX2__)
    return (i32x8)_mm256_maddubs_epi16((__m256i)bytes, _mm256_set1_epi16((int16_t)0x8000));
#else
    return (i32x8)(((u32x8)bytes >> 1) & 0x7f807f80u);
#endif
}

// Lanes from other lanes ----------------------------------------------------------------------------

// This is 1 where i32x8_permute is an instruction.
#if defined(__AVX2__)
enum { I8_PERMUTES = 1 };
#else
enum { I8_PERMUTES = 0 };
#endif

// Return lane lane[i] of `v` in each lane. Lane numbers count modulo 8.
RHW_INLINE i32x8 i32x8_permute(i32x8 v, i32x8 lane)
{
#if defined(__AVX2__)
    return (i32x8)_mm256_permutevar8x32_epi32((__m256i)v, (__m256i)lane);
#else
    i32x8 result;
    for (int i = 0; i < RHW_LANES; i++) {
        result[i] = v[lane[i] & 7];
    }
    return result;
#endif
}

// Return in lane i the lane lane[i] of the 16 of `low` and then `high`. Lane numbers are 0..15.
RHW_INLINE i32x8 i32x8_permute_two(i32x8 low, i32x8 high, i32x8 lane)
{
#if defined(__AVX2__)
    // The blend reads the sign, where a shift puts the bit that is set from 8 on.
    return (i32x8)_mm256_blendv_ps((__m256)i32x8_permute(low, lane), (__m256)i32x8_permute(high, lane),
                                   (__m256)(lane << 28));
#else
    return rhw_select_int((lane << 28) >> 31, i32x8_permute(high, lane), i32x8_permute(low, lane));
#endif
}

// Return the first lane, or the last one, in all lanes.
RHW_INLINE i32x8 i32x8_splat_first(i32x8 v)
{
#if defined(__AVX2__)
    return (i32x8)_mm256_broadcastd_epi32(_mm256_castsi256_si128((__m256i)v));
#else
    return i32x8_splat(v[0]);
#endif
}

RHW_INLINE i32x8 i32x8_splat_last(i32x8 v)
{
#if defined(__AVX2__)
    return (i32x8)_mm256_shuffle_epi32(_mm256_permute4x64_epi64((__m256i)v, 0xff), 0xff);
#else
    return i32x8_splat(v[RHW_LANES - 1]);
#endif
}

// Loads from tables ---------------------------------------------------------------------------------

RHW_INLINE int32_t word_at(const void *words, uint32_t number)
{
    int32_t word;
    memcpy(&word, (const char *)words + (size_t)number * sizeof word, sizeof word);
    return word;
}

// Return the 4-byte words with these numbers.
RHW_INLINE i32x8 i32x8_gather(const void *words, i32x8 index)
{
#if defined(__AVX2__)
    return (i32x8)_mm256_i32gather_epi32(words, (__m256i)index, 4);
#else
    uint32_t at[RHW_LANES];
    memcpy(at, &index, sizeof at);
    const i32x4 halves[2] = {
        {word_at(words, at[0]), word_at(words, at[1]), word_at(words, at[2]), word_at(words, at[3])},
        {word_at(words, at[4]), word_at(words, at[5]), word_at(words, at[6]), word_at(words, at[7])}};
    return i32x8_load(halves);
#endif
}

// Return the 4-byte words with these numbers, from a table in the first cache level, by a load for each. A Zen 5 takes
// 1.2 times as long for a gather, and begins little beside it.
RHW_INLINE i32x8 i32x8_look_up(const void *words, i32x8 index)
{
#if defined(__AVX2__) && defined(__x86_64__)
    const __m128i half[2] = {_mm256_castsi256_si128((__m256i)index),
                             _mm256_extracti128_si256((__m256i)index, 1)};
    __m128i found[2];
    for (int i = 0; i < 2; i++) {
        const uint64_t a = (uint64_t)_mm_cvtsi128_si64(half[i]), b = (uint64_t)_mm_extract_epi64(half[i], 1);
        found[i] = _mm_unpacklo_epi64(_mm_insert_epi32(_mm_cvtsi32_si128(word_at(words, (uint32_t)a)),
                                                       word_at(words, (uint32_t)(a >> 32)), 1),
                                      _mm_insert_epi32(_mm_cvtsi32_si128(word_at(words, (uint32_t)b)),
                                                       word_at(words, (uint32_t)(b >> 32)), 1));
    }
    return (i32x8)_mm256_inserti128_si256(_mm256_castsi128_si256(found[0]), found[1], 1);
#else
    return i32x8_gather(words, index);
#endif
}

// Return the 4-byte words with these numbers, and the words behind them.
RHW_INLINE void i32x8_load_pairs(const unsigned char *words, const uint32_t at[RHW_LANES], i32x8 *first,
                                 i32x8 *second)
{
#if defined(__SSE2__)
    __m128 pair[4];
    for (int i = 0; i < 4; i++) {
        const void *const low = words + (size_t)at[2 * i] * 4;
        const void *const high = words + (size_t)at[2 * i + 1] * 4;
        pair[i] = _mm_loadh_pi(_mm_castsi128_ps(_mm_loadl_epi64(low)), high);
    }
    union lanes x, y;
#if defined(__AVX2__)
    const __m256 even = _mm256_insertf128_ps(_mm256_castps128_ps256(pair[0]), pair[2], 1);
    const __m256 odd = _mm256_insertf128_ps(_mm256_castps128_ps256(pair[1]), pair[3], 1);
    x.full = _mm256_shuffle_ps(even, odd, 0x88);
    y.full = _mm256_shuffle_ps(even, odd, 0xdd);
#else
    for (int i = 0; i < 2; i++) {
        x.half[i] = _mm_shuffle_ps(pair[2 * i], pair[2 * i + 1], 0x88);
        y.half[i] = _mm_shuffle_ps(pair[2 * i], pair[2 * i + 1], 0xdd);
    }
#endif
    *first = x.i;
    *second = y.i;
#else
    i32x4 four[4], halves[2][2];
    for (int i = 0; i < 4; i++) {
        i32x2 pair[2];
        memcpy(&pair[0], words + (size_t)at[2 * i] * 4, sizeof pair[0]);
        memcpy(&pair[1], words + (size_t)at[2 * i + 1] * 4, sizeof pair[1]);
        four[i] = __builtin_shufflevector(pair[0], pair[1], 0, 1, 2, 3);
    }
    for (int i = 0; i < 2; i++) {
        halves[0][i] = __builtin_shufflevector(four[2 * i], four[2 * i + 1], 0, 2, 4, 6);
        halves[1][i] = __builtin_shufflevector(four[2 * i], four[2 * i + 1], 1, 3, 5, 7);
    }
    *first = i32x8_load(halves[0]);
    *second = i32x8_load(halves[1]);
#endif
}

#endif
