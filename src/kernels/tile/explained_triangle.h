// SPDX-License-Identifier: MIT
// The history of a sample is told triangle by triangle: what is there before, the triangle drawn as any other, what is
// there afterwards. explained_fragment.h records what happens between.
#ifndef RHW_EXPLAINED_TRIANGLE_H
#define RHW_EXPLAINED_TRIANGLE_H

#include "kernels/fragment/expand.h"
#include "kernels/texel/texel_codec.h"
#include "kernels/raster/coverage.h"
#include "triangle_run.h"

static void read_sample(const struct tile_work *work, struct sample_content *content)
{
    const struct rhw_explained *const e = work->explained;
    struct rhw_tile_scratch *const scratch = work->scratch;
    const int at = e->y * RHW_TILE + e->x, row = at & -8, sample = e->ask.sample;
    const struct tile_depth *const depth = depth_of_sample(scratch, sample);
    const bool has_own = work->samples == 1 || scratch->expanded >> block_of_texel(at) & 1;
    memset(content, 0, sizeof *content);
    content->depth = work->target->has_depth ? depth->texels[at] : 0.0f;
    content->stencil = work->target->has_stencil ? depth->stencil[at] : 0;
    for (int t = 0; t < work->target->color_count; t++) {
        const struct rhw_format_info *const format = rhw_format_info(work->target->colors[t].format);
        struct raw_texels raw = {{{0}}};
        f32x8 lanes[4];
        load_texel_row(format->size,
                       color_of_sample(scratch, t, has_own ? sample : 0) + (size_t)row * format->size, &raw);
        decode_texels(format, &raw, lanes);
        for (int c = 0; c < 4; c++) {
            content->color[t][c] = lanes[c][at - row];
        }
    }
}

static void describe_triangle(struct rhw_explained *e, const struct rhw_segment *segment,
                              const struct rhw_triangle *t, const struct sample_origin *sample)
{
    struct rhw_explained_fragment *const f = &e->fragment;
    const struct rhw_pipeline_data *const pipeline = segment->draw->state->pipeline;
    const struct rhw_primitive_id id = rhw_primitive_id_of(segment, t->primitive);
    f->draw = segment->draw->index;
    f->instance = id.instance;
    f->primitive = id.primitive;
    f->label = pipeline->def.label ? pipeline->def.label : "";
    f->front_facing = !(t->flags & RHW_TRIANGLE_BACK);
    f->is_clipped = t->flags & RHW_TRIANGLE_POLYGON;
    f->is_snapped = !(t->flags & RHW_TRIANGLE_UNSNAPPED);
    f->sample_x = (int32_t)sample->x;
    f->sample_y = (int32_t)sample->y;
    for (int i = 0; i < 3; i++) {
        const struct rhw_vertex_record *const vertex = record_at(segment, t->vertex[i]);
        const int j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
        memcpy(f->position[i], vertex->position, sizeof f->position[i]);
        f->vertex_varyings[i] = vertex->varyings;
        f->x[i] = f->is_snapped ? vertex->x_24_8 : 0;
        f->y[i] = f->is_snapped ? vertex->y_24_8 : 0;
        f->edge[i] = f->is_clipped ? 0
                                   : edge_value(t->x_24_8[j], t->y_24_8[j], t->x_24_8[k], t->y_24_8[k],
                                                t->flags & RHW_TRIANGLE_NEGATIVE ? -1 : 1, *sample);
    }
    f->bindings = segment->draw->bindings;
    f->component_count = pipeline->varying_components;
    f->varyings = e->varyings;
    f->ddx = e->ddx;
    f->ddy = e->ddy;
    f->qualifiers = pipeline->component_qualifier;
    f->has_derivatives = pipeline->component_derivatives;
}

static enum rhw_fragment_fate fate_of(const struct tile_work *work)
{
    const struct rhw_explained *const e = work->explained;
    if (!e->passed) {
        return RHW_FRAGMENT_FAILED_EARLY;
    }
    if (e->written || work->plan.shading == RHW_SHADING_NONE) {
        return RHW_FRAGMENT_WRITTEN;
    }
    return e->discarded || work->plan.depth_mode < RHW_DEPTH_LATE ? RHW_FRAGMENT_DISCARDED
                                                                  : RHW_FRAGMENT_FAILED_LATE;
}

// Begin the history of a triangle before it is drawn.
void RHW_ISA_NAME(rhw_explain_begin)(struct tile_work *work, struct sample_content *before)
{
    struct rhw_explained *const e = work->explained;
    RHW_ISA_NAME(rhw_flush)(work);
    memset(&e->fragment, 0, sizeof e->fragment);
    e->passed = e->discarded = e->written = false;
    read_sample(work, before);
}

// End the history of a triangle after it is drawn, and report it if the triangle covers the sample.
void RHW_ISA_NAME(rhw_explain_end)(struct tile_work *work, const struct sample_content *before,
                                   const struct triangle_work *triangle)
{
    struct rhw_explained *const e = work->explained;
    struct rhw_explained_fragment *const f = &e->fragment;
    const struct sample_origin sample = {
        (int64_t)(work->x + e->x) * RHW_SUBPIXEL + work->target->pattern->x_0_8[e->ask.sample],
        (int64_t)(work->y + e->y) * RHW_SUBPIXEL + work->target->pattern->y_0_8[e->ask.sample]};
    struct sample_content after;
    RHW_ISA_NAME(rhw_flush)(work);
    if (!(f->covered >> e->ask.sample & 1)) {
        return;
    }
    read_sample(work, &after);
    describe_triangle(e, triangle->segment, triangle->t, &sample);
    f->fate = fate_of(work);
    f->depth_before = before->depth;
    f->depth_after = after.depth;
    f->stencil_before = before->stencil;
    f->stencil_after = after.stencil;
    memcpy(f->color_before, before->color, sizeof before->color);
    memcpy(f->color_after, after.color, sizeof after.color);
    e->ask.fragment(e->ask.user, f);
}

#endif
