// SPDX-License-Identifier: MIT
// A row of a block of 8×8 pixels is the group of the general path, with everything that a fragment function may ask
// for. Values at centroids are made here alone.
#ifndef RHW_GENERAL_ROWS_H
#define RHW_GENERAL_ROWS_H

#include "kernels/raster/plane_clipped.h"
#include "block.h"
#include "builtin.h"
#include "derivative.h"
#include "explained_fragment.h"
#include "interpolate.h"

// The rows of a block that become groups: their numbers, and their bits.
struct block_rows {
    int count;
    uint8_t row[RHW_BLOCK], bits[RHW_BLOCK];
};

// The rows of a block that is covered all over.
static const struct block_rows all_rows = {
    RHW_BLOCK, {0, 1, 2, 3, 4, 5, 6, 7}, {255, 255, 255, 255, 255, 255, 255, 255}};

static inline struct block_rows rows_of_mask(uint64_t mask)
{
    struct block_rows rows = {0};
    while (mask != 0) {
        const int shift = __builtin_ctzll(mask) & 56;
        rows.row[rows.count] = (uint8_t)(shift / 8);
        rows.bits[rows.count++] = (uint8_t)(mask >> shift & 0xff);
        mask &= ~((uint64_t)0xff << shift);
    }
    return rows;
}

// Make what a triangle needs before its first group.
static void set_inputs(const struct tile_work *work, struct triangle_work *triangle)
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    set_values(triangle, pipeline);
    if (work->plan.needs_distance) {
        component_derivatives(triangle->derivatives, triangle, pipeline);
    }
    triangle->has_values = true;
}

static void fill_barycentric_derivatives(struct rhw_fragment *group, const struct derivative_pair *weights,
                                         const struct anchor_offset *at, f64x8 squared)
{
    f32x8 b_dx, b_dy, c_dx, c_dy;
    pair_derivatives(weights, 0, at, squared, &b_dx, &b_dy);
    pair_derivatives(weights, 1, at, squared, &c_dx, &c_dy);
    fill_barycentrics(group->barycentric_ddx, 0, b_dx, c_dx);
    fill_barycentrics(group->barycentric_ddy, 0, b_dy, c_dy);
}

// The places of the 8 fragments of a group, and the weights of their triangle there.
struct group_place {
    i32x8 texels;      // numbers of the texels in the tile
    float position[2]; // position in each pixel
    struct anchor_offset at;
    struct weights weights;
    struct screen_weights screen; // weights on the screen, where they are wanted
};

// Set what a group gets beside varyings and depth.
static void fill_builtins(const struct tile_work *work, int g, const struct triangle_work *triangle,
                          const struct group_place *place)
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    const uint32_t uses = pipeline->def.program.uses;
    struct fragment_queue *const queue = &work->scratch->queue;
    struct rhw_fragment *const group = &queue->groups[g];
    const struct weights *const w = &place->weights;
    if (work->plan.needs_distance) {
        const f64x8 squared = f64x8_mul(w->inverse_s, w->inverse_s);
        smooth_derivatives(queue, g, pipeline, triangle->derivatives, &place->at, squared);
        constant_derivatives(queue, g, 1, pipeline, triangle);
        if (uses & RHW_USE_BARYCENTRIC_DERIVATIVES) {
            fill_barycentric_derivatives(group, &triangle->planes.weights, &place->at, squared);
        }
    }
    if (uses & (RHW_USE_SAMPLE | RHW_USE_SAMPLE_MASK) && work->samples == 1) {
        fill_one_sample(group);
    }
    if (uses & RHW_USE_COORD) {
        fill_coordinates(work, group, place->texels, place->position, w->s);
    }
    if (uses & RHW_USE_BARYCENTRIC) {
        const f32x8 s = f32x8_from_f64x8(place->screen.s), t = f32x8_from_f64x8(place->screen.t);
        fill_barycentrics(group->barycentric, 1, w->b, w->c);
        fill_barycentrics(group->barycentric_noperspective, 1, s, t);
    }
    if (uses & RHW_USE_POINT_COORD) {
        fill_point_coord(group, f32x8_from_f64x8(place->screen.s), f32x8_from_f64x8(place->screen.t));
    }
    fill_identity(group, uses, triangle);
}

// Return the pixels of a row that a triangle contains. Return none if the triangle is not drawn conservatively.
static i32x8 contained_in_row(const struct triangle_work *triangle, int row)
{
    return triangle->t->flags & RHW_TRIANGLE_CONSERVATIVE
               ? i32x8_from_bits((unsigned)(triangle->contained >> (8 * row)) & 0xff)
               : i32x8_splat(0);
}

// Fill the groups from `first` on with the rows of a block.
static __attribute__((noinline)) void fill_any_rows(const struct tile_work *work,
                                                    const struct triangle_work *triangle,
                                                    const struct block *block, const struct block_rows *rows,
                                                    int first)
{
    const struct planes *const planes = &triangle->planes;
    const bool is_general = work->plan.shading == RHW_SHADING_ROWS;
    const enum weight_path best = weight_path_of(planes);
    const enum weight_path path = is_general && best == WEIGHTS_PER_ROW ? WEIGHTS_PER_PIXEL : best;
    struct block_planes over;
    const float center = (float)sample_offset();
    struct group_place place = {.at.dx = block->at.dx, .position = {center, center}};
    if (work->plan.sampling == RHW_SAMPLING_SAMPLE) {
        memcpy(place.position, block->samples->position, sizeof place.position);
    }
    double dy[RHW_BLOCK];
    memcpy(dy, &block->at.dy, sizeof dy);
    block_weights(&over, planes, &block->at, path);
    if (work->plan.needs_screen) {
        block_screen_weights(&over, planes, &block->at);
    }
    for (int n = 0; n < rows->count; n++) {
        const int row = rows->row[n];
        place.texels = i32x8_splat((block->y + row) * RHW_TILE + block->x) + rhw_lane_index;
        place.at.dy = f64x8_splat(dy[row]);
        place.weights = weights_of_row(planes, &over, row, path);
        if (work->plan.needs_screen) {
            place.screen = screen_weights_of_row(planes, &over, row);
        }
        if (block->leaves_triangle) {
            struct clipped_row clipped;
            clipped_row_set(&clipped, planes, triangle->clipped, &block->at, row);
            clipped_row_replace(&clipped, &place.weights, &place.screen);
        }
        if (work->explained) {
            explain_weights(work, (block->y + row) * RHW_TILE + block->x, rows->bits[n],
                            work->plan.sampling == RHW_SAMPLING_SAMPLE ? block->samples->only : -1,
                            place.position, &place.weights, &place.screen);
        }
        interpolate_any(work->scratch->queue.varyings + (first + n) * work->pipeline->varying_components,
                        work->pipeline, triangle, &place.weights, &place.screen);
        fill_builtins(work, first + n, triangle, &place);
        if (work->pipeline->def.program.uses & RHW_USE_FULLY_COVERED) {
            work->scratch->queue.groups[first + n].fully_covered = contained_in_row(triangle, row);
        }
    }
}

// Values of the 8 fragments of a group at centroids.
struct centroid_values {
    f32x8 value[RHW_MAX_VARYING_COMPONENTS], ddx[RHW_MAX_VARYING_COMPONENTS], ddy[RHW_MAX_VARYING_COMPONENTS];
};

static void keep_centroids(struct centroid_values *kept, const struct fragment_queue *queue, int g,
                           const struct rhw_pipeline_data *pipeline)
{
    const ptrdiff_t first = (ptrdiff_t)g * pipeline->varying_components;
    for (int i = 0; i < pipeline->centroid_count; i++) {
        const ptrdiff_t at = first + pipeline->centroid_component[i];
        kept->value[i] = queue->varyings[at];
        if (pipeline->any_derivatives) {
            kept->ddx[i] = queue->ddx[at];
            kept->ddy[i] = queue->ddy[at];
        }
    }
}

static void put_centroids(const struct centroid_values *kept, struct fragment_queue *queue, int g,
                          const struct rhw_pipeline_data *pipeline)
{
    const ptrdiff_t first = (ptrdiff_t)g * pipeline->varying_components;
    for (int i = 0; i < pipeline->centroid_count; i++) {
        const ptrdiff_t at = first + pipeline->centroid_component[i];
        queue->varyings[at] = kept->value[i];
        if (pipeline->any_derivatives) {
            queue->ddx[at] = kept->ddx[i];
            queue->ddy[at] = kept->ddy[i];
        }
    }
}

// Fill the groups from `first` on with the rows of a block whose pixels are at centroids: varyings that ask for it are
// taken there, and everything else at the centres.
static __attribute__((noinline)) void fill_centroid_rows(const struct tile_work *work,
                                                         const struct triangle_work *triangle,
                                                         const struct block *block,
                                                         const struct block_rows *rows, int first)
{
    struct fragment_queue *const queue = &work->scratch->queue;
    for (int n = 0; n < rows->count; n++) {
        const struct block_rows row = {1, {rows->row[n]}, {rows->bits[n]}};
        struct centroid_values kept;
        fill_any_rows(work, triangle, block, &row, first + n);
        keep_centroids(&kept, queue, first + n, work->pipeline);
        fill_any_rows(work, triangle, block->samples->center, &row, first + n);
        put_centroids(&kept, queue, first + n, work->pipeline);
    }
}

#endif
