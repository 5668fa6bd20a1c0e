// SPDX-License-Identifier: MIT
// See tolerance.h.
#include "tolerance.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const char *const names[] = {
    "sin",
    "cos",
    "tan",
    "asin",
    "acos",
    "atan",
    "sinh",
    "cosh",
    "tanh",
    "asinh",
    "acosh",
    "atanh",
    "exp",
    "log",
    "exp2",
    "log2",
    "sqrt",
    "inversesqrt",
    "atan2",
    "pow",
    "roundEven",
    "trunc",
    "floor",
    "ceil",
    "fract",
    "abs",
    "sign",
    "min",
    "max",
    "clamp",
    "mix",
    "step",
    "smoothstep",
    "fma",
    "ldexp",
    "frexp",
    "modf",
    "mod",
    "mix by bool",
    "isnan, isinf, ==, !=",
    "radians",
    "degrees",
    "NMin",
    "NMax",
    "NClamp",
    "<, <=, >, >=",
    "conversions",
    NULL,
    NULL,
    NULL,
    "length",
    "distance",
    "normalize",
    "cross",
    "faceforward",
    "reflect",
    "refract",
    "dot",
    "pack",
    "unpackUnorm4x8",
    "unpackSnorm4x8",
    "unpack 2x16",
    "halves",
    "matrices",
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    NULL,
    "findMSB, findLSB, bitCount",
    "bitfieldReverse, abs, sign, -",
    "bit fields",
    "min, max, clamp of integers",
    "/, %",
    "shifts, ^, ~",
    "uaddCarry, usubBorrow",
    "extended products",
    "< of integers",
};

enum { NAMES = sizeof names / sizeof *names };

const char *function_name(int which)
{
    return which >= 0 && which < NAMES ? names[which] : NULL;
}

static float as_float(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static double ulp(double value)
{
    int exponent;
    (void)frexp(fabs(value) < (double)FLT_MIN ? (double)FLT_MIN : value, &exponent);
    return ldexp(1, exponent - 24);
}

static bool is_denormal(float x)
{
    return x != 0 && fabsf(x) < FLT_MIN;
}

// Are the results integers or truths, which have no tolerance?
static bool is_whole(int which, int word)
{
    return which >= 70 || which == 39 || which == 45 || which == 58 || (which == 46 && word < 2) ||
           (which == 35 && word == 1);
}

static double largest(const float v[3])
{
    return fmax(fabs((double)v[0]), fmax(fabs((double)v[1]), fabs((double)v[2])));
}

// The absolute error that Vulkan's tables allow.
static double tolerance(int which, const float v[3], double r)
{
    const double x = (double)v[0], y = (double)v[1], z = (double)v[2], most = largest(v);
    switch (which) {
    case 0:
    case 1: return 0x1p-11;
    case 2: return (1 + r * r) * 0x1p-10;
    case 3:
    case 4:
    case 5:
    case 18: return 4096 * ulp(fmax(fabs(r), 1));
    case 6:
    case 7: return (3 + 2 * fabs(x)) * ulp(exp(fabs(x)));
    case 8: return 64 * ulp(1);
    case 9:
    case 10:
    case 11: return 0x1p-20 + 8 * ulp(r);
    case 12:
    case 14: return (3 + 2 * fabs(x)) * ulp(r);
    case 13:
    case 15: return x >= 0.5 && x <= 2 ? 0x1p-21 : 3 * ulp(r);
    case 16: return 3 * ulp(r);
    case 17: return 2 * ulp(r);
    case 19: return (3 + 8 * fabs(y * log2(x))) * ulp(r);
    case 24:
    case 36: return 0;
    case 30: return 4 * ulp(fmax(fabs(x * (1 - z)), fmax(fabs(y * z), most)));
    case 32: return 32 * ulp(1);
    case 33: return ulp(x * y) + ulp(r);
    case 37: return 4 * ulp(x) + 4 * ulp(y);
    case 40:
    case 41: return 2 * ulp(r);
    case 50:
    case 51:
    case 52: return 8 * ulp(r);
    case 53:
    case 57: return 8 * ulp(most * most);
    case 55: return 16 * ulp(fmax(most * most * most, most));
    case 56: return 1e-4 * (1 + most * most * most);
    case 59:
    case 60:
    case 61: return 3 * ulp(r);
    case 63: return HUGE_VAL;
    default: return 0;
    }
}

// Does GLSL, or SPIR-V's extended instructions for it, leave the result open?
static bool is_undefined(int which, const float v[3])
{
    const float x = v[0], y = v[1], z = v[2];
    switch (which) {
    case 0:
    case 1:
    case 2: return fabsf(x) > 3.14160f; // no precision is stated there
    case 3:
    case 4: return fabsf(x) > 1;
    case 10: return x < 1;
    case 11: return fabsf(x) >= 1;
    case 13:
    case 15: return x <= 0;
    case 16: return x < 0;
    case 17: return x <= 0;
    case 18: return x == 0 && y == 0;
    case 19: return x < 0 || (x == 0 && y <= 0);
    case 29: return y > z;
    case 32: return x >= y;
    case 34: return fabsf(y) > 128;
    case 37: return y == 0 || fabsf(x / y) > 8388608;
    case 44: return y > z;
    case 46: return fabsf(x) >= 2147483648.0f || x < 0; // and conversions to unsigned of negative numbers
    case 52: return largest(v) == 0;
    default: return false;
    }
}

// Integers may differ where GLSL leaves them open: fields outside of the 32 bits, and division of what overflows.
static bool is_undefined_whole(int which, int word, const float v[3])
{
    int32_t n[3];
    memcpy(n, v, sizeof n);
    switch (which) {
    case 74: return (word == 0 || word == 3) && n[0] == INT32_MIN && n[1] == -1;
    default: return false;
    }
}

static bool has_special(const float v[3])
{
    return !isfinite(v[0]) || !isfinite(v[1]) || !isfinite(v[2]);
}

static bool has_denormal(const float v[3])
{
    return is_denormal(v[0]) || is_denormal(v[1]) || is_denormal(v[2]);
}

// Packed numbers may be rounded either way where they lie halfway between two steps.
static bool is_a_step_apart(int word, uint32_t here, uint32_t there)
{
    const int bits = word < 2 ? 8 : 16;
    for (int at = 0; at < 32; at += bits) {
        const uint32_t mask = (1u << bits) - 1, a = here >> at & mask, b = there >> at & mask;
        if (a != b && ((a + 1) & mask) != b && ((b + 1) & mask) != a) {
            return false;
        }
    }
    return true;
}

enum difference explain_difference(int which, int word, const float operands[3], uint32_t here,
                                   uint32_t there)
{
    const float a = as_float(here), b = as_float(there);
    if (here == there) {
        return DIFFERENCE_NONE;
    }
    if (which >= 70) {
        return is_undefined_whole(which, word, operands) ? DIFFERENCE_UNDEFINED : DIFFERENCE_UNEXPLAINED;
    }
    if (has_special(operands) || is_undefined(which, operands)) {
        return DIFFERENCE_UNDEFINED;
    }
    if (is_whole(which, word)) {
        return which == 58 && is_a_step_apart(word, here, there) ? DIFFERENCE_PRECISION
               : has_denormal(operands)                          ? DIFFERENCE_DENORMAL
                                                                 : DIFFERENCE_UNEXPLAINED;
    }
    if (isnan(a) && isnan(b)) {
        return DIFFERENCE_NONE;
    }
    if (a == 0 && b == 0) {
        return DIFFERENCE_ZERO;
    }
    if (!isfinite(a) || !isfinite(b)) {
        return DIFFERENCE_UNDEFINED;
    }
    const double apart = fabs((double)a - (double)b);
    const double least = fmin(tolerance(which, operands, (double)a), tolerance(which, operands, (double)b));
    if (apart <= 2 * least) { // each of them may be wrong by as much
        return DIFFERENCE_PRECISION;
    }
    return has_denormal(operands) || is_denormal(a) || is_denormal(b) ? DIFFERENCE_DENORMAL
                                                                      : DIFFERENCE_UNEXPLAINED;
}
