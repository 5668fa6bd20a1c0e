// SPDX-License-Identifier: MIT
// These are the hyperbolic functions of 8 lanes and their inverses. shader_one.h has them for one float. shader.h
// includes this header.
//
// Each is computed in double from an exponential or a logarithm and rounded once, so its error is little above half an
// ULP. Near 0, where that would cancel, the first terms of the series are as exact. shader_math.h tells what a stated
// error is.
#ifndef RHW_SHADER_HYPERBOLIC_H
#define RHW_SHADER_HYPERBOLIC_H

#include "shader_math.h"

#if RHW_HAS_LANES

RHW_QUIET_BEGIN

// Helpers -------------------------------------------------------------------------------------------

// Return e^r for |r| ≤ 0.35: the series up to r^10, which is exact to 2^-41.
static inline rhw_double4 rhw_exp_fraction_double(rhw_double4 r)
{
    rhw_double4 q = r * (1.0 / 3628800) + 1.0 / 362880;
    q = q * r + 1.0 / 40320;
    q = q * r + 1.0 / 5040;
    q = q * r + 1.0 / 720;
    q = q * r + 1.0 / 120;
    q = q * r + 1.0 / 24;
    q = q * r + 1.0 / 6;
    q = q * r + 0.5;
    return 1.0 + (r + r * r * q);
}

// Return e^a in double for |a| ≤ 100.
static inline struct rhw_double8 rhw_exp_double(rhw_float a)
{
    const rhw_float n = rhw_round(a * 1.44269502f);
    const rhw_int whole = rhw_int_from_float_unchecked(n);
    const rhw_int first = whole >> 1;
    const struct rhw_double8 x = rhw_to_double(a), count = rhw_to_double(n);
    const struct rhw_double8 one = rhw_to_double(rhw_power_of_two(first));
    const struct rhw_double8 other = rhw_to_double(rhw_power_of_two(whole - first));
    struct rhw_double8 result;
    result.low = rhw_exp_fraction_double(x.low - count.low * 0.69314718055994531) * one.low * other.low;
    result.high = rhw_exp_fraction_double(x.high - count.high * 0.69314718055994531) * one.high * other.high;
    return result;
}

// Return the natural logarithm of `a`, whose doubles lie in 2^-120 < a < 2^120.
static inline rhw_float rhw_log_of_double(struct rhw_double8 a)
{
    const rhw_float nearest = rhw_from_double(a);
    const struct rhw_double8 rounded = rhw_to_double(nearest);
    rhw_float e;
    const struct rhw_double8 m = rhw_to_double(rhw_split_exponent(nearest, &e));
    const struct rhw_double8 exponent = rhw_to_double(e);
    struct rhw_double8 result; // what rounding took is given back to m
    result.low = 0.69314718055994531 * rhw_log2_double(m.low * (a.low / rounded.low), exponent.low);
    result.high = 0.69314718055994531 * rhw_log2_double(m.high * (a.high / rounded.high), exponent.high);
    return rhw_from_double(result);
}

// Functions -----------------------------------------------------------------------------------------

/// Return the hyperbolic sine of a, (e^a − e^−a)/2. The largest error is 0.51 ULP.
static inline rhw_float rhw_sinh(rhw_float a)
{
    const rhw_float magnitude = rhw_abs(a);
    const struct rhw_double8 e = rhw_exp_double(rhw_min(magnitude, rhw_splat(100.0f)));
    struct rhw_double8 half;
    half.low = 0.5 * (e.low - 1.0 / e.low);
    half.high = 0.5 * (e.high - 1.0 / e.high);
    const rhw_float z = a * a;
    const rhw_float series = magnitude + magnitude * (z * (0.166666667f + z * 0.00833333333f));
    const rhw_float result =
        rhw_select(rhw_less(magnitude, rhw_splat(0.015625f)), series, rhw_from_double(half));
    return rhw_select(rhw_equal(a, a), rhw_copysign(result, a), a);
}

/// Return the hyperbolic cosine of a, (e^a + e^−a)/2. The largest error is 0.51 ULP.
static inline rhw_float rhw_cosh(rhw_float a)
{
    const struct rhw_double8 e = rhw_exp_double(rhw_min(rhw_abs(a), rhw_splat(100.0f)));
    struct rhw_double8 half;
    half.low = 0.5 * (e.low + 1.0 / e.low);
    half.high = 0.5 * (e.high + 1.0 / e.high);
    return rhw_select(rhw_equal(a, a), rhw_from_double(half), a);
}

/// Return the hyperbolic tangent of a, sinh(a)/cosh(a). The largest error is 0.51 ULP.
static inline rhw_float rhw_tanh(rhw_float a)
{
    const rhw_float magnitude = rhw_abs(a);
    const struct rhw_double8 e = rhw_exp_double(rhw_min(magnitude + magnitude, rhw_splat(40.0f)));
    struct rhw_double8 ratio;
    ratio.low = (e.low - 1.0) / (e.low + 1.0);
    ratio.high = (e.high - 1.0) / (e.high + 1.0);
    const rhw_float z = a * a;
    const rhw_float series = magnitude + magnitude * (z * (-0.333333333f + z * 0.133333333f));
    const rhw_float result =
        rhw_select(rhw_less(magnitude, rhw_splat(0.015625f)), series, rhw_from_double(ratio));
    return rhw_select(rhw_equal(a, a), rhw_copysign(result, a), a);
}

/// Return the inverse hyperbolic sine of a, ln(a + sqrt(a² + 1)). The largest error is 0.51 ULP.
static inline rhw_float rhw_asinh(rhw_float a)
{
    const rhw_float magnitude = rhw_abs(a);
    // From 2^24 on the root is a itself to a double's last bits, and the sum is taken in the logarithm.
    const rhw_int large = rhw_less_equal(rhw_splat(16777216.0f), magnitude);
    const struct rhw_double8 x = rhw_to_double(rhw_select(large, rhw_splat(0.0f), magnitude));
    struct rhw_double8 sum;
    sum.low = x.low + rhw_sqrt_double(x.low * x.low + 1.0);
    sum.high = x.high + rhw_sqrt_double(x.high * x.high + 1.0);
    rhw_float e;
    const struct rhw_double8 m = rhw_to_double(rhw_split_exponent(magnitude, &e));
    const struct rhw_double8 exponent = rhw_to_double(e);
    struct rhw_double8 twice;
    twice.low = 0.69314718055994531 * (1.0 + rhw_log2_double(m.low, exponent.low));
    twice.high = 0.69314718055994531 * (1.0 + rhw_log2_double(m.high, exponent.high));
    const rhw_float beyond =
        rhw_select(rhw_equal(magnitude, rhw_infinity()), magnitude, rhw_from_double(twice));
    const rhw_float z = a * a;
    const rhw_float series = magnitude + magnitude * (z * -0.166666667f);
    rhw_float result = rhw_select(large, beyond, rhw_log_of_double(sum));
    result = rhw_select(rhw_less(magnitude, rhw_splat(0.000244140625f)), series, result);
    return rhw_select(rhw_equal(a, a), rhw_copysign(result, a), a);
}

/// Return the inverse hyperbolic cosine of a, ln(a + sqrt(a² − 1)). An a below 1 gives NaN. The largest error is 0.51
/// ULP.
static inline rhw_float rhw_acosh(rhw_float a)
{
    const rhw_int large = rhw_less_equal(rhw_splat(16777216.0f), a);
    const struct rhw_double8 x =
        rhw_to_double(rhw_select(large | rhw_less(a, rhw_splat(1.0f)), rhw_splat(1.0f), a));
    struct rhw_double8 sum;
    sum.low = x.low + rhw_sqrt_double((x.low - 1.0) * (x.low + 1.0));
    sum.high = x.high + rhw_sqrt_double((x.high - 1.0) * (x.high + 1.0));
    const rhw_float result = rhw_select(large, rhw_asinh(a), rhw_log_of_double(sum));
    return rhw_select(rhw_less_equal(rhw_splat(1.0f), a), result, rhw_nan());
}

/// Return the inverse hyperbolic tangent of a, ln((1 + a)/(1 − a))/2. 1 gives infinity, −1 gives −infinity, and an a
/// beyond them gives NaN. The largest error is 0.51 ULP.
static inline rhw_float rhw_atanh(rhw_float a)
{
    const rhw_float magnitude = rhw_abs(a), one = rhw_splat(1.0f);
    const struct rhw_double8 x =
        rhw_to_double(rhw_select(rhw_less(magnitude, one), magnitude, rhw_splat(0.0f)));
    struct rhw_double8 ratio;
    ratio.low = (1.0 + x.low) / (1.0 - x.low);
    ratio.high = (1.0 + x.high) / (1.0 - x.high);
    const rhw_float z = a * a;
    const rhw_float series = magnitude + magnitude * (z * 0.333333333f);
    rhw_float result = 0.5f * rhw_log_of_double(ratio);
    result = rhw_select(rhw_less(magnitude, rhw_splat(0.000244140625f)), series, result);
    result = rhw_select(rhw_equal(magnitude, one), rhw_infinity(), result);
    return rhw_select(rhw_less_equal(magnitude, one), rhw_copysign(result, a), rhw_nan());
}

RHW_QUIET_END

#endif

#endif
