// SPDX-License-Identifier: MIT
// Operations on registers: each is a loop over the groups of a batch.
#ifndef SHADER_KERNEL_ARITHMETIC_H
#define SHADER_KERNEL_ARITHMETIC_H

#include "frame.h"
#include "rhw/shader_hyperbolic.h"
#include "rhw/shader_integer.h"
#include "rhw/shader_math.h"
#include "rhw/shader_pack.h"

// Loops over the vectors of the result; a, b and c are operands, as floats or whole numbers.
#define OPERANDS                                                                                  \
    const int count = in->is_uniform ? 1 : frame->groups;                                         \
    union vector *const d = &frame->registers[in->result.vector];                                 \
    const union vector *const a = &frame->registers[in->a.vector];                                \
    const union vector *const b = &frame->registers[in->b.vector];                                \
    const union vector *const c = &frame->registers[in->c.vector];                                \
    const int a_step = !in->a.is_uniform, b_step = !in->b.is_uniform, c_step = !in->c.is_uniform; \
    (void)a, (void)b, (void)c, (void)a_step, (void)b_step, (void)c_step

#define KERNEL(name, member, value)                                            \
    static void name(struct frame *frame, const struct shader_instruction *in) \
    {                                                                          \
        OPERANDS;                                                              \
        for (int i = 0; i < count; i++) {                                      \
            d[i].member = value;                                               \
        }                                                                      \
    }

#define AF a[i * a_step].f
#define BF b[i * b_step].f
#define AI a[i * a_step].i
#define BI b[i * b_step].i
#define CI c[i * c_step].i
#define AU (rhw_uint) a[i * a_step].i
#define BU (rhw_uint) b[i * b_step].i

static inline rhw_int shader_less_uint(rhw_int a, rhw_int b)
{
    const rhw_int sign = rhw_splat_int(INT32_MIN);
    return rhw_less_int(a ^ sign, b ^ sign);
}

static inline rhw_float shader_float_from_uint(rhw_int a)
{
    rhw_float result;
    for (int i = 0; i < RHW_LANES; i++) {
        result[i] = (float)(uint32_t)a[i];
    }
    return result;
}

static inline rhw_int shader_uint_from_float(rhw_float a)
{
    rhw_int result;
    for (int i = 0; i < RHW_LANES; i++) {
        result[i] = !(a[i] > 0.0f) ? 0 : a[i] >= 0x1p32f ? -1 : (int32_t)(uint32_t)a[i];
    }
    return result;
}

static inline rhw_int shader_mul_high(rhw_int a, rhw_int b, bool is_signed)
{
    rhw_int result;
    for (int i = 0; i < RHW_LANES; i++) {
        const int64_t whole = (int64_t)a[i] * b[i];
        const uint64_t positive = (uint64_t)(uint32_t)a[i] * (uint32_t)b[i];
        result[i] = is_signed ? (int32_t)((uint64_t)whole >> 32) : (int32_t)(positive >> 32);
    }
    return result;
}

static inline rhw_int shader_pack_halves(rhw_float low, rhw_float high)
{
    const rhw_float v[2] = {low, high};
    return rhw_pack_half2x16(v);
}

static inline rhw_float shader_frexp_fraction(rhw_float a)
{
    rhw_int exponent;
    return rhw_frexp(a, &exponent);
}

static inline rhw_int shader_frexp_exponent(rhw_float a)
{
    rhw_int exponent;
    (void)rhw_frexp(a, &exponent);
    return exponent;
}

KERNEL(run_COPY, i, AI)
KERNEL(run_FADD, f, AF + BF)
KERNEL(run_FSUB, f, AF - BF)
KERNEL(run_FMUL, f, AF *BF)
KERNEL(run_FDIV, f, AF / BF)
KERNEL(run_FMIN, f, rhw_min(AF, BF))
KERNEL(run_FMAX, f, rhw_max(AF, BF))
KERNEL(run_FSQRT, f, rhw_sqrt(AF))
KERNEL(run_FLOOR, f, rhw_floor(AF))
KERNEL(run_CEIL, f, rhw_ceil(AF))
KERNEL(run_TRUNC, f, rhw_trunc(AF))
KERNEL(run_ROUND_EVEN, f, rhw_round(AF))
KERNEL(run_FEQUAL, i, rhw_equal(AF, BF))
KERNEL(run_FLESS, i, rhw_less(AF, BF))
KERNEL(run_FLESS_EQUAL, i, rhw_less_equal(AF, BF))
KERNEL(run_IADD, i, (rhw_int)(AU + BU))
KERNEL(run_ISUB, i, (rhw_int)(AU - BU))
KERNEL(run_IMUL, i, (rhw_int)(AU *BU))
KERNEL(run_IMUL_HIGH, i, shader_mul_high(AI, BI, true))
KERNEL(run_UMUL_HIGH, i, shader_mul_high(AI, BI, false))
KERNEL(run_IDIV, i, rhw_divide_int(AI, BI))
KERNEL(run_UDIV, i, rhw_divide_uint(AI, BI))
KERNEL(run_IREM, i, rhw_remainder_int(AI, BI))
KERNEL(run_UREM, i, rhw_remainder_uint(AI, BI))
KERNEL(run_AND, i, AI &BI)
KERNEL(run_OR, i, AI | BI)
KERNEL(run_XOR, i, AI ^ BI)
KERNEL(run_NOT, i, ~AI)
KERNEL(run_SHIFT_LEFT, i, (rhw_int)(AU << (rhw_uint)(BI & 31)))
KERNEL(run_SHIFT_RIGHT, i, (rhw_int)(AU >> (rhw_uint)(BI & 31)))
KERNEL(run_SHIFT_RIGHT_SIGNED, i, AI >> (BI & 31))
KERNEL(run_IEQUAL, i, rhw_equal_int(AI, BI))
KERNEL(run_ILESS, i, rhw_less_int(AI, BI))
KERNEL(run_ULESS, i, shader_less_uint(AI, BI))
KERNEL(run_BIT_REVERSE, i, rhw_bit_reverse(AI))
KERNEL(run_BIT_COUNT, i, rhw_bit_count(AI))
KERNEL(run_FIND_LOWEST, i, rhw_find_lsb(AI))
KERNEL(run_FIND_HIGHEST, i, rhw_find_msb_uint(AI))
KERNEL(run_SELECT, i, rhw_select_int(AI, BI, CI))
KERNEL(run_FLOAT_FROM_INT, f, rhw_float_from_int(AI))
KERNEL(run_FLOAT_FROM_UINT, f, shader_float_from_uint(AI))
KERNEL(run_INT_FROM_FLOAT, i, rhw_int_from_float(AF))
KERNEL(run_UINT_FROM_FLOAT, i, shader_uint_from_float(AF))
KERNEL(run_PACK_HALVES, i, shader_pack_halves(AF, BF))
KERNEL(run_UNPACK_LOW_HALF, f, rhw_float_from_half_bits(AI & 0xffff))
KERNEL(run_UNPACK_HIGH_HALF, f, rhw_float_from_half_bits((rhw_int)(AU >> 16)))
KERNEL(run_SIN, f, rhw_sin(AF))
KERNEL(run_COS, f, rhw_cos(AF))
KERNEL(run_TAN, f, rhw_tan(AF))
KERNEL(run_ASIN, f, rhw_asin(AF))
KERNEL(run_ACOS, f, rhw_acos(AF))
KERNEL(run_ATAN, f, rhw_atan(AF))
KERNEL(run_ATAN2, f, rhw_atan2(AF, BF))
KERNEL(run_SINH, f, rhw_sinh(AF))
KERNEL(run_COSH, f, rhw_cosh(AF))
KERNEL(run_TANH, f, rhw_tanh(AF))
KERNEL(run_ASINH, f, rhw_asinh(AF))
KERNEL(run_ACOSH, f, rhw_acosh(AF))
KERNEL(run_ATANH, f, rhw_atanh(AF))
KERNEL(run_EXP, f, rhw_exp(AF))
KERNEL(run_LOG, f, rhw_log(AF))
KERNEL(run_EXP2, f, rhw_exp2(AF))
KERNEL(run_LOG2, f, rhw_log2(AF))
KERNEL(run_POW, f, rhw_pow(AF, BF))
KERNEL(run_RSQRT, f, rhw_rsqrt(AF))
KERNEL(run_LDEXP, f, rhw_ldexp(AF, BI))
KERNEL(run_FREXP_FRACTION, f, shader_frexp_fraction(AF))
KERNEL(run_FREXP_EXPONENT, i, shader_frexp_exponent(AF))

#endif
