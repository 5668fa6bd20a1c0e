// SPDX-License-Identifier: MIT
// The functions of shader_dual.h; see isa_kit.h. This file is compiled with RHW_ISA_SUFFIX = baseline, avx2, ...
#include "isa_kit.h"

#include <rhw/shader_dual.h>

static struct rhw_dual dual(const rhw_float *a)
{
    return rhw_dual_make(a[0], a[1], a[2]);
}

static struct rhw_dual1 dual1(const float *a)
{
    return rhw_dual_make1(a[0], a[1], a[2]);
}

static void duals(int count, const rhw_float *a, struct rhw_dual *result)
{
    for (int i = 0; i < count; i++) {
        result[i] = dual(a + 3 * i);
    }
}

static void duals1(int count, const float *a, struct rhw_dual1 *result)
{
    for (int i = 0; i < count; i++) {
        result[i] = dual1(a + 3 * i);
    }
}

static void put(rhw_float *r, struct rhw_dual a)
{
    r[0] = a.value;
    r[1] = a.ddx;
    r[2] = a.ddy;
}

static void put1(float *r, struct rhw_dual1 a)
{
    r[0] = a.value;
    r[1] = a.ddx;
    r[2] = a.ddy;
}

static void dual_make_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_make(a[0], a[1], a[2]));
}

static void dual_make_one(const float *a, float *r)
{
    put1(r, rhw_dual_make1(a[0], a[1], a[2]));
}

static void dual_constant_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_constant(a[0]));
}

static void dual_constant_one(const float *a, float *r)
{
    put1(r, rhw_dual_constant1(a[0]));
}

static void dual_varying_lanes(const rhw_float *a, rhw_float *r)
{
    struct rhw_fragment f;
    f.varying = a;
    f.ddx = a + 1;
    f.ddy = a + 2;
    put(r, rhw_dual_varying(&f, 1));
}

static void dual_varying_one(const float *a, float *r)
{
    struct rhw_fragment1 f;
    f.varying = a;
    f.ddx = a + 1;
    f.ddy = a + 2;
    put1(r, rhw_dual_varying1(&f, 1));
}

static void dual_chain_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_chain(a[3], a[4], dual(a)));
}

static void dual_chain_one(const float *a, float *r)
{
    put1(r, rhw_dual_chain1(a[3], a[4], dual1(a)));
}

static void dual_select_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_select(rhw_less(a[0], a[3]), dual(a), dual(a + 3)));
}

static void dual_select_one(const float *a, float *r)
{
    put1(r, rhw_dual_select1(rhw_less1(a[0], a[3]), dual1(a), dual1(a + 3)));
}

static void dual_neg_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_neg(dual(a)));
}

static void dual_neg_one(const float *a, float *r)
{
    put1(r, rhw_dual_neg1(dual1(a)));
}

static void dual_add_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_add(dual(a), dual(a + 3)));
}

static void dual_add_one(const float *a, float *r)
{
    put1(r, rhw_dual_add1(dual1(a), dual1(a + 3)));
}

static void dual_sub_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_sub(dual(a), dual(a + 3)));
}

static void dual_sub_one(const float *a, float *r)
{
    put1(r, rhw_dual_sub1(dual1(a), dual1(a + 3)));
}

static void dual_mul_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_mul(dual(a), dual(a + 3)));
}

static void dual_mul_one(const float *a, float *r)
{
    put1(r, rhw_dual_mul1(dual1(a), dual1(a + 3)));
}

static void dual_div_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_div(dual(a), dual(a + 3)));
}

static void dual_div_one(const float *a, float *r)
{
    put1(r, rhw_dual_div1(dual1(a), dual1(a + 3)));
}

static void dual_scale_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_scale(dual(a), a[3]));
}

static void dual_scale_one(const float *a, float *r)
{
    put1(r, rhw_dual_scale1(dual1(a), a[3]));
}

static void dual_offset_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_offset(dual(a), a[3]));
}

static void dual_offset_one(const float *a, float *r)
{
    put1(r, rhw_dual_offset1(dual1(a), a[3]));
}

static void dual_abs_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_abs(dual(a)));
}

static void dual_abs_one(const float *a, float *r)
{
    put1(r, rhw_dual_abs1(dual1(a)));
}

static void dual_min_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_min(dual(a), dual(a + 3)));
}

static void dual_min_one(const float *a, float *r)
{
    put1(r, rhw_dual_min1(dual1(a), dual1(a + 3)));
}

static void dual_max_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_max(dual(a), dual(a + 3)));
}

static void dual_max_one(const float *a, float *r)
{
    put1(r, rhw_dual_max1(dual1(a), dual1(a + 3)));
}

static void dual_clamp_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_clamp(dual(a), dual(a + 3), dual(a + 6)));
}

static void dual_clamp_one(const float *a, float *r)
{
    put1(r, rhw_dual_clamp1(dual1(a), dual1(a + 3), dual1(a + 6)));
}

static void dual_saturate_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_saturate(dual(a)));
}

static void dual_saturate_one(const float *a, float *r)
{
    put1(r, rhw_dual_saturate1(dual1(a)));
}

static void dual_fract_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_fract(dual(a)));
}

static void dual_fract_one(const float *a, float *r)
{
    put1(r, rhw_dual_fract1(dual1(a)));
}

static void dual_mix_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_mix(dual(a), dual(a + 3), dual(a + 6)));
}

static void dual_mix_one(const float *a, float *r)
{
    put1(r, rhw_dual_mix1(dual1(a), dual1(a + 3), dual1(a + 6)));
}

static void dual_smoothstep_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_smoothstep(dual(a), dual(a + 3), dual(a + 6)));
}

static void dual_smoothstep_one(const float *a, float *r)
{
    put1(r, rhw_dual_smoothstep1(dual1(a), dual1(a + 3), dual1(a + 6)));
}

static void dual_sqrt_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_sqrt(dual(a)));
}

static void dual_sqrt_one(const float *a, float *r)
{
    put1(r, rhw_dual_sqrt1(dual1(a)));
}

static void dual_rsqrt_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_rsqrt(dual(a)));
}

static void dual_rsqrt_one(const float *a, float *r)
{
    put1(r, rhw_dual_rsqrt1(dual1(a)));
}

static void dual_exp2_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_exp2(dual(a)));
}

static void dual_exp2_one(const float *a, float *r)
{
    put1(r, rhw_dual_exp2_1(dual1(a)));
}

static void dual_exp_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_exp(dual(a)));
}

static void dual_exp_one(const float *a, float *r)
{
    put1(r, rhw_dual_exp1(dual1(a)));
}

static void dual_log2_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_log2(dual(a)));
}

static void dual_log2_one(const float *a, float *r)
{
    put1(r, rhw_dual_log2_1(dual1(a)));
}

static void dual_log_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_log(dual(a)));
}

static void dual_log_one(const float *a, float *r)
{
    put1(r, rhw_dual_log1(dual1(a)));
}

static void dual_pow_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_pow(dual(a), dual(a + 3)));
}

static void dual_pow_one(const float *a, float *r)
{
    put1(r, rhw_dual_pow1(dual1(a), dual1(a + 3)));
}

static void dual_sincos_lanes(const rhw_float *a, rhw_float *r)
{
    struct rhw_dual s, c;
    rhw_dual_sincos(dual(a), &s, &c);
    put(r, s);
    put(r + 3, c);
}

static void dual_sincos_one(const float *a, float *r)
{
    struct rhw_dual1 s, c;
    rhw_dual_sincos1(dual1(a), &s, &c);
    put1(r, s);
    put1(r + 3, c);
}

static void dual_sin_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_sin(dual(a)));
}

static void dual_sin_one(const float *a, float *r)
{
    put1(r, rhw_dual_sin1(dual1(a)));
}

static void dual_cos_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_cos(dual(a)));
}

static void dual_cos_one(const float *a, float *r)
{
    put1(r, rhw_dual_cos1(dual1(a)));
}

static void dual_tan_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_tan(dual(a)));
}

static void dual_tan_one(const float *a, float *r)
{
    put1(r, rhw_dual_tan1(dual1(a)));
}

static void dual_atan2_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_atan2(dual(a), dual(a + 3)));
}

static void dual_atan2_one(const float *a, float *r)
{
    put1(r, rhw_dual_atan2_1(dual1(a), dual1(a + 3)));
}

static void dual_atan_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_atan(dual(a)));
}

static void dual_atan_one(const float *a, float *r)
{
    put1(r, rhw_dual_atan1(dual1(a)));
}

static void dual_asin_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_asin(dual(a)));
}

static void dual_asin_one(const float *a, float *r)
{
    put1(r, rhw_dual_asin1(dual1(a)));
}

static void dual_acos_lanes(const rhw_float *a, rhw_float *r)
{
    put(r, rhw_dual_acos(dual(a)));
}

static void dual_acos_one(const float *a, float *r)
{
    put1(r, rhw_dual_acos1(dual1(a)));
}

static void dual_dot2_lanes(const rhw_float *a, rhw_float *r)
{
    struct rhw_dual x[2], y[2];
    duals(2, a, x);
    duals(2, a + 6, y);
    put(r, rhw_dual_dot2(x, y));
}

static void dual_dot2_one(const float *a, float *r)
{
    struct rhw_dual1 x[2], y[2];
    duals1(2, a, x);
    duals1(2, a + 6, y);
    put1(r, rhw_dual_dot2_1(x, y));
}

static void dual_length2_lanes(const rhw_float *a, rhw_float *r)
{
    struct rhw_dual x[2];
    duals(2, a, x);
    put(r, rhw_dual_length2(x));
}

static void dual_length2_one(const float *a, float *r)
{
    struct rhw_dual1 x[2];
    duals1(2, a, x);
    put1(r, rhw_dual_length2_1(x));
}

static void dual_normalize2_lanes(const rhw_float *a, rhw_float *r)
{
    struct rhw_dual x[2], z[2];
    duals(2, a, x);
    rhw_dual_normalize2(x, z);
    for (int i = 0; i < 2; i++) {
        put(r + 3 * i, z[i]);
    }
}

static void dual_normalize2_one(const float *a, float *r)
{
    struct rhw_dual1 x[2], z[2];
    duals1(2, a, x);
    rhw_dual_normalize2_1(x, z);
    for (int i = 0; i < 2; i++) {
        put1(r + 3 * i, z[i]);
    }
}

static void dual_dot3_lanes(const rhw_float *a, rhw_float *r)
{
    struct rhw_dual x[3], y[3];
    duals(3, a, x);
    duals(3, a + 9, y);
    put(r, rhw_dual_dot3(x, y));
}

static void dual_dot3_one(const float *a, float *r)
{
    struct rhw_dual1 x[3], y[3];
    duals1(3, a, x);
    duals1(3, a + 9, y);
    put1(r, rhw_dual_dot3_1(x, y));
}

static void dual_length3_lanes(const rhw_float *a, rhw_float *r)
{
    struct rhw_dual x[3];
    duals(3, a, x);
    put(r, rhw_dual_length3(x));
}

static void dual_length3_one(const float *a, float *r)
{
    struct rhw_dual1 x[3];
    duals1(3, a, x);
    put1(r, rhw_dual_length3_1(x));
}

static void dual_normalize3_lanes(const rhw_float *a, rhw_float *r)
{
    struct rhw_dual x[3], z[3];
    duals(3, a, x);
    rhw_dual_normalize3(x, z);
    for (int i = 0; i < 3; i++) {
        put(r + 3 * i, z[i]);
    }
}

static void dual_normalize3_one(const float *a, float *r)
{
    struct rhw_dual1 x[3], z[3];
    duals1(3, a, x);
    rhw_dual_normalize3_1(x, z);
    for (int i = 0; i < 3; i++) {
        put1(r + 3 * i, z[i]);
    }
}

static void dual_dot4_lanes(const rhw_float *a, rhw_float *r)
{
    struct rhw_dual x[4], y[4];
    duals(4, a, x);
    duals(4, a + 12, y);
    put(r, rhw_dual_dot4(x, y));
}

static void dual_dot4_one(const float *a, float *r)
{
    struct rhw_dual1 x[4], y[4];
    duals1(4, a, x);
    duals1(4, a + 12, y);
    put1(r, rhw_dual_dot4_1(x, y));
}

static void dual_length4_lanes(const rhw_float *a, rhw_float *r)
{
    struct rhw_dual x[4];
    duals(4, a, x);
    put(r, rhw_dual_length4(x));
}

static void dual_length4_one(const float *a, float *r)
{
    struct rhw_dual1 x[4];
    duals1(4, a, x);
    put1(r, rhw_dual_length4_1(x));
}

static void dual_normalize4_lanes(const rhw_float *a, rhw_float *r)
{
    struct rhw_dual x[4], z[4];
    duals(4, a, x);
    rhw_dual_normalize4(x, z);
    for (int i = 0; i < 4; i++) {
        put(r + 3 * i, z[i]);
    }
}

static void dual_normalize4_one(const float *a, float *r)
{
    struct rhw_dual1 x[4], z[4];
    duals1(4, a, x);
    rhw_dual_normalize4_1(x, z);
    for (int i = 0; i < 4; i++) {
        put1(r + 3 * i, z[i]);
    }
}

static void dual_cross_lanes(const rhw_float *a, rhw_float *r)
{
    struct rhw_dual x[3], y[3], z[3];
    duals(3, a, x);
    duals(3, a + 9, y);
    rhw_dual_cross(x, y, z);
    for (int i = 0; i < 3; i++) {
        put(r + 3 * i, z[i]);
    }
}

static void dual_cross_one(const float *a, float *r)
{
    struct rhw_dual1 x[3], y[3], z[3];
    duals1(3, a, x);
    duals1(3, a + 9, y);
    rhw_dual_cross1(x, y, z);
    for (int i = 0; i < 3; i++) {
        put1(r + 3 * i, z[i]);
    }
}

static void dual_reflect2_lanes(const rhw_float *a, rhw_float *r)
{
    struct rhw_dual x[2], y[2], z[2];
    duals(2, a, x);
    duals(2, a + 6, y);
    rhw_dual_reflect2(x, y, z);
    for (int i = 0; i < 2; i++) {
        put(r + 3 * i, z[i]);
    }
}

static void dual_reflect2_one(const float *a, float *r)
{
    struct rhw_dual1 x[2], y[2], z[2];
    duals1(2, a, x);
    duals1(2, a + 6, y);
    rhw_dual_reflect2_1(x, y, z);
    for (int i = 0; i < 2; i++) {
        put1(r + 3 * i, z[i]);
    }
}

static void dual_reflect3_lanes(const rhw_float *a, rhw_float *r)
{
    struct rhw_dual x[3], y[3], z[3];
    duals(3, a, x);
    duals(3, a + 9, y);
    rhw_dual_reflect3(x, y, z);
    for (int i = 0; i < 3; i++) {
        put(r + 3 * i, z[i]);
    }
}

static void dual_reflect3_one(const float *a, float *r)
{
    struct rhw_dual1 x[3], y[3], z[3];
    duals1(3, a, x);
    duals1(3, a + 9, y);
    rhw_dual_reflect3_1(x, y, z);
    for (int i = 0; i < 3; i++) {
        put1(r + 3 * i, z[i]);
    }
}

static const struct kit_function functions[] = {
    {"dual_make", dual_make_lanes, dual_make_one},
    {"dual_constant", dual_constant_lanes, dual_constant_one},
    {"dual_varying", dual_varying_lanes, dual_varying_one},
    {"dual_chain", dual_chain_lanes, dual_chain_one},
    {"dual_select", dual_select_lanes, dual_select_one},
    {"dual_neg", dual_neg_lanes, dual_neg_one},
    {"dual_add", dual_add_lanes, dual_add_one},
    {"dual_sub", dual_sub_lanes, dual_sub_one},
    {"dual_mul", dual_mul_lanes, dual_mul_one},
    {"dual_div", dual_div_lanes, dual_div_one},
    {"dual_scale", dual_scale_lanes, dual_scale_one},
    {"dual_offset", dual_offset_lanes, dual_offset_one},
    {"dual_abs", dual_abs_lanes, dual_abs_one},
    {"dual_min", dual_min_lanes, dual_min_one},
    {"dual_max", dual_max_lanes, dual_max_one},
    {"dual_clamp", dual_clamp_lanes, dual_clamp_one},
    {"dual_saturate", dual_saturate_lanes, dual_saturate_one},
    {"dual_fract", dual_fract_lanes, dual_fract_one},
    {"dual_mix", dual_mix_lanes, dual_mix_one},
    {"dual_smoothstep", dual_smoothstep_lanes, dual_smoothstep_one},
    {"dual_sqrt", dual_sqrt_lanes, dual_sqrt_one},
    {"dual_rsqrt", dual_rsqrt_lanes, dual_rsqrt_one},
    {"dual_exp2", dual_exp2_lanes, dual_exp2_one},
    {"dual_exp", dual_exp_lanes, dual_exp_one},
    {"dual_log2", dual_log2_lanes, dual_log2_one},
    {"dual_log", dual_log_lanes, dual_log_one},
    {"dual_pow", dual_pow_lanes, dual_pow_one},
    {"dual_sincos", dual_sincos_lanes, dual_sincos_one},
    {"dual_sin", dual_sin_lanes, dual_sin_one},
    {"dual_cos", dual_cos_lanes, dual_cos_one},
    {"dual_tan", dual_tan_lanes, dual_tan_one},
    {"dual_atan2", dual_atan2_lanes, dual_atan2_one},
    {"dual_atan", dual_atan_lanes, dual_atan_one},
    {"dual_asin", dual_asin_lanes, dual_asin_one},
    {"dual_acos", dual_acos_lanes, dual_acos_one},
    {"dual_dot2", dual_dot2_lanes, dual_dot2_one},
    {"dual_length2", dual_length2_lanes, dual_length2_one},
    {"dual_normalize2", dual_normalize2_lanes, dual_normalize2_one},
    {"dual_dot3", dual_dot3_lanes, dual_dot3_one},
    {"dual_length3", dual_length3_lanes, dual_length3_one},
    {"dual_normalize3", dual_normalize3_lanes, dual_normalize3_one},
    {"dual_dot4", dual_dot4_lanes, dual_dot4_one},
    {"dual_length4", dual_length4_lanes, dual_length4_one},
    {"dual_normalize4", dual_normalize4_lanes, dual_normalize4_one},
    {"dual_cross", dual_cross_lanes, dual_cross_one},
    {"dual_reflect2", dual_reflect2_lanes, dual_reflect2_one},
    {"dual_reflect3", dual_reflect3_lanes, dual_reflect3_one},
};

const struct kit_table RHW_ISA_NAME(kit_dual_table) = {sizeof functions / sizeof functions[0], functions};
