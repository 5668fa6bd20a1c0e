// SPDX-License-Identifier: MIT
// See link.h.
#include "link.h"

#include <string.h>

enum { LOCATIONS = 32, COMPONENTS = 4, NO_COMPONENT = 0xff };

static void find_qualifiers(const struct shader_program *program, struct shader_interface *interface)
{
    const struct shader_module *const module = program->module;
    for (uint32_t i = 0; i < module->variable_count; i++) {
        const struct shader_variable *const variable = module->variables[i];
        if (variable->storage != SPIRV_INPUT || variable->location < 0 || variable->location >= LOCATIONS) {
            continue;
        }
        // A variable of several locations has one qualifier; those behind follow it.
        const uint32_t slots = (variable->type->scalars + COMPONENTS - 1) / COMPONENTS;
        for (uint32_t l = (uint32_t)variable->location;
             l < LOCATIONS && l < (uint32_t)variable->location + slots; l++) {
            interface->is_flat[l] = variable->is_flat;
            interface->is_noperspective[l] = variable->is_noperspective;
            interface->is_centroid[l] = variable->is_centroid;
            interface->is_sample[l] = variable->is_sample;
        }
    }
}

// Return by value whether something reads it.
static const bool *find_read(const struct shader_program *program)
{
    bool *const is_read = shader_take(program->memory, program->node_count, sizeof *is_read);
    for (uint32_t i = 0; i < program->code_count; i++) {
        uint32_t count;
        const uint32_t *const operands = shader_operands(program, &program->nodes[program->code[i]], &count);
        for (uint32_t o = 0; o < count; o++) {
            is_read[operands[o]] = true;
        }
    }
    return is_read;
}

// The order of atomics shows in what they return, and where they exchange words. The memory of a workgroup is nobody
// else's.
static void find_atomic(const struct shader_program *program, uint32_t value, const bool *is_read,
                        struct shader_interface *interface)
{
    struct shader_node *const node = &program->nodes[value];
    uint32_t count;
    const uint32_t *const operands = shader_operands(program, node, &count);
    if (program->nodes[operands[0]].op == SHADER_WORKGROUP) {
        return;
    }
    interface->has_effects = interface->has_effects || node->immediate != SHADER_ATOMIC_LOAD;
    interface->uses_atomic_results =
        interface->uses_atomic_results || is_read[value] || node->immediate == SHADER_ATOMIC_STORE ||
        node->immediate == SHADER_ATOMIC_EXCHANGE || node->immediate == SHADER_ATOMIC_COMPARE_EXCHANGE;
}

void shader_find_interface(const struct shader_program *program, struct shader_interface *interface)
{
    *interface = (struct shader_interface){.discards = false};
    const bool *const is_read = find_read(program);
    find_qualifiers(program, interface);
    for (uint32_t i = 0; i < program->code_count; i++) {
        const struct shader_node *const node = &program->nodes[program->code[i]];
        switch ((enum shader_op)node->op) {
        case SHADER_INPUT: interface->reads[node->immediate] = true; break;
        case SHADER_INPUT_BESIDE:
        case SHADER_INPUT_BELOW: interface->needs_w = true; // fall through
        case SHADER_INPUT_DX:
        case SHADER_INPUT_DY:
            interface->reads[node->immediate] = interface->derives[node->immediate] = true;
            break;
        case SHADER_BUILT_IN: interface->built_in[node->immediate] = true; break;
        case SHADER_OUTPUT: interface->writes[node->immediate] = true; break;
        case SHADER_DISCARD: interface->discards = true; break;
        case SHADER_STORE:
        case SHADER_IMAGE_STORE: interface->has_effects = true; break;
        case SHADER_ATOMIC:
        case SHADER_IMAGE_ATOMIC: find_atomic(program, program->code[i], is_read, interface); break;
        default: break;
        }
    }
}

// Varyings -------------------------------------------------------------------------------------------

// Add a varying of the components [first, end) of a location.
static void add_varying(struct rhw_program *program, const struct shader_interface *fragment,
                        uint32_t location, uint32_t first, uint32_t end)
{
    struct rhw_varying *const varying = &program->varyings[program->varying_count++];
    *varying = (struct rhw_varying){.components = (int)(end - first),
                                    .qualifier = fragment->is_flat[location]            ? RHW_FLAT
                                                 : fragment->is_noperspective[location] ? RHW_NOPERSPECTIVE
                                                                                        : RHW_SMOOTH,
                                    .sampling = fragment->is_sample[location]     ? RHW_SAMPLING_SAMPLE
                                                : fragment->is_centroid[location] ? RHW_SAMPLING_CENTROID
                                                                                  : RHW_SAMPLING_CENTER};
    for (uint32_t c = first; c < end; c++) {
        varying->derivatives = varying->derivatives || fragment->derives[location * COMPONENTS + c];
    }
}

// Every location that the fragment stage reads becomes a varying, of the components from its first to its last.
static const char *link_varyings(const struct shader_interface *vertex,
                                 const struct shader_interface *fragment, struct shader_bytecode *vertex_code,
                                 struct shader_bytecode *fragment_code, struct rhw_program *program)
{
    uint8_t component = 0;
    for (uint32_t location = 0; location < LOCATIONS; location++) {
        const bool *const reads = &fragment->reads[location * COMPONENTS];
        uint32_t first = 0, end = COMPONENTS;
        while (first < COMPONENTS && !reads[first]) {
            first++;
        }
        while (end > first && !reads[end - 1]) {
            end--;
        }
        if (first == end) {
            continue;
        }
        if (program->varying_count == RHW_MAX_VARYINGS) {
            return "there are too many varyings";
        }
        add_varying(program, fragment, location, first, end);
        fragment_code->is_linear[location] =
            fragment->is_flat[location] || fragment->is_noperspective[location];
        for (uint32_t c = first; c < end; c++) {
            const uint32_t slot = location * COMPONENTS + c;
            if (reads[c] && !vertex->writes[SHADER_OUT_VARYING + slot]) {
                return "the fragment stage reads a location that the vertex stage does not write";
            }
            vertex_code->component_of[slot] = fragment_code->component_of[slot] = component++;
        }
    }
    if (fragment->needs_w) {
        program->varyings[program->varying_count++] =
            (struct rhw_varying){.components = 1, .derivatives = true};
        vertex_code->w_component = fragment_code->w_component = component;
    }
    return NULL;
}

static uint32_t find_uses(const struct shader_interface *fragment)
{
    uint32_t uses = 0;
    for (int c = 0; c < 4; c++) {
        uses |= fragment->built_in[SHADER_IN_COORD + c] ? (uint32_t)RHW_USE_COORD : 0;
    }
    const bool uses_sample = fragment->built_in[SHADER_IN_SAMPLE_ID] ||
                             fragment->built_in[SHADER_IN_SAMPLE_POSITION] ||
                             fragment->built_in[SHADER_IN_SAMPLE_POSITION + 1];
    const bool uses_point =
        fragment->built_in[SHADER_IN_POINT_COORD] || fragment->built_in[SHADER_IN_POINT_COORD + 1];
    const bool uses_mask =
        fragment->built_in[SHADER_IN_SAMPLE_MASK] || fragment->writes[SHADER_OUT_SAMPLE_MASK];
    uses |= fragment->built_in[SHADER_IN_FRONT_FACING] ? (uint32_t)RHW_USE_FACING : 0;
    uses |= fragment->built_in[SHADER_IN_PRIMITIVE] ? (uint32_t)RHW_USE_IDS : 0;
    uses |= fragment->built_in[SHADER_IN_LAYER] || fragment->built_in[SHADER_IN_VIEWPORT]
                ? (uint32_t)RHW_USE_LAYER
                : 0;
    uses |= uses_sample ? (uint32_t)RHW_USE_SAMPLE : 0;
    uses |= uses_point ? (uint32_t)RHW_USE_POINT_COORD : 0;
    uses |= uses_mask ? (uint32_t)RHW_USE_SAMPLE_MASK : 0;
    uses |= fragment->discards ? (uint32_t)RHW_USE_DISCARD : 0;
    uses |= fragment->writes[SHADER_OUT_DEPTH] ? (uint32_t)RHW_USE_DEPTH : 0;
    uses |= fragment->has_effects ? (uint32_t)RHW_USE_EFFECTS : 0;
    return uses;
}

// Distances are counted up to the last that is written.
static int count_distances(const struct shader_interface *vertex, uint32_t first)
{
    int count = 0;
    for (int i = 0; i < 8; i++) {
        count = vertex->writes[first + (uint32_t)i] ? i + 1 : count;
    }
    return count;
}

const char *shader_link(const struct shader_interface *vertex, const struct shader_interface *fragment,
                        struct shader_bytecode *vertex_code, struct shader_bytecode *fragment_code,
                        struct rhw_program *program)
{
    static const struct shader_interface nothing = {.discards = false};
    const struct shader_interface *const reader = fragment ? fragment : &nothing;
    memset(vertex_code->component_of, NO_COMPONENT, sizeof vertex_code->component_of);
    vertex_code->w_component = NO_COMPONENT;
    if (fragment) {
        memset(fragment_code->component_of, NO_COMPONENT, sizeof fragment_code->component_of);
        fragment_code->w_component = NO_COMPONENT;
    }
    program->varying_count = 0;
    const char *const problem =
        link_varyings(vertex, reader, vertex_code, fragment ? fragment_code : vertex_code, program);
    if (problem) {
        return problem;
    }
    program->uniform_size = sizeof(struct rhw_shader_frame);
    program->writes_point_size = vertex->writes[SHADER_OUT_POINT_SIZE];
    program->writes_layer = vertex->writes[SHADER_OUT_LAYER];
    program->writes_viewport_index = vertex->writes[SHADER_OUT_VIEWPORT];
    program->clip_distance_count = count_distances(vertex, SHADER_OUT_CLIP_DISTANCE);
    program->cull_distance_count = count_distances(vertex, SHADER_OUT_CULL_DISTANCE);
    program->vertex_effects = vertex->has_effects;
    program->uses_atomic_results = vertex->uses_atomic_results || reader->uses_atomic_results;
    program->uses = find_uses(reader);
    return NULL;
}
