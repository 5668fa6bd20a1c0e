// SPDX-License-Identifier: MIT
// Composites: their scalars stand behind one another, so that parts are ranges of scalars.
#include "build.h"

#include <string.h>

// Find the part that literals from operand `first` on name. Return its type, and where its scalars begin.
static const struct shader_type *find_part(const struct shader_builder *builder,
                                           const struct shader_type *type, uint32_t first, uint32_t *begin)
{
    *begin = 0;
    for (uint32_t i = first; i < shader_word_count(builder); i++) {
        const uint32_t index = shader_operand(builder, i);
        const bool has_parts = type->kind == SHADER_VECTOR || type->kind == SHADER_MATRIX ||
                               type->kind == SHADER_ARRAY || type->kind == SHADER_STRUCT;
        if (!has_parts || index >= type->count) {
            shader_build_refuse(builder, "there is no part %u", (unsigned)index);
        }
        if (type->kind == SHADER_STRUCT) {
            *begin += type->members[index].first;
            type = type->members[index].type;
        } else {
            *begin += index * type->element->scalars;
            type = type->element;
        }
    }
    return type;
}

static void check_type(const struct shader_builder *builder, const struct shader_type *type,
                       const struct shader_type *expected)
{
    if (type != expected) {
        shader_build_refuse(builder, "a part is of the type of id %u, not %u", (unsigned)type->id,
                            (unsigned)expected->id);
    }
}

// Part i of a composite is one of its elements; of a vector it may be a vector of them.
static void check_part(const struct shader_builder *builder, const struct shader_type *type, uint32_t i,
                       const struct shader_type *part)
{
    if (type->kind == SHADER_STRUCT) {
        if (i >= type->count) {
            shader_build_refuse(builder, "it has too many parts");
        }
        check_type(builder, part, type->members[i].type);
        return;
    }
    if (type->kind != SHADER_VECTOR && type->kind != SHADER_MATRIX && type->kind != SHADER_ARRAY) {
        shader_build_refuse(builder, "id %u is no composite", (unsigned)type->id);
    }
    const bool is_vector = type->kind == SHADER_VECTOR && part->kind == SHADER_VECTOR;
    check_type(builder, is_vector ? part->element : part, type->element);
}

static void build_construct(struct shader_builder *builder)
{
    const struct shader_type *const type = shader_result_type(builder);
    uint32_t *const result = shader_new_scalars(builder, type);
    uint32_t count = 0;
    for (uint32_t i = 3; i < shader_word_count(builder); i++) {
        const uint32_t id = shader_operand(builder, i);
        const struct shader_type *const part = shader_type_of_value(builder, id);
        const uint32_t *const scalars = shader_scalars(builder, id);
        check_part(builder, type, i - 3, part);
        if (part->scalars > type->scalars - count) {
            shader_build_refuse(builder, "it has too many parts");
        }
        memcpy(result + count, scalars, part->scalars * sizeof *result);
        count += part->scalars;
    }
    if (count != type->scalars) {
        shader_build_refuse(builder, "it has too few parts");
    }
    shader_define(builder, result);
}

static void build_extract(struct shader_builder *builder)
{
    const uint32_t id = shader_operand(builder, 3);
    uint32_t begin;
    check_type(builder, find_part(builder, shader_type_of_value(builder, id), 4, &begin),
               shader_result_type(builder));
    shader_define(builder, shader_scalars(builder, id) + begin);
}

static void build_insert(struct shader_builder *builder)
{
    const uint32_t part = shader_operand(builder, 3), whole = shader_operand(builder, 4);
    const struct shader_type *const type = shader_result_type(builder);
    uint32_t begin;
    check_type(builder, shader_type_of_value(builder, whole), type);
    check_type(builder, find_part(builder, type, 5, &begin), shader_type_of_value(builder, part));
    uint32_t *const result = shader_new_scalars(builder, type);
    memcpy(result, shader_scalars(builder, whole), type->scalars * sizeof *result);
    memcpy(result + begin, shader_scalars(builder, part),
           shader_type_of_value(builder, part)->scalars * sizeof *result);
    shader_define(builder, result);
}

static void check_vector(const struct shader_builder *builder, const struct shader_type *type)
{
    if (type->kind != SHADER_VECTOR) {
        shader_build_refuse(builder, "id %u is no vector", (unsigned)type->id);
    }
}

static void build_shuffle(struct shader_builder *builder)
{
    const uint32_t a = shader_operand(builder, 3), b = shader_operand(builder, 4);
    const uint32_t a_count = shader_type_of_value(builder, a)->scalars;
    const uint32_t b_count = shader_type_of_value(builder, b)->scalars;
    const struct shader_type *const type = shader_result_type(builder);
    check_vector(builder, type);
    check_vector(builder, shader_type_of_value(builder, a));
    check_vector(builder, shader_type_of_value(builder, b));
    check_type(builder, shader_type_of_value(builder, a)->element, type->element);
    check_type(builder, shader_type_of_value(builder, b)->element, type->element);
    if (shader_word_count(builder) != 5 + type->count) {
        shader_build_refuse(builder, "a vector of %u is picked by %u components", (unsigned)type->count,
                            (unsigned)shader_word_count(builder) - 5);
    }
    uint32_t *const result = shader_new_scalars(builder, type);
    for (uint32_t i = 0; i < type->scalars; i++) {
        const uint32_t from = shader_operand(builder, 5 + i);
        if (from != UINT32_MAX && from >= a_count + b_count) {
            shader_build_refuse(builder, "there is no component %u", (unsigned)from);
        }
        result[i] = from == UINT32_MAX ? shader_number(builder, 0)
                    : from < a_count   ? shader_scalars(builder, a)[from]
                                       : shader_scalars(builder, b)[from - a_count];
    }
    shader_define(builder, result);
}

// Return the value of an index, which stands at this operand.
static uint32_t index_at(struct shader_builder *builder, uint32_t operand)
{
    const uint32_t id = shader_operand(builder, operand);
    if (shader_type_of_value(builder, id)->kind != SHADER_INT) {
        shader_build_refuse(builder, "index %u is no integer", (unsigned)id);
    }
    return shader_scalars(builder, id)[0];
}

// A truth for each component: it is the one that the index names. An index outside names none.
static uint32_t is_component(struct shader_builder *builder, uint32_t index, uint32_t i)
{
    return shader_emit(builder, SHADER_IEQUAL, index, shader_number(builder, i), 0);
}

static void build_extract_dynamic(struct shader_builder *builder)
{
    const uint32_t id = shader_operand(builder, 3), index = index_at(builder, 4);
    const struct shader_type *const type = shader_type_of_value(builder, id);
    check_vector(builder, type);
    check_type(builder, shader_result_type(builder), type->element);
    const uint32_t *const scalars = shader_scalars(builder, id);
    const uint32_t count = type->scalars;
    uint32_t result = scalars[count - 1];
    for (uint32_t i = count - 1; i-- > 0;) {
        result = shader_emit(builder, SHADER_SELECT, is_component(builder, index, i), scalars[i], result);
    }
    shader_define_scalar(builder, result);
}

static void build_insert_dynamic(struct shader_builder *builder)
{
    const uint32_t id = shader_operand(builder, 3),
                   part = shader_scalars(builder, shader_operand(builder, 4))[0];
    const uint32_t index = index_at(builder, 5);
    const struct shader_type *const type = shader_result_type(builder);
    check_vector(builder, type);
    check_type(builder, shader_type_of_value(builder, id), type);
    check_type(builder, shader_type_of_value(builder, shader_operand(builder, 4)), type->element);
    const uint32_t *const scalars = shader_scalars(builder, id);
    uint32_t *const result = shader_new_scalars(builder, type);
    for (uint32_t i = 0; i < type->scalars; i++) {
        result[i] = shader_emit(builder, SHADER_SELECT, is_component(builder, index, i), part, scalars[i]);
    }
    shader_define(builder, result);
}

// A copy of a value, a pointer or a resource. A logical copy is of another type with the same parts.
static void build_object_copy(struct shader_builder *builder, bool is_logical)
{
    const uint32_t id = shader_operand(builder, 3), result = shader_operand(builder, 2);
    const struct shader_type *const type = shader_result_type(builder);
    if (is_logical) {
        if (shader_type_of_value(builder, id)->scalars != type->scalars) {
            shader_build_refuse(builder, "id %u has other parts", (unsigned)id);
        }
        shader_define(builder, shader_scalars(builder, id));
        return;
    }
    check_type(builder, shader_type_of_value(builder, id), type);
    builder->built[result] = builder->built[id];
}

bool shader_build_composite(struct shader_builder *builder, uint32_t opcode)
{
    switch (opcode) {
    case SPIRV_OP_CompositeConstruct: build_construct(builder); return true;
    case SPIRV_OP_CompositeExtract: build_extract(builder); return true;
    case SPIRV_OP_CompositeInsert: build_insert(builder); return true;
    case SPIRV_OP_CopyObject: build_object_copy(builder, false); return true;
    case SPIRV_OP_CopyLogical: build_object_copy(builder, true); return true;
    case SPIRV_OP_VectorShuffle: build_shuffle(builder); return true;
    case SPIRV_OP_VectorExtractDynamic: build_extract_dynamic(builder); return true;
    case SPIRV_OP_VectorInsertDynamic: build_insert_dynamic(builder); return true;
    default: return false;
    }
}
