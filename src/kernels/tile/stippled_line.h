// SPDX-License-Identifier: MIT
// Half a rectangular line with a stipple is drawn in a tile: it has the samples that the triangle covers and the
// stipple draws.
#ifndef RHW_STIPPLED_LINE_H
#define RHW_STIPPLED_LINE_H

#include "kernels/raster/coverage.h"
#include "kernels/raster/stipple_mask.h"
#include "kernels/tile_work.h"

struct stippled_line {
    struct stippled_rectangle rectangle;
    struct coverage coverage[RHW_MAX_SAMPLES];
};

// Return the position of sample s of the tile's first pixel.
static struct sample_origin origin_of_sample(const struct tile_work *work, int s)
{
    const struct rhw_sample_pattern *const pattern = work->target->pattern;
    return (struct sample_origin){(int64_t)work->x * RHW_SUBPIXEL + pattern->x_0_8[s],
                                  (int64_t)work->y * RHW_SUBPIXEL + pattern->y_0_8[s]};
}

static void set_stippled_line(struct stippled_line *line, const struct tile_work *work,
                              const struct rhw_chunk *chunk, const struct rhw_triangle *t)
{
    line->rectangle = stippled_rectangle_of(t, &work->state->stipple);
    for (int s = 0; s < work->samples; s++) {
        coverage_setup(&line->coverage[s], chunk, t, origin_of_sample(work, s));
    }
}

// Return the pixels of the block at (x, y) of the tile whose sample s is drawn.
static uint64_t stippled_line_mask(const struct stippled_line *line, const struct tile_work *work, int x,
                                   int y, int s)
{
    const struct sample_origin origin = origin_of_sample(work, s);
    const bool is_drawn = work->pipeline->def.sample_mask >> s & 1;
    const uint64_t covered = is_drawn ? coverage_mask(&line->coverage[s], x, y) : 0;
    return covered == 0 ? 0
                        : covered & stippled_samples(&line->rectangle, origin.x + x * RHW_SUBPIXEL,
                                                     origin.y + y * RHW_SUBPIXEL);
}

#endif
