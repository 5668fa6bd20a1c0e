// SPDX-License-Identifier: MIT
// Which draws may be drawn depth first or backwards.
#include "hidden_surface.h"

#include "draw_list.h"
#include "pipeline/pipeline.h"

static const struct rhw_hidden_rule in_order = {RHW_HIDDEN_IN_ORDER, RHW_COMPARE_NEVER};

static bool shades_opaque_texels(const struct rhw_draw_state *state, int color_count)
{
    const struct rhw_pipeline_data *const pipeline = state->pipeline;
    bool opaque = color_count != 0 && (pipeline->fragment || pipeline->def.program.fragment1);
    for (int i = 0; i < color_count; i++) {
        opaque = opaque && (state->blend[i].replaces || pipeline->left_out >> i & 1);
    }
    return opaque;
}

struct rhw_hidden_rule rhw_hidden_rule_of(const struct rhw_draw_state *state, int color_count)
{
    const struct rhw_pipeline_def *const def = &state->pipeline->def;
    const struct rhw_depth_stencil_state *const depth = &state->depth_stencil;
    if (def->program.uses & (RHW_USE_EFFECTS | RHW_USE_TARGET_INPUT | RHW_USE_FULLY_COVERED) ||
        def->program.early_fragment_tests || state->pipeline->is_smooth) {
        return in_order;
    }
    if (depth->tests_stencil || depth->tests_bounds || depth->counts ||
        !shades_opaque_texels(state, color_count)) {
        return in_order;
    }
    if (!def->depth_test) {
        return def->program.uses & RHW_USE_DISCARD || state->plans[RHW_PHASE_ONLY].masks_samples
                   ? in_order
                   : (struct rhw_hidden_rule){RHW_HIDDEN_BACKWARDS, RHW_COMPARE_NEVER};
    }
    if (def->depth_read_only || def->program.uses & RHW_USE_DEPTH) {
        return in_order;
    }
    switch (def->depth_compare) {
    case RHW_COMPARE_LESS:
    case RHW_COMPARE_LESS_EQUAL:
    case RHW_COMPARE_GREATER:
    case RHW_COMPARE_GREATER_EQUAL:
        return (struct rhw_hidden_rule){RHW_HIDDEN_DEPTH_FIRST, def->depth_compare};
    default: return in_order;
    }
}
