// SPDX-License-Identifier: MIT
// The rules of transform feedback's outputs, and where each output lies in a vertex record.
#include "feedback_layout.h"

#include "context/misuse.h"
#include "shaded_vertex.h"

// Return the floats that the vertex function writes of a source, which is one that the program has.
static int components_of(const struct rhw_program *program, const struct rhw_feedback_output *output)
{
    switch (output->source) {
    case RHW_FEEDBACK_POSITION: return 4;
    case RHW_FEEDBACK_VARYING: return program->varyings[output->index].components;
    case RHW_FEEDBACK_POINT_SIZE: return program->writes_point_size ? 1 : 0;
    case RHW_FEEDBACK_CLIP_DISTANCES: return program->clip_distance_count;
    case RHW_FEEDBACK_CULL_DISTANCES: return program->cull_distance_count;
    }
    return 0;
}

static int count_of(const struct rhw_program *program, const struct rhw_feedback_output *output)
{
    return output->component_count == 0 ? components_of(program, output) - output->first_component
                                        : output->component_count;
}

static uint64_t end_of(const struct rhw_program *program, const struct rhw_feedback_output *output)
{
    return output->offset + sizeof(float) * (uint64_t)count_of(program, output);
}

// Return the bytes from one vertex in a target to the next.
static uint32_t stride_of(const struct rhw_pipeline_def *def, int target)
{
    uint64_t end = 0;
    for (int i = 0; i < def->feedback_output_count; i++) {
        const struct rhw_feedback_output *const output = &def->feedback_outputs[i];
        if (output->target == target && end < end_of(&def->program, output)) {
            end = end_of(&def->program, output);
        }
    }
    return def->feedback_strides[target] == 0 ? (uint32_t)end : def->feedback_strides[target];
}

static bool check_output(const struct rhw_context *context, const struct rhw_pipeline_def *def, int i,
                         const char *where)
{
    const struct rhw_feedback_output *const output = &def->feedback_outputs[i];
    if (!rhw_check(context, (unsigned)output->source <= RHW_FEEDBACK_CULL_DISTANCES,
                   "%s: feedback_outputs[%d].source is %d; it must be 0..%d", where, i, (int)output->source,
                   RHW_FEEDBACK_CULL_DISTANCES) ||
        !rhw_check(context, output->target >= 0 && output->target < RHW_MAX_FEEDBACK_TARGETS,
                   "%s: feedback_outputs[%d].target is %d; it must be 0..%d", where, i, output->target,
                   RHW_MAX_FEEDBACK_TARGETS - 1)) {
        return false;
    }
    if (!rhw_check(context,
                   output->source != RHW_FEEDBACK_VARYING ||
                       (output->index >= 0 && output->index < def->program.varying_count),
                   "%s: feedback_outputs[%d].index is %d; the program has %d varyings", where, i,
                   output->index, def->program.varying_count)) {
        return false;
    }
    const int there = components_of(&def->program, output), count = output->component_count;
    const uint32_t stride = def->feedback_strides[output->target];
    return rhw_check(
               context,
               output->first_component >= 0 && output->first_component < there && count >= 0 &&
                   count <= there - output->first_component,
               "%s: feedback_outputs[%d] asks for components from %d on, %d of them; the vertex function "
               "writes %d of that source",
               where, i, output->first_component, count, there) &&
           rhw_check(context, output->offset % 4 == 0 && stride % 4 == 0,
                     "%s: feedback_outputs[%d].offset is %u and the stride of its target %u; both must be "
                     "multiples of 4",
                     where, i, (unsigned)output->offset, (unsigned)stride) &&
           rhw_check(context, end_of(&def->program, output) <= (stride == 0 ? UINT32_MAX : stride),
                     "%s: feedback_outputs[%d] ends at byte %llu of a vertex; feedback_strides[%d] is %u",
                     where, i, (unsigned long long)end_of(&def->program, output), output->target,
                     (unsigned)stride);
}

static bool overlap(const struct rhw_program *program, const struct rhw_feedback_output *a,
                    const struct rhw_feedback_output *b)
{
    return a->target == b->target && a->offset < end_of(program, b) && b->offset < end_of(program, a);
}

bool rhw_feedback_check(const struct rhw_context *context, const struct rhw_pipeline_def *def,
                        const char *where)
{
    const int count = def->feedback_output_count;
    if (!rhw_check(context, count >= 0 && count <= RHW_MAX_FEEDBACK_OUTPUTS,
                   "%s: feedback_output_count is %d; it must be 0..%d", where, count,
                   RHW_MAX_FEEDBACK_OUTPUTS)) {
        return false;
    }
    for (int i = 0; i < count; i++) {
        if (!check_output(context, def, i, where)) {
            return false;
        }
        for (int k = 0; k < i; k++) {
            if (!rhw_check(context,
                           !overlap(&def->program, &def->feedback_outputs[i], &def->feedback_outputs[k]),
                           "%s: feedback_outputs[%d] and [%d] share bytes of target %d", where, k, i,
                           def->feedback_outputs[i].target)) {
                return false;
            }
        }
    }
    return true;
}

// Return where a source begins in a vertex record, which has position, varyings, clip distances, cull distances and
// point size.
static int float_of(const struct rhw_program *program, const struct rhw_feedback_output *output)
{
    const int header = (int)(sizeof(struct rhw_vertex_record) / sizeof(float));
    int varyings = 0, before = 0;
    for (int i = 0; i < program->varying_count; i++) {
        before += i < output->index ? program->varyings[i].components : 0;
        varyings += program->varyings[i].components;
    }
    switch (output->source) {
    case RHW_FEEDBACK_POSITION: return header - 4;
    case RHW_FEEDBACK_VARYING: return header + before;
    case RHW_FEEDBACK_CLIP_DISTANCES: return header + varyings;
    case RHW_FEEDBACK_CULL_DISTANCES: return header + varyings + program->clip_distance_count;
    case RHW_FEEDBACK_POINT_SIZE:
        return header + varyings + program->clip_distance_count + program->cull_distance_count;
    }
    return header;
}

unsigned rhw_feedback_lay_out(struct rhw_pipeline_def *def, struct rhw_feedback_copy *copies)
{
    unsigned targets = 0;
    for (int i = 0; i < def->feedback_output_count; i++) {
        const struct rhw_feedback_output *const output = &def->feedback_outputs[i];
        copies[i] =
            (struct rhw_feedback_copy){.first = float_of(&def->program, output) + output->first_component,
                                       .count = count_of(&def->program, output),
                                       .target = output->target,
                                       .offset = output->offset};
        targets |= 1u << output->target;
    }
    for (int target = 0; target < RHW_MAX_FEEDBACK_TARGETS; target++) {
        def->feedback_strides[target] = stride_of(def, target);
    }
    return targets;
}
