// SPDX-License-Identifier: MIT
// The work on a tile changes when the next triangle belongs to another draw, or another phase begins.
#ifndef RHW_DRAW_STATE_H
#define RHW_DRAW_STATE_H

#include "draw/used_query.h"
#include "kernels/tile_units.h"
#include "kernels/depth/hiz.h"

// Give queries what was counted since the state was set.
static __attribute__((noinline)) void give_counts(const struct tile_work *work)
{
    struct rhw_used_query *const *const queries = work->state->queries->of;
    const uint64_t fragments = work->counters->fragments - work->fragments_before;
    const bool by_test = work->state->depth_stencil.counts_by_test;
    uint64_t samples = by_test ? 0 : fragments;
    for (int s = 0; s < work->samples && by_test; s++) {
        samples += depth_of_sample(work->scratch, s)->passed;
    }
    for (int kind = RHW_QUERY_OCCLUSION; kind <= RHW_QUERY_ANY_PASSED; kind++) {
        if (queries[kind] && samples != 0) {
            atomic_fetch_add_explicit(&queries[kind]->samples, samples, memory_order_relaxed);
        }
    }
    if (queries[RHW_QUERY_STATISTICS] && fragments != 0) {
        atomic_fetch_add_explicit(&queries[RHW_QUERY_STATISTICS]->fragments, fragments, memory_order_relaxed);
    }
}

// End what is counted for the queries of the state under way.
static void end_counts(const struct tile_work *work)
{
    if (work->state && work->state->queries) {
        give_counts(work);
    }
}

static void set_state(struct tile_work *work, const struct rhw_draw_state *state)
{
    const struct rhw_pipeline_data *const pipeline = state->pipeline;
    const struct rhw_rect *const scissor = &state->scissor;
    struct fragment_queue *const queue = &work->scratch->queue;
    struct tile_depth *const depth = &work->scratch->depth;
    end_counts(work);
    work->state = state;
    work->fragments_before = work->counters->fragments;
    work->pipeline = pipeline;
    work->plan = state->plans[work->phase];
    work->is_scissored = scissor->x > work->x || scissor->y > work->y ||
                         scissor->x + scissor->width < work->x + RHW_TILE ||
                         scissor->y + scissor->height < work->y + RHW_TILE;
    for (int s = 0; s < work->samples; s++) {
        struct tile_depth *const sample = depth_of_sample(work->scratch, s);
        sample->least = state->depth_least;
        sample->most = state->depth_most;
        sample->state = &state->depth_stencil;
        sample->passed = 0;
    }
    // If fragments have effects, two of one pixel must not meet in a group: the later lane would not see what the
    // earlier one has stored.
    work->orders_lanes =
        work->plan.depth_mode < RHW_DEPTH_LATE && !(pipeline->def.program.uses & RHW_USE_EFFECTS);
    for (int t = 0; t < work->target->color_count; t++) {
        const struct rhw_blend_state *const blend = &state->blend[t];
        work->orders_lanes = work->orders_lanes && !blend->blend && blend->logic == RHW_LOGIC_OFF;
    }
    work->packs_plainly = work->orders_lanes && work->plan.shading == RHW_SHADING_SMOOTH &&
                          !work->plan.needs_distance && !work->plan.needs_screen &&
                          !work->plan.keeps_identity;
    work->drawn_cell = (pipeline->def.sample_mask & 0xf) * 0x1111111111111111u;
    work->scratch->collected.overtakes = false;
    work->tests_bounds = hiz_follow(depth, &work->plan);
    work->tests_small_bounds = work->tests_bounds && work->samples > 1 && work->phase != RHW_PHASE_ONLY;
    if (work->plan.moves_depth) {
        depth->has_ranges = false;
        depth->unranged = 0;
    }
    for (int g = 0; g < RHW_FRAGMENT_GROUPS; g++) {
        struct rhw_fragment *const group = &queue->groups[g];
        const int offset = g * pipeline->varying_components;
        group->varying = queue->varyings + offset;
        group->ddx = queue->ddx + offset;
        group->ddy = queue->ddy + offset;
        group->user = pipeline->def.program.user;
        group->color = queue->colors[g];
        if (pipeline->def.program.uses & RHW_USE_LAYER) {
            group->layer = i32x8_splat(work->layer);
            group->viewport_index = i32x8_splat(state->viewport_index);
        }
    }
}

// Make a draw the one under way, out of line. Draws that differ in uniforms and bindings alone have one state.
static void set_draw(struct tile_work *work, const struct rhw_draw *draw)
{
    RHW_ISA_NAME(rhw_flush)(work);
    if (!work->draw || work->draw->state != draw->state) {
        set_state(work, draw->state);
    }
    const bool is_bound = work->draw && work->draw->bindings == draw->bindings;
    for (int g = 0; g < RHW_FRAGMENT_GROUPS && !is_bound; g++) {
        work->scratch->queue.groups[g].bindings = draw->bindings;
    }
    work->draw = draw;
    work->constant_is_ready = false;
    for (int g = 0; g < RHW_FRAGMENT_GROUPS; g++) {
        work->scratch->queue.groups[g].uniforms = draw->uniforms;
    }
}

// Make a draw the one under way.
RHW_INLINE void begin_draw(struct tile_work *work, const struct rhw_draw *draw)
{
    if (draw != work->draw) {
        set_draw(work, draw);
    }
}

// Open all pixels of the tile.
static void open_all(const struct tile_work *work, struct tile_depth *depth)
{
    const struct tile_rect *const area = &work->area;
    const uint64_t row = ~(uint64_t)0 >> (RHW_TILE - area->x1) & ~(uint64_t)0 << area->x0;
    for (int y = 0; y < RHW_TILE; y++) {
        depth->open[y] = y >= area->y0 && y < area->y1 ? row : 0;
    }
    depth->open_count = (area->x1 - area->x0) * (area->y1 - area->y0);
}

// Look anew at the bounds of the tile's blocks.
static void refresh_bounds(const struct tile_work *work)
{
    struct tile_depth *samples[RHW_MAX_SAMPLES];
    for (int s = 0; s < work->samples; s++) {
        samples[s] = depth_of_sample(work->scratch, s);
    }
    hiz_refresh(samples, work->samples);
}

// Start a phase. Fragments that wait are tested against the open pixels of their own phase: they are flushed before the
// open pixels change.
static void start_phase(struct tile_work *work, enum rhw_phase phase)
{
    struct tile_depth *const depth = &work->scratch->depth;
    RHW_ISA_NAME(rhw_flush)(work);
    for (int s = 0; s < work->samples; s++) {
        struct tile_depth *const sample = depth_of_sample(work->scratch, s);
        if (phase == RHW_PHASE_DEPTH) {
            memset(sample->open, 0, sizeof sample->open);
        } else if (phase == RHW_PHASE_BACKWARDS) {
            open_all(work, sample);
        }
    }
    work->draw = NULL;
    work->phase = phase;
    if (phase == RHW_PHASE_SHADE && depth->direction != 0) {
        refresh_bounds(work);
    }
}

#endif
