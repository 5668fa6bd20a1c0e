// SPDX-License-Identifier: MIT
// On which path a triangle is drawn in a tile: path_of decides it, of the plan of the draw and of what the setup of 8
// triangles has found, and draw_triangles in tile.c takes it. All paths give the same bytes. Triangles of a batch
// that follow each other on the same path are a run.
#ifndef RHW_TRIANGLE_PATH_H
#define RHW_TRIANGLE_PATH_H

#include "kernels/integer.h"
#include "triangle_run.h"

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
    TRIANGLE_LARGE_SAMPLES, // triangle_large_samples.h
    // Where a pixel has any number of samples (triangle_shape.h):
    TRIANGLE_SHAPE,        // not what the triangle covers is drawn, but what its flags say
    TRIANGLE_STIPPLED_LINE // what it covers, without what a stipple leaves out
};

// The path of a triangle, and the triangles of its batch that have this path too, a bit each, as far as they are of
// its draw.
struct path_choice {
    enum triangle_path path;
    unsigned alike;
};

// Chooses the path of triangle i of a batch, which belongs to the draw under way.
RHW_INLINE struct path_choice path_of(const struct tile_work *work, const struct triangle_setup8 *setup,
                                      int i)
{
    const struct rhw_draw_plan *const plan = &work->plan;
    const bool has_samples = work->samples > 1;
    const unsigned tiny = plan->draws_tiny ? setup->tiny : 0, alone = 1u << i;
    const unsigned small = plan->draws_small ? setup->small & ~tiny : 0;
    if (tiny & alone) {
        return (struct path_choice){has_samples ? TRIANGLE_TINY_SAMPLES : TRIANGLE_TINY, tiny};
    }
    if (small & alone) {
        return (struct path_choice){has_samples ? TRIANGLE_SMALL_SAMPLES : TRIANGLE_SMALL, small};
    }
    const uint16_t flags = setup->read->triangle[i]->flags;
    if (plan->is_skipped) {
        return (struct path_choice){TRIANGLE_SKIPPED, alone};
    }
    if (flags & (RHW_TRIANGLE_LINE | RHW_TRIANGLE_SMOOTH | RHW_TRIANGLE_CONSERVATIVE)) {
        return (struct path_choice){TRIANGLE_SHAPE, alone};
    }
    if (flags & RHW_TRIANGLE_STIPPLE) {
        return (struct path_choice){TRIANGLE_STIPPLED_LINE, alone};
    }
    if (has_samples) {
        return (struct path_choice){TRIANGLE_LARGE_SAMPLES, alone};
    }
    return (struct path_choice){
        plan->draws_spans && flags & RHW_TRIANGLE_SMALL ? TRIANGLE_SPANS : TRIANGLE_LARGE, alone};
}

RHW_INLINE const struct rhw_draw *draw_of(const struct rhw_chunk *chunk, const struct triangle_setup8 *setup,
                                          int i)
{
    return chunk->segments[setup->read->triangle[i]->segment].draw;
}

// Returns the end of the run of triangles from `first` on that are `alike`, which has `first`, and of one draw.
RHW_INLINE int end_of_run(const struct rhw_chunk *chunk, const struct triangle_setup8 *setup, int first,
                          unsigned alike)
{
    const int most = min_int(first + __builtin_ctz(~(alike >> first)), setup->read->count);
    if (setup->is_one_segment) {
        return most;
    }
    const struct rhw_draw *const draw = draw_of(chunk, setup, first);
    int end = first + 1;
    while (end < most && draw_of(chunk, setup, end) == draw) {
        end++;
    }
    return end;
}

#endif
