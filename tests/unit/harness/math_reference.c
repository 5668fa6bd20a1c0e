// SPDX-License-Identifier: MIT
// See math_reference.h.
#include "math_reference.h"

#include <math.h>
#include <stdint.h>

#include "float_bits.h"

// mpfr_rec_sqrt gives +infinity for −0, IEEE 754 −infinity.
static int reciprocal_root(mpfr_t result, const mpfr_t a, mpfr_rnd_t rounding)
{
    mpfr_sqrt(result, a, rounding);
    return mpfr_ui_div(result, 1, result, rounding);
}

static double reciprocal_root_libm(double a)
{
    return 1 / sqrt(a);
}

const struct math_function math_functions[MATH_FUNCTIONS] = {
    {ISA_EXP2, "exp2", 1.25, mpfr_exp2, exp2, -130, 130},
    {ISA_EXP, "exp", 1.05, mpfr_exp, exp, -90, 90},
    {ISA_LOG2, "log2", 1.25, mpfr_log2, log2, 0.4f, 2.2f},
    {ISA_LOG, "log", 0.95, mpfr_log, log, 0.4f, 2.2f},
    {ISA_SIN, "sin", 1.6, mpfr_sin, sin, -20, 20},
    {ISA_COS, "cos", 1.6, mpfr_cos, cos, -20, 20},
    {ISA_TAN, "tan", 3.6, mpfr_tan, tan, -10, 10},
    {ISA_ASIN, "asin", 1.7, mpfr_asin, asin, -1, 1},
    {ISA_ACOS, "acos", 1.1, mpfr_acos, acos, -1, 1},
    {ISA_ATAN, "atan", 2.0, mpfr_atan, atan, -4, 4},
    {ISA_SINH, "sinh", 0.51, mpfr_sinh, sinh, -90, 90},
    {ISA_COSH, "cosh", 0.51, mpfr_cosh, cosh, -90, 90},
    {ISA_TANH, "tanh", 0.51, mpfr_tanh, tanh, -10, 10},
    {ISA_ASINH, "asinh", 0.51, mpfr_asinh, asinh, -4, 4},
    {ISA_ACOSH, "acosh", 0.51, mpfr_acosh, acosh, 1, 5},
    {ISA_ATANH, "atanh", 0.51, mpfr_atanh, atanh, -1, 1},
    {ISA_SQRT, "sqrt", 0.5, mpfr_sqrt, sqrt, 0, 4},
    {ISA_RSQRT, "rsqrt", 1.5, reciprocal_root, reciprocal_root_libm, 0, 4},
};

const struct math_function2 math_functions2[MATH_FUNCTIONS2] = {
    {ISA_POW, "pow", 1.4, mpfr_pow, pow},
    {ISA_ATAN2, "atan2", 2.0, mpfr_atan2, atan2},
};

double math_ulp_error(float got, const mpfr_t want)
{
    if (mpfr_nan_p(want)) {
        return isnan(got) ? 0 : INFINITY;
    }
    if (mpfr_inf_p(want) || mpfr_zero_p(want)) {
        const float exact = mpfr_get_flt(want, MPFR_RNDN);
        return to_bits(got) == to_bits(exact) ? 0 : INFINITY;
    }
    if (isnan(got)) {
        return INFINITY;
    }
    if (isinf(got) && got == mpfr_get_flt(want, MPFR_RNDN)) {
        return 0;
    }
    long exponent = mpfr_get_exp(want); // want = m · 2^exponent, 0.5 <= m < 1
    exponent = exponent < -125 ? -125 : exponent;
    mpfr_t error;
    mpfr_init2(error, 100);
    if (isinf(got)) { // as good as the next float after the largest
        mpfr_set_d(error, copysign(0x1p128, (double)got), MPFR_RNDN);
    } else {
        mpfr_set_flt(error, got, MPFR_RNDN);
    }
    mpfr_sub(error, error, want, MPFR_RNDN);
    mpfr_mul_2si(error, error, 24 - exponent, MPFR_RNDN);
    const double result = fabs(mpfr_get_d(error, MPFR_RNDN));
    mpfr_clear(error);
    return result;
}

static int32_t to_int(float a)
{
    return isnan(a) ? 0 : a >= 0x1p31f ? INT32_MAX : a < -0x1p31f ? INT32_MIN : (int32_t)a;
}

float math_plain(enum isa_function function, float a, float b)
{
    switch (function) {
    case ISA_FLOOR: return floorf(a);
    case ISA_CEIL: return ceilf(a);
    case ISA_TRUNC: return truncf(a);
    case ISA_ROUND: return rintf(a);
    case ISA_FRACT: return a - floorf(a);
    case ISA_SIGN: return a > 0 ? 1.0f : a < 0 ? -1.0f : 0.0f;
    case ISA_SATURATE: return a > 1 ? 1.0f : a > 0 ? a : 0.0f;
    case ISA_TO_INT: return from_bits((uint32_t)to_int(a));
    case ISA_MIN: return a < b ? a : b;
    case ISA_MAX: return a > b ? a : b;
    case ISA_LESS: return from_bits(a < b ? UINT32_MAX : 0);
    case ISA_LESS_EQUAL: return from_bits(a <= b ? UINT32_MAX : 0);
    default: return from_bits(a == b ? UINT32_MAX : 0);
    }
}
