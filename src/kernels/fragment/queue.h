// SPDX-License-Identifier: MIT
// Groups of 8 fragments of one draw wait in the fragment queue until it is full or the draw changes. Then the fragment
// function is called once for all of them, and what it returns is tested (where depth is tested late) and blended.
// Groups are blended in the order in which they came, so several may have fragments of the same pixel.
#ifndef RHW_QUEUE_H
#define RHW_QUEUE_H

#include "binding/shader_adapter.h"
#include "context/given_up.h"
#include "kernels/depth/stencil_test.h"
#include "kernels/tile_units.h"
#include "blend.h"
#include "explained_fragment.h"
#include "full_rows.h"
#include "sample_queue.h"

static void run_fragment_function(const struct tile_work *work, int count)
{
    if (work->pipeline->fragment) {
        work->pipeline->fragment(work->scratch->queue.groups, count);
    } else {
        rhw_fragment1_run(work->pipeline, work->scratch->queue.groups, count);
    }
}

// Return the lanes of group g that are still live after discarding, masks and the late depth test.
static unsigned finish_depth(struct tile_work *work, int g)
{
    struct fragment_queue *const queue = &work->scratch->queue;
    struct tile_depth *const depth = &work->scratch->depth;
    const struct rhw_fragment *const group = &queue->groups[g];
    const struct rhw_draw_plan *const plan = &work->plan;
    const uint32_t uses = work->pipeline->def.program.uses;
    const unsigned bits = lanes_of_sample(masked_samples(work, g, i32x8_from_bits(queue->live[g])), 0);
    if (work->explained) {
        explain_masked(work, g, queue->live[g], bits);
    }
    if (plan->depth_mode < RHW_DEPTH_LATE) {
        return bits;
    }
    const f32x8 z = uses & RHW_USE_DEPTH ? viewport_clamp(depth, group->depth) : group->depth;
    const int x = queue->row_at[g] % RHW_TILE, y = queue->row_at[g] / RHW_TILE; // first pixel of a row
    if (plan->test != RHW_TEST_DEPTH) {
        const unsigned back = uses & RHW_USE_FACING ? i32x8_sign_bits(~group->front_facing) : 0;
        return queue->is_scattered[g]
                   ? test_texels_late_stencil(depth, queue->texels[g], z, bits, back, plan->late)
                   : test_row_late_stencil(depth, x, y, z, bits, back, plan->late);
    }
    return queue->is_scattered[g] ? test_texels_late(depth, queue->texels[g], z, bits, plan->late)
                                  : test_row_late(depth, x, y, z, bits, plan->late);
}

// Do what finish_depth does, for all groups, where depth and the fragment function alone decide. `rule` is the draw's,
// a constant where a call names it.
RHW_INLINE void finish_plain_depth(struct tile_work *work, const struct rhw_depth_rule rule)
{
    struct fragment_queue *const queue = &work->scratch->queue;
    struct tile_depth *const depth = &work->scratch->depth;
    const uint32_t uses = work->pipeline->def.program.uses;
    const bool moves = uses & RHW_USE_DEPTH;
    bool only_full_rows = queue->only_full_rows;
    if (only_full_rows && rule.open == RHW_OPEN_IGNORED && !(uses & RHW_USE_DISCARD)) {
        for (int g = 0; g < queue->count; g++) {
            const f32x8 made = queue->groups[g].depth, z = moves ? viewport_clamp(depth, made) : made;
            const i32x8 pass = test_lanes(depth->texels + queue->row_at[g], z, i32x8_splat(-1), 0, rule);
            queue->live[g] = (uint8_t)i32x8_sign_bits(pass);
            only_full_rows = only_full_rows && queue->live[g] == 0xff;
        }
        queue->only_full_rows = only_full_rows;
        return;
    }
    for (int g = 0; g < queue->count; g++) {
        const struct rhw_fragment *const group = &queue->groups[g];
        const f32x8 z = moves ? viewport_clamp(depth, group->depth) : group->depth;
        unsigned live = queue->live[g];
        if (uses & RHW_USE_DISCARD) {
            live &= i32x8_sign_bits(group->mask);
        }
        if (queue->is_scattered[g]) {
            live = test_texels_late(depth, queue->texels[g], z, live, rule);
        } else {
            const int at = queue->row_at[g];
            live = test_row_late(depth, texel_column(at), texel_row(at), z, live, rule);
        }
        queue->live[g] = (uint8_t)live;
        only_full_rows = only_full_rows && live == 0xff;
    }
    queue->only_full_rows = only_full_rows;
}

RHW_INLINE void finish_plain_depths(struct tile_work *work)
{
    const struct rhw_depth_rule rule = work->plan.late;
    const bool is_plain = rule.write && rule.open == RHW_OPEN_IGNORED;
    if (is_plain && rule.compare == RHW_COMPARE_LESS) {
        finish_plain_depth(work, (struct rhw_depth_rule){RHW_COMPARE_LESS, true, RHW_OPEN_IGNORED});
    } else if (is_plain && rule.compare == RHW_COMPARE_LESS_EQUAL) {
        finish_plain_depth(work, (struct rhw_depth_rule){RHW_COMPARE_LESS_EQUAL, true, RHW_OPEN_IGNORED});
    } else {
        finish_plain_depth(work, rule);
    }
}

// Leave the lanes live that the fragment function did not discard, of 8 groups at a time: a byte that is loaded beside
// bytes just stored waits until these are in the cache, which took 0.4 of cliffs_discard_fill's time.
static void leave_undiscarded(struct fragment_queue *queue)
{
    uint64_t full = ~(uint64_t)0;
    for (int first = 0; first < queue->count; first += RHW_BLOCK) {
        const int left = queue->count - first;
        i32x8 mask[RHW_BLOCK];
        uint64_t live;
        for (int n = 0; n < RHW_BLOCK; n++) {
            mask[n] = queue->groups[first + n].mask;
        }
        memcpy(&live, &queue->live[first], sizeof live);
        live &= i32x8_sign_bits_of_rows(mask);
        memcpy(&queue->live[first], &live, sizeof live);
        full &= live | (left < RHW_BLOCK ? ~(uint64_t)0 << (8 * left) : 0);
    }
    queue->only_full_rows = queue->only_full_rows && full == ~(uint64_t)0;
}

// Blend what was shaded into target t. `path` is the target's, and `size` is the size of its texels in bytes; both are
// constants where a call names them.
RHW_INLINE void blend_target(const struct tile_work *work, int t, enum rhw_blend_path path, size_t size)
{
    struct fragment_queue *const queue = &work->scratch->queue;
    unsigned char *const texels = work->scratch->color[t];
    const int count = queue->count;
    if (queue->only_full_rows) {
        blend_full_rows(work, t, path, size, 0, count, texels);
        return;
    }
    struct rhw_blend_state state = work->state->blend[t];
    state.path = path;
    const bool replaces = replaces_texels(&state);
    _Alignas(32) unsigned char lanes[RHW_LANES * RHW_TEXEL_BYTES] = {0};
    for (int g = 0; g < count; g++) {
        const f32x8 *const color = queue->colors[g][t];
        if (queue->live[g] == 0) {
            continue;
        }
        if (!queue->is_scattered[g]) {
            blend_group(&state, color, i32x8_from_bits(queue->live[g]),
                        texels + (size_t)queue->row_at[g] * size);
            continue;
        }
        const int32_t *const at = queue->texels[g];
        if (replaces) {
            replacing_texels(&state, color, lanes);
            scatter_texels(at, queue->live[g], texels, size, lanes);
            continue;
        }
        gather_texels(at, texels, size, lanes);
        blend_group(&state, color, i32x8_splat(-1), lanes);
        scatter_texels(at, queue->live[g], texels, size, lanes);
    }
}

// Leave the lanes live that discarding, masks and the late depth test leave.
static __attribute__((noinline)) void finish_tests(struct tile_work *work)
{
    struct fragment_queue *const queue = &work->scratch->queue;
    const bool is_late = work->plan.depth_mode >= RHW_DEPTH_LATE;
    if (work->plan.masks_samples || work->explained || (is_late && work->plan.test != RHW_TEST_DEPTH)) {
        for (int g = 0; g < queue->count; g++) {
            queue->live[g] = (uint8_t)finish_depth(work, g);
            queue->only_full_rows = queue->only_full_rows && queue->live[g] == 0xff;
        }
    } else if (is_late) {
        finish_plain_depths(work);
    } else {
        leave_undiscarded(queue);
    }
}

// Finish all groups after the fragment function, where a pixel has one sample.
RHW_INLINE void finish_queue(struct tile_work *work)
{
    struct fragment_queue *const queue = &work->scratch->queue;
    const struct rhw_pipeline_def *const def = &work->pipeline->def;
    if (work->plan.drops) {
        finish_tests(work);
    }
    for (int g = 0; g < queue->count && def->alpha_to_one; g++) {
        queue->colors[g][0][3] = f32x8_splat(1);
    }
    for (int g = 0; g < queue->count && work->explained; g++) {
        explain_written(work, g, queue->live[g]);
    }
    for (int t = 0; t < work->target->color_count; t++) {
        const enum rhw_blend_path path = work->state->blend[t].path;
        if (path == BLEND_RGBA8_REPLACE) {
            blend_target(work, t, BLEND_RGBA8_REPLACE, 4);
        } else if (path == BLEND_RGBA8_OVER) {
            blend_target(work, t, BLEND_RGBA8_OVER, 4);
        } else {
            blend_target(work, t, path, work->target->colors[t].texel_size);
        }
    }
}

static void empty_queue(struct fragment_queue *queue)
{
    queue->count = 0;
    queue->only_full_rows = true;
}

// Shade and blend all groups. Fragments without a group go on waiting. A program that gives up the pass gets none of
// the groups.
void RHW_ISA_NAME(rhw_shade_queue)(struct tile_work *work)
{
    struct fragment_queue *const queue = &work->scratch->queue;
    if (work->wave->asked && rhw_context_is_given_up_amid(work->wave->asked, work->worker, queue->count)) {
        empty_queue(queue);
        return;
    }
    run_fragment_function(work, queue->count);
    if (work->explained) {
        explain_shaded(work);
    }
    for (int g = 0; g < queue->count && work->plan.weighs_alpha; g++) {
        queue->colors[g][0][3] *= queue->coverage[g];
    }
    if (work->samples > 1) {
        finish_sample_queue(work);
    } else {
        finish_queue(work);
    }
    work->counters->groups += (uint64_t)queue->count;
    empty_queue(queue);
}

#endif
