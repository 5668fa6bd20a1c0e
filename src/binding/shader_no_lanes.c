// SPDX-License-Identifier: MIT
// The one-at-a-time form for programs whose compiler has no lanes: it is a lane of the functions on 8.
#include "rhw/shader.h"

float rhw_math1(enum rhw_math1_function function, float a, float b)
{
    switch (function) {
    case RHW_MATH1_EXP2: return rhw_exp2_1(a);
    case RHW_MATH1_EXP: return rhw_exp1(a);
    case RHW_MATH1_LOG2: return rhw_log2_1(a);
    case RHW_MATH1_LOG: return rhw_log1(a);
    case RHW_MATH1_POW: return rhw_pow1(a, b);
    case RHW_MATH1_SIN: return rhw_sin1(a);
    case RHW_MATH1_COS: return rhw_cos1(a);
    case RHW_MATH1_TAN: return rhw_tan1(a);
    case RHW_MATH1_ASIN: return rhw_asin1(a);
    case RHW_MATH1_ACOS: return rhw_acos1(a);
    case RHW_MATH1_ATAN: return rhw_atan1(a);
    case RHW_MATH1_ATAN2: return rhw_atan2_1(a, b);
    case RHW_MATH1_SQRT: return rhw_sqrt1(a);
    case RHW_MATH1_TRUNC: return rhw_trunc1(a);
    case RHW_MATH1_FLOOR: return rhw_floor1(a);
    case RHW_MATH1_CEIL: return rhw_ceil1(a);
    case RHW_MATH1_ROUND: return rhw_round1(a);
    case RHW_MATH1_SINH: return rhw_sinh1(a);
    case RHW_MATH1_COSH: return rhw_cosh1(a);
    case RHW_MATH1_TANH: return rhw_tanh1(a);
    case RHW_MATH1_ASINH: return rhw_asinh1(a);
    case RHW_MATH1_ACOSH: return rhw_acosh1(a);
    case RHW_MATH1_ATANH: return rhw_atanh1(a);
    }
    return rhw_nan1();
}
