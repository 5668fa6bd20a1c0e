// SPDX-License-Identifier: MIT
// The instructions of GLSL.std.450 on whole vectors and matrices.
#include "build_glsl.h"

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

// ----------------------------------------------------------------------------------------------------

bool shader_build_geometry(struct shader_builder *b, uint32_t instruction)
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
    case GLSL_DETERMINANT:
    case GLSL_MATRIX_INVERSE: build_matrix(b, instruction == GLSL_MATRIX_INVERSE); return true;
    default: return false;
    }
}
