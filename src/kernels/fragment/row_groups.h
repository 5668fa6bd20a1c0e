// SPDX-License-Identifier: MIT
// Large triangles are shaded in groups that are rows of a block of 8×8 pixels. All rows of a block are filled at once,
// step by step, so that what a step needs of the triangle is loaded once for all of them.
#ifndef RHW_ROW_GROUPS_H
#define RHW_ROW_GROUPS_H

#include "general_rows.h"
#include "partial_group.h"
#include "target_input.h"

// Varyings and coordinates -----------------------------------------------------------------------------

// Set the derivatives of smooth components of the rows of a block, in the groups from `first` on. The numbers are those
// of smooth_derivatives; what the rows share is worked out once. `squared` has a vector for each row.
RHW_INLINE void fill_row_derivatives(const struct tile_work *work, const struct triangle_work *triangle,
                                     const struct anchor_offset *at, const struct block_rows *rows, int first,
                                     const f64x8 squared[RHW_BLOCK])
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    const ptrdiff_t components = pipeline->varying_components;
    for (int n = 0; n < 2 * pipeline->derivative_pairs; n++) {
        const struct derivative_pair *const pair = &triangle->derivatives[n / 2];
        const int x = n % 2 * 2, y = x + 1, i = pipeline->derivative_component[n / 2][n % 2];
        const f64x8 along_x = numerator8(pair->at[x], pair->step[x], at->dy);
        const f64x8 along_y = numerator8(pair->at[y], pair->step[y], at->dx);
        double by_row[RHW_BLOCK];
        memcpy(by_row, &along_x, sizeof by_row);
        f32x8 *ddx = work->scratch->queue.ddx + first * components + i,
              *ddy = work->scratch->queue.ddy + first * components + i;
        for (int k = 0; k < rows->count; k++, ddx += components, ddy += components) {
            const int row = rows == &all_rows ? k : rows->row[k];
            *ddx = derivative_of(f64x8_splat(by_row[row]), squared[k]);
            *ddy = derivative_of(along_y, squared[k]);
        }
    }
}

// Fill groups with the rows of a block, some rows at a time: while the weights of a step wait for their divisions, the
// varyings of the step before are worked out.
RHW_INLINE void fill_steps(const struct tile_work *work, const struct triangle_work *triangle,
                           const struct block_planes *over, const struct anchor_offset *at,
                           const struct block_rows *rows, enum derivatives derivatives, enum weight_path path)
{
    enum { STEP = 4 };
    const int first = work->scratch->queue.count;
    const ptrdiff_t components = work->pipeline->varying_components;
    const struct rhw_component_run all = {0, work->pipeline->varying_components};
    f64x8 squared[RHW_BLOCK];
    for (int n = 0; n < rows->count; n += STEP) {
        const int left = rows->count - n, count = rows == &all_rows || left > STEP ? STEP : left;
        struct group_weights weights;
        for (int k = 0; k < count; k++) {
            const int row = rows == &all_rows ? n + k : rows->row[n + k];
            const struct weights w = weights_of_row(&triangle->planes, over, row, path);
            weights.b[k] = w.b;
            weights.c[k] = w.c;
            if (derivatives == DERIVATIVES) {
                squared[n + k] = f64x8_mul(w.inverse_s, w.inverse_s);
            }
        }
        interpolate_groups(work->scratch->queue.varyings + (first + n) * components, components, all,
                           triangle, &weights, count);
    }
    // Flat components overwrite what interpolation made of them, as noperspective ones do later.
    if (work->pipeline->flat_count != 0) {
        set_flat_groups(work->scratch->queue.varyings + first * components, work->pipeline, triangle,
                        rows->count);
    }
    if (derivatives == DERIVATIVES) {
        fill_row_derivatives(work, triangle, at, rows, first, squared);
    }
}

RHW_INLINE void fill_block(const struct tile_work *work, const struct triangle_work *triangle,
                           const struct anchor_offset *at, const struct block_rows *rows,
                           enum derivatives derivatives, enum weight_path path)
{
    struct block_planes over;
    block_weights(&over, &triangle->planes, at, path);
    fill_steps(work, triangle, &over, at, rows, derivatives, path);
}

RHW_INLINE void fill_rows(const struct tile_work *work, const struct triangle_work *triangle,
                          const struct anchor_offset *at, const struct block_rows *rows,
                          enum derivatives derivatives)
{
    switch (weight_path_of(&triangle->planes)) {
    case WEIGHTS_EXACT: fill_block(work, triangle, at, rows, derivatives, WEIGHTS_EXACT); break;
    case WEIGHTS_PER_ROW: fill_block(work, triangle, at, rows, derivatives, WEIGHTS_PER_ROW); break;
    case WEIGHTS_PER_PIXEL: fill_block(work, triangle, at, rows, derivatives, WEIGHTS_PER_PIXEL); break;
    }
}

// Set the noperspective varyings of the rows of a block.
RHW_INLINE void fill_screen_rows(const struct tile_work *work, const struct triangle_work *triangle,
                                 const struct anchor_offset *at, const struct block_rows *rows)
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    const ptrdiff_t components = pipeline->varying_components;
    f32x8 *const varyings = work->scratch->queue.varyings + work->scratch->queue.count * components;
    struct block_planes over;
    struct group_weights screen;
    block_screen_weights(&over, &triangle->planes, at);
    for (int n = 0; n < rows->count; n++) {
        const int row = rows == &all_rows ? n : rows->row[n];
        const struct screen_weights w = screen_weights_of_row(&triangle->planes, &over, row);
        screen.b[n] = f32x8_from_f64x8(w.s);
        screen.c[n] = f32x8_from_f64x8(w.t);
    }
    for (int run = 0; run < pipeline->screen_runs; run++) {
        interpolate_groups(varyings, components, pipeline->screen_run[run], triangle, &screen, rows->count);
    }
}

// Set 1/W of the rows of a block, as coordinates have it.
RHW_INLINE void fill_inverse_w(struct rhw_fragment *groups, const struct planes *planes,
                               const struct anchor_offset *at, const struct block_rows *rows)
{
    const struct plane s = plane_of(&planes->quantities, QUANTITY_S);
    if (planes->kind != PLANES_EXACT && plane_is_level(s)) {
        float by_row[RHW_BLOCK];
        plane_level_rows(s, at->dy, by_row);
        for (int n = 0; n < rows->count; n++) {
            groups[n].coord[3] = f32x8_splat(by_row[rows == &all_rows ? n : rows->row[n]]);
        }
        return;
    }
    struct block_planes over;
    if (planes->kind == PLANES_EXACT) {
        block_edges(&over, planes, at);
    } else {
        block_plane_set(&over.s, s, at);
    }
    for (int n = 0; n < rows->count; n++) {
        const int row = rows == &all_rows ? n : rows->row[n];
        groups[n].coord[3] = f32x8_from_f64x8(inverse_w_of_row(planes, &over, row));
    }
}

// Set the coordinates of the rows of a block. Groups have their depth already.
RHW_INLINE void fill_row_coordinates(const struct tile_work *work, const struct planes *planes,
                                     const struct block *block, const struct block_rows *rows)
{
    struct rhw_fragment *const groups = &work->scratch->queue.groups[work->scratch->queue.count];
    const bool at_sample = work->plan.sampling == RHW_SAMPLING_SAMPLE;
    const float center = (float)sample_offset(), right = at_sample ? block->samples->position[0] : center,
                down = at_sample ? block->samples->position[1] : center;
    const f32x8 x = coordinate_of_pixels(work->x + block->x, right);
    float y[RHW_BLOCK];
    f32x8_store(y, coordinate_of_pixels(work->y + block->y, down));
    for (int n = 0; n < rows->count; n++) {
        groups[n].coord[0] = x;
        groups[n].coord[1] = f32x8_splat(y[rows == &all_rows ? n : rows->row[n]]);
        groups[n].coord[2] = groups[n].depth;
    }
    fill_inverse_w(groups, planes, &block->at, rows);
}

// Set what groups that are rows of a block have beside smooth and flat varyings.
RHW_INLINE void fill_more(const struct tile_work *work, const struct triangle_work *triangle,
                          const struct block *block, const struct block_rows *rows)
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    struct fragment_queue *const queue = &work->scratch->queue;
    if (pipeline->any_noperspective) {
        fill_screen_rows(work, triangle, &block->at, rows);
    }
    if (pipeline->any_noperspective && pipeline->smooth_runs == 0) {
        set_flat_groups(queue->varyings + queue->count * pipeline->varying_components, pipeline, triangle,
                        rows->count);
    }
    if (pipeline->any_constant_derivatives) {
        constant_derivatives(queue, queue->count, rows->count, pipeline, triangle);
    }
    if (pipeline->def.program.uses & RHW_USE_COORD) {
        fill_row_coordinates(work, &triangle->planes, block, rows);
    }
}

static __attribute__((noinline)) void fill_more_of_block(const struct tile_work *work,
                                                         const struct triangle_work *triangle,
                                                         const struct block *block)
{
    fill_more(work, triangle, block, &all_rows);
}

static __attribute__((noinline)) void fill_more_of_rows(const struct tile_work *work,
                                                        const struct triangle_work *triangle,
                                                        const struct block *block,
                                                        const struct block_rows *rows)
{
    fill_more(work, triangle, block, rows);
}

// Queueing ---------------------------------------------------------------------------------------------

// Set where the groups from the queue's end on stand: they are the rows of a block at (x, y).
RHW_INLINE void place_rows(struct fragment_queue *queue, const struct block_rows *rows, int x, int y)
{
    const int first = queue->count;
    struct rhw_fragment *const groups = &queue->groups[first];
    memcpy(&queue->live[first], rows->bits, sizeof rows->bits);
    memset(&queue->is_scattered[first], 0, sizeof rows->bits);
    i32x8_store(&queue->row_at[first],
                (i32x8_load_bytes(rows->row) << RHW_TILE_LOG2) + i32x8_splat(y * RHW_TILE + x));
    for (int n = 0; n < rows->count; n++) {
        groups[n].mask = rows == &all_rows ? i32x8_splat(-1) : i32x8_from_bits(rows->bits[n]);
    }
    for (int n = 0; n < rows->count && rows != &all_rows; n++) {
        queue->only_full_rows = queue->only_full_rows && rows->bits[n] == 0xff;
    }
}

// Set that the groups from the queue's end on stand for one sample of their pixels. `asks` is true if the fragment
// function asks which.
RHW_INLINE void place_one_sample(struct fragment_queue *queue, const struct block_samples *from,
                                 const struct block_rows *rows, bool asks)
{
    struct rhw_fragment *const groups = &queue->groups[queue->count];
    const i32x8 sample = i32x8_splat(1 << from->only), id = i32x8_splat(from->only);
    const f32x8 x = f32x8_splat(from->position[0]), y = f32x8_splat(from->position[1]);
    for (int n = 0; n < rows->count; n++) {
        queue->samples[queue->count + n] = sample & groups[n].mask;
    }
    for (int n = 0; n < rows->count && asks; n++) {
        groups[n].sample_mask = sample & groups[n].mask;
        groups[n].sample_id = id;
        groups[n].sample_position[0] = x;
        groups[n].sample_position[1] = y;
    }
}

// Set which samples the groups from the queue's end on cover.
static __attribute__((noinline)) void place_any_samples(const struct tile_work *work,
                                                        const struct block_samples *from,
                                                        const struct block_rows *rows)
{
    struct fragment_queue *const queue = &work->scratch->queue;
    for (int n = 0; n < rows->count; n++) {
        const int g = queue->count + n, row = rows->row[n];
        i32x8 samples = i32x8_splat(0);
        for (int s = 0; s < work->samples; s++) {
            if (from->only < 0 || from->only == s) {
                samples |=
                    i32x8_from_bits((unsigned)(from->mask[s] >> (8 * row)) & 0xff) & i32x8_splat(1 << s);
            }
            if (from->depth) {
                queue->sample_depth[g][s] = from->depth[s][row];
            }
        }
        samples &= i32x8_from_bits(rows->bits[n]);
        queue->samples[g] = queue->groups[g].sample_mask = samples;
        queue->groups[g].sample_id = i32x8_splat(from->only);
        queue->groups[g].sample_position[0] = f32x8_splat(from->position[0]);
        queue->groups[g].sample_position[1] = f32x8_splat(from->position[1]);
    }
}

RHW_INLINE void place_samples(const struct tile_work *work, const struct block_samples *from,
                              const struct block_rows *rows)
{
    struct fragment_queue *const queue = &work->scratch->queue;
    const uint32_t uses = work->pipeline->def.program.uses;
    memset(&queue->sample[queue->count], from->only, RHW_BLOCK);
    if (from->only >= 0 && !from->depth) {
        place_one_sample(queue, from, rows, uses & (RHW_USE_SAMPLE | RHW_USE_SAMPLE_MASK));
    } else {
        place_any_samples(work, from, rows);
    }
}

RHW_INLINE void fill_kept_depths(struct rhw_fragment *groups, const f32x8 *z, const struct block_rows *rows)
{
    for (int n = 0; n < rows->count; n++) {
        groups[n].depth = z[rows == &all_rows ? n : rows->row[n]];
    }
}

static __attribute__((noinline)) void fill_kept_identity(const struct tile_work *work,
                                                         const struct triangle_work *triangle,
                                                         struct rhw_fragment *groups, int count)
{
    for (int n = 0; n < count; n++) {
        fill_identity(&groups[n], work->pipeline->def.program.uses, triangle);
    }
}

// Fill the groups from the queue's end on with the rows of a block, together.
RHW_INLINE void fill_together(const struct tile_work *work, const struct triangle_work *triangle,
                              const struct block *block, const struct block_rows *rows)
{
    if (work->pipeline->derivative_pairs != 0) {
        fill_rows(work, triangle, &block->at, rows, DERIVATIVES);
    } else if (wants_weights(work->pipeline)) {
        fill_rows(work, triangle, &block->at, rows, NO_DERIVATIVES);
    }
    if (work->plan.fills_more && rows == &all_rows) {
        fill_more_of_block(work, triangle, block);
    } else if (work->plan.fills_more) {
        fill_more_of_rows(work, triangle, block, rows);
    }
}

// Queue the rows of a block as groups.
RHW_INLINE void queue_rows(struct tile_work *work, struct triangle_work *triangle, const struct block *block,
                           const struct block_rows *rows)
{
    struct fragment_queue *const queue = &work->scratch->queue;
    // What a program reads of targets is what earlier triangles left; no sample is among a triangle's fragments twice.
    const bool ends_others = work->plan.reads_targets && !triangle->has_values && queue->count != 0;
    if (queue->count + rows->count > RHW_FRAGMENT_GROUPS || ends_others) {
        RHW_ISA_NAME(rhw_shade_queue)(work);
    }
    if (!triangle->has_values) {
        set_inputs(work, triangle);
    }
    place_rows(queue, rows, block->x, block->y);
    if (block->samples) {
        place_samples(work, block->samples, rows);
    }
    for (int n = 0; n < rows->count && work->plan.weighs_alpha; n++) {
        queue->coverage[queue->count + n] = triangle->coverage[rows->row[n]];
    }
    if (work->plan.reads_targets) {
        read_targets(work, queue->count, rows->count);
    }
    if (work->plan.keeps_depth) {
        fill_kept_depths(&queue->groups[queue->count], block->z, rows);
    }
    if (work->plan.keeps_identity) {
        fill_kept_identity(work, triangle, &queue->groups[queue->count], rows->count);
    }
    if (block->samples && block->samples->center) {
        fill_centroid_rows(work, triangle, block, rows, queue->count);
    } else if (work->plan.shading != RHW_SHADING_SMOOTH || block->leaves_triangle ||
               interpolates_in_double(work->pipeline, triangle)) {
        fill_any_rows(work, triangle, block, rows, queue->count);
    } else {
        fill_together(work, triangle, block, rows);
    }
    queue->count += rows->count;
    shade_if_full(work);
}

// Queue the rows of a block of which some pixels are set in `mask`.
static __attribute__((noinline)) void queue_some_rows(struct tile_work *work, struct triangle_work *triangle,
                                                      const struct block *block, uint64_t mask)
{
    const struct block_rows rows = rows_of_mask(mask);
    queue_rows(work, triangle, block, &rows);
}

#endif
