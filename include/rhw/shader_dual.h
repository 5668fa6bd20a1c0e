// SPDX-License-Identifier: MIT
// A dual is a value with its change per pixel to the right and down. Duals are the derivatives of what a fragment
// function computes, by forward mode. A dual begins as a varying that asked for derivatives. Every function here
// carries value and change on, by the rules of calculus. The change is exact up to rounding, also in branches and
// loops, where differences of neighbouring pixels are wrong. Duals serve as the gradient of textures at computed
// coordinates, and for edges that are one pixel wide.
//
//     struct rhw_dual uv[2] = {rhw_dual_varying(f, 0), rhw_dual_varying(f, 1)};
//     uv[0] = rhw_dual_add(uv[0], rhw_dual_scale(rhw_dual_sin(uv[1]), 0.1f));
//     rhw_sample_dual(f->textures, 0, uv, texel);
//
// The value of rhw_dual_name is the value of rhw_name, bit for bit, with its errors and special cases. At a corner of a
// function, the change is that of the side which the value comes from. Where the slope of a function is infinite, as
// that of sqrt at 0, or NaN, the change is infinite or NaN too; 0 · ∞ is NaN. Programs compare the values of duals:
// rhw_less(a.value, b.value). An operand without a change may be a plain number or lanes: rhw_dual_max(a, 0.0f).
//
// shader.h does not include this header. A file that needs duals includes it.
#ifndef RHW_SHADER_DUAL_H
#define RHW_SHADER_DUAL_H

#include "shader.h"

#if RHW_HAS_LANES

RHW_QUIET_BEGIN

/// 8 values, with their change per pixel to the right (ddx) and down (ddy).
struct rhw_dual {
    rhw_float value, ddx, ddy;
};

// Making duals --------------------------------------------------------------------------------------

/// Return a dual of a value whose derivatives are known.
static inline struct rhw_dual rhw_dual_make(rhw_float value, rhw_float ddx, rhw_float ddy)
{
    const struct rhw_dual result = {value, ddx, ddy};
    return result;
}

/// Return a dual of a value that is the same in all pixels.
static inline struct rhw_dual rhw_dual_constant(rhw_float value)
{
    return rhw_dual_make(value, rhw_splat(0.0f), rhw_splat(0.0f));
}

/// Return component `component` of the varyings, which must have asked for derivatives.
static inline struct rhw_dual rhw_dual_varying(const struct rhw_fragment *f, int component)
{
    return rhw_dual_make(f->varying[component], f->ddx[component], f->ddy[component]);
}

/// Return the result of a function that is missing here, by the chain rule: `value` is the function's value at a, and
/// `slope` its derivative at a.
static inline struct rhw_dual rhw_dual_chain(rhw_float value, rhw_float slope, struct rhw_dual a)
{
    return rhw_dual_make(value, slope * a.ddx, slope * a.ddy);
}

/// Return a, with its change, where mask is −1, and b, with its change, where mask is 0.
static inline struct rhw_dual rhw_dual_select(rhw_int mask, struct rhw_dual a, struct rhw_dual b)
{
    return rhw_dual_make(rhw_select(mask, a.value, b.value), rhw_select(mask, a.ddx, b.ddx),
                         rhw_select(mask, a.ddy, b.ddy));
}

// Arithmetic ----------------------------------------------------------------------------------------

/// Return −a.
static inline struct rhw_dual rhw_dual_neg(struct rhw_dual a)
{
    return rhw_dual_make(-a.value, -a.ddx, -a.ddy);
}

/// Return a + b.
static inline struct rhw_dual rhw_dual_add(struct rhw_dual a, struct rhw_dual b)
{
    return rhw_dual_make(a.value + b.value, a.ddx + b.ddx, a.ddy + b.ddy);
}

/// Return a − b.
static inline struct rhw_dual rhw_dual_sub(struct rhw_dual a, struct rhw_dual b)
{
    return rhw_dual_make(a.value - b.value, a.ddx - b.ddx, a.ddy - b.ddy);
}

/// Return a · b.
static inline struct rhw_dual rhw_dual_mul(struct rhw_dual a, struct rhw_dual b)
{
    return rhw_dual_make(a.value * b.value, a.ddx * b.value + a.value * b.ddx,
                         a.ddy * b.value + a.value * b.ddy);
}

/// Return a / b.
static inline struct rhw_dual rhw_dual_div(struct rhw_dual a, struct rhw_dual b)
{
    const rhw_float value = a.value / b.value;
    return rhw_dual_make(value, (a.ddx - value * b.ddx) / b.value, (a.ddy - value * b.ddy) / b.value);
}

/// Return a · factor for a constant factor. This takes half the work of rhw_dual_mul.
static inline struct rhw_dual rhw_dual_scale(struct rhw_dual a, rhw_float factor)
{
    return rhw_dual_chain(a.value * factor, factor, a);
}

/// Return a + offset for a constant offset.
static inline struct rhw_dual rhw_dual_offset(struct rhw_dual a, rhw_float offset)
{
    return rhw_dual_make(a.value + offset, a.ddx, a.ddy);
}

// Minimum, maximum and range ------------------------------------------------------------------------

/// Return the magnitude of a. The slope at −0 is −1.
static inline struct rhw_dual rhw_dual_abs(struct rhw_dual a)
{
    return rhw_dual_chain(rhw_abs(a.value), rhw_copysign(rhw_splat(1.0f), a.value), a);
}

/// Return a where a < b, and b elsewhere.
static inline struct rhw_dual rhw_dual_min(struct rhw_dual a, struct rhw_dual b)
{
    return rhw_dual_select(rhw_less(a.value, b.value), a, b);
}

/// Return a where a > b, and b elsewhere.
static inline struct rhw_dual rhw_dual_max(struct rhw_dual a, struct rhw_dual b)
{
    return rhw_dual_select(rhw_less(b.value, a.value), a, b);
}

/// Return a clamped to low..high.
static inline struct rhw_dual rhw_dual_clamp(struct rhw_dual a, struct rhw_dual low, struct rhw_dual high)
{
    return rhw_dual_min(rhw_dual_max(a, low), high);
}

/// Return a clamped to 0..1.
static inline struct rhw_dual rhw_dual_saturate(struct rhw_dual a)
{
    return rhw_dual_clamp(a, rhw_dual_constant(rhw_splat(0.0f)), rhw_dual_constant(rhw_splat(1.0f)));
}

/// Return a − floor(a), with the change of a. The jumps at whole numbers do not change it.
static inline struct rhw_dual rhw_dual_fract(struct rhw_dual a)
{
    return rhw_dual_make(rhw_fract(a.value), a.ddx, a.ddy);
}

/// Return a + (b − a) · t.
static inline struct rhw_dual rhw_dual_mix(struct rhw_dual a, struct rhw_dual b, struct rhw_dual t)
{
    return rhw_dual_add(a, rhw_dual_mul(rhw_dual_sub(b, a), t));
}

/// Return 0 where a is at most edge0, 1 where a is at least edge1, and a smooth curve between them, as rhw_smoothstep
/// does.
static inline struct rhw_dual rhw_dual_smoothstep(struct rhw_dual edge0, struct rhw_dual edge1,
                                                  struct rhw_dual a)
{
    const struct rhw_dual t =
        rhw_dual_saturate(rhw_dual_div(rhw_dual_sub(a, edge0), rhw_dual_sub(edge1, edge0)));
    return rhw_dual_chain(t.value * t.value * (3.0f - 2.0f * t.value), 6.0f * t.value * (1.0f - t.value), t);
}

// Powers and logarithms -----------------------------------------------------------------------------

/// Return the square root of a.
static inline struct rhw_dual rhw_dual_sqrt(struct rhw_dual a)
{
    const rhw_float root = rhw_sqrt(a.value);
    return rhw_dual_chain(root, 0.5f / root, a);
}

/// Return 1 / sqrt(a).
static inline struct rhw_dual rhw_dual_rsqrt(struct rhw_dual a)
{
    const rhw_float value = rhw_rsqrt(a.value);
    return rhw_dual_chain(value, -0.5f * value / a.value, a);
}

/// Return 2^a.
static inline struct rhw_dual rhw_dual_exp2(struct rhw_dual a)
{
    const rhw_float value = rhw_exp2(a.value);
    return rhw_dual_chain(value, 0.693147182f * value, a);
}

/// Return e^a.
static inline struct rhw_dual rhw_dual_exp(struct rhw_dual a)
{
    const rhw_float value = rhw_exp(a.value);
    return rhw_dual_chain(value, value, a);
}

/// Return the logarithm of a to base 2.
static inline struct rhw_dual rhw_dual_log2(struct rhw_dual a)
{
    return rhw_dual_chain(rhw_log2(a.value), 1.44269502f / a.value, a);
}

/// Return the natural logarithm of a.
static inline struct rhw_dual rhw_dual_log(struct rhw_dual a)
{
    return rhw_dual_chain(rhw_log(a.value), 1.0f / a.value, a);
}

/// Return a^b. If b does not change, a may be 0 or negative, as in rhw_pow.
static inline struct rhw_dual rhw_dual_pow(struct rhw_dual a, struct rhw_dual b)
{
    const rhw_float steep = b.value * rhw_pow(a.value, b.value - 1.0f);
    const rhw_float slope =
        rhw_select(rhw_equal(b.value, 0.0f), 0.0f, steep); // 0 · ∞ would be NaN where a is 0
    struct rhw_dual result = rhw_dual_chain(rhw_pow(a.value, b.value), slope, a);
    const rhw_int moves = rhw_not_equal(b.ddx, 0.0f) | rhw_not_equal(b.ddy, 0.0f);
    if (rhw_any(moves)) {
        const rhw_float growth = result.value * rhw_log(a.value);
        result.ddx = rhw_select(moves, result.ddx + growth * b.ddx, result.ddx);
        result.ddy = rhw_select(moves, result.ddy + growth * b.ddy, result.ddy);
    }
    return result;
}

// Trigonometry --------------------------------------------------------------------------------------

/// Set `*sine` and `*cosine` to the sine and cosine of a, which is in radians. Both together take little more time than
/// one.
static inline void rhw_dual_sincos(struct rhw_dual a, struct rhw_dual *sine, struct rhw_dual *cosine)
{
    rhw_float s, c;
    rhw_sincos(a.value, &s, &c);
    *sine = rhw_dual_chain(s, c, a);
    *cosine = rhw_dual_chain(c, -s, a);
}

/// Return the sine of a, which is in radians.
static inline struct rhw_dual rhw_dual_sin(struct rhw_dual a)
{
    struct rhw_dual sine, cosine;
    rhw_dual_sincos(a, &sine, &cosine);
    return sine;
}

/// Return the cosine of a, which is in radians.
static inline struct rhw_dual rhw_dual_cos(struct rhw_dual a)
{
    struct rhw_dual sine, cosine;
    rhw_dual_sincos(a, &sine, &cosine);
    return cosine;
}

/// Return the tangent of a, which is in radians.
static inline struct rhw_dual rhw_dual_tan(struct rhw_dual a)
{
    const rhw_float value = rhw_tan(a.value);
    return rhw_dual_chain(value, 1.0f + value * value, a);
}

/// Return the angle of the point (x, y) in radians, −π..π. The change ignores the jump from π to −π. The squares of x
/// and y must not overflow or underflow.
static inline struct rhw_dual rhw_dual_atan2(struct rhw_dual y, struct rhw_dual x)
{
    const rhw_float square = x.value * x.value + y.value * y.value;
    return rhw_dual_make(rhw_atan2(y.value, x.value), (x.value * y.ddx - y.value * x.ddx) / square,
                         (x.value * y.ddy - y.value * x.ddy) / square);
}

/// Return the arc tangent of a in radians.
static inline struct rhw_dual rhw_dual_atan(struct rhw_dual a)
{
    return rhw_dual_chain(rhw_atan(a.value), 1.0f / (1.0f + a.value * a.value), a);
}

/// Return the arc sine of a in radians.
static inline struct rhw_dual rhw_dual_asin(struct rhw_dual a)
{
    return rhw_dual_chain(rhw_asin(a.value), rhw_rsqrt((1.0f - a.value) * (1.0f + a.value)), a);
}

/// Return the arc cosine of a in radians.
static inline struct rhw_dual rhw_dual_acos(struct rhw_dual a)
{
    return rhw_dual_chain(rhw_acos(a.value), -rhw_rsqrt((1.0f - a.value) * (1.0f + a.value)), a);
}

// Small vectors -------------------------------------------------------------------------------------

/// Return the scalar product of two vectors.
static inline struct rhw_dual rhw_dual_dot2(const struct rhw_dual a[2], const struct rhw_dual b[2])
{
    return rhw_dual_add(rhw_dual_mul(a[0], b[0]), rhw_dual_mul(a[1], b[1]));
}

/// Return the scalar product of two vectors.
static inline struct rhw_dual rhw_dual_dot3(const struct rhw_dual a[3], const struct rhw_dual b[3])
{
    return rhw_dual_add(rhw_dual_dot2(a, b), rhw_dual_mul(a[2], b[2]));
}

/// Return the scalar product of two vectors.
static inline struct rhw_dual rhw_dual_dot4(const struct rhw_dual a[4], const struct rhw_dual b[4])
{
    return rhw_dual_add(rhw_dual_dot3(a, b), rhw_dual_mul(a[3], b[3]));
}

/// Return the length, sqrt(a · a). The change is NaN where the length is 0.
static inline struct rhw_dual rhw_dual_length2(const struct rhw_dual a[2])
{
    return rhw_dual_sqrt(rhw_dual_dot2(a, a));
}

/// Return the length, sqrt(a · a). The change is NaN where the length is 0.
static inline struct rhw_dual rhw_dual_length3(const struct rhw_dual a[3])
{
    return rhw_dual_sqrt(rhw_dual_dot3(a, a));
}

/// Return the length, sqrt(a · a). The change is NaN where the length is 0.
static inline struct rhw_dual rhw_dual_length4(const struct rhw_dual a[4])
{
    return rhw_dual_sqrt(rhw_dual_dot4(a, a));
}

/// Set `result` to the vector product of `a` and `b`. `result` must not be `a` or `b`.
static inline void rhw_dual_cross(const struct rhw_dual a[3], const struct rhw_dual b[3],
                                  struct rhw_dual result[3])
{
    result[0] = rhw_dual_sub(rhw_dual_mul(a[1], b[2]), rhw_dual_mul(a[2], b[1]));
    result[1] = rhw_dual_sub(rhw_dual_mul(a[2], b[0]), rhw_dual_mul(a[0], b[2]));
    result[2] = rhw_dual_sub(rhw_dual_mul(a[0], b[1]), rhw_dual_mul(a[1], b[0]));
}

// Return component i of the vector unit = a / |a|, with scale = 1 / |a|. Its change is Σ unit_j (unit_j a_i' − unit_i
// a_j') / |a|, which keeps its digits where `a` is nearly along an axis. a_i' − unit_i (unit · a') would lose them.
static inline struct rhw_dual rhw_dual_unit(int count, const struct rhw_dual *a, const rhw_float *unit,
                                            rhw_float scale, int i)
{
    rhw_float ddx = rhw_splat(0.0f), ddy = rhw_splat(0.0f);
    for (int j = 0; j < count; j++) {
        if (j != i) {
            ddx += unit[j] * (unit[j] * a[i].ddx - unit[i] * a[j].ddx);
            ddy += unit[j] * (unit[j] * a[i].ddy - unit[i] * a[j].ddy);
        }
    }
    return rhw_dual_make(unit[i], ddx * scale, ddy * scale);
}

/// Set `result` to the vector of length 1 along `a`. `result` may be `a`. rhw_normalize2 tells the range of lengths.
static inline void rhw_dual_normalize2(const struct rhw_dual a[2], struct rhw_dual result[2])
{
    const struct rhw_dual from[2] = {a[0], a[1]};
    const rhw_float value[2] = {a[0].value, a[1].value};
    const rhw_float scale = rhw_normalizing(rhw_dot2(value, value));
    const rhw_float unit[2] = {value[0] * scale, value[1] * scale};
    for (int i = 0; i < 2; i++) {
        result[i] = rhw_dual_unit(2, from, unit, scale, i);
    }
}

/// Set `result` to the vector of length 1 along `a`. `result` may be `a`. rhw_normalize3 tells the range of lengths.
static inline void rhw_dual_normalize3(const struct rhw_dual a[3], struct rhw_dual result[3])
{
    const struct rhw_dual from[3] = {a[0], a[1], a[2]};
    const rhw_float value[3] = {a[0].value, a[1].value, a[2].value};
    const rhw_float scale = rhw_normalizing(rhw_dot3(value, value));
    const rhw_float unit[3] = {value[0] * scale, value[1] * scale, value[2] * scale};
    for (int i = 0; i < 3; i++) {
        result[i] = rhw_dual_unit(3, from, unit, scale, i);
    }
}

/// Set `result` to the vector of length 1 along `a`. `result` may be `a`. rhw_normalize4 tells the range of lengths.
static inline void rhw_dual_normalize4(const struct rhw_dual a[4], struct rhw_dual result[4])
{
    const struct rhw_dual from[4] = {a[0], a[1], a[2], a[3]};
    const rhw_float value[4] = {a[0].value, a[1].value, a[2].value, a[3].value};
    const rhw_float scale = rhw_normalizing(rhw_dot4(value, value));
    const rhw_float unit[4] = {value[0] * scale, value[1] * scale, value[2] * scale, value[3] * scale};
    for (int i = 0; i < 4; i++) {
        result[i] = rhw_dual_unit(4, from, unit, scale, i);
    }
}

/// Set `result` to the direction `incident` reflected by a surface of unit normal `normal`. `result` may be `incident`.
static inline void rhw_dual_reflect2(const struct rhw_dual incident[2], const struct rhw_dual normal[2],
                                     struct rhw_dual result[2])
{
    const struct rhw_dual twice = rhw_dual_scale(rhw_dual_dot2(normal, incident), rhw_splat(2.0f));
    for (int i = 0; i < 2; i++) {
        result[i] = rhw_dual_sub(incident[i], rhw_dual_mul(twice, normal[i]));
    }
}

/// Set `result` to the direction `incident` reflected by a surface of unit normal `normal`. `result` may be `incident`.
static inline void rhw_dual_reflect3(const struct rhw_dual incident[3], const struct rhw_dual normal[3],
                                     struct rhw_dual result[3])
{
    const struct rhw_dual twice = rhw_dual_scale(rhw_dual_dot3(normal, incident), rhw_splat(2.0f));
    for (int i = 0; i < 3; i++) {
        result[i] = rhw_dual_sub(incident[i], rhw_dual_mul(twice, normal[i]));
    }
}

// Textures ------------------------------------------------------------------------------------------

/// Sample as rhw_sample_grad does, at computed coordinates. The derivatives of the coordinates are the gradient.
static inline void rhw_sample_dual(const struct rhw_bindings *textures, int slot, const struct rhw_dual uv[2],
                                   rhw_float texel[4])
{
    const rhw_float at[2] = {uv[0].value, uv[1].value};
    const rhw_float grad[4] = {uv[0].ddx, uv[1].ddx, uv[0].ddy, uv[1].ddy};
    rhw_sample_grad(textures, slot, at, grad, texel);
}

RHW_QUIET_END

#endif

#include "shader_dual_one.h"

#endif
