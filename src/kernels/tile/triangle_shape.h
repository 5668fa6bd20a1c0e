// SPDX-License-Identifier: MIT
// Some triangles stand for another shape than their own: Bresenham lines, smooth lines, pixels of conservative
// rasterization, and lines with a stipple. Every block of the triangle's rectangle is asked for the pixels of the
// shape.
#ifndef RHW_TRIANGLE_SHAPE_H
#define RHW_TRIANGLE_SHAPE_H

#include "kernels/raster/conservative.h"
#include "kernels/raster/line_pixels.h"
#include "kernels/raster/smooth_coverage.h"
#include "stippled_line.h"
#include "triangle_large.h"
#include "sampled_block.h"

// A shape that has pixels rather than samples: a Bresenham line, a smooth line, or the pixels of conservative
// rasterization.
struct pixel_shape {
    bool is_line, is_smooth;
    struct line_pixels line;
    struct smooth_line smooth;
    struct stippled_rectangle stipple; // stipple of the smooth line
    struct conservative_edges edges;
    bool tells_contained; // true if `contained` has the edges of pixels that are contained
    struct conservative_edges contained;
};

// Set the shape of a triangle. Return false if the tile has nothing of it.
static bool set_shape(const struct tile_work *work, const struct rhw_triangle *t,
                      const struct rhw_chunk *chunk, struct pixel_shape *shape)
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    shape->is_line = t->flags & RHW_TRIANGLE_LINE;
    shape->is_smooth = t->flags & RHW_TRIANGLE_SMOOTH;
    shape->tells_contained = false;
    if (shape->is_line) {
        shape->line = line_pixels_of(t, work->state->line_pixels);
        return true;
    }
    if (shape->is_smooth) {
        smooth_line_set(&shape->smooth, t, work->x, work->y);
        shape->stipple = stippled_rectangle_of(t, &work->state->stipple);
        return true;
    }
    const struct sample_origin origin = center_of_pixel(work->x, work->y);
    shape->tells_contained = pipeline->def.program.uses & RHW_USE_FULLY_COVERED &&
                             conservative_setup(&shape->contained, chunk, t, true, origin);
    return conservative_setup(&shape->edges, chunk, t,
                              pipeline->def.conservative == RHW_CONSERVATIVE_UNDERESTIMATE, origin);
}

// Return the pixels of a Bresenham line in the block at (x, y) of the tile.
static uint64_t line_shape_mask(const struct tile_work *work, const struct rhw_triangle *t,
                                const struct line_pixels *line, int x, int y)
{
    const uint64_t mask = line_mask(line, work->x + x, work->y + y);
    return t->flags & RHW_TRIANGLE_STIPPLE && mask != 0
               ? mask & stippled_columns(t, &work->state->stipple, line->is_y_major, work->x + x, work->y + y)
               : mask;
}

// Return the pixels of any shape in the block at (x, y) of the tile. `coverage` gets how much of them a smooth line
// covers.
static uint64_t shape_mask(const struct tile_work *work, const struct rhw_triangle *t,
                           const struct pixel_shape *shape, int x, int y, f32x8 coverage[RHW_BLOCK])
{
    if (shape->is_line) {
        return line_shape_mask(work, t, &shape->line, x, y);
    }
    if (!shape->is_smooth) {
        return conservative_mask(&shape->edges, x, y);
    }
    const uint64_t mask = smooth_mask(&shape->smooth, x, y, coverage);
    const struct sample_origin center = center_of_pixel(work->x + x, work->y + y);
    return t->flags & RHW_TRIANGLE_STIPPLE && mask != 0
               ? mask & stippled_samples(&shape->stipple, center.x, center.y)
               : mask;
}

// Draw the pixels of a block that the shape has: all their samples are covered.
static void draw_shape_block(struct tile_work *work, struct triangle_work *triangle, int x, int y,
                             uint64_t mask)
{
    if (work->samples == 1) {
        draw_block(work, triangle, x, y, mask);
        return;
    }
    struct sampled_block block = {.x = x, .y = y};
    for (int s = 0; s < work->samples; s++) {
        block.mask[s] = work->pipeline->def.sample_mask >> s & 1 ? mask : 0;
    }
    RHW_ISA_NAME(rhw_draw_sampled_block)(work, triangle, &block);
}

// Clear the marks of all samples but the first. Whether a triangle was seen is kept by sample, and unite_marks then
// tells it of all.
static void unmark_samples(struct tile_work *work)
{
    for (int s = 1; s < work->samples; s++) {
        depth_of_sample(work->scratch, s)->marked = false;
    }
}

static void unite_marks(struct tile_work *work)
{
    for (int s = 1; s < work->samples; s++) {
        work->scratch->depth.marked |= depth_of_sample(work->scratch, s)->marked;
    }
}

static void draw_pixel_shape(struct tile_work *work, struct triangle_work *triangle)
{
    struct clipped_planes clipped;
    begin_any(work, triangle, &clipped);
    const struct tile_rect rect = rect_of(work, triangle->t);
    struct pixel_shape shape;
    if (!set_shape(work, triangle->t, triangle->chunk, &shape)) {
        return;
    }
    unmark_samples(work);
    for (int y = rect.y0 & -RHW_BLOCK; y < rect.y1; y += RHW_BLOCK) {
        for (int x = rect.x0 & -RHW_BLOCK; x < rect.x1; x += RHW_BLOCK) {
            f32x8 coverage[RHW_BLOCK];
            const uint64_t mask = shape_mask(work, triangle->t, &shape, x, y, coverage) &
                                  rect_mask(x, y, rect.x0, rect.y0, rect.x1, rect.y1);
            if (mask != 0) {
                triangle->coverage = coverage;
                triangle->contained = shape.tells_contained ? conservative_mask(&shape.contained, x, y) : 0;
                draw_shape_block(work, triangle, x, y, mask);
            }
        }
    }
    finish_collected(work, triangle);
    unite_marks(work);
}

static void draw_stippled(struct tile_work *work, struct triangle_work *triangle)
{
    struct clipped_planes clipped;
    begin_any(work, triangle, &clipped);
    const struct tile_rect rect = rect_of(work, triangle->t);
    struct stippled_line line;
    set_stippled_line(&line, work, triangle->chunk, triangle->t);
    unmark_samples(work);
    for (int y = rect.y0 & -RHW_BLOCK; y < rect.y1; y += RHW_BLOCK) {
        for (int x = rect.x0 & -RHW_BLOCK; x < rect.x1; x += RHW_BLOCK) {
            const uint64_t inside = rect_mask(x, y, rect.x0, rect.y0, rect.x1, rect.y1);
            struct sampled_block block = {.x = x, .y = y};
            for (int s = 0; s < work->samples; s++) {
                block.mask[s] = inside & stippled_line_mask(&line, work, x, y, s);
            }
            if (work->samples == 1) {
                draw_block(work, triangle, x, y, block.mask[0]);
            } else {
                RHW_ISA_NAME(rhw_draw_sampled_block)(work, triangle, &block);
            }
        }
    }
    finish_collected(work, triangle);
    unite_marks(work);
}

#endif
