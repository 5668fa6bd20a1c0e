// SPDX-License-Identifier: MIT
// Blocks of any triangle are drawn with the triangle's planes, which are made when its first block survives, the depths
// of a block, and the blocks that the triangle is hidden in.
#ifndef RHW_TRIANGLE_PLANES_H
#define RHW_TRIANGLE_PLANES_H

#include "kernels/fragment/block.h"
#include "kernels/integer.h"
#include "kernels/depth/hiz.h"
#include "kernels/raster/plane_clipped.h"
#include "depth_bias.h"
#include "triangle_run.h"

// Return what a triangle may cover of the tile.
RHW_INLINE struct tile_rect rect_of(const struct tile_work *work, const struct rhw_triangle *t)
{
    return (struct tile_rect){max_int(t->x0 - work->x, 0), max_int(t->y0 - work->y, 0),
                              min_int(t->x1 - work->x, RHW_TILE), min_int(t->y1 - work->y, RHW_TILE)};
}

// Copy what shading needs of the planes from the setup.
RHW_INLINE void copy_planes(const struct tile_work *work, struct triangle_work *triangle)
{
    const struct triangle_setup8 *const setup = triangle->setup;
    struct planes *const planes = &triangle->planes;
    const int i = triangle->lane;
    triangle->v = setup->read->vertex[i];
    planes->kind = PLANES_LINEAR;
    planes->is_homogeneous = false;
    planes->anchor_x = setup->anchor_x[i];
    planes->anchor_y = setup->anchor_y[i];
    planes->quantities = setup->quantities[i];
    planes->inverse_area = setup->inverse_area[i];
    triangle->has_planes = true;
    if (work->plan.needs_screen) {
        set_screen_planes(triangle);
    }
}

static void set_planes(const struct tile_work *work, struct triangle_work *triangle)
{
    const struct triangle_setup8 *const setup = triangle->setup;
    struct planes *const planes = &triangle->planes;
    const int i = triangle->lane;
    triangle->v = setup->read->vertex[i];
    triangle->has_planes = true;
    if (triangle->t->flags & RHW_TRIANGLE_UNSNAPPED) {
        planes_homogeneous(planes, triangle->clipped, work->state, triangle->v);
        if (work->plan.is_biased) {
            bias_homogeneous(work, triangle);
            bias_clipped(triangle);
        }
        return;
    }
    planes->anchor_x = setup->anchor_x[i];
    planes->anchor_y = setup->anchor_y[i];
    planes->kind = setup->exact >> i & 1 ? PLANES_EXACT : PLANES_LINEAR;
    planes->is_homogeneous = false;
    planes->quantities = setup->quantities[i];
    planes->inverse_area = setup->inverse_area[i];
    if (planes->kind == PLANES_EXACT || triangle->clipped) {
        const struct setup_input4 input = setup_input(triangle, work->state);
        setup_factors(&planes->factors, &input);
        planes->factors.base[QUANTITY_Z] += triangle->depth_bias;
    }
    if (triangle->clipped || work->plan.needs_screen) {
        set_screen_planes(triangle);
    }
    if (triangle->clipped) {
        planes_clipped_snapped(planes, triangle->clipped, work->state, triangle->v);
        if (work->plan.is_biased) {
            bias_clipped(triangle);
        }
    }
}

// Return true if numbers in a block may differ from the triangle's planes.
RHW_INLINE bool leaves_triangle(const struct triangle_work *triangle, const struct anchor_offset *at)
{
    return triangle->clipped && block_leaves_triangle(&triangle->planes, triangle->clipped, at);
}

// Samples lie within half a pixel of the centre, each way.
static const double SAMPLE_REACH = 0.5;

// Return a bit for each block of the row of blocks at y: the triangle's plane lies behind all that the block shows.
static unsigned hidden_blocks(struct tile_work *work, struct triangle_work *triangle, int y)
{
    const struct tile_depth *const depth = &work->scratch->depth;
    const struct planes *const planes = &triangle->planes;
    if (!work->tests_bounds || !hiz_has_bounds(depth, y)) {
        return 0;
    }
    if (!triangle->has_planes) {
        set_planes(work, triangle);
    }
    if (planes->kind != PLANES_LINEAR) {
        return 0;
    }
    return hiz_hidden(depth, plane_of(&planes->quantities, QUANTITY_Z), planes->anchor_x - work->x,
                      planes->anchor_y - work->y, y, work->samples == 1 ? 0 : SAMPLE_REACH);
}

// Return true if all of a small triangle in a rectangle of the tile lies behind what the tile shows there.
RHW_INLINE bool hides_small(const struct tile_work *work, const struct triangle_setup8 *setup, int i,
                            struct hiz_rect rect)
{
    return work->tests_small_bounds &&
           hiz_hides(&work->scratch->depth, plane_of(&setup->quantities[i], QUANTITY_Z),
                     setup->anchor_x[i] - work->x, setup->anchor_y[i] - work->y, &rect, SAMPLE_REACH);
}

// Set the depths of a block. Depths of pixels outside `mask` are rubbish.
RHW_INLINE void depth_rows(const struct tile_work *work, const struct triangle_work *triangle,
                           const struct block *block, uint64_t mask, f32x8 z[RHW_BLOCK])
{
    struct block_planes over;
    block_depth(&over, &triangle->planes, &block->at);
    for (int row = 0; row < RHW_BLOCK; row++) {
        z[row] = depth_of_row(&triangle->planes, &over, row);
    }
    for (int row = 0; row < RHW_BLOCK && block->leaves_triangle; row++) {
        struct clipped_row clipped;
        const unsigned bits = (unsigned)(mask >> (8 * row)) & 0xff;
        if (bits != 0 && row_leaves_triangle(&triangle->planes, triangle->clipped, &block->at, row, bits)) {
            clipped_row_set(&clipped, &triangle->planes, triangle->clipped, &block->at, row);
            z[row] = f32x8_select(clipped.lanes, clipped.z, z[row]);
        }
    }
    for (int row = 0; row < RHW_BLOCK && triangle->clamps_depth; row++) {
        z[row] = viewport_clamp(&work->scratch->depth, z[row]);
    }
}

// Tiny ones ---------------------------------------------------------------------------------------------

// Make tiny triangle i of a run ready for shading.
RHW_INLINE void begin_tiny(struct triangle_work *triangle, const struct triangle_run *run, int i)
{
    begin_triangle(triangle, run, i);
    begin_plain(triangle);
    copy_planes(run->work, triangle);
}

#endif
