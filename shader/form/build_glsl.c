// SPDX-License-Identifier: MIT
// The instructions of GLSL.std.450: those that work component by component here, others in the files of build_glsl.h.
#include "build_glsl.h"

// What types the operands have (signature.c), by number; NULL: whoever translates the instruction looks.
static const char *const signatures[] = {
    [GLSL_ROUND] = "ff",
    [GLSL_ROUND_EVEN] = "ff",
    [GLSL_TRUNC] = "ff",
    [GLSL_FABS] = "ff",
    [GLSL_SABS] = "ii",
    [GLSL_FSIGN] = "ff",
    [GLSL_SSIGN] = "ii",
    [GLSL_FLOOR] = "ff",
    [GLSL_CEIL] = "ff",
    [GLSL_FRACT] = "ff",
    [GLSL_RADIANS] = "ff",
    [GLSL_DEGREES] = "ff",
    [GLSL_SIN] = "ff",
    [GLSL_COS] = "ff",
    [GLSL_TAN] = "ff",
    [GLSL_ASIN] = "ff",
    [GLSL_ACOS] = "ff",
    [GLSL_ATAN] = "ff",
    [GLSL_SINH] = "ff",
    [GLSL_COSH] = "ff",
    [GLSL_TANH] = "ff",
    [GLSL_ASINH] = "ff",
    [GLSL_ACOSH] = "ff",
    [GLSL_ATANH] = "ff",
    [GLSL_ATAN2] = "fff",
    [GLSL_POW] = "fff",
    [GLSL_EXP] = "ff",
    [GLSL_LOG] = "ff",
    [GLSL_EXP2] = "ff",
    [GLSL_LOG2] = "ff",
    [GLSL_SQRT] = "ff",
    [GLSL_INVERSE_SQRT] = "ff",
    [GLSL_FMIN] = "fff",
    [GLSL_UMIN] = "iii",
    [GLSL_SMIN] = "iii",
    [GLSL_FMAX] = "fff",
    [GLSL_UMAX] = "iii",
    [GLSL_SMAX] = "iii",
    [GLSL_FCLAMP] = "ffff",
    [GLSL_UCLAMP] = "iiii",
    [GLSL_SCLAMP] = "iiii",
    [GLSL_FMIX] = "ffff",
    [GLSL_STEP] = "fff",
    [GLSL_SMOOTH_STEP] = "ffff",
    [GLSL_FMA] = "ffff",
    [GLSL_LDEXP] = "ffi",
    [GLSL_PACK_SNORM4X8] = "If",
    [GLSL_PACK_UNORM4X8] = "If",
    [GLSL_PACK_SNORM2X16] = "If",
    [GLSL_PACK_UNORM2X16] = "If",
    [GLSL_PACK_HALF2X16] = "If",
    [GLSL_UNPACK_SNORM2X16] = "fI",
    [GLSL_UNPACK_UNORM2X16] = "fI",
    [GLSL_UNPACK_HALF2X16] = "fI",
    [GLSL_UNPACK_SNORM4X8] = "fI",
    [GLSL_UNPACK_UNORM4X8] = "fI",
    [GLSL_LENGTH] = "Ff",
    [GLSL_DISTANCE] = "Fff",
    [GLSL_CROSS] = "fff",
    [GLSL_NORMALIZE] = "ff",
    [GLSL_FACE_FORWARD] = "ffff",
    [GLSL_REFLECT] = "fff",
    [GLSL_REFRACT] = "fffF",
    [GLSL_FIND_I_LSB] = "ii",
    [GLSL_FIND_S_MSB] = "ii",
    [GLSL_FIND_U_MSB] = "ii",
    [GLSL_NMIN] = "fff",
    [GLSL_NMAX] = "fff",
    [GLSL_NCLAMP] = "ffff",
};

// Return whether the whole number x is less than y, with or without a sign.
static uint32_t smaller(struct shader_builder *b, uint32_t x, uint32_t y, bool is_signed)
{
    return emit2(b, is_signed ? SHADER_ILESS : SHADER_ULESS, x, y);
}

// min and max of floats that give the other operand where one is NaN. FMIN and FMAX give y where x is NaN.
static uint32_t number_min(struct shader_builder *b, uint32_t x, uint32_t y, bool takes_max)
{
    const uint32_t is_number = emit2(b, SHADER_FEQUAL, y, y);
    return select(b, is_number, emit2(b, takes_max ? SHADER_FMAX : SHADER_FMIN, x, y), x);
}

static uint32_t sign_of(struct shader_builder *b, uint32_t x)
{
    const uint32_t one = number(b, 1.0f), zero = number(b, 0.0f);
    const uint32_t above = select(b, emit2(b, SHADER_FLESS, zero, x), one, zero);
    return select(b, emit2(b, SHADER_FLESS, x, zero), number(b, -1.0f), above);
}

static uint32_t whole_sign_of(struct shader_builder *b, uint32_t x)
{
    const uint32_t zero = shader_number(b, 0);
    const uint32_t above = emit2(b, SHADER_AND, emit2(b, SHADER_ILESS, zero, x), shader_number(b, 1));
    return emit2(b, SHADER_OR, emit2(b, SHADER_SHIFT_RIGHT_SIGNED, x, shader_number(b, 31)), above);
}

static uint32_t whole_magnitude(struct shader_builder *b, uint32_t x)
{
    const uint32_t sign = emit2(b, SHADER_SHIFT_RIGHT_SIGNED, x, shader_number(b, 31));
    return emit2(b, SHADER_ISUB, emit2(b, SHADER_XOR, x, sign), sign);
}

static uint32_t mix(struct shader_builder *b, uint32_t x, uint32_t y, uint32_t a)
{
    const uint32_t rest = emit2(b, SHADER_FSUB, number(b, 1.0f), a);
    return emit2(b, SHADER_FADD, emit2(b, SHADER_FMUL, x, rest), emit2(b, SHADER_FMUL, y, a));
}

static uint32_t smooth_step(struct shader_builder *b, uint32_t from, uint32_t to, uint32_t x)
{
    const uint32_t part =
        emit2(b, SHADER_FDIV, emit2(b, SHADER_FSUB, x, from), emit2(b, SHADER_FSUB, to, from));
    const uint32_t t = emit2(b, SHADER_FMIN, emit2(b, SHADER_FMAX, part, number(b, 0.0f)), number(b, 1.0f));
    const uint32_t rest = emit2(b, SHADER_FSUB, number(b, 3.0f), emit2(b, SHADER_FMUL, number(b, 2.0f), t));
    return emit2(b, SHADER_FMUL, emit2(b, SHADER_FMUL, t, t), rest);
}

// Instructions that are one operation of the form.
struct plain_instruction {
    uint8_t instruction, op, operands;
};

static const struct plain_instruction plain_instructions[] = {
    {GLSL_ROUND, SHADER_ROUND_EVEN, 1},
    {GLSL_ROUND_EVEN, SHADER_ROUND_EVEN, 1},
    {GLSL_TRUNC, SHADER_TRUNC, 1},
    {GLSL_FLOOR, SHADER_FLOOR, 1},
    {GLSL_CEIL, SHADER_CEIL, 1},
    {GLSL_SIN, SHADER_SIN, 1},
    {GLSL_COS, SHADER_COS, 1},
    {GLSL_TAN, SHADER_TAN, 1},
    {GLSL_ASIN, SHADER_ASIN, 1},
    {GLSL_ACOS, SHADER_ACOS, 1},
    {GLSL_ATAN, SHADER_ATAN, 1},
    {GLSL_SINH, SHADER_SINH, 1},
    {GLSL_COSH, SHADER_COSH, 1},
    {GLSL_TANH, SHADER_TANH, 1},
    {GLSL_ASINH, SHADER_ASINH, 1},
    {GLSL_ACOSH, SHADER_ACOSH, 1},
    {GLSL_ATANH, SHADER_ATANH, 1},
    {GLSL_ATAN2, SHADER_ATAN2, 2},
    {GLSL_POW, SHADER_POW, 2},
    {GLSL_EXP, SHADER_EXP, 1},
    {GLSL_LOG, SHADER_LOG, 1},
    {GLSL_EXP2, SHADER_EXP2, 1},
    {GLSL_LOG2, SHADER_LOG2, 1},
    {GLSL_SQRT, SHADER_FSQRT, 1},
    {GLSL_INVERSE_SQRT, SHADER_RSQRT, 1},
    {GLSL_FMIN, SHADER_FMIN, 2},
    {GLSL_FMAX, SHADER_FMAX, 2},
    {GLSL_LDEXP, SHADER_LDEXP, 2},
    {GLSL_FIND_I_LSB, SHADER_FIND_LOWEST, 1},
    {GLSL_FIND_U_MSB, SHADER_FIND_HIGHEST, 1},
};

static bool build_plain_instruction(struct shader_builder *b, uint32_t instruction, const uint32_t v[3],
                                    uint32_t *result)
{
    for (size_t i = 0; i < sizeof plain_instructions / sizeof *plain_instructions; i++) {
        const struct plain_instruction *const plain = &plain_instructions[i];
        if (plain->instruction == instruction) {
            *result = emit2(b, (enum shader_op)plain->op, v[0], plain->operands > 1 ? v[1] : 0);
            return true;
        }
    }
    return false;
}

// Hold a whole number within least..most.
static uint32_t whole_clamp(struct shader_builder *b, uint32_t x, uint32_t least, uint32_t most,
                            bool is_signed)
{
    const uint32_t above = select(b, smaller(b, x, least, is_signed), least, x);
    return select(b, smaller(b, most, above, is_signed), most, above);
}

static uint32_t highest_of_signed(struct shader_builder *b, uint32_t x)
{
    const uint32_t sign = emit2(b, SHADER_SHIFT_RIGHT_SIGNED, x, shader_number(b, 31));
    return emit1(b, SHADER_FIND_HIGHEST, emit2(b, SHADER_XOR, x, sign));
}

static uint32_t step(struct shader_builder *b, uint32_t edge, uint32_t x)
{
    return select(b, emit2(b, SHADER_FLESS, x, edge), number(b, 0.0f), number(b, 1.0f));
}

// Translate an instruction that works component by component, on up to three operands. Return false where the
// instruction is none.
static bool build_component(struct shader_builder *b, uint32_t instruction, const uint32_t v[3],
                            uint32_t *result)
{
    const uint32_t x = v[0], y = v[1], z = v[2];
    switch (instruction) {
    case GLSL_FABS: *result = emit2(b, SHADER_AND, x, shader_number(b, ~SIGN_BIT)); return true;
    case GLSL_SABS: *result = whole_magnitude(b, x); return true;
    case GLSL_FSIGN: *result = sign_of(b, x); return true;
    case GLSL_SSIGN: *result = whole_sign_of(b, x); return true;
    case GLSL_FRACT: *result = emit2(b, SHADER_FSUB, x, emit1(b, SHADER_FLOOR, x)); return true;
    case GLSL_RADIANS: *result = emit2(b, SHADER_FMUL, x, number(b, 0.017453292519943295f)); return true;
    case GLSL_DEGREES: *result = emit2(b, SHADER_FMUL, x, number(b, 57.29577951308232f)); return true;
    case GLSL_NMIN: *result = number_min(b, x, y, false); return true;
    case GLSL_NMAX: *result = number_min(b, x, y, true); return true;
    case GLSL_UMIN: *result = select(b, smaller(b, y, x, false), y, x); return true;
    case GLSL_SMIN: *result = select(b, smaller(b, y, x, true), y, x); return true;
    case GLSL_UMAX: *result = select(b, smaller(b, x, y, false), y, x); return true;
    case GLSL_SMAX: *result = select(b, smaller(b, x, y, true), y, x); return true;
    case GLSL_FCLAMP: *result = emit2(b, SHADER_FMIN, emit2(b, SHADER_FMAX, x, y), z); return true;
    case GLSL_NCLAMP: *result = number_min(b, number_min(b, x, y, true), z, false); return true;
    case GLSL_UCLAMP: *result = whole_clamp(b, x, y, z, false); return true;
    case GLSL_SCLAMP: *result = whole_clamp(b, x, y, z, true); return true;
    case GLSL_FMIX: *result = mix(b, x, y, z); return true;
    case GLSL_STEP: *result = step(b, x, y); return true;
    case GLSL_SMOOTH_STEP: *result = smooth_step(b, x, y, z); return true;
    case GLSL_FMA: *result = emit2(b, SHADER_FADD, emit2(b, SHADER_FMUL, x, y), z); return true;
    case GLSL_FIND_S_MSB: *result = highest_of_signed(b, x); return true;
    default: return build_plain_instruction(b, instruction, v, result);
    }
}

void shader_build_glsl(struct shader_builder *builder)
{
    const uint32_t instruction = shader_operand(builder, 4), operands = shader_word_count(builder) - 5;
    if (instruction < sizeof signatures / sizeof *signatures && signatures[instruction]) {
        shader_check_signature(builder, signatures[instruction], 5);
    }
    if (shader_build_geometry(builder, instruction) || shader_build_packing(builder, instruction) ||
        shader_build_interpolation(builder, instruction)) {
        return;
    }
    const struct shader_type *const type = shader_result_type(builder);
    uint32_t *const result = shader_new_scalars(builder, type);
    for (uint32_t i = 0; i < type->scalars; i++) {
        uint32_t v[3] = {0, 0, 0};
        for (uint32_t o = 0; o < operands && o < 3; o++) {
            v[o] = operand(builder, o, i);
        }
        if (!build_component(builder, instruction, v, &result[i])) {
            shader_build_refuse(builder, "instruction %u of GLSL.std.450 is not supported",
                                (unsigned)instruction);
        }
    }
    shader_define(builder, result);
}
