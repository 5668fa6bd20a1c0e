// SPDX-License-Identifier: MIT
// This is the shader kit for one vertex or fragment at a time. It has every function of 8 lanes under the same name
// with a 1 behind it, or _1 after a digit. These functions take plain floats and give the bits of a lane. A mask is a
// bool. The docstrings of the headers for lanes tell ranges, special cases and errors. shader.h includes this header
// and shader_bits_one.h, which has the functions of shader_integer.h and shader_pack.h. A compiler without lanes
// has these functions too: where the functions here go through a lane, it calls the library (shader_no_lanes.h).
#ifndef RHW_SHADER_ONE_H
#define RHW_SHADER_ONE_H

#include "shader_hyperbolic.h"
#include "shader_linear.h"
#include "shader_math.h"
#include "shader_memory.h"
#include "shader_no_lanes.h"
#include "shader_sample.h"
#include "shader_storage.h"

#include <stdbool.h>
#include <string.h>

RHW_QUIET_BEGIN

// Comparison and selection ---------------------------------------------------------------------------

static inline bool rhw_less1(float a, float b)
{
    return a < b;
}

static inline bool rhw_less_equal1(float a, float b)
{
    return a <= b;
}

static inline bool rhw_equal1(float a, float b)
{
    return a == b;
}

static inline bool rhw_greater1(float a, float b)
{
    return a > b;
}

static inline bool rhw_greater_equal1(float a, float b)
{
    return a >= b;
}

static inline bool rhw_not_equal1(float a, float b)
{
    return a != b;
}

static inline bool rhw_less_int1(int32_t a, int32_t b)
{
    return a < b;
}

static inline bool rhw_equal_int1(int32_t a, int32_t b)
{
    return a == b;
}

static inline float rhw_select1(bool mask, float a, float b)
{
    return mask ? a : b;
}

static inline int32_t rhw_select_int1(bool mask, int32_t a, int32_t b)
{
    return mask ? a : b;
}

static inline float rhw_min1(float a, float b)
{
    return a < b ? a : b;
}

static inline float rhw_max1(float a, float b)
{
    return a > b ? a : b;
}

static inline int32_t rhw_min_int1(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

static inline int32_t rhw_max_int1(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

static inline float rhw_clamp1(float a, float low, float high)
{
    return rhw_min1(rhw_max1(a, low), high);
}

static inline float rhw_saturate1(float a)
{
    return rhw_clamp1(a, 0.0f, 1.0f);
}

// Conversion -----------------------------------------------------------------------------------------

static inline int32_t rhw_bits_from_float1(float a)
{
    int32_t bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}

static inline float rhw_float_from_bits1(int32_t a)
{
    float value;
    memcpy(&value, &a, sizeof value);
    return value;
}

static inline float rhw_float_from_int1(int32_t a)
{
    return (float)a;
}

static inline int32_t rhw_int_from_float1(float a)
{
    return a >= 2147483648.0f ? INT32_MAX : a < -2147483648.0f ? INT32_MIN : a == a ? (int32_t)a : 0;
}

static inline int32_t rhw_int_from_float_unchecked1(float a)
{
    return rhw_int_from_float1(a);
}

// Through a lane -------------------------------------------------------------------------------------

#if RHW_HAS_LANES

static inline float rhw_trunc1(float a)
{
    return rhw_trunc(rhw_splat(a))[0];
}

static inline float rhw_floor1(float a)
{
    return rhw_floor(rhw_splat(a))[0];
}

static inline float rhw_ceil1(float a)
{
    return rhw_ceil(rhw_splat(a))[0];
}

static inline float rhw_round1(float a)
{
    return rhw_round(rhw_splat(a))[0];
}

static inline float rhw_sqrt1(float a)
{
    return rhw_sqrt(rhw_splat(a))[0];
}

static inline float rhw_exp2_1(float a)
{
    return rhw_exp2(rhw_splat(a))[0];
}

static inline float rhw_exp1(float a)
{
    return rhw_exp(rhw_splat(a))[0];
}

static inline float rhw_log2_1(float a)
{
    return rhw_log2(rhw_splat(a))[0];
}

static inline float rhw_log1(float a)
{
    return rhw_log(rhw_splat(a))[0];
}

static inline float rhw_pow1(float a, float b)
{
    return rhw_pow(rhw_splat(a), rhw_splat(b))[0];
}

static inline void rhw_sincos1(float a, float *sine, float *cosine)
{
    rhw_float both[2];
    rhw_sincos(rhw_splat(a), &both[0], &both[1]);
    *sine = both[0][0];
    *cosine = both[1][0];
}

static inline float rhw_sin1(float a)
{
    return rhw_sin(rhw_splat(a))[0];
}

static inline float rhw_cos1(float a)
{
    return rhw_cos(rhw_splat(a))[0];
}

static inline float rhw_tan1(float a)
{
    return rhw_tan(rhw_splat(a))[0];
}

static inline float rhw_atan2_1(float y, float x)
{
    return rhw_atan2(rhw_splat(y), rhw_splat(x))[0];
}

static inline float rhw_atan1(float a)
{
    return rhw_atan(rhw_splat(a))[0];
}

static inline float rhw_asin1(float a)
{
    return rhw_asin(rhw_splat(a))[0];
}

static inline float rhw_acos1(float a)
{
    return rhw_acos(rhw_splat(a))[0];
}

static inline float rhw_sinh1(float a)
{
    return rhw_sinh(rhw_splat(a))[0];
}

static inline float rhw_cosh1(float a)
{
    return rhw_cosh(rhw_splat(a))[0];
}

static inline float rhw_tanh1(float a)
{
    return rhw_tanh(rhw_splat(a))[0];
}

static inline float rhw_asinh1(float a)
{
    return rhw_asinh(rhw_splat(a))[0];
}

static inline float rhw_acosh1(float a)
{
    return rhw_acosh(rhw_splat(a))[0];
}

static inline float rhw_atanh1(float a)
{
    return rhw_atanh(rhw_splat(a))[0];
}

#endif

// Sign and rounding ----------------------------------------------------------------------------------

static inline float rhw_abs1(float a)
{
    return rhw_float_from_bits1(rhw_bits_from_float1(a) & INT32_MAX);
}

static inline float rhw_copysign1(float a, float sign)
{
    return rhw_float_from_bits1((rhw_bits_from_float1(a) & INT32_MAX) |
                                (rhw_bits_from_float1(sign) & INT32_MIN));
}

static inline float rhw_sign1(float a)
{
    return a > 0.0f ? 1.0f : a < 0.0f ? -1.0f : rhw_float_from_bits1(0);
}

static inline float rhw_fract1(float a)
{
    return a - rhw_floor1(a);
}

static inline float rhw_mix1(float a, float b, float t)
{
    return a + (b - a) * t;
}

static inline float rhw_smoothstep1(float edge0, float edge1, float a)
{
    const float t = rhw_saturate1((a - edge0) / (edge1 - edge0));
    return t * t * (3.0f - 2.0f * t);
}

static inline float rhw_rsqrt1(float a)
{
    return 1.0f / rhw_sqrt1(a);
}

// Special values -------------------------------------------------------------------------------------

static inline float rhw_infinity1(void)
{
    return rhw_float_from_bits1(0x7f800000);
}

static inline float rhw_nan1(void)
{
    return rhw_float_from_bits1(0x7fc00000);
}

// Small vectors and matrices -------------------------------------------------------------------------

static inline float rhw_dot2_1(const float a[2], const float b[2])
{
    return a[0] * b[0] + a[1] * b[1];
}

static inline float rhw_dot3_1(const float a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline float rhw_dot4_1(const float a[4], const float b[4])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

static inline float rhw_length2_1(const float a[2])
{
    return rhw_sqrt1(rhw_dot2_1(a, a));
}

static inline float rhw_length3_1(const float a[3])
{
    return rhw_sqrt1(rhw_dot3_1(a, a));
}

static inline float rhw_length4_1(const float a[4])
{
    return rhw_sqrt1(rhw_dot4_1(a, a));
}

static inline void rhw_cross1(const float a[3], const float b[3], float result[3])
{
    result[0] = a[1] * b[2] - a[2] * b[1];
    result[1] = a[2] * b[0] - a[0] * b[2];
    result[2] = a[0] * b[1] - a[1] * b[0];
}

// Return the factor that gives a vector with this square the length 1, as rhw_normalizing does.
static inline float rhw_normalizing1(float square)
{
    return rhw_rsqrt1(rhw_max1(square, 1.17549435e-38f));
}

static inline void rhw_normalize2_1(const float a[2], float result[2])
{
    const float scale = rhw_normalizing1(rhw_dot2_1(a, a));
    result[0] = a[0] * scale;
    result[1] = a[1] * scale;
}

static inline void rhw_normalize3_1(const float a[3], float result[3])
{
    const float scale = rhw_normalizing1(rhw_dot3_1(a, a));
    result[0] = a[0] * scale;
    result[1] = a[1] * scale;
    result[2] = a[2] * scale;
}

static inline void rhw_normalize4_1(const float a[4], float result[4])
{
    const float scale = rhw_normalizing1(rhw_dot4_1(a, a));
    result[0] = a[0] * scale;
    result[1] = a[1] * scale;
    result[2] = a[2] * scale;
    result[3] = a[3] * scale;
}

static inline void rhw_reflect2_1(const float incident[2], const float normal[2], float result[2])
{
    const float twice = 2.0f * rhw_dot2_1(normal, incident);
    result[0] = incident[0] - twice * normal[0];
    result[1] = incident[1] - twice * normal[1];
}

static inline void rhw_reflect3_1(const float incident[3], const float normal[3], float result[3])
{
    const float twice = 2.0f * rhw_dot3_1(normal, incident);
    result[0] = incident[0] - twice * normal[0];
    result[1] = incident[1] - twice * normal[1];
    result[2] = incident[2] - twice * normal[2];
}

static inline void rhw_mat4_mul_vec4_1(const float m[16], const float v[4], float result[4])
{
    const float x = v[0], y = v[1], z = v[2], w = v[3];
    for (int r = 0; r < 4; r++) {
        result[r] = m[r] * x + m[4 + r] * y + m[8 + r] * z + m[12 + r] * w;
    }
}

static inline void rhw_mat4_mul_point1(const float m[16], const float v[3], float result[4])
{
    const float x = v[0], y = v[1], z = v[2];
    for (int r = 0; r < 4; r++) {
        result[r] = m[r] * x + m[4 + r] * y + m[8 + r] * z + m[12 + r];
    }
}

static inline void rhw_mat4_mul_direction1(const float m[16], const float v[3], float result[3])
{
    const float x = v[0], y = v[1], z = v[2];
    for (int r = 0; r < 3; r++) {
        result[r] = m[r] * x + m[4 + r] * y + m[8 + r] * z;
    }
}

static inline void rhw_mat3_mul_vec3_1(const float m[9], const float v[3], float result[3])
{
    const float x = v[0], y = v[1], z = v[2];
    for (int r = 0; r < 3; r++) {
        result[r] = m[r] * x + m[3 + r] * y + m[6 + r] * z;
    }
}

// Tables and textures --------------------------------------------------------------------------------

static inline float rhw_gather1(const float *table, int32_t count, int32_t index)
{
    return index >= 0 && index < count ? table[index] : 0.0f;
}

static inline int32_t rhw_gather_int1(const int32_t *table, int32_t count, int32_t index)
{
    return index >= 0 && index < count ? table[index] : 0;
}

static inline void rhw_sample_grad1(const struct rhw_bindings *bindings, int slot, const float *coordinates,
                                    const float *grad, float texel[4])
{
    const struct rhw_sample_request1 request = {
        coordinates, grad, (const float *)0, (const float *)0, (const int32_t *)0, (const float *)0};
    rhw_sample1(bindings, slot, &request, texel);
}

static inline void rhw_sample_lod1(const struct rhw_bindings *bindings, int slot, const float *coordinates,
                                   float lod, float texel[4])
{
    const struct rhw_sample_request1 request = {coordinates,      (const float *)0,   &lod,
                                                (const float *)0, (const int32_t *)0, (const float *)0};
    rhw_sample1(bindings, slot, &request, texel);
}

static inline void rhw_sample_bias1(const struct rhw_bindings *bindings, int slot, const float *coordinates,
                                    const float *grad, float bias, float texel[4])
{
    const struct rhw_sample_request1 request = {coordinates,        grad, (const float *)0, (const float *)0,
                                                (const int32_t *)0, &bias};
    rhw_sample1(bindings, slot, &request, texel);
}

static inline float rhw_sample_compare_grad1(const struct rhw_bindings *bindings, int slot,
                                             const float *coordinates, float reference, const float *grad)
{
    const struct rhw_sample_request1 request = {
        coordinates, grad, (const float *)0, &reference, (const int32_t *)0, (const float *)0};
    float texel[4];
    rhw_sample1(bindings, slot, &request, texel);
    return texel[0];
}

static inline float rhw_sample_compare_lod1(const struct rhw_bindings *bindings, int slot,
                                            const float *coordinates, float reference, float lod)
{
    const struct rhw_sample_request1 request = {coordinates, (const float *)0,   &lod,
                                                &reference,  (const int32_t *)0, (const float *)0};
    float texel[4];
    rhw_sample1(bindings, slot, &request, texel);
    return texel[0];
}

RHW_QUIET_END

#endif
