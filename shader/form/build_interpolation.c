// SPDX-License-Identifier: MIT
// Inputs of fragments at other places than they are declared for.
#include "build.h"

enum { HALF = 0x3f000000 }; // bits of 0.5

enum { GLSL_INTERPOLATE_AT_CENTROID = 76, GLSL_INTERPOLATE_AT_SAMPLE, GLSL_INTERPOLATE_AT_OFFSET };

// The input, whose place its declaration gives, at another place.
static uint32_t interpolate(struct shader_builder *builder, uint32_t instruction, uint32_t input,
                            const uint32_t offset[2])
{
    const struct shader_node *const node = &builder->program->nodes[input];
    const uint32_t number = node->immediate;
    if (node->op != SHADER_INPUT || number >= SHADER_IN_CENTROID) {
        shader_build_refuse(builder, "what is interpolated is an input with a location");
    }
    const uint8_t declared = builder->program->interpolation[number];
    const bool is_at_center = (declared & (SHADER_AT_CENTROID | SHADER_AT_SAMPLE)) == 0;
    if (declared & SHADER_FLAT) {
        return input;
    }
    if (instruction == GLSL_INTERPOLATE_AT_CENTROID) {
        return (declared & SHADER_AT_CENTROID)
                   ? input
                   : shader_emit_with(builder, SHADER_INPUT, SHADER_IN_CENTROID + number, 0, 0, 0);
    }
    return shader_emit_with(builder, SHADER_INPUT_AT, is_at_center ? number : SHADER_IN_CENTER + number,
                            offset[0], offset[1], 0);
}

// Pixels from the centre, to the right and down.
static void take_offset(struct shader_builder *builder, uint32_t instruction, uint32_t offset[2])
{
    if (instruction == GLSL_INTERPOLATE_AT_CENTROID) {
        return;
    }
    const uint32_t id = shader_operand(builder, 6);
    const uint32_t needed = instruction == GLSL_INTERPOLATE_AT_OFFSET ? 2 : 1;
    const uint32_t *const scalars = shader_scalars(builder, id);
    if (shader_type_of_value(builder, id)->scalars != needed) {
        shader_build_refuse(builder, "id %u has another number of components than %u", (unsigned)id,
                            (unsigned)needed);
    }
    for (uint32_t i = 0; i < 2; i++) {
        offset[i] = instruction == GLSL_INTERPOLATE_AT_OFFSET
                        ? scalars[i]
                        : shader_emit(builder, i == 0 ? SHADER_SAMPLE_X : SHADER_SAMPLE_Y, scalars[0], 0, 0);
    }
    // Where a fragment is one sample, inputs are taken there and not at the centre.
    for (uint32_t i = 0; i < 2 && builder->program->shades_samples; i++) {
        const uint32_t half = shader_number(builder, HALF);
        const uint32_t at =
            shader_emit_with(builder, SHADER_BUILT_IN, SHADER_IN_SAMPLE_POSITION + i, 0, 0, 0);
        const uint32_t own = shader_emit(builder, SHADER_FSUB, at, half, 0);
        offset[i] = shader_emit(builder, SHADER_FSUB, offset[i], own, 0);
    }
}

// Every input that an index may pick is interpolated, and then one is picked.
static void build_interpolation(struct shader_builder *builder, uint32_t instruction)
{
    struct shader_place place = *shader_place_of(builder, shader_operand(builder, 5));
    const struct shader_type *const type = shader_result_type(builder);
    uint32_t offset[2] = {0, 0};
    if (builder->entry->model != SPIRV_FRAGMENT || place.kind != SHADER_PLACE_INPUT || place.type != type) {
        shader_build_refuse(builder, "what is interpolated is an input of fragments");
    }
    take_offset(builder, instruction, offset);
    uint32_t *const all = shader_take(builder->memory, place.scalar_count, sizeof *all);
    uint32_t *const result = shader_new_scalars(builder, type);
    const bool is_dynamic = place.dynamic_count > 0;
    const uint32_t first = is_dynamic ? 0 : place.first;
    const uint32_t end = is_dynamic ? place.scalar_count : place.first + type->scalars;
    for (uint32_t i = first; i < end; i++) {
        all[i] = interpolate(builder, instruction, place.scalars[i], offset);
    }
    place.scalars = all;
    shader_read_place(builder, &place, result);
    shader_define(builder, result);
}

bool shader_build_interpolation(struct shader_builder *builder, uint32_t instruction)
{
    switch (instruction) {
    case GLSL_INTERPOLATE_AT_CENTROID:
    case GLSL_INTERPOLATE_AT_SAMPLE:
    case GLSL_INTERPOLATE_AT_OFFSET: build_interpolation(builder, instruction); return true;
    default: return false;
    }
}
