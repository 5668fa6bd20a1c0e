// SPDX-License-Identifier: MIT
// A triangle that covers the tile all over, in every sample, is drawn at once where no depth is tested before shading,
// as in full-screen passes: what its blocks share is done once, and one of one colour is one fill.
#ifndef RHW_TRIANGLE_WHOLE_H
#define RHW_TRIANGLE_WHOLE_H

#include "kernels/fragment/expand.h"
#include "kernels/tile_units.h"

// Return true if every sample of the tile is open, when triangles are drawn backwards.
RHW_INLINE bool is_all_open(const struct tile_work *work)
{
    bool all = true;
    for (int s = 0; s < work->samples; s++) {
        all = all && depth_of_sample(work->scratch, s)->open_count == RHW_TILE * RHW_TILE;
    }
    return all;
}

// Return true if the samples of a draw are shaded one by one, and all of them are drawn.
RHW_INLINE bool shades_all_samples(const struct tile_work *work)
{
    const uint32_t all = (uint32_t)(((uint64_t)1 << work->samples) - 1);
    return work->plan.sampling == RHW_SAMPLING_SAMPLE && (work->pipeline->def.sample_mask & all) == all &&
           !work->scratch->is_woven;
}

// Return true if a triangle of the draw that covers the tile all over is drawn by draw_whole_tile.
RHW_INLINE bool takes_whole_tile(const struct tile_work *work)
{
    const struct rhw_draw_plan *const plan = &work->plan;
    const bool tests_late = plan->depth_mode == RHW_DEPTH_LATE && work->samples == 1;
    return plan->shading == RHW_SHADING_SMOOTH && !plan->keeps_identity && !work->is_scissored &&
           (work->samples == 1 || shades_all_samples(work)) &&
           ((work->phase == RHW_PHASE_ONLY && (plan->depth_mode == RHW_DEPTH_NONE || tests_late)) ||
            (work->phase == RHW_PHASE_BACKWARDS && plan->depth_mode == RHW_DEPTH_NONE && is_all_open(work)));
}

// Return true if a triangle of the draw that covers the tile all over has one colour in all of it.
RHW_INLINE bool takes_constant_tile(const struct tile_work *work)
{
    return work->plan.shading == RHW_SHADING_CONSTANT && !work->plan.needs_depth && !work->is_scissored &&
           (work->phase == RHW_PHASE_ONLY || (work->phase == RHW_PHASE_BACKWARDS && is_all_open(work)));
}

// Expand all blocks of the tile: each of their samples is about to be shaded.
static void expand_tile(const struct tile_work *work)
{
    for (int block = 0; block < HIZ_BLOCKS * HIZ_BLOCKS; block++) {
        if (!(work->scratch->expanded >> block & 1)) {
            expand_block(work, block);
        }
    }
}

// Count the fragments of a triangle that covers the tile all over. When triangles are drawn backwards, no sample is
// open behind it.
static void end_whole_tile(struct tile_work *work)
{
    work->counters->fragments += (uint64_t)work->samples * RHW_TILE * RHW_TILE;
    for (int s = 0; s < work->samples && work->phase == RHW_PHASE_BACKWARDS; s++) {
        struct tile_depth *const depth = depth_of_sample(work->scratch, s);
        memset(depth->open, 0, sizeof depth->open);
        depth->open_count = 0;
    }
}

// Draw a triangle that covers the tile all over and whose planes are set, of a draw that takes_whole_tile is true for.
// Return false if the triangle takes the path of any other.
static __attribute__((noinline)) bool draw_whole_tile(struct tile_work *work, struct triangle_work *triangle)
{
    if (triangle->planes.kind != PLANES_LINEAR || triangle->clipped) {
        return false;
    }
    if (work->samples > 1) {
        expand_tile(work);
    }
    RHW_ISA_NAME(rhw_queue_tile)(work, triangle);
    end_whole_tile(work);
    return true;
}

#endif
