// SPDX-License-Identifier: MIT
// The functions of shader_math.h and shader_hyperbolic.h; see isa_kit.h. This file is compiled with RHW_ISA_SUFFIX =
// baseline, avx2, ...
#include "isa_kit.h"

static void infinity_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = a[0] + rhw_infinity();
}

static void infinity_one(const float *a, float *r)
{
    r[0] = a[0] + rhw_infinity1();
}

static void nan_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = a[0] + rhw_nan();
}

static void nan_one(const float *a, float *r)
{
    r[0] = a[0] + rhw_nan1();
}

static void exp2_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_exp2(a[0]);
}

static void exp2_one(const float *a, float *r)
{
    r[0] = rhw_exp2_1(a[0]);
}

static void exp_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_exp(a[0]);
}

static void exp_one(const float *a, float *r)
{
    r[0] = rhw_exp1(a[0]);
}

static void log2_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_log2(a[0]);
}

static void log2_one(const float *a, float *r)
{
    r[0] = rhw_log2_1(a[0]);
}

static void log_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_log(a[0]);
}

static void log_one(const float *a, float *r)
{
    r[0] = rhw_log1(a[0]);
}

static void pow_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_pow(a[0], a[1]);
}

static void pow_one(const float *a, float *r)
{
    r[0] = rhw_pow1(a[0], a[1]);
}

static void sincos_lanes(const rhw_float *a, rhw_float *r)
{
    rhw_sincos(a[0], &r[0], &r[1]);
}

static void sincos_one(const float *a, float *r)
{
    rhw_sincos1(a[0], &r[0], &r[1]);
}

static void sin_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_sin(a[0]);
}

static void sin_one(const float *a, float *r)
{
    r[0] = rhw_sin1(a[0]);
}

static void cos_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_cos(a[0]);
}

static void cos_one(const float *a, float *r)
{
    r[0] = rhw_cos1(a[0]);
}

static void tan_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_tan(a[0]);
}

static void tan_one(const float *a, float *r)
{
    r[0] = rhw_tan1(a[0]);
}

static void atan2_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_atan2(a[0], a[1]);
}

static void atan2_one(const float *a, float *r)
{
    r[0] = rhw_atan2_1(a[0], a[1]);
}

static void atan_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_atan(a[0]);
}

static void atan_one(const float *a, float *r)
{
    r[0] = rhw_atan1(a[0]);
}

static void asin_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_asin(a[0]);
}

static void asin_one(const float *a, float *r)
{
    r[0] = rhw_asin1(a[0]);
}

static void acos_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_acos(a[0]);
}

static void acos_one(const float *a, float *r)
{
    r[0] = rhw_acos1(a[0]);
}

static void sinh_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_sinh(a[0]);
}

static void sinh_one(const float *a, float *r)
{
    r[0] = rhw_sinh1(a[0]);
}

static void cosh_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_cosh(a[0]);
}

static void cosh_one(const float *a, float *r)
{
    r[0] = rhw_cosh1(a[0]);
}

static void tanh_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_tanh(a[0]);
}

static void tanh_one(const float *a, float *r)
{
    r[0] = rhw_tanh1(a[0]);
}

static void asinh_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_asinh(a[0]);
}

static void asinh_one(const float *a, float *r)
{
    r[0] = rhw_asinh1(a[0]);
}

static void acosh_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_acosh(a[0]);
}

static void acosh_one(const float *a, float *r)
{
    r[0] = rhw_acosh1(a[0]);
}

static void atanh_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_atanh(a[0]);
}

static void atanh_one(const float *a, float *r)
{
    r[0] = rhw_atanh1(a[0]);
}

static const struct kit_function functions[] = {
    {"infinity", infinity_lanes, infinity_one},
    {"nan", nan_lanes, nan_one},
    {"exp2", exp2_lanes, exp2_one},
    {"exp", exp_lanes, exp_one},
    {"log2", log2_lanes, log2_one},
    {"log", log_lanes, log_one},
    {"pow", pow_lanes, pow_one},
    {"sincos", sincos_lanes, sincos_one},
    {"sin", sin_lanes, sin_one},
    {"cos", cos_lanes, cos_one},
    {"tan", tan_lanes, tan_one},
    {"atan2", atan2_lanes, atan2_one},
    {"atan", atan_lanes, atan_one},
    {"asin", asin_lanes, asin_one},
    {"acos", acos_lanes, acos_one},
    {"sinh", sinh_lanes, sinh_one},
    {"cosh", cosh_lanes, cosh_one},
    {"tanh", tanh_lanes, tanh_one},
    {"asinh", asinh_lanes, asinh_one},
    {"acosh", acosh_lanes, acosh_one},
    {"atanh", atanh_lanes, atanh_one},
};

const struct kit_table RHW_ISA_NAME(kit_math_table) = {sizeof functions / sizeof functions[0], functions};
