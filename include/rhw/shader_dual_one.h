// SPDX-License-Identifier: MIT
// These are the duals of one fragment at a time. Every function of shader_dual.h is here under the same name with a 1
// behind it, or _1 after a digit. The functions give the bits of a lane. shader_dual.h includes this header.
#ifndef RHW_SHADER_DUAL_ONE_H
#define RHW_SHADER_DUAL_ONE_H

#include "shader_dual.h"

#if RHW_HAS_LANES

RHW_QUIET_BEGIN

/// One value, with its change per pixel to the right (ddx) and down (ddy).
struct rhw_dual1 {
    float value, ddx, ddy;
};

// Making duals --------------------------------------------------------------------------------------

static inline struct rhw_dual1 rhw_dual_make1(float value, float ddx, float ddy)
{
    const struct rhw_dual1 result = {value, ddx, ddy};
    return result;
}

static inline struct rhw_dual1 rhw_dual_constant1(float value)
{
    return rhw_dual_make1(value, 0.0f, 0.0f);
}

static inline struct rhw_dual1 rhw_dual_varying1(const struct rhw_fragment1 *f, int component)
{
    return rhw_dual_make1(f->varying[component], f->ddx[component], f->ddy[component]);
}

// These functions go to 8 equal lanes and back, so that results have the bits of a lane.

static inline struct rhw_dual rhw_dual_splat(struct rhw_dual1 a)
{
    return rhw_dual_make(rhw_splat(a.value), rhw_splat(a.ddx), rhw_splat(a.ddy));
}

static inline void rhw_dual_splat_all(int count, const struct rhw_dual1 *a, struct rhw_dual *result)
{
    for (int i = 0; i < count; i++) {
        result[i] = rhw_dual_splat(a[i]);
    }
}

static inline struct rhw_dual1 rhw_dual_lane(struct rhw_dual a)
{
    return rhw_dual_make1(a.value[0], a.ddx[0], a.ddy[0]);
}

static inline void rhw_dual_lane_all(int count, const struct rhw_dual *a, struct rhw_dual1 *result)
{
    for (int i = 0; i < count; i++) {
        result[i] = rhw_dual_lane(a[i]);
    }
}

static inline struct rhw_dual1 rhw_dual_chain1(float value, float slope, struct rhw_dual1 a)
{
    return rhw_dual_lane(rhw_dual_chain(rhw_splat(value), rhw_splat(slope), rhw_dual_splat(a)));
}

static inline struct rhw_dual1 rhw_dual_select1(bool mask, struct rhw_dual1 a, struct rhw_dual1 b)
{
    return rhw_dual_lane(
        rhw_dual_select(rhw_splat_int(-(int32_t)mask), rhw_dual_splat(a), rhw_dual_splat(b)));
}

// Arithmetic ----------------------------------------------------------------------------------------

static inline struct rhw_dual1 rhw_dual_neg1(struct rhw_dual1 a)
{
    return rhw_dual_lane(rhw_dual_neg(rhw_dual_splat(a)));
}

static inline struct rhw_dual1 rhw_dual_add1(struct rhw_dual1 a, struct rhw_dual1 b)
{
    return rhw_dual_lane(rhw_dual_add(rhw_dual_splat(a), rhw_dual_splat(b)));
}

static inline struct rhw_dual1 rhw_dual_sub1(struct rhw_dual1 a, struct rhw_dual1 b)
{
    return rhw_dual_lane(rhw_dual_sub(rhw_dual_splat(a), rhw_dual_splat(b)));
}

static inline struct rhw_dual1 rhw_dual_mul1(struct rhw_dual1 a, struct rhw_dual1 b)
{
    return rhw_dual_lane(rhw_dual_mul(rhw_dual_splat(a), rhw_dual_splat(b)));
}

static inline struct rhw_dual1 rhw_dual_div1(struct rhw_dual1 a, struct rhw_dual1 b)
{
    return rhw_dual_lane(rhw_dual_div(rhw_dual_splat(a), rhw_dual_splat(b)));
}

static inline struct rhw_dual1 rhw_dual_scale1(struct rhw_dual1 a, float factor)
{
    return rhw_dual_lane(rhw_dual_scale(rhw_dual_splat(a), rhw_splat(factor)));
}

static inline struct rhw_dual1 rhw_dual_offset1(struct rhw_dual1 a, float offset)
{
    return rhw_dual_lane(rhw_dual_offset(rhw_dual_splat(a), rhw_splat(offset)));
}

// Minimum, maximum and range ------------------------------------------------------------------------

static inline struct rhw_dual1 rhw_dual_abs1(struct rhw_dual1 a)
{
    return rhw_dual_lane(rhw_dual_abs(rhw_dual_splat(a)));
}

static inline struct rhw_dual1 rhw_dual_min1(struct rhw_dual1 a, struct rhw_dual1 b)
{
    return rhw_dual_lane(rhw_dual_min(rhw_dual_splat(a), rhw_dual_splat(b)));
}

static inline struct rhw_dual1 rhw_dual_max1(struct rhw_dual1 a, struct rhw_dual1 b)
{
    return rhw_dual_lane(rhw_dual_max(rhw_dual_splat(a), rhw_dual_splat(b)));
}

static inline struct rhw_dual1 rhw_dual_clamp1(struct rhw_dual1 a, struct rhw_dual1 low,
                                               struct rhw_dual1 high)
{
    return rhw_dual_lane(rhw_dual_clamp(rhw_dual_splat(a), rhw_dual_splat(low), rhw_dual_splat(high)));
}

static inline struct rhw_dual1 rhw_dual_saturate1(struct rhw_dual1 a)
{
    return rhw_dual_lane(rhw_dual_saturate(rhw_dual_splat(a)));
}

static inline struct rhw_dual1 rhw_dual_fract1(struct rhw_dual1 a)
{
    return rhw_dual_lane(rhw_dual_fract(rhw_dual_splat(a)));
}

static inline struct rhw_dual1 rhw_dual_mix1(struct rhw_dual1 a, struct rhw_dual1 b, struct rhw_dual1 t)
{
    return rhw_dual_lane(rhw_dual_mix(rhw_dual_splat(a), rhw_dual_splat(b), rhw_dual_splat(t)));
}

static inline struct rhw_dual1 rhw_dual_smoothstep1(struct rhw_dual1 edge0, struct rhw_dual1 edge1,
                                                    struct rhw_dual1 a)
{
    return rhw_dual_lane(
        rhw_dual_smoothstep(rhw_dual_splat(edge0), rhw_dual_splat(edge1), rhw_dual_splat(a)));
}

// Powers and logarithms -----------------------------------------------------------------------------

static inline struct rhw_dual1 rhw_dual_sqrt1(struct rhw_dual1 a)
{
    return rhw_dual_lane(rhw_dual_sqrt(rhw_dual_splat(a)));
}

static inline struct rhw_dual1 rhw_dual_rsqrt1(struct rhw_dual1 a)
{
    return rhw_dual_lane(rhw_dual_rsqrt(rhw_dual_splat(a)));
}

static inline struct rhw_dual1 rhw_dual_exp2_1(struct rhw_dual1 a)
{
    return rhw_dual_lane(rhw_dual_exp2(rhw_dual_splat(a)));
}

static inline struct rhw_dual1 rhw_dual_exp1(struct rhw_dual1 a)
{
    return rhw_dual_lane(rhw_dual_exp(rhw_dual_splat(a)));
}

static inline struct rhw_dual1 rhw_dual_log2_1(struct rhw_dual1 a)
{
    return rhw_dual_lane(rhw_dual_log2(rhw_dual_splat(a)));
}

static inline struct rhw_dual1 rhw_dual_log1(struct rhw_dual1 a)
{
    return rhw_dual_lane(rhw_dual_log(rhw_dual_splat(a)));
}

static inline struct rhw_dual1 rhw_dual_pow1(struct rhw_dual1 a, struct rhw_dual1 b)
{
    return rhw_dual_lane(rhw_dual_pow(rhw_dual_splat(a), rhw_dual_splat(b)));
}

// Trigonometry --------------------------------------------------------------------------------------

static inline void rhw_dual_sincos1(struct rhw_dual1 a, struct rhw_dual1 *sine, struct rhw_dual1 *cosine)
{
    struct rhw_dual both[2];
    rhw_dual_sincos(rhw_dual_splat(a), &both[0], &both[1]);
    *sine = rhw_dual_lane(both[0]);
    *cosine = rhw_dual_lane(both[1]);
}

static inline struct rhw_dual1 rhw_dual_sin1(struct rhw_dual1 a)
{
    return rhw_dual_lane(rhw_dual_sin(rhw_dual_splat(a)));
}

static inline struct rhw_dual1 rhw_dual_cos1(struct rhw_dual1 a)
{
    return rhw_dual_lane(rhw_dual_cos(rhw_dual_splat(a)));
}

static inline struct rhw_dual1 rhw_dual_tan1(struct rhw_dual1 a)
{
    return rhw_dual_lane(rhw_dual_tan(rhw_dual_splat(a)));
}

static inline struct rhw_dual1 rhw_dual_atan2_1(struct rhw_dual1 y, struct rhw_dual1 x)
{
    return rhw_dual_lane(rhw_dual_atan2(rhw_dual_splat(y), rhw_dual_splat(x)));
}

static inline struct rhw_dual1 rhw_dual_atan1(struct rhw_dual1 a)
{
    return rhw_dual_lane(rhw_dual_atan(rhw_dual_splat(a)));
}

static inline struct rhw_dual1 rhw_dual_asin1(struct rhw_dual1 a)
{
    return rhw_dual_lane(rhw_dual_asin(rhw_dual_splat(a)));
}

static inline struct rhw_dual1 rhw_dual_acos1(struct rhw_dual1 a)
{
    return rhw_dual_lane(rhw_dual_acos(rhw_dual_splat(a)));
}

// Small vectors -------------------------------------------------------------------------------------

static inline struct rhw_dual1 rhw_dual_dot2_1(const struct rhw_dual1 a[2], const struct rhw_dual1 b[2])
{
    struct rhw_dual a8[2];
    rhw_dual_splat_all(2, a, a8);
    struct rhw_dual b8[2];
    rhw_dual_splat_all(2, b, b8);
    return rhw_dual_lane(rhw_dual_dot2(a8, b8));
}

static inline struct rhw_dual1 rhw_dual_dot3_1(const struct rhw_dual1 a[3], const struct rhw_dual1 b[3])
{
    struct rhw_dual a8[3];
    rhw_dual_splat_all(3, a, a8);
    struct rhw_dual b8[3];
    rhw_dual_splat_all(3, b, b8);
    return rhw_dual_lane(rhw_dual_dot3(a8, b8));
}

static inline struct rhw_dual1 rhw_dual_dot4_1(const struct rhw_dual1 a[4], const struct rhw_dual1 b[4])
{
    struct rhw_dual a8[4];
    rhw_dual_splat_all(4, a, a8);
    struct rhw_dual b8[4];
    rhw_dual_splat_all(4, b, b8);
    return rhw_dual_lane(rhw_dual_dot4(a8, b8));
}

static inline struct rhw_dual1 rhw_dual_length2_1(const struct rhw_dual1 a[2])
{
    struct rhw_dual a8[2];
    rhw_dual_splat_all(2, a, a8);
    return rhw_dual_lane(rhw_dual_length2(a8));
}

static inline struct rhw_dual1 rhw_dual_length3_1(const struct rhw_dual1 a[3])
{
    struct rhw_dual a8[3];
    rhw_dual_splat_all(3, a, a8);
    return rhw_dual_lane(rhw_dual_length3(a8));
}

static inline struct rhw_dual1 rhw_dual_length4_1(const struct rhw_dual1 a[4])
{
    struct rhw_dual a8[4];
    rhw_dual_splat_all(4, a, a8);
    return rhw_dual_lane(rhw_dual_length4(a8));
}

static inline void rhw_dual_cross1(const struct rhw_dual1 a[3], const struct rhw_dual1 b[3],
                                   struct rhw_dual1 result[3])
{
    struct rhw_dual a8[3];
    rhw_dual_splat_all(3, a, a8);
    struct rhw_dual b8[3];
    rhw_dual_splat_all(3, b, b8);
    struct rhw_dual result8[3];
    rhw_dual_cross(a8, b8, result8);
    rhw_dual_lane_all(3, result8, result);
}

static inline void rhw_dual_normalize2_1(const struct rhw_dual1 a[2], struct rhw_dual1 result[2])
{
    struct rhw_dual a8[2];
    rhw_dual_splat_all(2, a, a8);
    struct rhw_dual result8[2];
    rhw_dual_normalize2(a8, result8);
    rhw_dual_lane_all(2, result8, result);
}

static inline void rhw_dual_normalize3_1(const struct rhw_dual1 a[3], struct rhw_dual1 result[3])
{
    struct rhw_dual a8[3];
    rhw_dual_splat_all(3, a, a8);
    struct rhw_dual result8[3];
    rhw_dual_normalize3(a8, result8);
    rhw_dual_lane_all(3, result8, result);
}

static inline void rhw_dual_normalize4_1(const struct rhw_dual1 a[4], struct rhw_dual1 result[4])
{
    struct rhw_dual a8[4];
    rhw_dual_splat_all(4, a, a8);
    struct rhw_dual result8[4];
    rhw_dual_normalize4(a8, result8);
    rhw_dual_lane_all(4, result8, result);
}

static inline void rhw_dual_reflect2_1(const struct rhw_dual1 incident[2], const struct rhw_dual1 normal[2],
                                       struct rhw_dual1 result[2])
{
    struct rhw_dual incident8[2];
    rhw_dual_splat_all(2, incident, incident8);
    struct rhw_dual normal8[2];
    rhw_dual_splat_all(2, normal, normal8);
    struct rhw_dual result8[2];
    rhw_dual_reflect2(incident8, normal8, result8);
    rhw_dual_lane_all(2, result8, result);
}

static inline void rhw_dual_reflect3_1(const struct rhw_dual1 incident[3], const struct rhw_dual1 normal[3],
                                       struct rhw_dual1 result[3])
{
    struct rhw_dual incident8[3];
    rhw_dual_splat_all(3, incident, incident8);
    struct rhw_dual normal8[3];
    rhw_dual_splat_all(3, normal, normal8);
    struct rhw_dual result8[3];
    rhw_dual_reflect3(incident8, normal8, result8);
    rhw_dual_lane_all(3, result8, result);
}

// Textures ------------------------------------------------------------------------------------------

static inline void rhw_sample_dual1(const struct rhw_bindings *textures, int slot,
                                    const struct rhw_dual1 uv[2], float texel[4])
{
    const float at[2] = {uv[0].value, uv[1].value};
    const float grad[4] = {uv[0].ddx, uv[1].ddx, uv[0].ddy, uv[1].ddy};
    rhw_sample_grad1(textures, slot, at, grad, texel);
}

RHW_QUIET_END

#endif

#include "shader_dual_scalar.h"

#endif
