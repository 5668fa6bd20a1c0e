// SPDX-License-Identifier: MIT
// Which draws may be drawn depth first or backwards.
#include "deferral.h"

#include "pipeline.h"

enum rhw_compare rhw_deferral(const struct rhw_draw_state *state, int color_count)
{
    if (!state->pipeline || color_count == 0) {
        return RHW_COMPARE_NEVER;
    }
    const struct rhw_pipeline_def *const def = &state->pipeline->def;
    if (!(state->pipeline->fragment || def->program.fragment1)) {
        return RHW_COMPARE_NEVER;
    }
    for (int i = 0; i < color_count; i++) {
        if (!state->outputs[i].replaces) {
            return RHW_COMPARE_NEVER;
        }
    }
    if (!def->depth_test) {
        return def->program.uses & RHW_USE_DISCARD ? RHW_COMPARE_NEVER : RHW_COMPARE_ALWAYS;
    }
    if (!def->depth_write || def->program.uses & RHW_USE_DEPTH) {
        return RHW_COMPARE_NEVER;
    }
    switch (def->depth_compare) {
    case RHW_COMPARE_LESS:
    case RHW_COMPARE_LESS_EQUAL:
    case RHW_COMPARE_GREATER:
    case RHW_COMPARE_GREATER_EQUAL: return def->depth_compare;
    default: return RHW_COMPARE_NEVER;
    }
}
