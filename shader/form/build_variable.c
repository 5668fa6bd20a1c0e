// SPDX-License-Identifier: MIT
// Variables become places. What a lane keeps for itself are homes where it is known which of them is meant, or where
// there are few; else it is memory of the lane, and a table where it is constant.
#include "build.h"

enum {
    MAX_RESOURCES = 4096,
    MAX_WORKGROUP = 1 << 16, // bytes
    MAX_INDEXED_HOMES =
        16 // beyond that, an index into memory takes less time than comparing it with all there are
};

// Resources ------------------------------------------------------------------------------------------

static uint32_t add_resource(struct shader_builder *builder, const struct shader_variable *variable,
                             const struct shader_type *element, uint32_t count)
{
    struct shader_program *const program = builder->program;
    if (program->resource_count == MAX_RESOURCES) {
        shader_build_refuse(builder, "the module has more than %d buffers, images and samplers",
                            MAX_RESOURCES);
    }
    if (!program->resources) {
        program->resources =
            shader_take(builder->memory, builder->module->variable_count, sizeof *program->resources);
    }
    program->resources[program->resource_count] =
        (struct shader_resource){.variable = variable, .type = element, .count = count};
    return program->resource_count++;
}

// The variable is a resource, or an array of resources.
static void build_resource(struct shader_builder *builder, const struct shader_variable *variable,
                           struct shader_place *place)
{
    const struct shader_type *element = variable->type;
    uint32_t count = 1;
    place->is_array_of_resources = element->kind == SHADER_ARRAY || element->kind == SHADER_RUNTIME_ARRAY;
    if (place->is_array_of_resources) {
        count = element->kind == SHADER_ARRAY ? element->count : 0;
        element = element->element;
    }
    const bool is_buffer = element->kind == SHADER_STRUCT;
    const bool is_image = element->kind == SHADER_IMAGE || element->kind == SHADER_SAMPLER ||
                          element->kind == SHADER_SAMPLED_IMAGE;
    if ((!is_buffer && !is_image) || is_image != (variable->storage == SPIRV_UNIFORM_CONSTANT)) {
        shader_build_refuse(builder, "a resource is a block in a buffer, an image or a sampler");
    }
    place->kind = is_buffer ? SHADER_PLACE_BUFFER : SHADER_PLACE_RESOURCE;
    place->is_read_only = variable->storage == SPIRV_UNIFORM && !element->is_buffer_block;
    place->resource = add_resource(builder, variable, element, count);
    if (!place->is_array_of_resources) {
        place->buffer =
            shader_emit_with(builder, SHADER_BUFFER, place->resource, shader_number(builder, 0), 0, 0);
    }
}

// Memory of the workgroup and of the lane ------------------------------------------------------------

// A variable of the workgroup lies in its memory, scalar behind scalar.
static void build_shared(struct shader_builder *builder, struct shader_place *place)
{
    struct shader_program *const program = builder->program;
    if (place->type->scalars == 0 && !place->type->is_empty && place->type->kind != SHADER_ARRAY) {
        shader_build_refuse(builder, "the variable holds no values");
    }
    const uint64_t bytes = program->workgroup_size + 4 * shader_packed_scalars(place->type);
    if (bytes > MAX_WORKGROUP) {
        shader_build_refuse(builder, "a workgroup has at most %d bytes of memory", MAX_WORKGROUP);
    }
    place->kind = SHADER_PLACE_WORKGROUP;
    place->buffer = shader_emit_with(builder, SHADER_WORKGROUP, 0, 0, 0, 0);
    place->bytes = program->workgroup_size;
    program->workgroup_size = (uint32_t)bytes;
}

// Return the constant that a variable holds wherever it is read, or NULL.
static const struct shader_constant *constant_of(const struct shader_builder *builder,
                                                 const struct shader_variable *variable)
{
    const struct shader_usage *const usage = &builder->usage[variable->id];
    const struct shader_constant *const stored =
        usage->constant != 0 ? builder->module->ids[usage->constant].data.as_constant : NULL;
    const struct shader_constant *const constant = variable->initial ? variable->initial : stored;
    const bool is_constant = constant && !usage->is_changed && (!stored || stored == constant);
    return is_constant && constant->type == variable->type ? constant : NULL;
}

// All variables that are given one constant share its words.
static void build_table(struct shader_builder *builder, const struct shader_variable *variable,
                        const struct shader_constant *constant, struct shader_place *place)
{
    struct shader_program *const program = builder->program;
    const uint32_t stored = builder->usage[variable->id].constant;
    struct shader_usage *const usage = &builder->usage[stored != 0 ? stored : variable->id];
    if (usage->node == 0) {
        const uint32_t scalars = constant->type->scalars;
        if (program->table_count + scalars > SHADER_MAX_TABLE) {
            shader_build_refuse(builder, "arrays of constants have more than %d numbers", SHADER_MAX_TABLE);
        }
        usage->node = shader_add_node(program, SHADER_TABLE, program->table_count, scalars, 0, 0);
        for (uint32_t i = 0; i < scalars; i++) {
            if (program->table_count == program->table_room) {
                program->table = shader_grow(builder->memory, program->table, &program->table_room,
                                             sizeof *program->table);
            }
            program->table[program->table_count++] = constant->scalars[i];
        }
    }
    place->kind = SHADER_PLACE_TABLE;
    place->buffer = usage->node;
    place->constants = constant->scalars;
}

static void build_private(struct shader_builder *builder, const struct shader_variable *variable,
                          struct shader_place *place)
{
    struct shader_program *const program = builder->program;
    struct shader_usage *const usage = &builder->usage[variable->id];
    if (usage->node == 0) { // a function that is called again takes the same memory again
        const uint32_t scalars = variable->type->scalars;
        if (program->private_count + scalars > SHADER_MAX_PRIVATE) {
            shader_build_refuse(builder, "arrays that indices pick from have more than %d numbers",
                                SHADER_MAX_PRIVATE);
        }
        usage->node = shader_add_node(program, SHADER_PRIVATE, program->private_count, scalars, 0, 0);
        program->private_count += scalars;
    }
    place->kind = SHADER_PLACE_PRIVATE;
    place->buffer = usage->node;
    if (variable->initial) {
        uint32_t *const scalars = shader_new_scalars(builder, variable->type);
        for (uint32_t i = 0; i < variable->type->scalars; i++) {
            scalars[i] = shader_number(builder, variable->initial->scalars[i]);
        }
        shader_write_place(builder, place, scalars);
    }
}

static void build_homes(struct shader_builder *builder, const struct shader_variable *variable,
                        struct shader_place *place)
{
    const struct shader_type *const type = variable->type;
    place->kind = SHADER_PLACE_HOMES;
    place->scalars = shader_new_scalars(builder, type);
    place->scalar_count = type->scalars;
    for (uint32_t i = 0; i < type->scalars; i++) {
        const uint32_t initial = variable->initial ? variable->initial->scalars[i] : 0;
        place->scalars[i] = shader_new_home(builder, initial);
        // A variable of a function is new in every call and every round of a loop.
        if (variable->storage == SPIRV_FUNCTION && variable->initial) {
            shader_set_home(builder, place->scalars[i], shader_number(builder, initial));
        }
    }
}

// A variable of a function, or of the module for each lane.
static void build_own(struct shader_builder *builder, const struct shader_variable *variable,
                      struct shader_place *place)
{
    const bool is_indexed = builder->usage[variable->id].is_indexed;
    const struct shader_constant *const constant = constant_of(builder, variable);
    if (is_indexed && constant) {
        build_table(builder, variable, constant, place);
    } else if (is_indexed && variable->type->scalars > MAX_INDEXED_HOMES) {
        build_private(builder, variable, place);
    } else {
        build_homes(builder, variable, place);
    }
}

void shader_build_variable(struct shader_builder *builder, const struct shader_variable *variable)
{
    struct shader_place place = {.type = variable->type, .offset = SHADER_NO_VALUE};
    switch (variable->storage) {
    case SPIRV_UNIFORM_CONSTANT:
    case SPIRV_UNIFORM:
    case SPIRV_STORAGE_BUFFER: build_resource(builder, variable, &place); break;
    case SPIRV_PUSH_CONSTANT:
        place.kind = SHADER_PLACE_BUFFER;
        place.is_read_only = true;
        place.buffer = shader_emit_with(builder, SHADER_PUSH, 0, 0, 0, 0);
        break;
    case SPIRV_INPUT:
    case SPIRV_OUTPUT: shader_build_interface_variable(builder, variable, &place); break;
    case SPIRV_WORKGROUP: build_shared(builder, &place); break;
    default: build_own(builder, variable, &place); break;
    }
    struct shader_built *const built = &builder->built[variable->id];
    built->place = shader_take(builder->memory, 1, sizeof place);
    *built->place = place;
    built->type = shader_type_of_id(builder->module, builder->word, builder->module->ids[variable->id].type);
    built->scalars = NULL;
}
