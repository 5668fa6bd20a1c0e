// SPDX-License-Identifier: MIT
// The instructions of GLSL.std.450 that pack numbers into a word, and that part a number into two.
#include "build_glsl.h"

// Round x, held to ±1 or 0..1, to the nearest of `scale` steps.
static uint32_t steps_of(struct shader_builder *b, uint32_t x, float scale, bool is_signed)
{
    const uint32_t held =
        emit2(b, SHADER_FMIN, emit2(b, SHADER_FMAX, x, number(b, is_signed ? -1.0f : 0.0f)), number(b, 1.0f));
    const uint32_t whole = emit1(b, SHADER_ROUND_EVEN, emit2(b, SHADER_FMUL, held, number(b, scale)));
    return emit1(b, SHADER_INT_FROM_FLOAT, whole);
}

static void build_pack(struct shader_builder *b, uint32_t bits, bool is_signed)
{
    const float scale = (float)((1u << (bits - is_signed)) - 1);
    uint32_t word = shader_number(b, 0);
    for (uint32_t i = 0; i < 32 / bits; i++) {
        const uint32_t field = emit2(b, SHADER_AND, steps_of(b, operand(b, 0, i), scale, is_signed),
                                     shader_number(b, (1u << bits) - 1));
        word = emit2(b, SHADER_OR, word, emit2(b, SHADER_SHIFT_LEFT, field, shader_number(b, i * bits)));
    }
    shader_define_scalar(b, word);
}

static void build_unpack(struct shader_builder *b, uint32_t bits, bool is_signed)
{
    const float scale = (float)((1u << (bits - is_signed)) - 1);
    uint32_t result[4];
    for (uint32_t i = 0; i < 32 / bits; i++) {
        const uint32_t above =
            emit2(b, SHADER_SHIFT_LEFT, operand(b, 0, 0), shader_number(b, 32 - bits * (i + 1)));
        const uint32_t field = emit2(b, is_signed ? SHADER_SHIFT_RIGHT_SIGNED : SHADER_SHIFT_RIGHT, above,
                                     shader_number(b, 32 - bits));
        const uint32_t value =
            emit2(b, SHADER_FDIV, emit1(b, SHADER_FLOAT_FROM_INT, field), number(b, scale));
        result[i] = is_signed ? emit2(b, SHADER_FMAX, value, number(b, -1.0f)) : value;
    }
    if (shader_result_type(b)->scalars != 32 / bits) {
        shader_build_refuse(b, "the result has %u components", (unsigned)(32 / bits));
    }
    shader_define(b, result);
}

static void build_pack_halves(struct shader_builder *b)
{
    const uint32_t word = emit2(b, SHADER_PACK_HALVES, operand(b, 0, 0), operand(b, 0, 1));
    shader_define_scalar(b, word);
}

static void build_unpack_halves(struct shader_builder *b)
{
    const uint32_t word = operand(b, 0, 0);
    const uint32_t result[2] = {emit1(b, SHADER_UNPACK_LOW_HALF, word),
                                emit1(b, SHADER_UNPACK_HIGH_HALF, word)};
    if (shader_result_type(b)->scalars != 2) {
        shader_build_refuse(b, "the result has 2 components");
    }
    shader_define(b, result);
}

// The two results of modf or frexp of operand 0: `count` scalars each.
static void split(struct shader_builder *b, bool is_frexp, uint32_t count, uint32_t *first, uint32_t *second)
{
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t x = operand(b, 0, i);
        if (is_frexp) {
            first[i] = emit1(b, SHADER_FREXP_FRACTION, x);
            second[i] = emit1(b, SHADER_FREXP_EXPONENT, x);
        } else {
            second[i] = emit1(b, SHADER_TRUNC, x);
            first[i] = emit2(b, SHADER_FSUB, x, second[i]);
        }
    }
}

// Refuse a second result that is not what goes with a first one of this type.
static void check_second(const struct shader_builder *b, bool is_frexp, const struct shader_type *first,
                         const struct shader_type *second)
{
    const bool is_integer = (second->kind == SHADER_VECTOR ? second->element : second)->kind == SHADER_INT;
    if (is_frexp ? !is_integer || second->scalars != first->scalars : second != first) {
        shader_build_refuse(b, "the second result is of a type that does not fit");
    }
}

// modf and frexp in the forms that give a structure.
static void build_parts(struct shader_builder *b, bool is_frexp)
{
    const struct shader_type *const type = shader_result_type(b);
    if (type->kind != SHADER_STRUCT || type->count != 2) {
        shader_build_refuse(b, "the result is a structure of two members");
    }
    const struct shader_type *const first = type->members[0].type;
    shader_check_types(b, first, "ff", 5);
    check_second(b, is_frexp, first, type->members[1].type);
    uint32_t *const result = shader_new_scalars(b, type);
    split(b, is_frexp, first->scalars, result, result + first->scalars);
    shader_define(b, result);
}

// modf and frexp in the forms that store the second result.
static void build_stored_part(struct shader_builder *b, bool is_frexp)
{
    const struct shader_type *const type = shader_result_type(b);
    const uint32_t pointer = shader_operand(b, 6);
    shader_check_signature(b, "ff", 5);
    const struct shader_type *const second = shader_place_of(b, pointer)->type;
    check_second(b, is_frexp, type, second);
    uint32_t *const result = shader_new_scalars(b, type), *const stored = shader_new_scalars(b, type);
    split(b, is_frexp, type->scalars, result, stored);
    shader_store(b, pointer, second, stored);
    shader_define(b, result);
}

bool shader_build_packing(struct shader_builder *b, uint32_t instruction)
{
    switch (instruction) {
    case GLSL_PACK_SNORM4X8: build_pack(b, 8, true); return true;
    case GLSL_PACK_UNORM4X8: build_pack(b, 8, false); return true;
    case GLSL_PACK_SNORM2X16: build_pack(b, 16, true); return true;
    case GLSL_PACK_UNORM2X16: build_pack(b, 16, false); return true;
    case GLSL_PACK_HALF2X16: build_pack_halves(b); return true;
    case GLSL_UNPACK_SNORM4X8: build_unpack(b, 8, true); return true;
    case GLSL_UNPACK_UNORM4X8: build_unpack(b, 8, false); return true;
    case GLSL_UNPACK_SNORM2X16: build_unpack(b, 16, true); return true;
    case GLSL_UNPACK_UNORM2X16: build_unpack(b, 16, false); return true;
    case GLSL_UNPACK_HALF2X16: build_unpack_halves(b); return true;
    case GLSL_MODF_STRUCT:
    case GLSL_FREXP_STRUCT: build_parts(b, instruction == GLSL_FREXP_STRUCT); return true;
    case GLSL_MODF:
    case GLSL_FREXP: build_stored_part(b, instruction == GLSL_FREXP); return true;
    default: return false;
    }
}
