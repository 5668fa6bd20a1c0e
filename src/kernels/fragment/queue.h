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

// Blend what was shaded into target t. `path` is the target's, and `size` is the size of its texels in bytes; both are
// constants where a call names them.
RHW_INLINE void blend_target(const struct tile_work *work, int t, enum rhw_blend_path path, size_t size)
{
    struct rhw_blend_state state = work->state->blend[t];
    state.path = path;
    struct fragment_queue *const queue = &work->scratch->queue;
    unsigned char *const texels = work->scratch->color[t];
    const int count = queue->count;
    const bool replaces = replaces_texels(&state);
    const bool is_common = path == BLEND_RGBA8_REPLACE || path == BLEND_RGBA8_OVER;
    if (is_common && queue->only_full_rows && state.texel_mask[0] == UINT32_MAX) {
        // The compiler knows the mask from here on.
        state.texel_mask[0] = UINT32_MAX;
        for (int g = 0; g < count; g++) {
            blend_group(&state, queue->colors[g][t], i32x8_splat(-1),
                        texels + (size_t)queue->row_at[g] * size);
        }
        return;
    }
    if (queue->only_full_rows && (path == BLEND_REPLACE || path == BLEND_OVER || path == BLEND_GENERAL)) {
        const struct texel_rows rows = {.count = count,
                                        .color = queue->colors[0][t],
                                        .stride = sizeof queue->colors[0] / sizeof queue->colors[0][t][0],
                                        .texels = texels,
                                        .at = queue->row_at};
        act_on_rows(&state, &rows);
        return;
    }
    _Alignas(32) unsigned char lanes[RHW_LANES * RHW_TEXEL_BYTES] = {0};
    for (int g = 0; g < count; g++) {
        const f32x8 *const color = queue->colors[g][t];
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

// Finish all groups after the fragment function, where a pixel has one sample.
RHW_INLINE void finish_queue(struct tile_work *work)
{
    struct fragment_queue *const queue = &work->scratch->queue;
    const struct rhw_pipeline_def *const def = &work->pipeline->def;
    if (work->plan.depth_mode >= RHW_DEPTH_LATE || work->plan.masks_samples ||
        def->program.uses & RHW_USE_DISCARD) {
        for (int g = 0; g < queue->count; g++) {
            queue->live[g] = (uint8_t)finish_depth(work, g);
            queue->only_full_rows = queue->only_full_rows && queue->live[g] == 0xff;
        }
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
