// SPDX-License-Identifier: MIT
// The general path leaves numbers for the history of a sample (rhw/explain.h) where it passes by: coverage, depth,
// weights, varyings, outputs. work->explained is NULL but in the tile of that sample; groups are rows there.
#ifndef RHW_EXPLAINED_FRAGMENT_H
#define RHW_EXPLAINED_FRAGMENT_H

#include "draw/explained.h"
#include "kernels/tile_work.h"

// Return true if the pixel lies in the block at (x, y) of the tile, and set which bit it has there.
RHW_INLINE bool explained_bit(const struct tile_work *work, int x, int y, int *bit)
{
    const int column = work->explained->x - x, row = work->explained->y - y;
    *bit = 8 * row + column;
    return column >= 0 && column < RHW_BLOCK && row >= 0 && row < RHW_BLOCK;
}

// Record, before the tests of a block, that its pixels in `mask` are covered in sample `sample`, at the depths `z`.
static __attribute__((noinline)) void explain_covered(const struct tile_work *work, int x, int y, int sample,
                                                      uint64_t mask, const f32x8 z[RHW_BLOCK])
{
    struct rhw_explained *const e = work->explained;
    int bit;
    if (!explained_bit(work, x, y, &bit) || !(mask >> bit & 1)) {
        return;
    }
    e->fragment.covered |= 1u << sample;
    if (sample == e->ask.sample) {
        e->fragment.depth = z[bit / 8][bit % 8];
    }
}

// Record, after the tests of a block, that its pixels in `mask` have passed in sample `sample`.
static __attribute__((noinline)) void explain_passed(const struct tile_work *work, int x, int y, int sample,
                                                     uint64_t mask)
{
    int bit;
    if (sample == work->explained->ask.sample && explained_bit(work, x, y, &bit) && mask >> bit & 1) {
        work->explained->passed = true;
    }
}

// Return the lane that stands for the sample in a group, which is a row from a texel of the tile on. Return −1 if no
// lane does.
static int explained_lane(const struct tile_work *work, int first_texel, unsigned live)
{
    const struct rhw_explained *const e = work->explained;
    const int lane = e->x - first_texel % RHW_TILE;
    const bool is_here = first_texel / RHW_TILE == e->y && lane >= 0 && lane < 8 && live >> lane & 1;
    return is_here && e->fragment.covered >> e->ask.sample & 1 ? lane : -1;
}

// Record the weights of a row of a block. Its fragments stand for sample `only`; if this is −1, they stand for all
// samples.
static __attribute__((noinline)) void explain_weights(const struct tile_work *work, int first_texel,
                                                      unsigned live, int only, const float position[2],
                                                      const struct weights *weights,
                                                      const struct screen_weights *screen)
{
    struct rhw_explained *const e = work->explained;
    const int lane = explained_lane(work, first_texel, live);
    if (lane < 0 || (only >= 0 && only != e->ask.sample)) {
        return;
    }
    struct rhw_explained_fragment *const f = &e->fragment;
    const f64x8 inverse[3] = {screen->s, screen->t, weights->s};
    double lanes[3][8];
    memcpy(lanes, inverse, sizeof lanes);
    f->is_shaded = true;
    f->place[0] = position[0];
    f->place[1] = position[1];
    f->screen[1] = lanes[0][lane];
    f->screen[2] = lanes[1][lane];
    f->screen[0] = 1.0 - f->screen[1] - f->screen[2];
    f->inverse_w = lanes[2][lane];
    f->weights[1] = weights->b[lane];
    f->weights[2] = weights->c[lane];
    f->weights[0] = 1.0f - f->weights[1] - f->weights[2];
}

// Record, after the fragment function, what it got and what it returned.
static __attribute__((noinline)) void explain_shaded(const struct tile_work *work)
{
    struct rhw_explained *const e = work->explained;
    const struct fragment_queue *const queue = &work->scratch->queue;
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    for (int g = 0; g < queue->count; g++) {
        const struct rhw_fragment *const group = &queue->groups[g];
        const int lane = explained_lane(work, queue->row_at[g], queue->live[g]);
        const bool per_sample = work->plan.sampling == RHW_SAMPLING_SAMPLE;
        if (lane < 0 || (per_sample && group->sample_id[lane] != e->ask.sample)) {
            continue;
        }
        for (int i = 0; i < pipeline->varying_components; i++) {
            e->varyings[i] = group->varying[i][lane];
            e->ddx[i] = pipeline->component_derivatives[i] ? group->ddx[i][lane] : 0.0f;
            e->ddy[i] = pipeline->component_derivatives[i] ? group->ddy[i][lane] : 0.0f;
        }
        for (int t = 0; t < work->target->color_count; t++) {
            for (int c = 0; c < 4; c++) {
                e->fragment.output[t][c] = queue->colors[g][t][c][lane];
            }
        }
    }
}

// Record whether discarding and masks took the sample. Before them the fragments of group g cover the sample in the
// lanes `before`, and after them in the lanes `after`.
static __attribute__((noinline)) void explain_masked(const struct tile_work *work, int g, unsigned before,
                                                     unsigned after)
{
    if (explained_lane(work, work->scratch->queue.row_at[g], before & ~after) >= 0) {
        work->explained->discarded = true;
    }
}

// Record that group g is about to be blended in the lanes `live` of the sample.
static __attribute__((noinline)) void explain_written(const struct tile_work *work, int g, unsigned live)
{
    if (explained_lane(work, work->scratch->queue.row_at[g], live) >= 0) {
        work->explained->written = true;
    }
}

#endif
