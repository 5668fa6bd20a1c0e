// SPDX-License-Identifier: MIT
// These functions of the library do the maths and sampling of the one-at-a-time form, so that any compiler can call
// them. If the compiler has lanes (RHW_HAS_LANES), the names of the maths functions that programs use are inline
// functions of shader_one.h with the same bits. shader_one.h includes this header.
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
    RHW_MATH1_ROUND,
    RHW_MATH1_SINH,
    RHW_MATH1_COSH,
    RHW_MATH1_TANH,
    RHW_MATH1_ASINH,
    RHW_MATH1_ACOSH,
    RHW_MATH1_ATANH
};

/// Return one lane of the function that `function` names. POW and ATAN2 read `b`; the others ignore it. Return NaN if
/// `function` is out of range.
RHW_API float rhw_math1(enum rhw_math1_function function, float a, float b);

/// A request says what one lane asks of a texture. Each member means what the member of struct rhw_sample_request with
/// the same name means.
struct rhw_sample_request1 {
    const float *coordinates, *gradient;
    const float *lod, *reference;
    const int32_t *offset;
    const float *bias;
};

/// Sample one lane of rhw_sample.
RHW_API void rhw_sample1(const struct rhw_bindings *bindings, int slot,
                         const struct rhw_sample_request1 *request, float texel[4]);

/// Gather one lane of rhw_sample_gather.
RHW_API void rhw_sample_gather1(const struct rhw_bindings *bindings, int slot,
                                const struct rhw_sample_request1 *request, int channel, float texel[4]);

/// Fetch one lane of rhw_sample_fetch.
RHW_API void rhw_sample_fetch1(const struct rhw_bindings *bindings, int slot, const int32_t *at,
                               int32_t level, float texel[4]);

/// Fetch one lane of rhw_sample_fetch_sample.
RHW_API void rhw_sample_fetch_sample1(const struct rhw_bindings *bindings, int slot, const int32_t *at,
                                      int32_t sample, float texel[4]);

/// Compute one lane of rhw_sample_query_lod.
RHW_API void rhw_sample_query_lod1(const struct rhw_bindings *bindings, int slot,
                                   const struct rhw_sample_request1 *request, float lod[2]);

/// Compute one lane of rhw_sample_size.
RHW_API void rhw_sample_size1(const struct rhw_bindings *bindings, int slot, int32_t level, int32_t size[3]);

/// Sample one lane of rhw_sample_compare_window, footprint by footprint.
RHW_API void rhw_sample_compare_window1(const struct rhw_bindings *bindings, int slot,
                                        const struct rhw_sample_request1 *request, int columns, int rows,
                                        float *parts);

/// Sample one lane of rhw_sample_groups. Bit n of `slots` samples slot n into texels[n], for one fragment, so there is
/// neither a count nor a stride. `texels` may be fragment->color.
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

static inline float rhw_sinh1(float a)
{
    return rhw_math1(RHW_MATH1_SINH, a, 0);
}

static inline float rhw_cosh1(float a)
{
    return rhw_math1(RHW_MATH1_COSH, a, 0);
}

static inline float rhw_tanh1(float a)
{
    return rhw_math1(RHW_MATH1_TANH, a, 0);
}

static inline float rhw_asinh1(float a)
{
    return rhw_math1(RHW_MATH1_ASINH, a, 0);
}

static inline float rhw_acosh1(float a)
{
    return rhw_math1(RHW_MATH1_ACOSH, a, 0);
}

static inline float rhw_atanh1(float a)
{
    return rhw_math1(RHW_MATH1_ATANH, a, 0);
}

static inline void rhw_sincos1(float a, float *sine, float *cosine)
{
    *sine = rhw_sin1(a);
    *cosine = rhw_cos1(a);
}

RHW_QUIET_END

#endif

#endif
