// SPDX-License-Identifier: MIT
// A run has triangles of a batch that follow each other and are drawn on one path (triangle_path.h). The functions here
// draw them one after the other.
#ifndef RHW_TRIANGLE_RUN_H
#define RHW_TRIANGLE_RUN_H

#include "kernels/tile_units.h"
#include "triangle_setup8.h"

// Triangles first .. end − 1 of a batch, which belong to the draw under way.
struct triangle_run {
    struct tile_work *work;
    const struct rhw_chunk *chunk;
    const struct triangle_setup8 *setup;
    int first, end;
};

// Make triangle i of a run ready for its path, but for what begin_any and begin_plain set.
RHW_INLINE void begin_triangle(struct triangle_work *triangle, const struct triangle_run *run, int i)
{
    triangle->chunk = run->chunk;
    triangle->t = run->setup->read->triangle[i];
    triangle->segment = &run->chunk->segments[triangle->t->segment];
    triangle->setup = run->setup;
    triangle->lane = i;
    triangle->has_planes = triangle->has_values = false;
}

// Make a triangle ready for a path that takes any. `clipped` is room for what clipping adds to its planes.
RHW_INLINE void begin_any(const struct tile_work *work, struct triangle_work *triangle,
                          struct clipped_planes *clipped)
{
    const struct triangle_setup8 *const setup = triangle->setup;
    triangle->clipped = triangle->t->flags & RHW_TRIANGLE_POLYGON ? clipped : NULL;
    triangle->clamps_depth = setup->clamps >> triangle->lane & 1;
    triangle->depth_bias = work->plan.is_biased ? setup->depth_bias[triangle->lane] : 0;
}

// Make a small triangle ready for a path that asks for clipping, clamping and bias: it is neither clipped nor clamped,
// and its planes in the setup have its bias.
RHW_INLINE void begin_plain(struct triangle_work *triangle)
{
    triangle->clipped = NULL;
    triangle->clamps_depth = false;
    triangle->depth_bias = 0;
}

// Keep for the second of two phases that a triangle of the run was seen in the first.
RHW_INLINE void see_triangle(const struct tile_work *work, uint32_t number)
{
    work->scratch->seen[number / 8] |= (uint8_t)(1u << number % 8);
}

// Return true if no sample of the tile but the first is open, when triangles are drawn backwards.
static __attribute__((noinline)) bool others_are_closed(const struct tile_work *work)
{
    int open = 0;
    for (int s = 1; s < work->samples && open == 0; s++) {
        open = depth_of_sample(work->scratch, s)->open_count;
    }
    return open == 0;
}

// Return true if what is left of the tile's bins is hidden.
RHW_INLINE bool is_hidden(const struct tile_work *work)
{
    return work->phase == RHW_PHASE_BACKWARDS && work->scratch->depth.open_count == 0 &&
           others_are_closed(work);
}

// A function that draws a triangle that begin_triangle has made ready.
typedef void draw_triangle_function(struct tile_work *work, struct triangle_work *triangle);

// Draw the triangles of a run by a function, which is inlined.
RHW_INLINE void draw_each(const struct triangle_run *run, draw_triangle_function *draw)
{
    struct tile_work *const work = run->work;
    for (int i = run->first; i < run->end && !is_hidden(work); i++) {
        struct triangle_work triangle;
        begin_triangle(&triangle, run, i);
        work->scratch->depth.marked = false;
        draw(work, &triangle);
        if (work->phase == RHW_PHASE_DEPTH && work->scratch->depth.marked) {
            see_triangle(work, run->setup->read->number[i]);
        }
    }
}

// Draw the triangles of a run by a function of the general path, and tell the history of a sample if it is asked for.
RHW_INLINE void draw_each_explained(const struct triangle_run *run, draw_triangle_function *draw)
{
    struct tile_work *const work = run->work;
    if (!work->explained) {
        draw_each(run, draw);
        return;
    }
    for (int i = run->first; i < run->end; i++) {
        struct triangle_work triangle;
        struct sample_content before;
        begin_triangle(&triangle, run, i);
        RHW_ISA_NAME(rhw_explain_begin)(work, &before);
        draw(work, &triangle);
        RHW_ISA_NAME(rhw_explain_end)(work, &before, &triangle);
    }
}

#endif
