// SPDX-License-Identifier: MIT
// Draws whose fragment function receives nothing that differs between fragments: no varyings, no builtins. It is a
// function of its inputs alone, so one call tells the colour of all, and the tile takes it at the speed of its memory.
#ifndef RHW_CONSTANT_COLOR_H
#define RHW_CONSTANT_COLOR_H

#include "queue.h"

// Blends a group out of line: the code is large, and few groups come here.
static __attribute__((noinline)) void blend_group_apart(const struct rhw_blend_state *state,
                                                        const f32x8 color[4], const i32x8 *mask,
                                                        unsigned char *texels)
{
    blend_group(state, color, *mask, texels);
}

static void prepare_constant(struct tile_work *work)
{
    struct fragment_queue *const queue = &work->scratch->queue;
    queue->groups[0].mask = i32x8_splat(-1);
    run_fragment_function(work, 1);
    if (work->pipeline->def.alpha_to_one) {
        queue->colors[0][0][3] = f32x8_splat(1);
    }
    work->counters->groups++;
    for (int t = 0; t < work->target->color_count; t++) {
        if (work->state->blend[t].path == BLEND_RGBA8_REPLACE) {
            const i32x8 all = i32x8_splat(-1);
            blend_group_apart(&work->state->blend[t], queue->colors[0][t], &all,
                              (unsigned char *)&work->scratch->constant[t]);
        }
    }
    work->constant_is_ready = true;
}

// Puts a texel of 4 bytes into the pixels of a block that are set in `mask`.
RHW_INLINE void replace_block(unsigned char *texels, i32x8 texel, uint64_t mask)
{
    const size_t stride = RHW_TILE * sizeof(int32_t);
    if (mask == ~(uint64_t)0) { // most are, where a draw is large
        for (int row = 0; row < RHW_BLOCK; row++) {
            i32x8_store(texels + (size_t)row * stride, texel);
        }
        return;
    }
    for (int row = 0; row < RHW_BLOCK; row++) {
        store_words(texels + (size_t)row * stride, texel,
                    i32x8_from_bits((unsigned)(mask >> (8 * row)) & 0xff));
    }
}

// Blends the pixels of the block at (x, y) whose bits are set in `mask`, in one sample.
RHW_INLINE void blend_constant_plane(struct tile_work *work, int sample, int x, int y, uint64_t mask)
{
    struct rhw_tile_scratch *const scratch = work->scratch;
    if (!work->constant_is_ready) {
        prepare_constant(work);
    }
    for (int t = 0; t < work->target->color_count; t++) {
        const struct rhw_blend_state *const state = &work->state->blend[t];
        const size_t size = work->target->colors[t].texel_size;
        unsigned char *const texels = color_plane(scratch, t, sample) + (size_t)(y * RHW_TILE + x) * size;
        if (state->path == BLEND_RGBA8_REPLACE) {
            replace_block(texels, scratch->constant[t], mask);
            continue;
        }
        for (int row = 0; row < RHW_BLOCK; row++) {
            const i32x8 live = i32x8_from_bits((unsigned)(mask >> (8 * row)) & 0xff);
            blend_group_apart(state, scratch->queue.colors[0][t], &live,
                              texels + (size_t)(row * RHW_TILE) * size);
        }
    }
}

// Does so where a pixel has one sample.
static void blend_constant(struct tile_work *work, int x, int y, uint64_t mask)
{
    blend_constant_plane(work, 0, x, y, mask);
}

// Does so in all samples where they are woven.
static void blend_constant_woven(struct tile_work *work, int x, int y, const uint64_t mask[RHW_MAX_SAMPLES])
{
    if (!work->constant_is_ready) {
        prepare_constant(work);
    }
    for (int row = 0; row < RHW_BLOCK; row++) {
        int32_t texel[RHW_LANES];
        i32x8 samples = i32x8_splat(0);
        i32x8_store(texel, i32x8_splat((y + row) * RHW_TILE + x) + rhw_lane_index);
        for (int s = 0; s < WOVEN_SAMPLES; s++) {
            samples |= i32x8_from_bits((unsigned)(mask[s] >> (8 * row)) & 0xff) & i32x8_splat(1 << s);
        }
        for (int t = 0; t < work->target->color_count; t++) {
            blend_woven(work, t, texel, work->scratch->queue.colors[0][t], &samples);
        }
    }
}

// Does so for the samples in `mask`, of a block at multiples of 8.
static __attribute__((noinline)) void blend_constant_samples(struct tile_work *work, int x, int y,
                                                             const uint64_t mask[RHW_MAX_SAMPLES])
{
    const int block = block_of_texel(y * RHW_TILE + x);
    bool differ = false;
    for (int s = 1; s < work->samples; s++) {
        differ |= mask[s] != mask[0];
    }
    if (differ && !(work->scratch->expanded >> block & 1)) {
        expand_block(work, block);
    }
    const bool is_expanded = work->scratch->expanded >> block & 1;
    if (is_expanded && work->scratch->is_woven) {
        blend_constant_woven(work, x, y, mask);
        return;
    }
    const int planes = is_expanded ? work->samples : 1;
    for (int s = 0; s < planes; s++) {
        blend_constant_plane(work, s, x, y, mask[s]);
    }
}

#endif
