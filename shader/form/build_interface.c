// SPDX-License-Identifier: MIT
// Inputs and outputs of a stage: by location, four components each, or built in.
#include "build.h"

enum { COMPONENTS = 4, MAX_LOCATIONS = 32, MAX_ATTRIBUTES = 16, MAX_TARGETS = 8 };

// What stands in the place of target 1.
enum { IS_TARGET = 1, IS_SECOND_SOURCE = 2 };

enum stage_set { IN_VERTEX = 1, IN_FRAGMENT = 2, IN_COMPUTE = 4, IN_EVERY_STAGE = 7 };

// In the place of a slot: the value is computed of others, or 0.
enum { NO_SLOT = -1 };

struct built_in {
    enum spirv_built_in number;
    int slot; // the first component: enum shader_built_in of inputs, enum shader_output of outputs, or NO_SLOT
    uint32_t components;
    enum shader_type_kind kind; // what a component is
    enum stage_set stages;      // stages that have it
};

static const struct built_in built_in_inputs[] = {
    {SPIRV_VERTEX_INDEX, SHADER_IN_VERTEX_INDEX, 1, SHADER_INT, IN_VERTEX},
    {SPIRV_INSTANCE_INDEX, SHADER_IN_INSTANCE_INDEX, 1, SHADER_INT, IN_VERTEX},
    {SPIRV_BASE_VERTEX, NO_SLOT, 1, SHADER_INT, IN_VERTEX},
    {SPIRV_BASE_INSTANCE, NO_SLOT, 1, SHADER_INT, IN_VERTEX},
    {SPIRV_DRAW_INDEX, NO_SLOT, 1, SHADER_INT, IN_VERTEX},
    {SPIRV_FRAG_COORD, SHADER_IN_COORD, 4, SHADER_FLOAT, IN_FRAGMENT},
    {SPIRV_FRONT_FACING, SHADER_IN_FRONT_FACING, 1, SHADER_BOOL, IN_FRAGMENT},
    {SPIRV_PRIMITIVE_ID, SHADER_IN_PRIMITIVE, 1, SHADER_INT, IN_FRAGMENT},
    {SPIRV_SAMPLE_ID, SHADER_IN_SAMPLE_ID, 1, SHADER_INT, IN_FRAGMENT},
    {SPIRV_SAMPLE_POSITION, SHADER_IN_SAMPLE_POSITION, 2, SHADER_FLOAT, IN_FRAGMENT},
    {SPIRV_SAMPLE_MASK, SHADER_IN_SAMPLE_MASK, 1, SHADER_INT, IN_FRAGMENT},
    {SPIRV_POINT_COORD, SHADER_IN_POINT_COORD, 2, SHADER_FLOAT, IN_FRAGMENT},
    {SPIRV_LAYER, SHADER_IN_LAYER, 1, SHADER_INT, IN_FRAGMENT},
    {SPIRV_VIEWPORT_INDEX, SHADER_IN_VIEWPORT, 1, SHADER_INT, IN_FRAGMENT},
    {SPIRV_CLIP_DISTANCE, SHADER_IN_CLIP_DISTANCE, 8, SHADER_FLOAT, IN_FRAGMENT},
    {SPIRV_CULL_DISTANCE, SHADER_IN_CULL_DISTANCE, 8, SHADER_FLOAT, IN_FRAGMENT},
    {SPIRV_NUM_WORKGROUPS, SHADER_IN_WORKGROUP_COUNT, 3, SHADER_INT, IN_COMPUTE},
    {SPIRV_WORKGROUP_ID, SHADER_IN_WORKGROUP, 3, SHADER_INT, IN_COMPUTE},
    {SPIRV_LOCAL_INVOCATION_ID, SHADER_IN_LOCAL, 3, SHADER_INT, IN_COMPUTE},
    {SPIRV_GLOBAL_INVOCATION_ID, SHADER_IN_GLOBAL, 3, SHADER_INT, IN_COMPUTE},
    {SPIRV_LOCAL_INVOCATION_INDEX, SHADER_IN_LOCAL_INDEX, 1, SHADER_INT, IN_COMPUTE},
    {SPIRV_NUM_SUBGROUPS, NO_SLOT, 1, SHADER_INT, IN_COMPUTE},
    {SPIRV_SUBGROUP_ID, NO_SLOT, 1, SHADER_INT, IN_COMPUTE},
    {SPIRV_SUBGROUP_SIZE, NO_SLOT, 1, SHADER_INT, IN_EVERY_STAGE},
    {SPIRV_SUBGROUP_LOCAL_INVOCATION_ID, NO_SLOT, 1, SHADER_INT, IN_EVERY_STAGE},
    {SPIRV_SUBGROUP_EQ_MASK, NO_SLOT, 4, SHADER_INT, IN_EVERY_STAGE},
    {SPIRV_SUBGROUP_GE_MASK, NO_SLOT, 4, SHADER_INT, IN_EVERY_STAGE},
    {SPIRV_SUBGROUP_GT_MASK, NO_SLOT, 4, SHADER_INT, IN_EVERY_STAGE},
    {SPIRV_SUBGROUP_LE_MASK, NO_SLOT, 4, SHADER_INT, IN_EVERY_STAGE},
    {SPIRV_SUBGROUP_LT_MASK, NO_SLOT, 4, SHADER_INT, IN_EVERY_STAGE},
    {SPIRV_HELPER_INVOCATION, NO_SLOT, 1, SHADER_BOOL, IN_FRAGMENT},
    {SPIRV_VIEW_INDEX, NO_SLOT, 1, SHADER_INT, IN_EVERY_STAGE},
    {SPIRV_DEVICE_INDEX, NO_SLOT, 1, SHADER_INT, IN_EVERY_STAGE},
};

static const struct built_in built_in_outputs[] = {
    {SPIRV_POSITION, SHADER_OUT_POSITION, 4, SHADER_FLOAT, IN_VERTEX},
    {SPIRV_POINT_SIZE, SHADER_OUT_POINT_SIZE, 1, SHADER_FLOAT, IN_VERTEX},
    {SPIRV_CLIP_DISTANCE, SHADER_OUT_CLIP_DISTANCE, 8, SHADER_FLOAT, IN_VERTEX},
    {SPIRV_CULL_DISTANCE, SHADER_OUT_CULL_DISTANCE, 8, SHADER_FLOAT, IN_VERTEX},
    {SPIRV_LAYER, SHADER_OUT_LAYER, 1, SHADER_INT, IN_VERTEX},
    {SPIRV_VIEWPORT_INDEX, SHADER_OUT_VIEWPORT, 1, SHADER_INT, IN_VERTEX},
    {SPIRV_FRAG_DEPTH, SHADER_OUT_DEPTH, 1, SHADER_FLOAT, IN_FRAGMENT},
    {SPIRV_SAMPLE_MASK, SHADER_OUT_SAMPLE_MASK, 1, SHADER_INT, IN_FRAGMENT},
};

// One input or output as it is walked: scalars of the variable get slots.
struct interface_walk {
    struct shader_builder *builder;
    const struct shader_variable *variable;
    uint32_t *scalars; // what the variable holds
    uint32_t next;     // scalar
    uint32_t blocks;   // blocks of an array that have been walked
    bool is_captured;
    uint32_t buffer, offset; // where transform feedback keeps the next scalar
};

static uint32_t output_home(struct shader_builder *builder, uint32_t slot)
{
    if (builder->output_homes[slot] == SHADER_NO_VALUE) {
        builder->output_homes[slot] = shader_new_home(builder, 0);
    }
    return builder->output_homes[slot];
}

// Note that transform feedback keeps the next scalar.
static void capture(struct interface_walk *walk, uint32_t slot)
{
    struct shader_program *const program = walk->builder->program;
    struct shader_capture *const last =
        program->capture_count > 0 ? &program->captures[program->capture_count - 1] : NULL;
    const bool goes_on = last && last->buffer == walk->buffer && last->slot + last->count == slot &&
                         last->offset + 4 * last->count == walk->offset;
    if (goes_on) {
        last->count++;
    } else {
        if (program->capture_count == program->capture_room) {
            program->captures = shader_grow(walk->builder->memory, program->captures, &program->capture_room,
                                            sizeof *program->captures);
        }
        program->captures[program->capture_count++] =
            (struct shader_capture){slot, 1, walk->buffer, walk->offset};
    }
    walk->offset += 4;
}

static void add_scalar(struct interface_walk *walk, enum shader_op input, uint32_t slot)
{
    struct shader_builder *const builder = walk->builder;
    if (walk->is_captured) {
        capture(walk, slot);
    }
    walk->scalars[walk->next++] = walk->variable->storage == SPIRV_OUTPUT
                                      ? output_home(builder, slot)
                                      : shader_emit_with(builder, input, slot, 0, 0, 0);
}

static enum stage_set stage_of(const struct shader_builder *builder)
{
    return builder->entry->model == SPIRV_VERTEX     ? IN_VERTEX
           : builder->entry->model == SPIRV_FRAGMENT ? IN_FRAGMENT
                                                     : IN_COMPUTE;
}

// Return what the components of a scalar, vector or array of scalars are.
static enum shader_type_kind component_kind(const struct shader_type *type)
{
    return type->kind == SHADER_VECTOR || type->kind == SHADER_ARRAY ? type->element->kind : type->kind;
}

// Return a number of the draw, which stands behind the push constants.
static uint32_t draw_parameter(struct shader_builder *builder, uint32_t number)
{
    const uint32_t push = shader_emit_with(builder, SHADER_PUSH, 0, 0, 0, 0);
    builder->program->reads_draw = true;
    return shader_emit_with(builder, SHADER_LOAD, SHADER_DRAW_OFFSET + 4 * number, push,
                            shader_number(builder, 0), 0);
}

// Return a component of what is built in and has no slot.
static uint32_t value_without_slot(struct shader_builder *builder, int number, uint32_t component)
{
    if (number == SPIRV_VIEW_INDEX) {
        builder->program->reads_view_index = true;
        return shader_number(builder, builder->program->view_index);
    }
    if (number >= SPIRV_BASE_VERTEX && number <= SPIRV_DRAW_INDEX) {
        return draw_parameter(builder, (uint32_t)(number - SPIRV_BASE_VERTEX));
    }
    const uint32_t value = shader_subgroup_built_in(builder, number, component);
    return value != SHADER_NO_VALUE ? value : shader_number(builder, 0);
}

static void add_built_in(struct interface_walk *walk, const struct shader_type *type, int number)
{
    struct shader_builder *const builder = walk->builder;
    const bool is_output = walk->variable->storage == SPIRV_OUTPUT;
    const struct built_in *const table = is_output ? built_in_outputs : built_in_inputs;
    const size_t count = is_output ? sizeof built_in_outputs / sizeof *built_in_outputs
                                   : sizeof built_in_inputs / sizeof *built_in_inputs;
    for (size_t i = 0; i < count; i++) {
        if ((int)table[i].number != number || (table[i].stages & stage_of(builder)) == 0) {
            continue;
        }
        if (component_kind(type) != table[i].kind) {
            shader_build_refuse(builder, "built-in %d is declared with another type", number);
        }
        if (type->scalars > table[i].components) {
            shader_build_refuse(builder, "built-in %d has at most %u components", number,
                                (unsigned)table[i].components);
        }
        builder->program->shades_samples |=
            !is_output && (number == SPIRV_SAMPLE_ID || number == SPIRV_SAMPLE_POSITION);
        for (uint32_t c = 0; c < type->scalars; c++) {
            // Distances of fragments are interpolated as other inputs are.
            const bool is_varying = table[i].slot >= SHADER_IN_CLIP_DISTANCE && !is_output;
            if (table[i].slot == NO_SLOT) {
                walk->scalars[walk->next++] = value_without_slot(builder, number, c);
            } else {
                add_scalar(walk, is_varying ? SHADER_INPUT : SHADER_BUILT_IN, (uint32_t)table[i].slot + c);
            }
        }
        return;
    }
    shader_build_refuse(builder, "built-in %d is not supported in this stage as an %s", number,
                        is_output ? "output" : "input");
}

// The first slot of outputs. A fragment shader's output of index 1 is the second source of blending (Vulkan 1.3,
// "Dual-Source Blending"), which librhw takes where target 1 would be.
static uint32_t output_slot(const struct interface_walk *walk, uint32_t location)
{
    struct shader_builder *const builder = walk->builder;
    const bool is_second = walk->variable->index == 1;
    if (builder->entry->model != SPIRV_FRAGMENT) {
        return SHADER_OUT_VARYING + location * COMPONENTS;
    }
    if (location >= MAX_TARGETS || walk->variable->index > 1 || (is_second && location != 0)) {
        shader_build_refuse(
            builder, "location %u, index %d is no target: there are %d, and index 1 of the first",
            (unsigned)location, walk->variable->index < 0 ? 0 : walk->variable->index, MAX_TARGETS);
    }
    builder->second_target |= is_second ? IS_SECOND_SOURCE : location == 1 ? IS_TARGET : 0;
    if (builder->second_target == (IS_TARGET | IS_SECOND_SOURCE)) {
        shader_build_refuse(builder, "with an output of index 1 there is one target");
    }
    return SHADER_OUT_VARYING + (is_second ? 1 : location) * COMPONENTS;
}

// Give the scalars of a number or vector their slots.
static void add_components(struct interface_walk *walk, const struct shader_type *type, uint32_t location,
                           uint32_t component, uint8_t interpolation)
{
    struct shader_builder *const builder = walk->builder;
    const bool is_output = walk->variable->storage == SPIRV_OUTPUT;
    const uint32_t scalars = type->kind == SHADER_VECTOR ? type->count : 1;
    const int locations = !is_output && stage_of(builder) == IN_VERTEX ? MAX_ATTRIBUTES : MAX_LOCATIONS;
    if (location >= (uint32_t)locations || component >= COMPONENTS || component + scalars > COMPONENTS) {
        shader_build_refuse(builder, "location %u, component %u is not among %d locations of %d components",
                            (unsigned)location, (unsigned)component, locations, COMPONENTS);
    }
    const uint32_t first = (is_output ? output_slot(walk, location) : location * COMPONENTS) + component;
    for (uint32_t i = 0; i < scalars; i++) {
        if (!is_output) {
            const bool is_integer = shader_scalar_type(type)->kind == SHADER_INT;
            builder->program->interpolation[first + i] = is_integer ? SHADER_FLAT : interpolation;
            builder->program->shades_samples |= (interpolation & SHADER_AT_SAMPLE) != 0;
        }
        add_scalar(walk, SHADER_INPUT, first + i);
    }
    if (is_output && shader_scalar_type(type)->kind == SHADER_INT) {
        builder->is_integer[(first - SHADER_OUT_VARYING) / COMPONENTS] = true;
    }
}

// Give the scalars of a type their slots from a location on. Return the location behind.
static uint32_t add_located(struct interface_walk *walk, const struct shader_type *type, uint32_t location,
                            uint32_t component, uint8_t interpolation)
{
    if (type->is_empty) {
        return location; // arrays of it may have any number of elements
    }
    switch (type->kind) {
    case SHADER_MATRIX:
    case SHADER_ARRAY:
        for (uint32_t i = 0; i < type->count; i++) {
            location = add_located(walk, type->element, location, component, interpolation);
        }
        return location;
    case SHADER_STRUCT:
        for (uint32_t i = 0; i < type->count; i++) {
            const uint8_t own = type->members[i].interpolation;
            location = add_located(walk, type->members[i].type, location, 0, own ? own : interpolation);
        }
        return location;
    case SHADER_VECTOR:
    case SHADER_INT:
    case SHADER_FLOAT:
        if (component_kind(type) != SHADER_BOOL) {
            add_components(walk, type, location, component, interpolation);
            return location + 1;
        } // fall through
    default: shader_build_refuse(walk->builder, "an input or output is made of numbers");
    }
}

// Return the value of a decoration of a member of a block (NULL: there is none), or of the variable, or `none`.
static uint32_t decorated(const struct interface_walk *walk, const struct shader_type *block, int member,
                          enum spirv_decoration number, uint32_t none)
{
    const struct shader_module *const module = walk->builder->module;
    const struct shader_decoration *found =
        block ? shader_find_decoration(module, block->id, member, number) : NULL;
    found = found ? found : shader_find_decoration(module, walk->variable->id, -1, number);
    return found ? found->value : none;
}

// Find out whether transform feedback keeps an output of vertices, and where (SPIR-V, XfbBuffer, XfbStride, Offset).
// Each block of an array goes to the buffer behind that of the one before, as in GLSL.
static void find_capture(struct interface_walk *walk, const struct shader_type *block, int member)
{
    struct shader_builder *const builder = walk->builder;
    walk->buffer = decorated(walk, block, member, SPIRV_XFB_BUFFER, UINT32_MAX);
    walk->offset = decorated(walk, block, member, SPIRV_OFFSET, UINT32_MAX);
    walk->is_captured = walk->variable->storage == SPIRV_OUTPUT && builder->entry->model == SPIRV_VERTEX &&
                        walk->buffer != UINT32_MAX && walk->offset != UINT32_MAX;
    walk->buffer = walk->buffer > INT32_MAX ? walk->buffer : walk->buffer + walk->blocks;
    if (walk->is_captured && (walk->buffer >= SHADER_MAX_CAPTURE_BUFFERS || walk->offset > INT32_MAX)) {
        shader_build_refuse(builder, "transform feedback has %d buffers, and offsets below 2^31",
                            SHADER_MAX_CAPTURE_BUFFERS);
    }
    const uint32_t stride = decorated(walk, block, member, SPIRV_XFB_STRIDE, 0);
    if (walk->is_captured && stride != 0) {
        uint32_t *const own = &builder->program->strides[walk->buffer];
        if (*own != 0 && *own != stride) {
            shader_build_refuse(builder, "transform feedback has strides of %u and %u for buffer %u",
                                (unsigned)*own, (unsigned)stride, (unsigned)walk->buffer);
        }
        *own = stride;
    }
}

// Give the members of a block their slots.
static void add_block(struct interface_walk *walk, const struct shader_type *type)
{
    const struct shader_variable *const variable = walk->variable;
    uint32_t location = variable->location < 0 ? 0 : (uint32_t)variable->location;
    for (uint32_t i = 0; i < type->count; i++) {
        const struct shader_member *const member = &type->members[i];
        find_capture(walk, type, (int)i);
        if (member->built_in >= 0) {
            add_built_in(walk, member->type, member->built_in);
            continue;
        }
        location = member->location < 0 ? location : (uint32_t)member->location;
        const uint8_t own = member->interpolation;
        location = add_located(walk, member->type, location, (uint32_t)member->component,
                               own ? own : variable->interpolation);
    }
}

// Give the members of an array of blocks their slots from a location on. Their own locations do not count, since each
// block has others. Return the location behind.
static uint32_t add_blocks(struct interface_walk *walk, const struct shader_type *type, uint32_t location)
{
    if (type->is_empty) {
        return location; // arrays of it may have any number of elements
    }
    if (type->kind == SHADER_ARRAY) {
        for (uint32_t i = 0; i < type->count; i++) {
            location = add_blocks(walk, type->element, location);
        }
        return location;
    }
    for (uint32_t i = 0; i < type->count; i++) {
        const uint8_t own = type->members[i].interpolation;
        find_capture(walk, type, (int)i);
        location =
            add_located(walk, type->members[i].type, location, 0, own ? own : walk->variable->interpolation);
    }
    walk->blocks++;
    return location;
}

static bool is_array_of_blocks(const struct shader_type *type)
{
    const struct shader_type *element = type;
    while (element->kind == SHADER_ARRAY) {
        element = element->element;
    }
    return element != type && element->kind == SHADER_STRUCT && element->is_block;
}

void shader_build_interface_variable(struct shader_builder *builder, const struct shader_variable *variable,
                                     struct shader_place *place)
{
    if (!builder->is_in_interface[variable->id]) {
        return; // another entry point has it
    }
    const struct shader_type *const type = variable->type;
    if (builder->entry->model == SPIRV_COMPUTE &&
        (variable->storage == SPIRV_OUTPUT || variable->built_in < 0)) {
        shader_build_refuse(builder, "compute has no outputs, and no inputs but built-in ones");
    }
    struct interface_walk walk = {
        .builder = builder, .variable = variable, .scalars = shader_new_scalars(builder, type)};
    find_capture(&walk, NULL, -1);
    if (variable->built_in >= 0) {
        add_built_in(&walk, type, variable->built_in);
    } else if (type->kind == SHADER_STRUCT && type->is_block) {
        add_block(&walk, type);
    } else if (variable->location >= 0 && is_array_of_blocks(type)) {
        (void)add_blocks(&walk, type, (uint32_t)variable->location);
    } else if (variable->location >= 0) {
        (void)add_located(&walk, type, (uint32_t)variable->location,
                          variable->component < 0 ? 0 : (uint32_t)variable->component,
                          variable->interpolation);
    } else {
        shader_build_refuse(builder, "the variable has no location and is not built in");
    }
    place->kind = variable->storage == SPIRV_OUTPUT ? SHADER_PLACE_HOMES : SHADER_PLACE_INPUT;
    place->scalars = walk.scalars;
    place->scalar_count = type->scalars;
    for (uint32_t i = 0; variable->storage == SPIRV_OUTPUT && variable->initial && i < type->scalars; i++) {
        shader_set_home(builder, place->scalars[i], shader_number(builder, variable->initial->scalars[i]));
    }
}

static void write_output(struct shader_builder *builder, uint32_t slot, uint32_t value)
{
    builder->program->writes[slot] = true;
    (void)shader_emit_with(builder, SHADER_OUTPUT, slot, value, 0, 0);
}

// Vulkan leaves it open what a colour has that no code sets. Here the components that are named are 0. Of the others,
// red to blue are 0 and alpha is 1.
static void complete_color(struct shader_builder *builder, uint32_t first)
{
    const uint32_t *const homes = &builder->output_homes[first];
    bool is_named = false;
    for (uint32_t c = 0; c < COMPONENTS; c++) {
        is_named = is_named || homes[c] != SHADER_NO_VALUE;
    }
    const bool is_integer = builder->is_integer[(first - SHADER_OUT_VARYING) / COMPONENTS];
    const uint32_t alpha = is_integer ? shader_number(builder, 1) : shader_number_float(builder, 1.0f);
    for (uint32_t c = 0; is_named && c < COMPONENTS; c++) {
        if (!builder->program->writes[first + c]) {
            const bool is_opaque = c == 3 && homes[c] == SHADER_NO_VALUE;
            write_output(builder, first + c, is_opaque ? alpha : shader_number(builder, 0));
        }
    }
}

void shader_write_outputs(struct shader_builder *builder)
{
    struct shader_program *const program = builder->program;
    bool *const is_set = shader_take(builder->memory, program->node_count, sizeof *is_set);
    for (uint32_t i = 0; i < program->code_count; i++) {
        const struct shader_node *const node = &program->nodes[program->code[i]];
        if (node->op == SHADER_SET) {
            is_set[node->operands[0]] = true;
        }
    }
    // A built-in variable is an output only if it is stored to somewhere. A vertex shader gives the fragment shader 0
    // for what it declares and never stores, which Vulkan leaves open.
    for (uint32_t slot = 0; slot < SHADER_OUT_COUNT; slot++) {
        const uint32_t home = builder->output_homes[slot];
        if (home != SHADER_NO_VALUE && is_set[home]) {
            write_output(builder, slot, shader_get_home(builder, home));
        } else if (home != SHADER_NO_VALUE && builder->entry->model == SPIRV_VERTEX &&
                   slot >= SHADER_OUT_VARYING) {
            write_output(builder, slot, shader_number(builder, 0));
        }
    }
    for (uint32_t t = 0; builder->entry->model == SPIRV_FRAGMENT && t < MAX_TARGETS; t++) {
        complete_color(builder, SHADER_OUT_VARYING + t * COMPONENTS);
    }
}
