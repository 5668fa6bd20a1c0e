// SPDX-License-Identifier: MIT
// Maths and sampling of the one-at-a-time form as functions of the library, which any compiler can call. Where there
// are lanes (compiler.h), the names that programs use are inline functions with the same bits. Included by shader_one.h.
#ifndef RHW_SHADER_NO_LANES_H
#define RHW_SHADER_NO_LANES_H

#include "shader_lanes.h"

struct rhw_bindings;
struct rhw_fragment1;

enum rhw_math1_function {
    RHW_MATH1_EXP2,
    RHW_MATH1_EXP,
    RHW_MATH1_LOG2,
    RHW_MATH1_LOG,
    RHW_MATH1_POW,
    RHW_MATH1_SIN,
    RHW_MATH1_COS,
    RHW_MATH1_TAN,
    RHW_MATH1_ASIN,
    RHW_MATH1_ACOS,
    RHW_MATH1_ATAN,
    RHW_MATH1_ATAN2,
    RHW_MATH1_SQRT,
    RHW_MATH1_TRUNC,
    RHW_MATH1_FLOOR,
    RHW_MATH1_CEIL,
    RHW_MATH1_ROUND
};

/// A lane of the function that the name says; `b` is read by POW and ATAN2 alone. NaN for another number.
RHW_API float rhw_math1(enum rhw_math1_function function, float a, float b);

/// What one lane asks of a texture; the members mean what those of struct rhw_sample_request do.
struct rhw_sample_request1 {
    const float *coordinates, *gradient;
    const float *lod, *reference;
    const int32_t *offset;
    const float *bias;
};

/// A lane of rhw_sample, rhw_sample_gather, rhw_sample_fetch, rhw_sample_fetch_sample, rhw_sample_query_lod and
/// rhw_sample_size.
RHW_API void rhw_sample1(const struct rhw_bindings *textures, int slot,
                         const struct rhw_sample_request1 *request, float texel[4]);
RHW_API void rhw_sample_gather1(const struct rhw_bindings *textures, int slot,
                                const struct rhw_sample_request1 *request, int channel, float texel[4]);
RHW_API void rhw_sample_fetch1(const struct rhw_bindings *textures, int slot, const int32_t *at,
                               int32_t level, float texel[4]);
RHW_API void rhw_sample_fetch_sample1(const struct rhw_bindings *textures, int slot, const int32_t *at,
                                      int32_t sample, float texel[4]);
RHW_API void rhw_sample_query_lod1(const struct rhw_bindings *textures, int slot,
                                   const struct rhw_sample_request1 *request, float lod[2]);
RHW_API void rhw_sample_size1(const struct rhw_bindings *textures, int slot, int32_t level, int32_t size[3]);
/// A lane of rhw_sample_compare_window, footprint by footprint.
RHW_API void rhw_sample_compare_window1(const struct rhw_bindings *textures, int slot,
                                        const struct rhw_sample_request1 *request, int columns, int rows,
                                        float *parts);
/// A lane of rhw_sample_groups: bit n of `slots` samples slot n into texels[n], for this fragment alone, hence no count and
/// no stride. fragment->color is allowed.
RHW_API void rhw_sample_groups1(const struct rhw_fragment1 *fragment, uint32_t slots, int at,
                                float (*texels)[4]);

#if !RHW_HAS_LANES

RHW_QUIET_BEGIN

static inline float rhw_exp2_1(float a)
{
    return rhw_math1(RHW_MATH1_EXP2, a, 0);
}

static inline float rhw_exp1(float a)
{
    return rhw_math1(RHW_MATH1_EXP, a, 0);
}

static inline float rhw_log2_1(float a)
{
    return rhw_math1(RHW_MATH1_LOG2, a, 0);
}

static inline float rhw_log1(float a)
{
    return rhw_math1(RHW_MATH1_LOG, a, 0);
}

static inline float rhw_pow1(float a, float b)
{
    return rhw_math1(RHW_MATH1_POW, a, b);
}

static inline float rhw_sin1(float a)
{
    return rhw_math1(RHW_MATH1_SIN, a, 0);
}

static inline float rhw_cos1(float a)
{
    return rhw_math1(RHW_MATH1_COS, a, 0);
}

static inline float rhw_tan1(float a)
{
    return rhw_math1(RHW_MATH1_TAN, a, 0);
}

static inline float rhw_asin1(float a)
{
    return rhw_math1(RHW_MATH1_ASIN, a, 0);
}

static inline float rhw_acos1(float a)
{
    return rhw_math1(RHW_MATH1_ACOS, a, 0);
}

static inline float rhw_atan1(float a)
{
    return rhw_math1(RHW_MATH1_ATAN, a, 0);
}

static inline float rhw_atan2_1(float y, float x)
{
    return rhw_math1(RHW_MATH1_ATAN2, y, x);
}

static inline float rhw_sqrt1(float a)
{
    return rhw_math1(RHW_MATH1_SQRT, a, 0);
}

static inline float rhw_trunc1(float a)
{
    return rhw_math1(RHW_MATH1_TRUNC, a, 0);
}

static inline float rhw_floor1(float a)
{
    return rhw_math1(RHW_MATH1_FLOOR, a, 0);
}

static inline float rhw_ceil1(float a)
{
    return rhw_math1(RHW_MATH1_CEIL, a, 0);
}

static inline float rhw_round1(float a)
{
    return rhw_math1(RHW_MATH1_ROUND, a, 0);
}

static inline void rhw_sincos1(float a, float *sine, float *cosine)
{
    *sine = rhw_sin1(a);
    *cosine = rhw_cos1(a);
}

RHW_QUIET_END

#endif

#endif
