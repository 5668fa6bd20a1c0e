// SPDX-License-Identifier: MIT
// See link.h.
#include "link.h"

#include "message.h"

#include <string.h>

enum { COMPONENTS = 4, NO_COMPONENT = 0xff };

_Static_assert((int)SHADER_DRAW_OFFSET == (int)RHW_SHADER_DRAW_OFFSET, "shaders and their users agree");
_Static_assert((int)SHADER_INPUT_NUMBERS == (int)SHADER_IN_NUMBERS, "code has a place for each input");

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

// Return true for a point size that is 1, as it is where nothing writes it. Transform feedback wants it written.
static bool is_default(const struct shader_program *program, const struct shader_node *output,
                       bool is_captured)
{
    const struct shader_node *const value = &program->nodes[output->operands[0]];
    return output->immediate == SHADER_OUT_POINT_SIZE && value->op == SHADER_CONSTANT &&
           value->immediate == 0x3f800000 && !is_captured;
}

void shader_find_interface(const struct shader_program *program, struct shader_interface *interface)
{
    *interface = (struct shader_interface){.is_captured = program->capture_count > 0};
    for (uint32_t i = 0; i < SHADER_IN_CENTROID; i++) {
        const unsigned declared = program->interpolation[i];
        const unsigned elsewhere = declared & ~(unsigned)(SHADER_AT_CENTROID | SHADER_AT_SAMPLE);
        interface->interpolation[SHADER_IN_DECLARED + i] = (uint8_t)declared;
        interface->interpolation[SHADER_IN_CENTROID + i] = (uint8_t)(elsewhere | SHADER_AT_CENTROID);
        interface->interpolation[SHADER_IN_CENTER + i] = (uint8_t)elsewhere;
    }
    const bool *const is_read = find_read(program);
    for (uint32_t i = 0; i < program->code_count; i++) {
        const struct shader_node *const node = &program->nodes[program->code[i]];
        switch ((enum shader_op)node->op) {
        case SHADER_INPUT: interface->reads[node->immediate] = true; break;
        case SHADER_INPUT_BESIDE:
        case SHADER_INPUT_BELOW:
        case SHADER_INPUT_AT: interface->needs_w = true; // fall through
        case SHADER_INPUT_DX:
        case SHADER_INPUT_DY:
            interface->reads[node->immediate] = interface->derives[node->immediate] = true;
            break;
        case SHADER_BUILT_IN: interface->built_in[node->immediate] = true; break;
        case SHADER_OUTPUT:
            interface->writes[node->immediate] =
                interface->writes[node->immediate] || !is_default(program, node, interface->is_captured);
            break;
        case SHADER_DISCARD: interface->discards = true; break;
        case SHADER_STORE:
            interface->has_effects =
                interface->has_effects || program->nodes[node->operands[0]].op != SHADER_PRIVATE;
            break;
        case SHADER_STORE8:
        case SHADER_STORE16:
        case SHADER_IMAGE_STORE: interface->has_effects = true; break;
        case SHADER_ATOMIC:
        case SHADER_IMAGE_ATOMIC: find_atomic(program, program->code[i], is_read, interface); break;
        default: break;
        }
    }
}

// Varyings -------------------------------------------------------------------------------------------

// What the vertex stage writes for a number of an input.
static uint32_t output_of(uint32_t number)
{
    if (number >= SHADER_IN_CULL_DISTANCE) {
        return SHADER_OUT_CULL_DISTANCE + number - SHADER_IN_CULL_DISTANCE;
    }
    return number >= SHADER_IN_CLIP_DISTANCE ? SHADER_OUT_CLIP_DISTANCE + number - SHADER_IN_CLIP_DISTANCE
                                             : SHADER_OUT_VARYING + number % SHADER_IN_CENTROID;
}

// Add a varying of the inputs [first, end).
static void add_varying(struct rhw_program *program, const struct shader_interface *fragment, uint32_t first,
                        uint32_t end)
{
    const unsigned interpolation = fragment->interpolation[first];
    struct rhw_varying *const varying = &program->varyings[program->varying_count++];
    *varying = (struct rhw_varying){.components = (int)(end - first),
                                    .qualifier = interpolation & SHADER_FLAT            ? RHW_FLAT
                                                 : interpolation & SHADER_NOPERSPECTIVE ? RHW_NOPERSPECTIVE
                                                                                        : RHW_SMOOTH,
                                    .sampling = interpolation & SHADER_AT_SAMPLE     ? RHW_SAMPLING_SAMPLE
                                                : interpolation & SHADER_AT_CENTROID ? RHW_SAMPLING_CENTROID
                                                                                     : RHW_SAMPLING_CENTER};
    for (uint32_t i = first; i < end; i++) {
        varying->derivatives = varying->derivatives || fragment->derives[i];
    }
}

// Return the end of the inputs from `first` on, of one location, that are read and interpolated alike. Where
// derivatives stand apart, they are asked for of all of these or of none.
static uint32_t end_of_run(const struct shader_interface *fragment, uint32_t first, bool are_apart)
{
    uint32_t end = first;
    do {
        end++;
    } while (end % COMPONENTS != 0 && fragment->reads[end] &&
             fragment->interpolation[end] == fragment->interpolation[first] &&
             (!are_apart || fragment->derives[end] == fragment->derives[first]));
    return end;
}

// Return true if there is room for the varyings where derivatives stand apart: for RHW_MAX_VARYINGS - 1 of them, since
// W may need one. What transform feedback keeps wants the room, too.
static bool may_be_apart(const struct shader_interface *vertex, const struct shader_interface *fragment)
{
    int count = vertex->is_captured ? RHW_MAX_VARYINGS : 0;
    for (uint32_t number = 0; number < SHADER_IN_NUMBERS;) {
        if (!fragment->reads[number]) {
            number++;
            continue;
        }
        number = end_of_run(fragment, number, true);
        count++;
    }
    return count < RHW_MAX_VARYINGS;
}

// Return false, with a message, where the vertex stage does not write an input.
static bool check_input(const struct shader_interface *vertex, uint32_t number, char *message)
{
    if (vertex->writes[output_of(number)]) {
        return true;
    }
    if (number >= SHADER_IN_CLIP_DISTANCE) {
        const uint32_t distance = number - SHADER_IN_CLIP_DISTANCE;
        shader_say(message,
                   "the fragment shader reads %s distance %u, which the vertex shader does not write",
                   distance < 8 ? "clip" : "cull", (unsigned)(distance % 8));
    } else {
        const uint32_t slot = number % SHADER_IN_CENTROID;
        shader_say(
            message,
            "the fragment shader reads location %u, component %u, which the vertex shader does not write",
            (unsigned)(slot / COMPONENTS), (unsigned)(slot % COMPONENTS));
    }
    return false;
}

// What the fragment stage reads becomes varyings. Return false, with a message, where that cannot be.
static bool link_varyings(const struct shader_interface *vertex, const struct shader_interface *fragment,
                          struct shader_bytecode *vertex_code, struct shader_bytecode *fragment_code,
                          struct rhw_program *program, char *message)
{
    const bool are_apart = may_be_apart(vertex, fragment); // no derivatives are computed in vain
    uint32_t component = 0;
    for (uint32_t number = 0; number < SHADER_IN_NUMBERS;) {
        if (!fragment->reads[number]) {
            number++;
            continue;
        }
        const uint32_t end = end_of_run(fragment, number, are_apart);
        // One of each is kept for W.
        if (program->varying_count == RHW_MAX_VARYINGS - 1 ||
            component + end - number >= RHW_MAX_VARYING_COMPONENTS) {
            shader_say(message, "the fragment shader reads more than %d components of inputs",
                       RHW_MAX_VARYING_COMPONENTS - 1);
            return false;
        }
        add_varying(program, fragment, number, end);
        for (; number < end; number++) {
            if (!check_input(vertex, number, message)) {
                return false;
            }
            const unsigned linear = SHADER_FLAT | SHADER_NOPERSPECTIVE;
            fragment_code->is_linear[number] = (fragment->interpolation[number] & linear) != 0;
            vertex_code->component_of[number] = fragment_code->component_of[number] = (uint8_t)component++;
        }
    }
    if (fragment->needs_w) {
        program->varyings[program->varying_count++] =
            (struct rhw_varying){.components = 1, .derivatives = true};
        vertex_code->w_component = fragment_code->w_component = (uint8_t)component;
    }
    return true;
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

bool shader_link(const struct shader_interface *vertex, const struct shader_interface *fragment,
                 struct shader_bytecode *vertex_code, struct shader_bytecode *fragment_code,
                 struct rhw_program *program, char *message)
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
    if (!link_varyings(vertex, reader, vertex_code, fragment ? fragment_code : vertex_code, program,
                       message)) {
        return false;
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
    return true;
}
