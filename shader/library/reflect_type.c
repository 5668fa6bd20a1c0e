// SPDX-License-Identifier: MIT
// What stands where in the memory of a block. A module may nest a struct in others so often that a walk over all of its
// places would not end, so a struct is told once, and others point to it.
#include "shader.h"

static uint32_t saturate(uint64_t size)
{
    return size > UINT32_MAX ? UINT32_MAX : (uint32_t)size;
}

static void tell_matrix(struct rhw_shader_type *told, const struct shader_type *type,
                        const struct shader_member *member)
{
    told->rows = type->element->count;
    told->columns = type->count;
    told->is_row_major = member->is_row_major;
    const uint32_t vectors = told->is_row_major ? told->rows : told->columns;
    const uint32_t components = told->is_row_major ? told->columns : told->rows;
    const uint32_t bytes = components * (told->bits / 8);
    told->stride = member->matrix_stride != 0 ? member->matrix_stride : bytes;
    told->size = saturate((uint64_t)(vectors - 1) * told->stride + bytes);
}

// Return the number that a scalar, vector or matrix is made of.
static const struct shader_type *number_of(const struct shader_type *type)
{
    while (type->kind == SHADER_VECTOR || type->kind == SHADER_MATRIX) {
        type = type->element;
    }
    return type;
}

// Return a type that `member` has, or an element of it.
static const struct rhw_shader_type *tell(rhw_shader *shader, const struct shader_type *type,
                                          const struct shader_member *member)
{
    if (type->kind == SHADER_STRUCT) {
        return shader_reflect_type(shader, type);
    }
    struct rhw_shader_type *const told = shader_take(&shader->memory, 1, sizeof *told);
    told->name = "";
    if (type->kind == SHADER_ARRAY || type->kind == SHADER_RUNTIME_ARRAY) {
        told->kind = RHW_SHADER_ARRAY;
        told->count = type->kind == SHADER_ARRAY ? type->count : 0;
        told->stride = type->stride;
        told->element = tell(shader, type->element, member);
        told->size =
            told->count ? saturate((uint64_t)(told->count - 1) * told->stride + told->element->size) : 0;
        return told;
    }
    const struct shader_type *const number = number_of(type);
    if (number->kind != SHADER_FLOAT && number->kind != SHADER_INT) {
        told->kind = RHW_SHADER_STRUCT; // without members: nothing in memory is of this type
        return told;
    }
    told->kind = number->kind == SHADER_FLOAT ? RHW_SHADER_FLOAT
                 : number->is_signed          ? RHW_SHADER_INT
                                              : RHW_SHADER_UINT;
    told->bits = (uint32_t)number->bits;
    told->rows = type->kind == SHADER_VECTOR ? type->count : 1;
    told->columns = 1;
    told->size = told->rows * (told->bits / 8);
    if (type->kind == SHADER_MATRIX) {
        tell_matrix(told, type, member);
    }
    return told;
}

const struct rhw_shader_type *shader_reflect_type(rhw_shader *shader, const struct shader_type *type)
{
    const struct shader_module *const module = shader->form->module;
    if (!shader->types) {
        shader->types = shader_take(&shader->memory, module->bound, sizeof(struct rhw_shader_type *));
    }
    if (shader->types[type->id]) {
        return shader->types[type->id];
    }
    struct rhw_shader_type *const told = shader_take(&shader->memory, 1, sizeof *told);
    struct rhw_shader_member *const members = shader_take(&shader->memory, type->count, sizeof *members);
    shader->types[type->id] = told;
    const char *const name = module->names[type->id];
    *told = (struct rhw_shader_type){
        .kind = RHW_SHADER_STRUCT, .count = type->count, .members = members, .name = name ? name : ""};
    for (uint32_t i = 0; i < type->count; i++) {
        const struct shader_member *const member = &type->members[i];
        members[i] = (struct rhw_shader_member){
            .name = "", .offset = member->offset, .type = tell(shader, member->type, member)};
        const uint32_t end = saturate((uint64_t)member->offset + members[i].type->size);
        told->size = end > told->size ? end : told->size;
    }
    return told;
}

void shader_name_members(const rhw_shader *shader)
{
    const struct shader_module *const module = shader->form->module;
    for (uint32_t word = SPIRV_HEADER_WORDS; shader->types && word < module->word_count;
         word += module->words[word] >> 16) {
        const uint32_t *const words = module->words + word;
        const bool names = (words[0] & 0xffff) == SPIRV_OP_MemberName;
        const struct rhw_shader_type *const type = names ? shader->types[words[1]] : NULL;
        if (type && words[2] < type->count) {
            ((struct rhw_shader_member *)type->members)[words[2]].name = (const char *)(words + 3);
        }
    }
}
