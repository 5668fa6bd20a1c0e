// SPDX-License-Identifier: MIT
// See isa_templates.h; compiled with RHW_ISA_SUFFIX = baseline, avx2, ...
#include "isa_templates.h"

#include "kernels/fragment/blend.h"

static void blend(const struct rhw_blend_state *state, const rhw_float color[4], const rhw_int *mask,
                  unsigned char *texels)
{
    blend_group(state, color, *mask, texels);
}

static void decode(const struct rhw_format_info *format, const unsigned char *texels, rhw_float value[4])
{
    struct raw_texels raw;
    load_texel_row(format->size, texels, &raw);
    decode_texels(format, &raw, value);
}

static inline rhw_float apply8(enum isa_function function, rhw_float a, rhw_float b)
{
    switch (function) {
    case ISA_EXP2: return rhw_exp2(a);
    case ISA_EXP: return rhw_exp(a);
    case ISA_LOG2: return rhw_log2(a);
    case ISA_LOG: return rhw_log(a);
    case ISA_SIN: return rhw_sin(a);
    case ISA_COS: return rhw_cos(a);
    case ISA_TAN: return rhw_tan(a);
    case ISA_ASIN: return rhw_asin(a);
    case ISA_ACOS: return rhw_acos(a);
    case ISA_ATAN: return rhw_atan(a);
    case ISA_SINH: return rhw_sinh(a);
    case ISA_COSH: return rhw_cosh(a);
    case ISA_TANH: return rhw_tanh(a);
    case ISA_ASINH: return rhw_asinh(a);
    case ISA_ACOSH: return rhw_acosh(a);
    case ISA_ATANH: return rhw_atanh(a);
    case ISA_SQRT: return rhw_sqrt(a);
    case ISA_RSQRT: return rhw_rsqrt(a);
    case ISA_FLOOR: return rhw_floor(a);
    case ISA_CEIL: return rhw_ceil(a);
    case ISA_TRUNC: return rhw_trunc(a);
    case ISA_ROUND: return rhw_round(a);
    case ISA_FRACT: return rhw_fract(a);
    case ISA_SIGN: return rhw_sign(a);
    case ISA_SATURATE: return rhw_saturate(a);
    case ISA_TO_INT: return rhw_float_from_bits(rhw_int_from_float(a));
    case ISA_POW: return rhw_pow(a, b);
    case ISA_ATAN2: return rhw_atan2(a, b);
    case ISA_MIN: return rhw_min(a, b);
    case ISA_MAX: return rhw_max(a, b);
    case ISA_LESS: return rhw_float_from_bits(rhw_less(a, b));
    case ISA_LESS_EQUAL: return rhw_float_from_bits(rhw_less_equal(a, b));
    case ISA_EQUAL: return rhw_float_from_bits(rhw_equal(a, b));
    case ISA_FUNCTION_COUNT: break;
    }
    return rhw_splat(0.0f);
}

static void apply(enum isa_function function, const float *a, const float *b, float *result, int count)
{
    for (int i = 0; i < count; i += RHW_LANES) {
        rhw_store(result + i, apply8(function, rhw_load(a + i), rhw_load(b + i)));
    }
}

const struct isa_templates RHW_ISA_NAME(isa_templates) = {blend, decode, apply};
