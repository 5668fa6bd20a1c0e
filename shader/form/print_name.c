// SPDX-License-Identifier: MIT
// Names of what a program reads, writes and keeps: those of the module's variables, where it has them.
#include "print.h"

static void print_component(const struct shader_sink *sink, const struct shader_type *type, uint32_t scalar)
{
    if (type->kind == SHADER_VECTOR && scalar < 4) {
        shader_sink_print(sink, ".%c", "xyzw"[scalar]);
    } else if (type->scalars != 1) {
        shader_sink_print(sink, "[%u]", (unsigned)scalar);
    }
}

// Return how many locations a type takes.
static uint32_t locations_of(const struct shader_type *type)
{
    uint32_t count = 0;
    if (type->is_empty) {
        return 0; // arrays of it may have any number of elements
    }
    switch (type->kind) {
    case SHADER_MATRIX:
    case SHADER_ARRAY: return type->count * locations_of(type->element);
    case SHADER_STRUCT:
        for (uint32_t i = 0; i < type->count; i++) {
            count += locations_of(type->members[i].type);
        }
        return count;
    default: return 1;
    }
}

// Return the variable of the entry point that has a location and component, or NULL.
static const struct shader_variable *find_variable(const struct shader_program *program,
                                                   enum spirv_storage_class storage, uint32_t location,
                                                   uint32_t component)
{
    const struct shader_module *const module = program->module;
    for (uint32_t i = 0; i < program->entry->interface_count; i++) {
        const uint32_t id = program->entry->interface[i];
        if (id >= module->bound || module->ids[id].opcode != SPIRV_OP_Variable) {
            continue;
        }
        const struct shader_variable *const variable = module->ids[id].data.as_variable;
        const uint32_t first = variable->component < 0 ? 0 : (uint32_t)variable->component;
        const uint32_t own = variable->type->kind == SHADER_VECTOR ? variable->type->count : 1;
        const bool is_one = variable->type->kind <= SHADER_VECTOR;
        if (variable->storage == storage && variable->location >= 0 &&
            location >= (uint32_t)variable->location &&
            location - (uint32_t)variable->location < locations_of(variable->type) && component >= first &&
            (!is_one || component < first + own)) {
            return variable;
        }
    }
    return NULL;
}

static void print_located(const struct shader_sink *sink, const struct shader_program *program,
                          enum spirv_storage_class storage, uint32_t number)
{
    const uint32_t location = number / 4, component = number % 4;
    const struct shader_variable *const variable = find_variable(program, storage, location, component);
    const char *const name = variable ? program->module->names[variable->id] : NULL;
    if (!name || name[0] == '\0') {
        shader_sink_print(sink, "location %u.%c", (unsigned)location, "xyzw"[component]);
        return;
    }
    shader_sink_print(sink, "%.100s", name);
    const bool is_one = variable->type->kind <= SHADER_VECTOR;
    if (!is_one) {
        shader_sink_print(sink, "[%u]", (unsigned)(location - (uint32_t)variable->location));
    }
    if (!is_one || variable->type->kind == SHADER_VECTOR) {
        const uint32_t first = variable->component < 0 ? 0 : (uint32_t)variable->component;
        shader_sink_print(sink, ".%c", "xyzw"[component - first]);
    }
}

// A built-in variable and its first number.
struct built_in_name {
    const char *name;
    uint32_t first, count;
};

static void print_named(const struct shader_sink *sink, const struct built_in_name *names, size_t count,
                        uint32_t number)
{
    for (size_t i = 0; i < count; i++) {
        const uint32_t component = number - names[i].first;
        if (number >= names[i].first && component < names[i].count) {
            shader_sink_print(sink, "%s", names[i].name);
            if (names[i].count > 4) {
                shader_sink_print(sink, "[%u]", (unsigned)component);
            } else if (names[i].count > 1) {
                shader_sink_print(sink, ".%c", "xyzw"[component]);
            }
            return;
        }
    }
    shader_sink_print(sink, "built-in %u", (unsigned)number);
}

void shader_print_built_in(const struct shader_sink *sink, uint32_t number)
{
    static const struct built_in_name names[] = {
        {"gl_VertexIndex", SHADER_IN_VERTEX_INDEX, 1},
        {"gl_InstanceIndex", SHADER_IN_INSTANCE_INDEX, 1},
        {"gl_FragCoord", SHADER_IN_COORD, 4},
        {"gl_FrontFacing", SHADER_IN_FRONT_FACING, 1},
        {"gl_PrimitiveID", SHADER_IN_PRIMITIVE, 1},
        {"gl_SampleID", SHADER_IN_SAMPLE_ID, 1},
        {"gl_SamplePosition", SHADER_IN_SAMPLE_POSITION, 2},
        {"gl_SampleMaskIn", SHADER_IN_SAMPLE_MASK, 1},
        {"gl_PointCoord", SHADER_IN_POINT_COORD, 2},
        {"gl_Layer", SHADER_IN_LAYER, 1},
        {"gl_ViewportIndex", SHADER_IN_VIEWPORT, 1},
        {"gl_NumWorkGroups", SHADER_IN_WORKGROUP_COUNT, 3},
        {"gl_WorkGroupID", SHADER_IN_WORKGROUP, 3},
        {"gl_LocalInvocationID", SHADER_IN_LOCAL, 3},
        {"gl_GlobalInvocationID", SHADER_IN_GLOBAL, 3},
        {"gl_LocalInvocationIndex", SHADER_IN_LOCAL_INDEX, 1},
        {"gl_SubgroupInvocationID", SHADER_IN_LANE, 1},
    };
    print_named(sink, names, sizeof names / sizeof *names, number);
}

void shader_print_input(const struct shader_sink *sink, const struct shader_program *program, uint32_t number)
{
    static const struct built_in_name names[] = {
        {"gl_ClipDistance", SHADER_IN_CLIP_DISTANCE, 8},
        {"gl_CullDistance", SHADER_IN_CULL_DISTANCE, 8},
    };
    if (number >= SHADER_IN_CLIP_DISTANCE) {
        print_named(sink, names, sizeof names / sizeof *names, number);
        return;
    }
    print_located(sink, program, SPIRV_INPUT, number % SHADER_IN_CENTROID);
    if (number >= SHADER_IN_CENTROID) {
        shader_sink_print(sink, number >= SHADER_IN_CENTER ? " at the centre" : " at the centroid");
    }
}

void shader_print_output(const struct shader_sink *sink, const struct shader_program *program,
                         uint32_t number)
{
    static const struct built_in_name names[] = {
        {"gl_Position", SHADER_OUT_POSITION, 4},
        {"gl_PointSize", SHADER_OUT_POINT_SIZE, 1},
        {"gl_ClipDistance", SHADER_OUT_CLIP_DISTANCE, 8},
        {"gl_CullDistance", SHADER_OUT_CULL_DISTANCE, 8},
        {"gl_Layer", SHADER_OUT_LAYER, 1},
        {"gl_ViewportIndex", SHADER_OUT_VIEWPORT, 1},
        {"gl_FragDepth", SHADER_OUT_DEPTH, 1},
        {"gl_SampleMask", SHADER_OUT_SAMPLE_MASK, 1},
    };
    if (number >= SHADER_OUT_VARYING) {
        print_located(sink, program, SPIRV_OUTPUT, number - SHADER_OUT_VARYING);
    } else {
        print_named(sink, names, sizeof names / sizeof *names, number);
    }
}

void shader_print_home(const struct shader_sink *sink, const struct shader_program *program, uint32_t home)
{
    const struct shader_module *const module = program->module;
    const uint32_t word = program->origins[home];
    if (word == 0 || (module->words[word] & 0xffff) != SPIRV_OP_Variable) {
        return;
    }
    const uint32_t id = module->words[word + 2];
    const struct shader_type *const pointer = module->ids[module->words[word + 1]].data.as_type;
    const char *const name = module->names[id];
    if (!name || name[0] == '\0') {
        return;
    }
    uint32_t scalar = 0;
    while (scalar < home && program->origins[home - scalar - 1] == word &&
           program->nodes[home - scalar - 1].op == SHADER_HOME) {
        scalar++;
    }
    shader_sink_print(sink, ".%.100s", name);
    print_component(sink, pointer->element, scalar);
}

void shader_print_resource(const struct shader_sink *sink, const struct shader_program *program,
                           uint32_t number)
{
    const struct shader_variable *const variable = program->resources[number].variable;
    const char *name = program->module->names[variable->id];
    name = name && name[0] != '\0' ? name : program->module->names[program->resources[number].type->id];
    shader_sink_print(sink, "%.100s (set %d, binding %d)", name ? name : "", variable->set,
                      variable->binding);
}
