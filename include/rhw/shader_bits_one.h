// SPDX-License-Identifier: MIT
// These are the functions of shader_integer.h and shader_pack.h for one integer or float at a time, with the bits of a
// lane. The docstrings there tell ranges and special cases. They are plain C, so a compiler without lanes has them too.
// shader.h includes this header.
#ifndef RHW_SHADER_BITS_ONE_H
#define RHW_SHADER_BITS_ONE_H

#include "shader_integer.h"
#include "shader_one.h"
#include "shader_pack.h"

RHW_QUIET_BEGIN

// Integers -------------------------------------------------------------------------------------------

static inline int32_t rhw_divide_int1(int32_t a, int32_t b)
{
    return b == 0 || (a == INT32_MIN && b == -1) ? a : a / b;
}

static inline int32_t rhw_remainder_int1(int32_t a, int32_t b)
{
    return b == 0 || b == -1 ? 0 : a % b;
}

static inline int32_t rhw_divide_uint1(int32_t a, int32_t b)
{
    return b == 0 ? a : (int32_t)((uint32_t)a / (uint32_t)b);
}

static inline int32_t rhw_remainder_uint1(int32_t a, int32_t b)
{
    return b == 0 ? 0 : (int32_t)((uint32_t)a % (uint32_t)b);
}

static inline int32_t rhw_bit_count1(int32_t a)
{
    uint32_t x = (uint32_t)a;
    x = x - ((x >> 1) & 0x55555555u);
    x = (x & 0x33333333u) + ((x >> 2) & 0x33333333u);
    x = (x + (x >> 4)) & 0x0f0f0f0fu;
    return (int32_t)((x * 0x01010101u) >> 24);
}

static inline int32_t rhw_bit_reverse1(int32_t a)
{
    uint32_t x = (uint32_t)a;
    x = (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
    x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
    x = (x >> 4 & 0x0f0f0f0fu) | (x & 0x0f0f0f0fu) << 4;
    x = (x >> 8 & 0x00ff00ffu) | (x & 0x00ff00ffu) << 8;
    return (int32_t)(x >> 16 | x << 16);
}

static inline int32_t rhw_find_lsb1(int32_t a)
{
    const uint32_t x = (uint32_t)a;
    return a == 0 ? -1 : rhw_bit_count1((int32_t)(~x & (x - 1u)));
}

static inline int32_t rhw_find_msb_uint1(int32_t a)
{
    uint32_t x = (uint32_t)a;
    x |= x >> 1;
    x |= x >> 2;
    x |= x >> 4;
    x |= x >> 8;
    x |= x >> 16;
    return rhw_bit_count1((int32_t)x) - 1;
}

static inline int32_t rhw_find_msb_int1(int32_t a)
{
    return rhw_find_msb_uint1(a < 0 ? ~a : a);
}

// Floats taken apart and put together ----------------------------------------------------------------

static inline float rhw_ldexp1(float a, int32_t n)
{
    const int32_t count = n < -300 ? -300 : n > 300 ? 300 : n;
    // 2^count is a double whose fraction is 0.
    const uint64_t bits = (uint64_t)(1023 + count) << 52;
    double power;
    memcpy(&power, &bits, sizeof power);
    return (float)((double)a * power);
}

static inline float rhw_frexp1(float a, int32_t *exponent)
{
    const float magnitude = rhw_abs1(a);
    *exponent = 0;
    if (!(magnitude > 0.0f && magnitude < rhw_infinity1())) {
        return a;
    }
    const bool tiny = magnitude < 1.17549435e-38f;
    const int32_t bits = rhw_bits_from_float1(tiny ? a * 16777216.0f : a);
    *exponent = (bits >> 23 & 0xff) - 126 - (tiny ? 24 : 0);
    return rhw_float_from_bits1((bits & (INT32_MIN | 0x7fffff)) | 0x3f000000);
}

static inline float rhw_modf1(float a, float *whole)
{
    *whole = rhw_trunc1(a);
    return a != a ? a : rhw_copysign1(rhw_abs1(a) == rhw_infinity1() ? 0.0f : a - *whole, a);
}

// Return a number that is clamped to `low`..1 already, times `scale`, in so many bits.
static inline uint32_t rhw_normalized1(float a, float scale, uint32_t bits)
{
    return (uint32_t)rhw_int_from_float1(rhw_round1(a * scale)) & bits;
}

static inline int32_t rhw_pack_unorm4x8_1(const float v[4])
{
    uint32_t packed = 0;
    for (int i = 0; i < 4; i++) {
        packed |= rhw_normalized1(rhw_saturate1(v[i]), 255.0f, 0xff) << (8 * i);
    }
    return (int32_t)packed;
}

static inline int32_t rhw_pack_snorm4x8_1(const float v[4])
{
    uint32_t packed = 0;
    for (int i = 0; i < 4; i++) {
        packed |= rhw_normalized1(rhw_clamp1(v[i], -1.0f, 1.0f), 127.0f, 0xff) << (8 * i);
    }
    return (int32_t)packed;
}

static inline int32_t rhw_pack_unorm2x16_1(const float v[2])
{
    const uint32_t low = rhw_normalized1(rhw_saturate1(v[0]), 65535.0f, 0xffff);
    return (int32_t)(low | rhw_normalized1(rhw_saturate1(v[1]), 65535.0f, 0xffff) << 16);
}

static inline int32_t rhw_pack_snorm2x16_1(const float v[2])
{
    const uint32_t low = rhw_normalized1(rhw_clamp1(v[0], -1.0f, 1.0f), 32767.0f, 0xffff);
    return (int32_t)(low | rhw_normalized1(rhw_clamp1(v[1], -1.0f, 1.0f), 32767.0f, 0xffff) << 16);
}

static inline void rhw_unpack_unorm4x8_1(int32_t a, float v[4])
{
    for (int i = 0; i < 4; i++) {
        v[i] = (float)((uint32_t)a >> (8 * i) & 0xff) / 255.0f;
    }
}

// Return the integer that `bits` bits of a from bit `first` on are, signed.
static inline int32_t rhw_signed_field1(int32_t a, int first, int bits)
{
    const int32_t field = (int32_t)((uint32_t)a >> first & ((1u << bits) - 1));
    return field >= 1 << (bits - 1) ? field - (1 << bits) : field;
}

static inline void rhw_unpack_snorm4x8_1(int32_t a, float v[4])
{
    for (int i = 0; i < 4; i++) {
        v[i] = rhw_max1((float)rhw_signed_field1(a, 8 * i, 8) / 127.0f, -1.0f);
    }
}

static inline void rhw_unpack_unorm2x16_1(int32_t a, float v[2])
{
    v[0] = (float)((uint32_t)a & 0xffff) / 65535.0f;
    v[1] = (float)((uint32_t)a >> 16) / 65535.0f;
}

static inline void rhw_unpack_snorm2x16_1(int32_t a, float v[2])
{
    for (int i = 0; i < 2; i++) {
        v[i] = rhw_max1((float)rhw_signed_field1(a, 16 * i, 16) / 32767.0f, -1.0f);
    }
}

static inline int32_t rhw_half_bits_from_float1(float a)
{
    const float magnitude = rhw_abs1(a);
    if (a != a) {
        return 0x7e00;
    }
    const int32_t bits = rhw_bits_from_float1(magnitude);
    const int32_t small = rhw_bits_from_float1(magnitude + 0.5f) - 0x3f000000;
    const int32_t normal = (bits - 0x38000000 + 0xfff + (bits >> 13 & 1)) >> 13;
    const int32_t half = magnitude < 6.10351562e-05f ? small : magnitude < 65520.0f ? normal : 0x7c00;
    return half | (rhw_bits_from_float1(a) < 0 ? 0x8000 : 0);
}

static inline float rhw_float_from_half_bits1(int32_t a)
{
    const int32_t magnitude = a & 0x7fff;
    float value = (float)magnitude * 5.9604644775390625e-08f;
    if (magnitude > 0x7c00) {
        value = rhw_nan1();
    } else if (magnitude == 0x7c00) {
        value = rhw_infinity1();
    } else if (magnitude >= 0x400) {
        value = rhw_float_from_bits1((magnitude << 13) + 0x38000000);
    }
    return rhw_copysign1(value, a & 0x8000 ? -1.0f : 1.0f);
}

static inline int32_t rhw_pack_half2x16_1(const float v[2])
{
    return (int32_t)((uint32_t)rhw_half_bits_from_float1(v[0]) | (uint32_t)rhw_half_bits_from_float1(v[1])
                                                                     << 16);
}

static inline void rhw_unpack_half2x16_1(int32_t a, float v[2])
{
    v[0] = rhw_float_from_half_bits1(a);
    v[1] = rhw_float_from_half_bits1((int32_t)((uint32_t)a >> 16));
}

RHW_QUIET_END

#endif
