// SPDX-License-Identifier: MIT
// A tile chooses the order in which it draws its triangles. Bins that follow each other and may be drawn in another
// order than that of submission (draw/hidden_surface.h) are a run of bins, and for each run the cheapest order is
// chosen.
#ifndef RHW_TILE_ORDER_H
#define RHW_TILE_ORDER_H

#include "triangle_planes.h"

// Some of the tile's bins, one after the other.
struct bin_run {
    const struct bin *first, *end;
};

// Estimate how many pixels a triangle covers in the tile.
static double area_in_tile(const struct tile_work *work, const struct rhw_triangle *t)
{
    const struct tile_rect rect = rect_of(work, t);
    const double rectangle = (rect.x1 - rect.x0) * (rect.y1 - rect.y0);
    if (t->flags & RHW_TRIANGLE_POLYGON) {
        return rectangle / 2;
    }
    const double x1 = t->x_24_8[1] - t->x_24_8[0], y1 = t->y_24_8[1] - t->y_24_8[0];
    const double x2 = t->x_24_8[2] - t->x_24_8[0], y2 = t->y_24_8[2] - t->y_24_8[0];
    const double turn = x1 * y2 - x2 * y1,
                 area = (turn < 0 ? -turn : turn) / (2 * RHW_SUBPIXEL * RHW_SUBPIXEL);
    return area < rectangle ? area : rectangle;
}

// Return true if the triangles of a run lie above each other so much that drawing depth first costs less than shading
// what is hidden, half of which the depth test would have stopped. The areas of some of the triangles decide. Measured:
// depth costs 3 ns a pixel and 60 ns a triangle more; shading costs 9 ns a pixel, with textures 18.
static bool overdraws(const struct tile_work *work, struct bin_run run)
{
    enum { SAMPLES = 64 };
    const struct tile_rect *const area = &work->area;
    const double tile_pixels = (area->x1 - area->x0) * (area->y1 - area->y0);
    const double shading_ns = 9, textured_ns = 18, depth_ns = 3, triangle_ns = 60;
    uint32_t count = 0;
    for (const struct bin *bin = run.first; bin < run.end; bin++) {
        count += bin->end - bin->first;
    }
    if (count > RHW_DEPTH_FIRST_TRIANGLES) {
        return false;
    }
    const uint32_t step = count / SAMPLES + 1;
    uint32_t next = 0; // index in the bin under way
    double covered = 0;
    for (const struct bin *bin = run.first; bin < run.end; bin++) {
        for (; next < bin->end - bin->first; next += step) {
            covered +=
                step * area_in_tile(work, &bin->chunk->triangles[bin->chunk->entries[bin->first + next]]);
        }
        next -= bin->end - bin->first;
    }
    const struct rhw_draw *const draw = run.first->chunk->segments[0].draw;
    const double pixel_ns = draw->state->pipeline->any_derivatives ? textured_ns : shading_ns;
    return (covered - tile_pixels) / 2 * pixel_ns > covered * depth_ns + count * triangle_ns;
}

// Return the run from `first` on: one bin at least, and the bins behind it that can be drawn in the same orders, be it
// depth first, backwards or neither.
static struct bin_run run_from(const struct bin *first, const struct bin *end)
{
    struct bin_run run = {first, first + 1};
    while (run.end < end && rhw_hidden_rule_equal(run.end->chunk->hidden, first->chunk->hidden)) {
        run.end++;
    }
    return run;
}

// Return how a run is drawn.
static enum rhw_tile_order choose_order(const struct tile_work *work, struct bin_run run)
{
    const enum rhw_hidden_surface hidden = run.first->chunk->hidden.kind;
    return hidden == RHW_HIDDEN_BACKWARDS                             ? RHW_TILE_BACKWARDS
           : hidden == RHW_HIDDEN_DEPTH_FIRST && overdraws(work, run) ? RHW_TILE_DEPTH_FIRST
                                                                      : RHW_TILE_IN_ORDER;
}

#endif
