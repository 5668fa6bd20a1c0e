// SPDX-License-Identifier: MIT
// Products and transposes of vectors and matrices. Sums of products are added from the first to the last.
#include "build.h"

static uint32_t add_product(struct shader_builder *builder, uint32_t sum, uint32_t a, uint32_t b)
{
    const uint32_t product = shader_emit(builder, SHADER_FMUL, a, b, 0);
    return sum == SHADER_NO_VALUE ? product : shader_emit(builder, SHADER_FADD, sum, product, 0);
}

static uint32_t columns_of(const struct shader_type *type)
{
    return type->kind == SHADER_MATRIX ? type->count : 1;
}

static uint32_t rows_of(const struct shader_type *type)
{
    return type->kind == SHADER_MATRIX ? type->element->count : type->kind == SHADER_VECTOR ? type->count : 1;
}

static void check_shape(const struct shader_builder *builder, bool fits)
{
    if (!fits) {
        shader_build_refuse(builder, "its operands have other numbers of rows and columns");
    }
}

static void check_matrix(const struct shader_builder *builder, const struct shader_type *type)
{
    if (type->kind != SHADER_MATRIX) {
        shader_build_refuse(builder, "id %u is no matrix", (unsigned)type->id);
    }
}

static bool is_float_vector(const struct shader_type *type)
{
    return type->kind == SHADER_VECTOR && type->element->kind == SHADER_FLOAT;
}

// Matrix a times matrix b; a vector on the right is one column.
static void multiply(struct shader_builder *builder, uint32_t a_id, uint32_t b_id)
{
    const struct shader_type *const a_type = shader_type_of_value(builder, a_id);
    const struct shader_type *const b_type = shader_type_of_value(builder, b_id);
    const struct shader_type *const type = shader_result_type(builder);
    const uint32_t *const a = shader_scalars(builder, a_id), *const b = shader_scalars(builder, b_id);
    const uint32_t rows = rows_of(a_type), inner = columns_of(a_type), columns = columns_of(b_type);
    check_matrix(builder, a_type);
    check_shape(builder, is_float_vector(b_type)
                             ? is_float_vector(type)
                             : b_type->kind == SHADER_MATRIX && type->kind == SHADER_MATRIX);
    check_shape(builder, rows_of(b_type) == inner && rows_of(type) == rows && columns_of(type) == columns);
    uint32_t *const result = shader_new_scalars(builder, type);
    for (uint32_t c = 0; c < columns; c++) {
        for (uint32_t r = 0; r < rows; r++) {
            uint32_t sum = SHADER_NO_VALUE;
            for (uint32_t k = 0; k < inner; k++) {
                sum = add_product(builder, sum, a[k * rows + r], b[c * inner + k]);
            }
            result[c * rows + r] = sum;
        }
    }
    shader_define(builder, result);
}

// A row vector times a matrix.
static void multiply_row(struct shader_builder *builder, uint32_t v_id, uint32_t m_id)
{
    const struct shader_type *const m_type = shader_type_of_value(builder, m_id);
    const struct shader_type *const type = shader_result_type(builder);
    const uint32_t *const v = shader_scalars(builder, v_id), *const m = shader_scalars(builder, m_id);
    const uint32_t rows = rows_of(m_type);
    check_matrix(builder, m_type);
    check_shape(builder, is_float_vector(type) && is_float_vector(shader_type_of_value(builder, v_id)));
    check_shape(builder,
                rows_of(shader_type_of_value(builder, v_id)) == rows && rows_of(type) == columns_of(m_type));
    uint32_t *const result = shader_new_scalars(builder, type);
    for (uint32_t c = 0; c < columns_of(m_type); c++) {
        uint32_t sum = SHADER_NO_VALUE;
        for (uint32_t r = 0; r < rows; r++) {
            sum = add_product(builder, sum, v[r], m[c * rows + r]);
        }
        result[c] = sum;
    }
    shader_define(builder, result);
}

static void build_scaled(struct shader_builder *builder, bool is_matrix)
{
    const struct shader_type *const type = shader_result_type(builder);
    if (is_matrix) {
        check_matrix(builder, type);
        shader_check_signature(builder, "ttF", 3);
    }
    const uint32_t scale = shader_component(builder, 4, 0);
    uint32_t *const result = shader_new_scalars(builder, type);
    for (uint32_t i = 0; i < type->scalars; i++) {
        result[i] = shader_emit(builder, SHADER_FMUL, shader_component(builder, 3, i), scale, 0);
    }
    shader_define(builder, result);
}

static void build_outer_product(struct shader_builder *builder)
{
    const struct shader_type *const type = shader_result_type(builder);
    const uint32_t rows = rows_of(type);
    const struct shader_type *const column = shader_type_of_value(builder, shader_operand(builder, 3));
    const struct shader_type *const row = shader_type_of_value(builder, shader_operand(builder, 4));
    check_matrix(builder, type);
    check_shape(builder, is_float_vector(column) && is_float_vector(row) && column->count == rows &&
                             row->count == columns_of(type));
    uint32_t *const result = shader_new_scalars(builder, type);
    for (uint32_t i = 0; i < type->scalars; i++) {
        result[i] = shader_emit(builder, SHADER_FMUL, shader_component(builder, 3, i % rows),
                                shader_component(builder, 4, i / rows), 0);
    }
    shader_define(builder, result);
}

static void build_transpose(struct shader_builder *builder)
{
    const struct shader_type *const type = shader_result_type(builder);
    const uint32_t rows = rows_of(type), columns = columns_of(type);
    const struct shader_type *const from = shader_type_of_value(builder, shader_operand(builder, 3));
    check_matrix(builder, type);
    check_matrix(builder, from);
    check_shape(builder, rows_of(from) == columns && columns_of(from) == rows);
    uint32_t *const result = shader_new_scalars(builder, type);
    for (uint32_t i = 0; i < type->scalars; i++) {
        result[i] = shader_component(builder, 3, i % rows * columns + i / rows);
    }
    shader_define(builder, result);
}

static void build_dot(struct shader_builder *builder)
{
    const uint32_t count = shader_type_of_value(builder, shader_operand(builder, 3))->scalars;
    uint32_t sum = SHADER_NO_VALUE;
    for (uint32_t i = 0; i < count; i++) {
        sum = add_product(builder, sum, shader_component(builder, 3, i), shader_component(builder, 4, i));
    }
    shader_define_scalar(builder, sum);
}

bool shader_build_matrix(struct shader_builder *builder, uint32_t opcode)
{
    switch (opcode) {
    case SPIRV_OP_VectorTimesScalar:
    case SPIRV_OP_MatrixTimesScalar: build_scaled(builder, opcode == SPIRV_OP_MatrixTimesScalar); return true;
    case SPIRV_OP_MatrixTimesVector:
    case SPIRV_OP_MatrixTimesMatrix:
        multiply(builder, shader_operand(builder, 3), shader_operand(builder, 4));
        return true;
    case SPIRV_OP_VectorTimesMatrix:
        multiply_row(builder, shader_operand(builder, 3), shader_operand(builder, 4));
        return true;
    case SPIRV_OP_OuterProduct: build_outer_product(builder); return true;
    case SPIRV_OP_Transpose: build_transpose(builder); return true;
    case SPIRV_OP_Dot: build_dot(builder); return true;
    default: return false;
    }
}
