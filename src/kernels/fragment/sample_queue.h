// SPDX-License-Identifier: MIT
// In a multisampled pass, samples are dropped, tested late and blended after the fragment function: sample by sample,
// or pixel by pixel if samples are woven. A group that covers its pixels all over is blended once, into the tile of the
// first sample, if its blocks are not expanded.
#ifndef RHW_SAMPLE_QUEUE_H
#define RHW_SAMPLE_QUEUE_H

#include "kernels/depth/stencil_test.h"
#include "blend.h"
#include "expand.h"
#include "explained_fragment.h"
#include "full_rows.h"
#include "woven.h"

// Return the lanes whose fragment covers sample s.
RHW_INLINE unsigned lanes_of_sample(i32x8 samples, int s)
{
    return i32x8_sign_bits((i32x8)((u32x8)samples << (31 - s)));
}

// Return the first round(alpha · count) samples.
RHW_INLINE i32x8 samples_of_alpha(f32x8 alpha, int count)
{
    const f32x8 kept = rhw_saturate(alpha) * f32x8_splat((float)count) + f32x8_splat(0.5f);
    return i32x8_power2(rhw_int_from_float_unchecked(kept)) - i32x8_splat(1);
}

// Test the lanes of group g in `bits` after the fragment function. Their sample is at z, and `depth` is the tile's
// depth of that sample.
static unsigned test_sample_late(struct tile_depth *depth, const struct tile_work *work, int g, f32x8 z,
                                 unsigned bits, unsigned back)
{
    const struct fragment_queue *const queue = &work->scratch->queue;
    const struct rhw_depth_rule rule = work->plan.late;
    const int x = queue->row_at[g] % RHW_TILE, y = queue->row_at[g] / RHW_TILE; // first pixel of a row
    if (queue->is_scattered[g]) {
        return work->plan.test != RHW_TEST_DEPTH
                   ? test_texels_late_stencil(depth, queue->texels[g], z, bits, back, rule)
                   : test_texels_late(depth, queue->texels[g], z, bits, rule);
    }
    return work->plan.test != RHW_TEST_DEPTH ? test_row_late_stencil(depth, x, y, z, bits, back, rule)
                                             : test_row_late(depth, x, y, z, bits, rule);
}

// Test the samples of group g after the fragment function.
static i32x8 test_samples_late(struct tile_work *work, int g, i32x8 samples)
{
    const struct fragment_queue *const queue = &work->scratch->queue;
    const struct rhw_fragment *const group = &queue->groups[g];
    const uint32_t uses = work->pipeline->def.program.uses;
    const unsigned back = uses & RHW_USE_FACING ? i32x8_sign_bits(~group->front_facing) : 0;
    i32x8 passed = i32x8_splat(0);
    for (int s = 0; s < work->samples; s++) {
        struct tile_depth *const depth = depth_of_sample(work->scratch, s);
        const unsigned bits = lanes_of_sample(samples, s);
        const f32x8 z =
            uses & RHW_USE_DEPTH ? viewport_clamp(depth, group->depth) : queue->sample_depth[g][s];
        const unsigned kept = bits == 0 ? 0 : test_sample_late(depth, work, g, z, bits, back);
        passed |= i32x8_from_bits(kept) & i32x8_splat(1 << s);
    }
    return passed;
}

// Return the samples of a group that the fragment function and its alpha leave. A pixel of one sample has bit 0 (Vulkan
// 1.3 §28.9 makes no exception of it).
static i32x8 masked_samples(const struct tile_work *work, int g, i32x8 samples)
{
    const struct fragment_queue *const queue = &work->scratch->queue;
    const struct rhw_fragment *const group = &queue->groups[g];
    const struct rhw_pipeline_def *const def = &work->pipeline->def;
    if (def->program.uses & RHW_USE_DISCARD) {
        samples &= rhw_less_int(group->mask, i32x8_splat(0));
    }
    if (def->program.uses & RHW_USE_SAMPLE_MASK) {
        samples &= group->sample_mask;
    }
    if (def->alpha_to_coverage) {
        samples &= samples_of_alpha(queue->colors[g][0][3], work->samples);
    }
    return samples;
}

// Return the samples of group g that are still to be blended.
static i32x8 finish_samples(struct tile_work *work, int g)
{
    const i32x8 covered = work->scratch->queue.samples[g], samples = masked_samples(work, g, covered);
    if (work->explained) {
        const int sample = work->explained->ask.sample;
        explain_masked(work, g, lanes_of_sample(covered, sample), lanes_of_sample(samples, sample));
    }
    return work->plan.depth_mode >= RHW_DEPTH_LATE ? test_samples_late(work, g, samples) : samples;
}

// Return the lanes of group g that lie in expanded blocks. Expand the blocks of lanes in `partial` before.
RHW_INLINE unsigned expanded_lanes(const struct tile_work *work, int g, unsigned partial)
{
    const struct fragment_queue *const queue = &work->scratch->queue;
    const uint64_t *const expanded = &work->scratch->expanded;
    if (!queue->is_scattered[g]) { // all lanes in one block
        const int block = block_of_texel(queue->row_at[g]);
        if (partial != 0 && !(*expanded >> block & 1)) {
            expand_block(work, block);
        }
        return *expanded >> block & 1 ? 0xff : 0;
    }
    unsigned lanes = expanded_texels(*expanded, queue->texels[g]);
    while ((partial & ~lanes) != 0) {
        expand_block(work, block_of_texel(queue->texels[g][__builtin_ctz(partial & ~lanes)]));
        lanes = expanded_texels(*expanded, queue->texels[g]);
    }
    return lanes;
}

// Blend the lanes of group g, of which some are expanded, into target t. `samples` are to be drawn; there is at least
// one.
RHW_INLINE void blend_row_samples(const struct tile_work *work, int t, int g, i32x8 samples,
                                  unsigned expanded)
{
    const struct fragment_queue *const queue = &work->scratch->queue;
    const struct rhw_blend_state *const state = &work->state->blend[t];
    const size_t at = (size_t)queue->row_at[g] * work->target->colors[t].texel_size;
    for (int s = 0; s < (expanded == 0 ? 1 : work->samples); s++) {
        const unsigned bits = lanes_of_sample(samples, s);
        if (bits != 0) {
            blend_group(state, queue->colors[g][t], i32x8_from_bits(bits),
                        color_of_sample(work->scratch, t, s) + at);
        }
    }
}

RHW_INLINE void blend_scattered_samples(const struct tile_work *work, int t, int g, i32x8 samples,
                                        unsigned expanded)
{
    const struct fragment_queue *const queue = &work->scratch->queue;
    const struct rhw_blend_state *const state = &work->state->blend[t];
    const size_t size = work->target->colors[t].texel_size;
    const bool replaces = replaces_texels(state);
    _Alignas(32) unsigned char lanes[RHW_LANES * RHW_TEXEL_BYTES] = {0};
    if (replaces) {
        replacing_texels(state, queue->colors[g][t], lanes);
    }
    for (int s = 0; s < (expanded == 0 ? 1 : work->samples); s++) {
        const unsigned bits = lanes_of_sample(samples, s) & (s == 0 ? 0xff : expanded);
        unsigned char *const texels = color_of_sample(work->scratch, t, s);
        if (bits == 0) {
            continue;
        }
        if (replaces) {
            scatter_texels(queue->texels[g], bits, texels, size, lanes);
            continue;
        }
        gather_texels(queue->texels[g], texels, size, lanes);
        blend_group(state, queue->colors[g][t], i32x8_splat(-1), lanes);
        scatter_texels(queue->texels[g], bits, texels, size, lanes);
    }
}

// Blend 8 fragments into those of their samples that are set. No two fragments have one sample.
static __attribute__((noinline)) void blend_woven(const struct tile_work *work, int target,
                                                  const int32_t texel[8], const f32x8 *color,
                                                  const i32x8 *samples)
{
    struct rhw_tile_scratch *const scratch = work->scratch;
    const struct rhw_blend_state *const state = &work->state->blend[target];
    f32x8 sample[WOVEN_SAMPLES];
    f32x4 pixel[RHW_LANES];
    load_woven(scratch, target, texel, sample);
    for (int s = 0; s < WOVEN_SAMPLES; s++) {
        _Alignas(32) unsigned char texels[RHW_LANES * 16];
        f32x8_store(texels, sample[s]);
        blend_group(state, color, i32x8_splat(-1), texels);
        sample[s] = f32x8_load(texels);
    }
    f32x4_rows(sample, pixel);
    store_woven(scratch, target, texel, pixel, *samples);
}

// Blend the lanes of group g into target t where samples are woven.
RHW_INLINE void blend_woven_samples(const struct tile_work *work, int t, int g, i32x8 samples,
                                    unsigned expanded)
{
    struct rhw_tile_scratch *const scratch = work->scratch;
    struct fragment_queue *const queue = &scratch->queue;
    const struct rhw_blend_state *const state = &work->state->blend[t];
    i32x8 woven = samples;
    if (expanded != 0xff && queue->is_scattered[g]) {
        blend_scattered_samples(work, t, g, samples & i32x8_from_bits(~expanded), 0);
        woven = samples & i32x8_from_bits(expanded);
    } else if (expanded == 0) {
        blend_row_samples(work, t, g, samples, 0);
    }
    if (expanded == 0) {
        return;
    }
    if (!queue->is_scattered[g]) { // all of the group is expanded
        i32x8_store(queue->texels[g], i32x8_splat(queue->row_at[g]) + rhw_lane_index);
    }
    if (replaces_words(state)) {
        replace_woven(scratch, t, queue->texels[g], replacing_words(state, queue->colors[g][t]), woven);
    } else {
        blend_woven(work, t, queue->texels[g], queue->colors[g][t], &woven);
    }
}

RHW_INLINE void blend_samples(const struct tile_work *work, int g, i32x8 samples)
{
    const i32x8 all = i32x8_splat((int32_t)(((int64_t)1 << work->samples) - 1));
    const unsigned live = ~i32x8_sign_bits(rhw_equal_int(samples, i32x8_splat(0))) & 0xff;
    const unsigned partial = live & ~i32x8_sign_bits(rhw_equal_int(samples, all));
    if (live == 0) {
        return;
    }
    const unsigned expanded = expanded_lanes(work, g, partial);
    for (int t = 0; t < work->target->color_count; t++) {
        if (work->scratch->is_woven) {
            blend_woven_samples(work, t, g, samples, expanded);
        } else if (work->scratch->queue.is_scattered[g]) {
            blend_scattered_samples(work, t, g, samples, expanded);
        } else {
            blend_row_samples(work, t, g, samples, expanded);
        }
    }
}

// Blend groups, which are rows of one sample each, into target t: the lanes whose sample is in `samples`.
RHW_INLINE void blend_rows_of_samples(const struct tile_work *work, int t, enum rhw_blend_path path,
                                      size_t size, const i32x8 *samples)
{
    const struct fragment_queue *const queue = &work->scratch->queue;
    if (queue->only_full_rows) {
        for (int g = 0, end; g < queue->count; g = end) {
            const int sample = queue->sample[g];
            for (end = g + 1; end < queue->count && queue->sample[end] == sample;) {
                end++;
            }
            blend_full_rows(work, t, path, size, g, end, color_of_sample(work->scratch, t, sample));
        }
        return;
    }
    struct rhw_blend_state state = work->state->blend[t];
    state.path = path;
    for (int g = 0; g < queue->count; g++) {
        const i32x8 live = ~rhw_equal_int(samples[g], i32x8_splat(0));
        if (rhw_any(live)) {
            blend_group(&state, queue->colors[g][t], live,
                        color_of_sample(work->scratch, t, queue->sample[g]) +
                            (size_t)queue->row_at[g] * size);
        }
    }
}

// Blend groups that are rows of one sample each: what is left of them in `samples`. Their blocks are expanded.
static __attribute__((noinline)) void finish_rows_of_samples(const struct tile_work *work,
                                                             const i32x8 *samples)
{
    for (int t = 0; t < work->target->color_count; t++) {
        const enum rhw_blend_path path = work->state->blend[t].path;
        if (path == BLEND_RGBA8_REPLACE) {
            blend_rows_of_samples(work, t, BLEND_RGBA8_REPLACE, 4, samples);
        } else if (path == BLEND_RGBA8_OVER) {
            blend_rows_of_samples(work, t, BLEND_RGBA8_OVER, 4, samples);
        } else {
            blend_rows_of_samples(work, t, path, work->target->colors[t].texel_size, samples);
        }
    }
}

// Blend, after the fragment function, what is left of all groups, in their order.
static __attribute__((noinline)) void finish_sample_queue(struct tile_work *work)
{
    struct fragment_queue *const queue = &work->scratch->queue;
    const struct rhw_pipeline_def *const def = &work->pipeline->def;
    const bool drops = work->plan.drops;
    const bool is_single = work->plan.sampling == RHW_SAMPLING_SAMPLE && !work->scratch->is_woven;
    if (is_single && !drops && !def->alpha_to_one && !work->explained) {
        finish_rows_of_samples(work, queue->samples);
        return;
    }
    i32x8 left[RHW_FRAGMENT_GROUPS];
    for (int g = 0; g < queue->count; g++) {
        const i32x8 samples = drops ? finish_samples(work, g) : queue->samples[g];
        left[g] = samples;
        if (def->alpha_to_one) {
            queue->colors[g][0][3] = f32x8_splat(1);
        }
        if (work->explained) {
            explain_written(work, g, lanes_of_sample(samples, work->explained->ask.sample));
        }
        if (!is_single) {
            blend_samples(work, g, samples);
        }
    }
    if (is_single) {
        queue->only_full_rows = queue->only_full_rows && !drops;
        finish_rows_of_samples(work, left);
    }
}

#endif
