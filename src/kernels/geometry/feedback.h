// SPDX-License-Identifier: MIT
// Transform feedback of a run: the vertices of its primitives are copied from their records to the places that the draw
// has.
#ifndef RHW_GEOMETRY_FEEDBACK_H
#define RHW_GEOMETRY_FEEDBACK_H

#include "pipeline/pipeline.h"
#include "draw/draw_list.h"
#include "geometry_scratch.h"

// Copy what a pipeline captures of a vertex. `number` is that of the vertex among those of the draw.
RHW_INLINE void capture_vertex(const struct rhw_pipeline_data *pipeline,
                               const struct rhw_draw_feedback *feedback, const float *record, uint64_t number)
{
    for (int i = 0; i < pipeline->def.feedback_output_count; i++) {
        const struct rhw_feedback_copy *const copy = &pipeline->feedback[i];
        const size_t stride = pipeline->def.feedback_strides[copy->target];
        memcpy(feedback->to[copy->target] + (size_t)number * stride + copy->offset, record + copy->first,
               (size_t)copy->count * sizeof(float));
    }
}

static void capture_run(const struct rhw_segment *segment, const struct rhw_run *run)
{
    const struct rhw_draw *const draw = segment->draw;
    const struct rhw_draw_feedback *const feedback = draw->feedback;
    const struct rhw_pipeline_data *const pipeline = draw->state->pipeline;
    const uint64_t first = (uint64_t)segment->instance * draw->triangles_per_instance + run->first_primitive;
    for (uint32_t i = 0; i < run->count && first + i < feedback->primitives; i++) {
        for (int v = 0; v < feedback->vertices; v++) {
            const uint32_t slot = run->indices[i][v] - run->first_slot;
            const float *const record = segment->vertices + (size_t)slot * (size_t)segment->vertex_stride;
            capture_vertex(pipeline, feedback, record,
                           (first + i) * (uint64_t)feedback->vertices + (uint64_t)v);
        }
    }
}

// Capture the chunk's runs of which the pass asks for it.
static __attribute__((noinline)) void capture_runs(const struct rhw_geometry_scratch *scratch)
{
    for (int i = 0; i < scratch->run_count; i++) {
        if (scratch->segments[i].draw->feedback) {
            capture_run(&scratch->segments[i], &scratch->runs[i]);
        }
    }
}

#endif
