// SPDX-License-Identifier: MIT
// A triangle is drawn in a tile on one of these paths: path_of decides it, by the plan of the draw and by what the
// setup of 8 triangles has found, and draw_triangles in tile.c takes it. All paths give the same bytes. Triangles of a
// batch that follow each other on one path are a run.
#ifndef RHW_TRIANGLE_PATH_H
#define RHW_TRIANGLE_PATH_H

#include "kernels/integer.h"
#include "triangle_run.h"

enum triangle_path {
    TRIANGLE_SKIPPED, // no drawing in this phase
    // Paths where a pixel has one sample:
    TRIANGLE_TINY,  // tiny triangles, pixel by pixel: triangle_tiny.h
    TRIANGLE_SMALL, // small triangles, in blocks that start where the triangle does: triangle_small.h
    TRIANGLE_SPANS, // small triangles that have no path above, by spans: triangle_large.h
    TRIANGLE_LARGE, // triangles of any size, in blocks of the tile: triangle_large.h
    // Paths where a pixel has several samples:
    TRIANGLE_TINY_SAMPLES,  // tiny triangles with 4 samples, in cells: triangle_tiny_samples.h
    TRIANGLE_SMALL_SAMPLES, // small triangles: triangle_small_samples.h
    TRIANGLE_LARGE_SAMPLES, // triangles of any size: triangle_large_samples.h
    // Paths where a pixel has any number of samples (triangle_shape.h):
    TRIANGLE_SHAPE,        // shape that the triangle's flags say, instead of what it covers
    TRIANGLE_STIPPLED_LINE // pixels that the triangle covers, without what a stipple leaves out
};

// The path of a triangle, and the triangles of its batch and draw that have this path too, a bit each.
struct path_choice {
    enum triangle_path path;
    unsigned alike;
};

// Choose the path of triangle i of a batch, which belongs to the draw under way.
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

// Return the end of the run of triangles from `first` on that are `alike` and of one draw. `first` is among them.
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
