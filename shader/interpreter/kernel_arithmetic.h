// SPDX-License-Identifier: MIT
// Operations on registers: each is a loop over the groups of a batch.
#ifndef SHADER_KERNEL_ARITHMETIC_H
#define SHADER_KERNEL_ARITHMETIC_H

#include "frame.h"
#include "rhw/shader_hyperbolic.h"
#include "rhw/shader_integer.h"
#include "rhw/shader_math.h"
#include "rhw/shader_pack.h"
#include "rhw/shader_spirv.h"

// Pointers to the vectors of the result and of the operands. No operand lies in the register of the result.
#define VECTORS                                                             \
    union vector *const restrict d = &frame->registers[in->result.vector];  \
    const union vector *const restrict a = &frame->registers[in->a.vector]; \
    const union vector *const restrict b = &frame->registers[in->b.vector]; \
    const union vector *const restrict c = &frame->registers[in->c.vector]; \
    (void)a, (void)b, (void)c

// A function of an operation: its operands have a vector for each group (a step of 1) or one for all (a step of 0).
// Groups are counted in fours as long as there are four.
#define STEPS(name, member, value, step_a, step_b, step_c)                      \
    static void name(struct frame *frame, const struct shader_instruction *in)  \
    {                                                                           \
        enum { a_step = step_a, b_step = step_b, c_step = step_c };             \
        const ptrdiff_t end = frame->range.end;                                 \
        ptrdiff_t four = frame->range.first;                                    \
        VECTORS;                                                                \
        for (; four + 4 <= end; four += 4) {                                    \
            _Pragma("GCC unroll 4") for (ptrdiff_t i = four; i < four + 4; i++) \
            {                                                                   \
                d[i].member = value;                                            \
            }                                                                   \
        }                                                                       \
        for (ptrdiff_t i = four; i < end; i++) {                                \
            d[i].member = value;                                                \
        }                                                                       \
    }

// One that computes a vector for all groups.
#define ONCE(name, member, value)                                              \
    static void name(struct frame *frame, const struct shader_instruction *in) \
    {                                                                          \
        enum { i = 0, a_step = 0, b_step = 0, c_step = 0 };                    \
        VECTORS;                                                               \
        d[i].member = value;                                                   \
    }

// All functions of an operation, named by the steps of its operands.
#define UNARY(name, member, value)            \
    STEPS(name##_100, member, value, 1, 0, 0) \
    STEPS(name##_000, member, value, 0, 0, 0) \
    ONCE(name##_ONCE, member, value)

#define BINARY(name, member, value)           \
    UNARY(name, member, value)                \
    STEPS(name##_110, member, value, 1, 1, 0) \
    STEPS(name##_010, member, value, 0, 1, 0)

#define TERNARY(name, member, value)          \
    BINARY(name, member, value)               \
    STEPS(name##_111, member, value, 1, 1, 1) \
    STEPS(name##_011, member, value, 0, 1, 1) \
    STEPS(name##_101, member, value, 1, 0, 1) \
    STEPS(name##_001, member, value, 0, 0, 1)

// One that takes so long that one form for any number of groups will do.
#define LONG(name, member, value)                                              \
    static void name(struct frame *frame, const struct shader_instruction *in) \
    {                                                                          \
        const int a_step = !in->a.is_uniform, b_step = !in->b.is_uniform;      \
        const int first = in->kind == SHADER_ONCE ? 0 : frame->range.first;    \
        const int end = in->kind == SHADER_ONCE ? 1 : frame->range.end;        \
        VECTORS;                                                               \
        (void)b_step;                                                          \
        for (int i = first; i < end; i++) {                                    \
            d[i].member = value;                                               \
        }                                                                      \
    }

#define AF a[i * a_step].f
#define BF b[i * b_step].f
#define CF c[i * c_step].f
#define AI a[i * a_step].i
#define BI b[i * b_step].i
#define CI c[i * c_step].i
#define AU (rhw_uint) a[i * a_step].i
#define BU (rhw_uint) b[i * b_step].i

UNARY(run_COPY, i, AI)
BINARY(run_FADD, f, AF + BF)
BINARY(run_FSUB, f, AF - BF)
BINARY(run_FMUL, f, AF *BF)
BINARY(run_FDIV, f, AF / BF)
BINARY(run_FMIN, f, rhw_min(AF, BF))
BINARY(run_FMAX, f, rhw_max(AF, BF))
UNARY(run_FSQRT, f, rhw_sqrt(AF))
UNARY(run_FLOOR, f, rhw_floor(AF))
UNARY(run_CEIL, f, rhw_ceil(AF))
UNARY(run_TRUNC, f, rhw_trunc(AF))
UNARY(run_ROUND_EVEN, f, rhw_round(AF))
BINARY(run_FEQUAL, i, rhw_equal(AF, BF))
BINARY(run_FLESS, i, rhw_less(AF, BF))
BINARY(run_FLESS_EQUAL, i, rhw_less_equal(AF, BF))
BINARY(run_IADD, i, (rhw_int)(AU + BU))
BINARY(run_ISUB, i, (rhw_int)(AU - BU))
BINARY(run_IMUL, i, (rhw_int)(AU *BU))
BINARY(run_AND, i, AI &BI)
BINARY(run_OR, i, AI | BI)
BINARY(run_XOR, i, AI ^ BI)
UNARY(run_NOT, i, ~AI)
BINARY(run_SHIFT_LEFT, i, (rhw_int)(AU << (rhw_uint)(BI & 31)))
BINARY(run_SHIFT_RIGHT, i, (rhw_int)(AU >> (rhw_uint)(BI & 31)))
BINARY(run_SHIFT_RIGHT_SIGNED, i, AI >> (BI & 31))
BINARY(run_IEQUAL, i, rhw_equal_int(AI, BI))
BINARY(run_ILESS, i, rhw_less_int(AI, BI))
BINARY(run_ULESS, i, rhw_spirv_less_uint(AI, BI))
BINARY(run_IMIN, i, rhw_min_int(AI, BI))
BINARY(run_IMAX, i, rhw_max_int(AI, BI))
TERNARY(run_SELECT, i, rhw_select_int(AI, BI, CI))
TERNARY(run_MUL_ADD, f, AF *BF + CF)
TERNARY(run_MUL_SUB, f, AF *BF - CF)
TERNARY(run_SUB_MUL, f, CF - AF * BF)
UNARY(run_FLOAT_FROM_INT, f, rhw_float_from_int(AI))
UNARY(run_INT_FROM_FLOAT, i, rhw_int_from_float(AF))

#define ONE(name, result, operand, function) LONG(run_##name, result, function(a[i * a_step].operand))
#define TWO(name, result, first, second, function) \
    LONG(run_##name, result, function(a[i * a_step].first, b[i * b_step].second))
#include "form/function.inc"
#undef ONE
#undef TWO

#endif
