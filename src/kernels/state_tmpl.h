// SPDX-License-Identifier: MIT
// What a draw changes of the work on a tile. Template: compiled once per instruction set.

#include "hiz_tmpl.h"

// How depth is tested in a phase; `strict`: LESS or GREATER, where the first of equals wins.
static void set_depth(struct tile_work *work, const struct rhw_pipeline_def *def)
{
    const uint32_t uses = def->program.uses;
    const enum rhw_compare compare = def->depth_compare;
    const bool strict = compare == RHW_COMPARE_LESS || compare == RHW_COMPARE_GREATER;
    const bool monotonic =
        strict || compare == RHW_COMPARE_LESS_EQUAL || compare == RHW_COMPARE_GREATER_EQUAL;
    // A fragment that fails an ordering test now fails it later too, as depth only moves that way meanwhile.
    work->depth_mode = !def->depth_test                                               ? DEPTH_NONE
                       : !work->shades || !(uses & (RHW_USE_DISCARD | RHW_USE_DEPTH)) ? DEPTH_EARLY
                       : uses & RHW_USE_DEPTH || !monotonic                           ? DEPTH_LATE
                                                                                      : DEPTH_EARLY_REJECT;
    const bool early = work->depth_mode == DEPTH_EARLY;
    work->late = (struct depth_rule){compare, def->depth_write, OPEN_IGNORED};
    work->early = (struct depth_rule){compare, def->depth_write && early, OPEN_IGNORED};
    if (work->phase == PHASE_DEPTH) {
        work->early.open = OPEN_MARK;
    } else if (work->phase == PHASE_SHADE && early) {
        work->early = (struct depth_rule){RHW_COMPARE_EQUAL, false, strict ? OPEN_TAKE : OPEN_IGNORED};
    } else if (work->phase == PHASE_SHADE && strict) {
        work->early.open = OPEN_TRY;
        work->late.open = OPEN_CLOSE;
    }
    work->common = common_rule(work->early);
    hiz_follow(work, def);
}

static void set_state(struct tile_work *work, const struct rhw_draw_state *state)
{
    const struct rhw_pipeline_data *const pipeline = state->pipeline;
    const struct rhw_pipeline_def *const def = &pipeline->def;
    const uint32_t uses = def->program.uses;
    work->state = state;
    work->pipeline = pipeline;
    work->shades = (pipeline->fragment || def->program.fragment1) && work->phase != PHASE_DEPTH;
    work->skips = work->phase == PHASE_DEPTH && uses & RHW_USE_DISCARD;
    const struct rhw_rect *const scissor = &state->scissor;
    work->scissored = scissor->x > work->x || scissor->y > work->y ||
                      scissor->x + scissor->width < work->x + RHW_TILE ||
                      scissor->y + scissor->height < work->y + RHW_TILE;
    const bool smooth = !pipeline->any_noperspective && !pipeline->any_flat;
    const uint32_t identity = RHW_USE_DISCARD | RHW_USE_DEPTH | RHW_USE_FACING | RHW_USE_IDS;
    work->constant = work->shades && uses == 0 && pipeline->varying_components == 0;
    work->smooth = smooth && !(uses & ~identity);
    work->packs = work->smooth && !work->constant;
    set_depth(work, def);
    work->keeps_depth =
        work->shades && (work->depth_mode >= DEPTH_LATE || uses & (RHW_USE_COORD | RHW_USE_DEPTH));
    work->needs_depth = work->depth_mode != DEPTH_NONE || work->keeps_depth;
    work->wants = work->keeps_depth || (work->smooth && uses & (RHW_USE_FACING | RHW_USE_IDS));
    for (int g = 0; g < RHW_FRAGMENT_GROUPS; g++) {
        struct rhw_fragment *const group = &work->scratch->groups[g];
        const int offset = g * pipeline->varying_components;
        group->varying = work->scratch->varyings + offset;
        group->ddx = work->scratch->ddx + offset;
        group->ddy = work->scratch->ddy + offset;
        group->user = def->program.user;
        group->textures = state->textures;
        group->color = work->scratch->outputs[g];
    }
}

// Draws that differ in their uniforms alone have the same state.
static void set_draw(struct tile_work *work, const struct rhw_draw *draw)
{
    flush(work);
    if (!work->draw || work->draw->state != draw->state) {
        set_state(work, draw->state);
    }
    work->draw = draw;
    work->constant_ready = false;
    for (int g = 0; g < RHW_FRAGMENT_GROUPS; g++) {
        work->scratch->groups[g].uniforms = draw->uniforms;
    }
}
