// SPDX-License-Identifier: MIT
// Lines that a plane may cut, or that have an end that cannot be snapped. What is left of a line is a line between two
// vertices that are made here, with the values of the line there. The values are rounded to float once more than those
// of other lines. Where a line is cut at the guard band they are exact in space, and the vertices lie far outside the
// view.
#ifndef RHW_CLIPPED_LINE_H
#define RHW_CLIPPED_LINE_H

#include "draw/clip.h"
#include "lines8.h"
#include "made_vertices.h"
#include "projection.h"

// Make the varyings at `t` of the line, counted in clip space.
static void line_varyings(struct rhw_vertex_record *out, const struct rhw_pipeline_data *pipeline,
                          const struct rhw_vertex_record *const v[2], double t)
{
    const double w0 = (double)v[0]->position[3], w1 = (double)v[1]->position[3];
    const double on_screen = t * w1 / (w0 + t * (w1 - w0));
    const float *const provoking = v[pipeline->def.provoking == RHW_PROVOKING_FIRST ? 0 : 1]->varyings;
    for (int i = 0; i < pipeline->varying_components; i++) {
        const double a = (double)v[0]->varyings[i], b = (double)v[1]->varyings[i];
        const bool flat = pipeline->component_qualifier[i] == RHW_FLAT;
        const double at = pipeline->component_qualifier[i] == RHW_NOPERSPECTIVE ? on_screen : t;
        out->varyings[i] = flat ? provoking[i] : a == b ? v[0]->varyings[i] : (float)(a + at * (b - a));
    }
}

// Put what is left of line `lane`, whose vertices are of the run, in its place. Return false where nothing is left, or
// where memory ran out, which the scratch remembers.
static __attribute__((noinline)) bool clip_line_lane(struct rhw_geometry_scratch *scratch, uint32_t run,
                                                     struct lines8 *l, int lane)
{
    const struct rhw_segment *const segment = &scratch->segments[run];
    const struct rhw_draw_state *const state = segment->draw->state;
    const struct rhw_vertex_record *v[2];
    double t[2];
    for (int i = 0; i < 2; i++) {
        v[i] = record_at(&scratch->segments[l->segment[lane]], (uint32_t)l->vertex[i][lane]);
    }
    uint32_t number, slot;
    if (!rhw_clip_line(state, v, t)) {
        return false;
    }
    struct rhw_vertex_record *const made = make_vertices(scratch, run, 2, &number, &slot);
    if (!made) {
        return false;
    }
    f32x8 position[4], header[8];
    for (int c = 0; c < 4; c++) {
        const double a = (double)v[0]->position[c], b = (double)v[1]->position[c];
        position[c] = f32x8_splat((float)(a + t[0] * (b - a)));
        position[c][1] = t[1] == 1 ? v[1]->position[c] : (float)(a + t[1] * (b - a));
    }
    if (!(position[3][0] > 0 && position[3][1] > 0)) {
        return false;
    }
    project(state, position, header);
    for (int i = 0; i < 2; i++) {
        struct rhw_vertex_record *const out =
            (struct rhw_vertex_record *)(void *)((float *)(void *)made + i * segment->vertex_stride);
        out->x_24_8 = l->x[i][lane] = ((i32x8)header[0])[i];
        out->y_24_8 = l->y[i][lane] = ((i32x8)header[1])[i];
        out->depth = header[2][i];
        out->flags = 0;
        for (int c = 0; c < 4; c++) {
            out->position[c] = position[c][i];
        }
        line_varyings(out, state->pipeline, v, t[i]);
        l->vertex[i][lane] = (int32_t)slot + i;
    }
    l->segment[lane] = (int32_t)number;
    l->flags[lane] |= RHW_TRIANGLE_CLAMP;
    return true;
}

#endif
