// SPDX-License-Identifier: MIT
// What transform feedback keeps of a vertex shader's outputs, as pipelines of librhw have it: floats of the position,
// of varyings, of the point size and of distances.
#include "link.h"
#include "message.h"

enum { NO_COMPONENT = 0xff };

static int count_components(const struct rhw_program *program)
{
    int count = 0;
    for (int i = 0; i < program->varying_count; i++) {
        count += program->varyings[i].components;
    }
    return count;
}

// Give an output a component where no fragment reads it: behind the component before it at its location, or else in a
// varying of its own. Fragments read the first `read_count` varyings. Return false if there is no room.
static bool place_output(struct shader_bytecode *vertex_code, struct rhw_program *program, int read_count,
                         uint32_t slot)
{
    uint8_t *const component = &vertex_code->component_of[slot - SHADER_OUT_VARYING];
    if (*component != NO_COMPONENT) {
        return true;
    }
    const int count = count_components(program);
    const bool goes_on = (slot - SHADER_OUT_VARYING) % 4 != 0 && program->varying_count > read_count &&
                         component[-1] == count - 1;
    if ((!goes_on && program->varying_count == RHW_MAX_VARYINGS) || count == RHW_MAX_VARYING_COMPONENTS) {
        return false;
    }
    *component = (uint8_t)count;
    if (goes_on) {
        program->varyings[program->varying_count - 1].components++;
        return true;
    }
    program->varyings[program->varying_count++] =
        (struct rhw_varying){.components = 1, .qualifier = RHW_FLAT};
    return true;
}

// Return where an output stands: its source, and the number of the varying.
static struct rhw_feedback_output output_of(const struct shader_bytecode *vertex_code,
                                            const struct rhw_program *program, uint32_t slot)
{
    struct rhw_feedback_output output = {.component_count = 1};
    if (slot >= SHADER_OUT_VARYING) {
        output.source = RHW_FEEDBACK_VARYING;
        output.first_component = vertex_code->component_of[slot - SHADER_OUT_VARYING];
        while (output.first_component >= program->varyings[output.index].components) {
            output.first_component -= program->varyings[output.index++].components;
        }
    } else if (slot >= SHADER_OUT_CULL_DISTANCE) {
        output.source = RHW_FEEDBACK_CULL_DISTANCES;
        output.first_component = (int)(slot - SHADER_OUT_CULL_DISTANCE);
    } else if (slot >= SHADER_OUT_CLIP_DISTANCE) {
        output.source = RHW_FEEDBACK_CLIP_DISTANCES;
        output.first_component = (int)(slot - SHADER_OUT_CLIP_DISTANCE);
    } else if (slot == SHADER_OUT_POINT_SIZE) {
        output.source = RHW_FEEDBACK_POINT_SIZE;
    } else {
        output.source = RHW_FEEDBACK_POSITION;
        output.first_component = (int)(slot - SHADER_OUT_POSITION);
    }
    return output;
}

// Add an output, or let the last one go on. Return false if there is no room.
static bool add_output(struct rhw_shader_feedback *feedback, const struct rhw_feedback_output *output)
{
    struct rhw_feedback_output *const last =
        feedback->output_count > 0 ? &feedback->outputs[feedback->output_count - 1] : NULL;
    if (last && last->source == output->source && last->index == output->index &&
        last->target == output->target &&
        last->first_component + last->component_count == output->first_component &&
        last->offset + 4 * (uint32_t)last->component_count == output->offset) {
        last->component_count++;
        return true;
    }
    if (feedback->output_count == RHW_MAX_FEEDBACK_OUTPUTS) {
        return false;
    }
    feedback->outputs[feedback->output_count++] = *output;
    return true;
}

bool shader_link_feedback(const struct shader_program *vertex, struct shader_bytecode *vertex_code,
                          struct rhw_program *program, struct rhw_shader_feedback *feedback, char *message)
{
    const int read_count = program->varying_count;
    for (uint32_t i = 0; i < vertex->capture_count; i++) {
        const struct shader_capture *const capture = &vertex->captures[i];
        for (uint32_t c = 0; c < capture->count; c++) {
            const uint32_t slot = capture->slot + c;
            if (!vertex->writes[slot]) {
                continue; // what nothing writes has no value
            }
            const bool is_placed =
                slot < SHADER_OUT_VARYING || place_output(vertex_code, program, read_count, slot);
            struct rhw_feedback_output output =
                is_placed ? output_of(vertex_code, program, slot) : (struct rhw_feedback_output){.index = 0};
            output.target = (int)capture->buffer;
            output.offset = capture->offset + 4 * c;
            if (!is_placed || !add_output(feedback, &output)) {
                shader_say(message,
                           "transform feedback keeps more than %d outputs of the vertex shader, or "
                           "fragments and it read more than %d components",
                           RHW_MAX_FEEDBACK_OUTPUTS, RHW_MAX_VARYING_COMPONENTS);
                return false;
            }
        }
    }
    for (int i = 0; i < RHW_MAX_FEEDBACK_TARGETS; i++) {
        feedback->strides[i] = vertex->strides[i];
    }
    return true;
}
