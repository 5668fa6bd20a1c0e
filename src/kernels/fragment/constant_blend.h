// SPDX-License-Identifier: MIT
// Some work of constant_color.h is left to a file that blends anyhow: it shades the constant colour of a draw, and
// blends it in other ways than to replace texels.
#ifndef RHW_CONSTANT_BLEND_H
#define RHW_CONSTANT_BLEND_H

#include "queue.h"

// Blend a group out of line: the code is large, and few groups come here.
static __attribute__((noinline)) void blend_group_apart(const struct rhw_blend_state *state,
                                                        const f32x8 color[4], const i32x8 *mask,
                                                        unsigned char *texels)
{
    blend_group(state, color, *mask, texels);
}

// Shade the draw's constant colour.
void RHW_ISA_NAME(rhw_prepare_constant)(struct tile_work *work)
{
    struct fragment_queue *const queue = &work->scratch->queue;
    queue->groups[0].mask = i32x8_splat(-1);
    run_fragment_function(work, 1);
    if (work->pipeline->def.alpha_to_one) {
        queue->colors[0][0][3] = f32x8_splat(1);
    }
    work->counters->groups++;
    for (int t = 0; t < work->target->color_count; t++) {
        if (replaces_texels(&work->state->blend[t])) {
            replacing_texels(&work->state->blend[t], queue->colors[0][t], work->scratch->constant[t]);
        }
    }
    work->constant_is_ready = true;
}

// Blend the colour into the pixels of a block that are set in `mask`. `texels` is the first texel of the block in
// target t.
void RHW_ISA_NAME(rhw_blend_constant_block)(const struct tile_work *work, int t, unsigned char *texels,
                                            uint64_t mask)
{
    const size_t stride = RHW_TILE * work->target->colors[t].texel_size;
    for (int row = 0; row < RHW_BLOCK; row++) {
        const i32x8 live = i32x8_from_bits((unsigned)(mask >> (8 * row)) & 0xff);
        blend_group_apart(&work->state->blend[t], work->scratch->queue.colors[0][t], &live,
                          texels + (size_t)row * stride);
    }
}

// Blend by samples the pixels of a block whose samples are woven.
void RHW_ISA_NAME(rhw_blend_constant_woven)(struct tile_work *work, int x, int y,
                                            const uint64_t mask[RHW_MAX_SAMPLES])
{
    if (!work->constant_is_ready) {
        RHW_ISA_NAME(rhw_prepare_constant)(work);
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

#endif
