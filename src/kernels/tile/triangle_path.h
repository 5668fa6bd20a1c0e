// SPDX-License-Identifier: MIT
// On which path a triangle is drawn in a tile: path_of decides it, of the plan of the draw and of what the setup of 8
// triangles has found, and draw_run in tile.c takes it. All paths give the same bytes. Triangles of a batch that follow each
// other on the same path are a run.
#ifndef RHW_TRIANGLE_PATH_H
#define RHW_TRIANGLE_PATH_H

#include "draw_state.h"
#include "triangle_setup8.h"

enum triangle_path {
    TRIANGLE_SKIPPED, // nothing of it is drawn in this phase
    // Where a pixel has one sample:
    TRIANGLE_TINY,  // pixel by pixel: triangle_tiny.h
    TRIANGLE_SMALL, // in blocks that start where the triangle does: triangle_small.h
    TRIANGLE_SPANS, // a small one that has none of these two paths: triangle_large.h
    TRIANGLE_LARGE, // in blocks of the tile: triangle_large.h
    // Where a pixel has several samples:
    TRIANGLE_TINY_SAMPLES,  // 4 samples, in cells: triangle_tiny_samples.h
    TRIANGLE_SMALL_SAMPLES, // triangle_small_samples.h
    TRIANGLE_LARGE_SAMPLES, // triangle_multisample.h
    // Where a pixel has any number of samples (triangle_shape.h):
    TRIANGLE_SHAPE,        // not what the triangle covers is drawn, but what its flags say
    TRIANGLE_STIPPLED_LINE // what it covers, without what a stipple leaves out
};

// The path of triangle i of a batch, which belongs to the draw under way.
RHW_INLINE enum triangle_path path_of(const struct tile_work *work, const struct triangle_setup8 *setup,
                                      int i)
{
    const struct rhw_draw_plan *const plan = &work->plan;
    const bool has_samples = work->samples > 1;
    if (plan->draws_tiny && setup->tiny >> i & 1) {
        return has_samples ? TRIANGLE_TINY_SAMPLES : TRIANGLE_TINY;
    }
    if (plan->draws_small && setup->small >> i & 1) {
        return has_samples ? TRIANGLE_SMALL_SAMPLES : TRIANGLE_SMALL;
    }
    const uint16_t flags = setup->read->triangle[i]->flags;
    if (plan->is_skipped) {
        return TRIANGLE_SKIPPED;
    }
    if (flags & (RHW_TRIANGLE_LINE | RHW_TRIANGLE_SMOOTH | RHW_TRIANGLE_CONSERVATIVE)) {
        return TRIANGLE_SHAPE;
    }
    if (flags & RHW_TRIANGLE_STIPPLE) {
        return TRIANGLE_STIPPLED_LINE;
    }
    if (has_samples) {
        return TRIANGLE_LARGE_SAMPLES;
    }
    return plan->draws_spans && flags & RHW_TRIANGLE_SMALL ? TRIANGLE_SPANS : TRIANGLE_LARGE;
}

// Triangles first .. end − 1 of a batch: they belong to the draw under way and have one path.
struct triangle_run {
    struct tile_work *work;
    const struct rhw_chunk *chunk;
    const struct triangle_setup8 *setup;
    enum triangle_path path;
    int first, end;
};

RHW_INLINE const struct rhw_draw *draw_of(const struct rhw_chunk *chunk, const struct triangle_setup8 *setup,
                                          int i)
{
    return chunk->segments[setup->read->triangle[i]->segment].draw;
}

// The run that begins with triangle `first`, whose draw begins.
RHW_INLINE struct triangle_run run_of(struct tile_work *work, const struct rhw_chunk *chunk,
                                      const struct triangle_setup8 *setup, int first)
{
    const struct rhw_draw *const draw = draw_of(chunk, setup, first);
    begin_draw(work, draw);
    const enum triangle_path path = path_of(work, setup, first);
    int end = first + 1;
    while (end < setup->read->count && (setup->is_one_segment || draw_of(chunk, setup, end) == draw) &&
           path_of(work, setup, end) == path) {
        end++;
    }
    return (struct triangle_run){work, chunk, setup, path, first, end};
}

// Makes triangle i of a run ready for its path.
RHW_INLINE void begin_triangle(struct triangle_work *triangle, const struct triangle_run *run, int i)
{
    const struct triangle_setup8 *const setup = run->setup;
    triangle->chunk = run->chunk;
    triangle->t = setup->read->triangle[i];
    triangle->segment = &run->chunk->segments[triangle->t->segment];
    triangle->setup = setup;
    triangle->lane = i;
    triangle->clamps_depth = setup->clamps >> i & 1;
    triangle->depth_bias = run->work->plan.is_biased ? setup->depth_bias[i] : 0;
    triangle->clipped = NULL;
    triangle->has_planes = triangle->has_values = false;
}

#endif
