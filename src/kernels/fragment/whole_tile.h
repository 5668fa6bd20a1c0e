// SPDX-License-Identifier: MIT
// A triangle that covers a tile all over has groups of its own: what the blocks of a tile share is done once. Where
// samples are shaded one by one, the tile is filled for one sample after the other.
#ifndef RHW_WHOLE_TILE_H
#define RHW_WHOLE_TILE_H

#include "kernels/depth/depth_test.h"
#include "row_groups.h"

// Set the depths of the groups from the queue's end on, which are the rows of a block.
RHW_INLINE void fill_block_depths(const struct tile_work *work, const struct triangle_work *triangle,
                                  const struct anchor_offset *at)
{
    struct rhw_fragment *const groups = &work->scratch->queue.groups[work->scratch->queue.count];
    const struct plane z = plane_of(&triangle->planes.quantities, QUANTITY_Z);
    if (plane_is_level(z)) {
        float by_row[RHW_BLOCK];
        plane_level_rows(z, at->dy, by_row);
        for (int row = 0; row < RHW_BLOCK; row++) {
            groups[row].depth = f32x8_splat(by_row[row]);
        }
    } else {
        struct block_plane over;
        block_plane_set(&over, z, at);
        for (int row = 0; row < RHW_BLOCK; row++) {
            groups[row].depth = f32x8_from_f64x8(block_plane_value(&over, row));
        }
    }
    for (int row = 0; row < RHW_BLOCK && triangle->clamps_depth; row++) {
        groups[row].depth = viewport_clamp(&work->scratch->depth, groups[row].depth);
    }
}

// Set depth, what targets hold, and what groups have beside smooth and flat varyings, of a block.
static __attribute__((noinline)) void fill_more_block(const struct tile_work *work,
                                                      const struct triangle_work *triangle,
                                                      const struct block *block)
{
    if (work->plan.reads_targets) {
        read_targets(work, work->scratch->queue.count, RHW_BLOCK);
    }
    if (work->plan.keeps_depth) {
        fill_block_depths(work, triangle, &block->at);
    }
    if (work->plan.fills_more) {
        fill_more(work, triangle, block, &all_rows);
    }
}

// The rows of a row of blocks, where depth and 1/W have one value along each.
struct level_rows {
    float y[RHW_BLOCK], depth[RHW_BLOCK], inverse_w[RHW_BLOCK];
};

// Return true if depth or coordinates are all that groups have beside smooth and flat varyings, and depth and 1/W have
// one value along a row, as on floors and on whatever faces the camera.
static bool wants_level_rows(const struct tile_work *work, const struct planes *planes)
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    const bool has_others =
        work->plan.reads_targets || pipeline->any_noperspective || pipeline->any_constant_derivatives;
    return work->plan.keeps_depth && !has_others &&
           plane_is_level(plane_of(&planes->quantities, QUANTITY_Z)) &&
           plane_is_level(plane_of(&planes->quantities, QUANTITY_S));
}

// Set what the blocks at row y of the tile share. `dy` is where their rows lie from the anchor, and `down` in their
// pixels.
RHW_INLINE void level_rows_set(struct level_rows *out, const struct tile_work *work,
                               const struct triangle_work *triangle, int y, f64x8 dy, float down)
{
    const struct quantity_planes *const quantities = &triangle->planes.quantities;
    plane_level_rows(plane_of(quantities, QUANTITY_S), dy, out->inverse_w);
    plane_level_rows(plane_of(quantities, QUANTITY_Z), dy, out->depth);
    if (triangle->clamps_depth) {
        f32x8_store(out->depth, viewport_clamp(&work->scratch->depth, f32x8_load(out->depth)));
    }
    f32x8_store(out->y, coordinate_of_pixels(work->y + y, down));
}

// Set depth and coordinates of a block at column x of the tile, and at `right` in its pixels, if they are asked for.
RHW_INLINE void fill_level_block(const struct tile_work *work, const struct level_rows *rows, int x,
                                 float right)
{
    const uint32_t uses = work->pipeline->def.program.uses;
    struct rhw_fragment *const groups = &work->scratch->queue.groups[work->scratch->queue.count];
    if (uses & RHW_USE_COORD) {
        const f32x8 columns = coordinate_of_pixels(work->x + x, right);
        for (int row = 0; row < RHW_BLOCK; row++) {
            groups[row].coord[0] = columns;
            groups[row].coord[1] = f32x8_splat(rows->y[row]);
            groups[row].coord[2] = f32x8_splat(rows->depth[row]);
            groups[row].coord[3] = f32x8_splat(rows->inverse_w[row]);
        }
    }
    if (uses & RHW_USE_DEPTH || work->plan.depth_mode == RHW_DEPTH_LATE) {
        for (int row = 0; row < RHW_BLOCK; row++) {
            groups[row].depth = f32x8_splat(rows->depth[row]);
        }
    }
}

// Queue and shade the blocks of a tile in one sample. `samples` tells which one it is, and where in a pixel it lies.
RHW_INLINE void fill_whole_tile(struct tile_work *work, const struct triangle_work *triangle,
                                const struct block_samples *samples, enum derivatives derivatives,
                                enum weight_path path)
{
    const bool weighs = derivatives == DERIVATIVES || wants_weights(work->pipeline);
    const bool is_level = wants_level_rows(work, &triangle->planes);
    const bool more =
        !is_level && (work->plan.keeps_depth || work->plan.fills_more || work->plan.reads_targets);
    const struct planes *const planes = &triangle->planes;
    struct fragment_queue *const queue = &work->scratch->queue;
    const float *const position = samples->position;
    const f64x8 to_right = f64x8_splat((double)position[0] - sample_offset()),
                to_bottom = f64x8_splat((double)position[1] - sample_offset());
    struct block block; // without z and leaves_triangle, which nothing here asks for
    block.samples = samples;
    for (int y = 0; y < RHW_TILE; y += RHW_BLOCK) {
        struct block_planes over;
        struct level_rows level;
        block.y = y;
        block.at.dy = f64x8_add(block_offset(work, planes, 0, y).dy, to_bottom);
        if (weighs) {
            block_weight_rows(&over, planes, block.at.dy, path);
        }
        if (is_level) {
            level_rows_set(&level, work, triangle, y, block.at.dy, position[1]);
        }
        for (int x = 0; x < RHW_TILE; x += RHW_BLOCK) {
            block.x = x;
            block.at.dx = f64x8_add(block_offset(work, planes, x, y).dx, to_right);
            place_rows(queue, &all_rows, x, y);
            if (work->samples > 1) {
                place_samples(work, samples, &all_rows);
            }
            if (weighs) {
                block_weight_columns(&over, planes, block.at.dx);
                fill_steps(work, triangle, &over, &block.at, &all_rows, derivatives, path);
            }
            if (is_level) {
                fill_level_block(work, &level, x, position[0]);
            } else if (more) {
                fill_more_block(work, triangle, &block);
            }
            queue->count += RHW_BLOCK;
            shade_if_full(work);
        }
    }
}

// Do what fill_whole_tile does, by the form that the triangle asks for.
static void queue_tile_sample(struct tile_work *work, const struct triangle_work *triangle,
                              const struct block_samples *samples)
{
    const bool derivatives = work->pipeline->derivative_pairs != 0;
    const bool per_row = weight_path_of(&triangle->planes) == WEIGHTS_PER_ROW;
    if (derivatives && per_row) {
        fill_whole_tile(work, triangle, samples, DERIVATIVES, WEIGHTS_PER_ROW);
    } else if (derivatives) {
        fill_whole_tile(work, triangle, samples, DERIVATIVES, WEIGHTS_PER_PIXEL);
    } else if (per_row) {
        fill_whole_tile(work, triangle, samples, NO_DERIVATIVES, WEIGHTS_PER_ROW);
    } else {
        fill_whole_tile(work, triangle, samples, NO_DERIVATIVES, WEIGHTS_PER_PIXEL);
    }
}

// Queue and shade all blocks of a tile in each of its samples. The queue is empty, so that the groups fill it without a
// rest.
static void queue_tile(struct tile_work *work, struct triangle_work *triangle)
{
    const struct rhw_sample_pattern *const pattern = work->target->pattern;
    set_inputs(work, triangle);
    for (int s = 0; s < work->samples; s++) {
        const struct block_samples samples = {
            .only = s,
            .position = {(float)pattern->x_0_8[s] / RHW_SUBPIXEL, (float)pattern->y_0_8[s] / RHW_SUBPIXEL}};
        queue_tile_sample(work, triangle, &samples);
    }
}

#endif
