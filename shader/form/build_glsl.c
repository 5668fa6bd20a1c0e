// SPDX-License-Identifier: MIT
// The instructions of GLSL.std.450 (SPIR-V Extended Instructions for GLSL).
#include "build.h"

#define SIGN_BIT 0x80000000u

enum glsl_instruction {
    GLSL_ROUND = 1,
    GLSL_ROUND_EVEN,
    GLSL_TRUNC,
    GLSL_FABS,
    GLSL_SABS,
    GLSL_FSIGN,
    GLSL_SSIGN,
    GLSL_FLOOR,
    GLSL_CEIL,
    GLSL_FRACT,
    GLSL_RADIANS,
    GLSL_DEGREES,
    GLSL_SIN,
    GLSL_COS,
    GLSL_TAN,
    GLSL_ASIN,
    GLSL_ACOS,
    GLSL_ATAN,
    GLSL_SINH,
    GLSL_COSH,
    GLSL_TANH,
    GLSL_ASINH,
    GLSL_ACOSH,
    GLSL_ATANH,
    GLSL_ATAN2,
    GLSL_POW,
    GLSL_EXP,
    GLSL_LOG,
    GLSL_EXP2,
    GLSL_LOG2,
    GLSL_SQRT,
    GLSL_INVERSE_SQRT,
    GLSL_DETERMINANT,
    GLSL_MATRIX_INVERSE,
    GLSL_MODF,
    GLSL_MODF_STRUCT,
    GLSL_FMIN,
    GLSL_UMIN,
    GLSL_SMIN,
    GLSL_FMAX,
    GLSL_UMAX,
    GLSL_SMAX,
    GLSL_FCLAMP,
    GLSL_UCLAMP,
    GLSL_SCLAMP,
    GLSL_FMIX,
    GLSL_STEP = 48,
    GLSL_SMOOTH_STEP,
    GLSL_FMA,
    GLSL_FREXP,
    GLSL_FREXP_STRUCT,
    GLSL_LDEXP,
    GLSL_PACK_SNORM4X8,
    GLSL_PACK_UNORM4X8,
    GLSL_PACK_SNORM2X16,
    GLSL_PACK_UNORM2X16,
    GLSL_PACK_HALF2X16,
    GLSL_UNPACK_SNORM2X16 = 60,
    GLSL_UNPACK_UNORM2X16,
    GLSL_UNPACK_HALF2X16,
    GLSL_UNPACK_SNORM4X8,
    GLSL_UNPACK_UNORM4X8,
    GLSL_LENGTH = 66,
    GLSL_DISTANCE,
    GLSL_CROSS,
    GLSL_NORMALIZE,
    GLSL_FACE_FORWARD,
    GLSL_REFLECT,
    GLSL_REFRACT,
    GLSL_FIND_I_LSB,
    GLSL_FIND_S_MSB,
    GLSL_FIND_U_MSB,
    GLSL_NMIN = 79,
    GLSL_NMAX,
    GLSL_NCLAMP
};

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

// Operands of the instruction: component i of operand o, counted behind the number of the instruction.
static uint32_t operand(struct shader_builder *builder, uint32_t o, uint32_t i)
{
    const uint32_t id = shader_operand(builder, 5 + o);
    const uint32_t count = shader_type_of_value(builder, id)->scalars;
    if (count != 1 && i >= count) {
        shader_build_refuse(builder, "id %u has too few components", (unsigned)id);
    }
    return shader_scalars(builder, id)[count == 1 ? 0 : i];
}

static uint32_t count_of(struct shader_builder *builder, uint32_t o)
{
    return shader_type_of_value(builder, shader_operand(builder, 5 + o))->scalars;
}

static uint32_t emit1(struct shader_builder *b, enum shader_op op, uint32_t x)
{
    return shader_emit(b, op, x, 0, 0);
}

static uint32_t emit2(struct shader_builder *b, enum shader_op op, uint32_t x, uint32_t y)
{
    return shader_emit(b, op, x, y, 0);
}

static uint32_t select(struct shader_builder *b, uint32_t condition, uint32_t x, uint32_t y)
{
    return shader_emit(b, SHADER_SELECT, condition, x, y);
}

static uint32_t number(struct shader_builder *b, float value)
{
    return shader_number_float(b, value);
}

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

// Vectors --------------------------------------------------------------------------------------------

static uint32_t dot(struct shader_builder *b, uint32_t o, uint32_t p, uint32_t count)
{
    uint32_t sum = emit2(b, SHADER_FMUL, operand(b, o, 0), operand(b, p, 0));
    for (uint32_t i = 1; i < count; i++) {
        sum = emit2(b, SHADER_FADD, sum, emit2(b, SHADER_FMUL, operand(b, o, i), operand(b, p, i)));
    }
    return sum;
}

static void build_distance(struct shader_builder *b)
{
    uint32_t sum = SHADER_NO_VALUE;
    for (uint32_t i = 0; i < count_of(b, 0); i++) {
        const uint32_t apart = emit2(b, SHADER_FSUB, operand(b, 0, i), operand(b, 1, i));
        const uint32_t square = emit2(b, SHADER_FMUL, apart, apart);
        sum = sum == SHADER_NO_VALUE ? square : emit2(b, SHADER_FADD, sum, square);
    }
    const uint32_t result = emit1(b, SHADER_FSQRT, sum);
    shader_define_scalar(b, result);
}

static void build_cross(struct shader_builder *b)
{
    uint32_t result[3];
    if (shader_result_type(b)->scalars != 3) {
        shader_build_refuse(b, "a cross product is of vectors of 3");
    }
    for (uint32_t i = 0; i < 3; i++) {
        const uint32_t j = (i + 1) % 3, k = (i + 2) % 3;
        const uint32_t first = emit2(b, SHADER_FMUL, operand(b, 0, j), operand(b, 1, k));
        result[i] = emit2(b, SHADER_FSUB, first, emit2(b, SHADER_FMUL, operand(b, 1, j), operand(b, 0, k)));
    }
    shader_define(b, result);
}

static void build_normalize(struct shader_builder *b)
{
    const uint32_t count = shader_result_type(b)->scalars;
    const uint32_t scale = emit1(b, SHADER_RSQRT, dot(b, 0, 0, count));
    uint32_t *const result = shader_new_scalars(b, shader_result_type(b));
    for (uint32_t i = 0; i < count; i++) {
        result[i] = emit2(b, SHADER_FMUL, operand(b, 0, i), scale);
    }
    shader_define(b, result);
}

static void build_face_forward(struct shader_builder *b)
{
    const uint32_t count = shader_result_type(b)->scalars;
    const uint32_t faces = emit2(b, SHADER_FLESS, dot(b, 2, 1, count), number(b, 0.0f));
    uint32_t *const result = shader_new_scalars(b, shader_result_type(b));
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t negated = emit2(b, SHADER_XOR, operand(b, 0, i), shader_number(b, SIGN_BIT));
        result[i] = select(b, faces, operand(b, 0, i), negated);
    }
    shader_define(b, result);
}

// I − 2 · dot(N, I) · N
static void build_reflect(struct shader_builder *b)
{
    const uint32_t count = shader_result_type(b)->scalars;
    const uint32_t twice = emit2(b, SHADER_FMUL, number(b, 2.0f), dot(b, 1, 0, count));
    uint32_t *const result = shader_new_scalars(b, shader_result_type(b));
    for (uint32_t i = 0; i < count; i++) {
        result[i] = emit2(b, SHADER_FSUB, operand(b, 0, i), emit2(b, SHADER_FMUL, twice, operand(b, 1, i)));
    }
    shader_define(b, result);
}

// k = 1 − η² · (1 − dot(N, I)²); 0 where k < 0, else η · I − (η · dot(N, I) + √k) · N
static void build_refract(struct shader_builder *b)
{
    const uint32_t count = shader_result_type(b)->scalars, eta = operand(b, 2, 0), one = number(b, 1.0f);
    const uint32_t d = dot(b, 1, 0, count);
    const uint32_t rest = emit2(b, SHADER_FSUB, one, emit2(b, SHADER_FMUL, d, d));
    const uint32_t k =
        emit2(b, SHADER_FSUB, one, emit2(b, SHADER_FMUL, emit2(b, SHADER_FMUL, eta, eta), rest));
    const uint32_t along = emit2(b, SHADER_FADD, emit2(b, SHADER_FMUL, eta, d), emit1(b, SHADER_FSQRT, k));
    const uint32_t is_inside = emit2(b, SHADER_FLESS, k, number(b, 0.0f));
    uint32_t *const result = shader_new_scalars(b, shader_result_type(b));
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t bent = emit2(b, SHADER_FSUB, emit2(b, SHADER_FMUL, eta, operand(b, 0, i)),
                                    emit2(b, SHADER_FMUL, along, operand(b, 1, i)));
        result[i] = select(b, is_inside, number(b, 0.0f), bent);
    }
    shader_define(b, result);
}

static bool build_vector(struct shader_builder *b, uint32_t instruction)
{
    uint32_t result;
    switch (instruction) {
    case GLSL_LENGTH:
        result = emit1(b, SHADER_FSQRT, dot(b, 0, 0, count_of(b, 0)));
        shader_define_scalar(b, result);
        return true;
    case GLSL_DISTANCE: build_distance(b); return true;
    case GLSL_CROSS: build_cross(b); return true;
    case GLSL_NORMALIZE: build_normalize(b); return true;
    case GLSL_FACE_FORWARD: build_face_forward(b); return true;
    case GLSL_REFLECT: build_reflect(b); return true;
    case GLSL_REFRACT: build_refract(b); return true;
    default: return false;
    }
}

// Matrices -------------------------------------------------------------------------------------------

// The determinant of the rows and columns that are left after taking away `row` and `column`, of a matrix of 2 to 4.
static uint32_t minor_of(struct shader_builder *b, const uint32_t *m, uint32_t size, uint32_t row,
                         uint32_t column)
{
    uint32_t left[9], count = 0;
    for (uint32_t c = 0; c < size; c++) {
        for (uint32_t r = 0; r < size; r++) {
            if (c != column && r != row) {
                left[count++] = m[c * size + r];
            }
        }
    }
    if (size == 2) {
        return left[0];
    }
    if (size == 3) {
        return emit2(b, SHADER_FSUB, emit2(b, SHADER_FMUL, left[0], left[3]),
                     emit2(b, SHADER_FMUL, left[2], left[1]));
    }
    uint32_t sum = SHADER_NO_VALUE;
    for (uint32_t c = 0; c < 3; c++) {
        const uint32_t part = emit2(b, SHADER_FMUL, left[c * 3], minor_of(b, left, 3, 0, c));
        sum = c == 0 ? part : emit2(b, c == 1 ? SHADER_FSUB : SHADER_FADD, sum, part);
    }
    return sum;
}

static uint32_t determinant(struct shader_builder *b, const uint32_t *m, uint32_t size)
{
    uint32_t sum = SHADER_NO_VALUE;
    for (uint32_t c = 0; c < size; c++) {
        const uint32_t part = emit2(b, SHADER_FMUL, m[c * size], minor_of(b, m, size, 0, c));
        sum = c == 0 ? part : emit2(b, c % 2 ? SHADER_FSUB : SHADER_FADD, sum, part);
    }
    return sum;
}

static void build_matrix(struct shader_builder *b, bool inverts)
{
    const uint32_t id = shader_operand(b, 5);
    const struct shader_type *const type = shader_type_of_value(b, id);
    const uint32_t *const m = shader_scalars(b, id);
    if (type->kind != SHADER_MATRIX || type->count != type->element->count) {
        shader_build_refuse(b, "id %u is no square matrix", (unsigned)id);
    }
    if (shader_result_type(b) != (inverts ? type : type->element->element)) {
        shader_build_refuse(b, "the result is %s", inverts ? "a matrix of the same type" : "a scalar of it");
    }
    const uint32_t size = type->count, whole = determinant(b, m, size);
    if (!inverts) {
        shader_define_scalar(b, whole);
        return;
    }
    uint32_t *const result = shader_new_scalars(b, type);
    for (uint32_t c = 0; c < size; c++) {
        for (uint32_t r = 0; r < size; r++) {
            const uint32_t part = emit2(b, SHADER_FDIV, minor_of(b, m, size, c, r), whole);
            result[c * size + r] =
                (c + r) % 2 ? emit2(b, SHADER_XOR, part, shader_number(b, SIGN_BIT)) : part;
        }
    }
    shader_define(b, result);
}

// Packing, and instructions with two results ---------------------------------------------------------

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

void shader_build_glsl(struct shader_builder *builder)
{
    const uint32_t instruction = shader_operand(builder, 4), operands = shader_word_count(builder) - 5;
    if (instruction < sizeof signatures / sizeof *signatures && signatures[instruction]) {
        shader_check_signature(builder, signatures[instruction], 5);
    }
    if (build_vector(builder, instruction) || shader_build_interpolation(builder, instruction)) {
        return;
    }
    switch (instruction) {
    case GLSL_DETERMINANT:
    case GLSL_MATRIX_INVERSE: build_matrix(builder, instruction == GLSL_MATRIX_INVERSE); return;
    case GLSL_PACK_SNORM4X8: build_pack(builder, 8, true); return;
    case GLSL_PACK_UNORM4X8: build_pack(builder, 8, false); return;
    case GLSL_PACK_SNORM2X16: build_pack(builder, 16, true); return;
    case GLSL_PACK_UNORM2X16: build_pack(builder, 16, false); return;
    case GLSL_PACK_HALF2X16: build_pack_halves(builder); return;
    case GLSL_UNPACK_SNORM4X8: build_unpack(builder, 8, true); return;
    case GLSL_UNPACK_UNORM4X8: build_unpack(builder, 8, false); return;
    case GLSL_UNPACK_SNORM2X16: build_unpack(builder, 16, true); return;
    case GLSL_UNPACK_UNORM2X16: build_unpack(builder, 16, false); return;
    case GLSL_UNPACK_HALF2X16: build_unpack_halves(builder); return;
    case GLSL_MODF_STRUCT:
    case GLSL_FREXP_STRUCT: build_parts(builder, instruction == GLSL_FREXP_STRUCT); return;
    case GLSL_MODF:
    case GLSL_FREXP: build_stored_part(builder, instruction == GLSL_FREXP); return;
    default: break;
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
