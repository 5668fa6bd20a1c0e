// SPDX-License-Identifier: MIT
// Access chains. Pointers are logical: each is a place that is known when the shader is translated, with indices that
// may be known when it runs.
#include "build.h"

uint64_t shader_packed_scalars(const struct shader_type *type)
{
    const uint64_t most = UINT32_MAX / 4;
    const uint64_t all =
        type->kind == SHADER_ARRAY ? shader_packed_scalars(type->element) * type->count : type->scalars;
    return all < most ? all : most;
}

bool shader_is_packed(const struct shader_place *place)
{
    return place->kind == SHADER_PLACE_WORKGROUP || place->kind == SHADER_PLACE_PRIVATE ||
           place->kind == SHADER_PLACE_TABLE;
}

bool shader_is_in_memory(const struct shader_place *place)
{
    return place->kind == SHADER_PLACE_BUFFER || shader_is_packed(place);
}

const struct shader_type *shader_scalar_type(const struct shader_type *type)
{
    while (type->kind == SHADER_MATRIX || type->kind == SHADER_VECTOR) {
        type = type->element;
    }
    return type->kind == SHADER_INT || type->kind == SHADER_FLOAT || type->kind == SHADER_BOOL ? type : NULL;
}

// Memory ---------------------------------------------------------------------------------------------

static uint32_t add_offset(struct shader_builder *builder, uint32_t offset, uint32_t more)
{
    return offset == SHADER_NO_VALUE ? more : shader_emit(builder, SHADER_IADD, offset, more, 0);
}

// Step `index` times `bytes` on in memory. An index that is constant and of no element is left to when the shader runs.
static void step_bytes(struct shader_builder *builder, struct shader_place *place, uint32_t index,
                       uint32_t bytes)
{
    uint32_t number;
    if (place->type->element && place->type->element->is_empty) {
        return;
    }
    if (bytes == 0) {
        shader_build_refuse(builder, "the array or matrix has no stride");
    }
    if (shader_is_number(builder, index, &number) &&
        (place->type->kind == SHADER_RUNTIME_ARRAY || number < place->type->count) &&
        place->bytes + (uint64_t)number * bytes <= INT32_MAX) {
        place->bytes += number * bytes;
        return;
    }
    const uint32_t more = shader_emit(builder, SHADER_IMUL, index, shader_number(builder, bytes), 0);
    place->offset = add_offset(builder, place->offset, more);
    place->strides |= bytes;
}

// The bytes from one element to the next in memory that has a layout.
static uint32_t stride_of(struct shader_place *place)
{
    const struct shader_type *const type = place->type;
    const struct shader_type *const scalar = shader_scalar_type(type->element);
    const struct shader_member *const matrix = place->matrix;
    const uint32_t bytes = scalar && scalar->kind != SHADER_BOOL ? (uint32_t)scalar->bits / 8 : 4;
    switch (type->kind) {
    case SHADER_ARRAY:
    case SHADER_RUNTIME_ARRAY: return type->stride;
    case SHADER_MATRIX:
        place->row_stride = matrix && matrix->is_row_major ? matrix->matrix_stride : bytes;
        return !matrix ? 0 : matrix->is_row_major ? bytes : matrix->matrix_stride;
    default: return place->row_stride ? place->row_stride : bytes;
    }
}

static void step_in_memory(struct shader_builder *builder, struct shader_place *place, uint32_t index)
{
    const uint32_t stride = shader_is_packed(place)
                                ? 4 * (uint32_t)shader_packed_scalars(place->type->element)
                                : stride_of(place);
    step_bytes(builder, place, index, stride);
}

// Scalars --------------------------------------------------------------------------------------------

static void step_in_scalars(struct shader_builder *builder, struct shader_place *place, uint32_t index)
{
    const struct shader_type *const type = place->type;
    uint32_t number;
    if (shader_is_number(builder, index, &number) && number < type->count) {
        place->first += number * type->element->scalars;
        return;
    }
    if (type->count == 1) {
        return;
    }
    if (place->dynamic_count == SHADER_MAX_DYNAMIC) {
        shader_build_refuse(builder, "more than %d indices are not constant", SHADER_MAX_DYNAMIC);
    }
    place->dynamic[place->dynamic_count++] =
        (struct shader_dynamic_index){index, type->count, type->element->scalars};
}

static void step_in_struct(struct shader_builder *builder, struct shader_place *place, uint32_t index)
{
    uint32_t number;
    if (!shader_is_number(builder, index, &number) || number >= place->type->count) {
        shader_build_refuse(builder, "a member of a structure is named by a constant below %u",
                            (unsigned)place->type->count);
    }
    const struct shader_member *const member = &place->type->members[number];
    place->first += member->first;
    place->bytes += shader_is_packed(place) ? 4 * member->first : member->offset;
    place->matrix = member;
    place->type = member->type;
}

void shader_step(struct shader_builder *builder, struct shader_place *place, uint32_t index)
{
    const struct shader_type *const type = place->type;
    if (type->kind == SHADER_STRUCT) {
        step_in_struct(builder, place, index);
        return;
    }
    if (type->kind != SHADER_VECTOR && type->kind != SHADER_MATRIX && type->kind != SHADER_ARRAY &&
        (type->kind != SHADER_RUNTIME_ARRAY || place->kind != SHADER_PLACE_BUFFER)) {
        shader_build_refuse(builder, "an index picks from what has no elements");
    }
    if (shader_is_in_memory(place)) {
        step_in_memory(builder, place, index);
    } else {
        step_in_scalars(builder, place, index);
    }
    place->type = type->element;
}

// Chains ---------------------------------------------------------------------------------------------

// An index that the module itself names has to be that of an element. One that is only found to be constant may be
// computed where it is not used.
static void check_named(const struct shader_builder *builder, const struct shader_place *place, uint32_t id)
{
    const struct shader_type *const type = place->type;
    const uint16_t opcode = builder->module->ids[id].opcode;
    if (opcode < SPIRV_OP_ConstantTrue || opcode > SPIRV_OP_SpecConstantOp) {
        return;
    }
    const uint32_t number = builder->module->ids[id].data.as_constant->scalars[0];
    const bool has_count =
        type->kind == SHADER_ARRAY || type->kind == SHADER_VECTOR || type->kind == SHADER_MATRIX;
    if (has_count && number >= type->count) {
        shader_build_refuse(builder, "there is no element %u of %u", (unsigned)number, (unsigned)type->count);
    }
    if (type->kind == SHADER_RUNTIME_ARRAY && (uint64_t)number * type->stride > INT32_MAX) {
        shader_build_refuse(builder, "element %u lies beyond %d bytes", (unsigned)number, INT32_MAX);
    }
}

static void step_by_id(struct shader_builder *builder, struct shader_place *place, uint32_t id)
{
    const uint32_t index = shader_scalars(builder, id)[0];
    if (shader_type_of_value(builder, id)->kind != SHADER_INT) {
        shader_build_refuse(builder, "index %u is no integer", (unsigned)id);
    }
    if (place->is_array_of_resources) {
        place->buffer = shader_emit_with(builder, SHADER_BUFFER, place->resource, index, 0, 0);
        place->is_array_of_resources = false;
        place->type = place->type->element;
        return;
    }
    check_named(builder, place, id);
    shader_step(builder, place, index);
}

void shader_build_access_chain(struct shader_builder *builder)
{
    struct shader_place place = *shader_place_of(builder, shader_operand(builder, 3));
    for (uint32_t i = 4; i < shader_word_count(builder); i++) {
        step_by_id(builder, &place, shader_operand(builder, i));
    }
    const struct shader_type *const type = shader_result_type(builder);
    if (type->kind != SHADER_POINTER || type->element != place.type) {
        shader_build_refuse(builder, "the pointer is not of the type of what it points to");
    }
    shader_define_place(builder, &place);
}
