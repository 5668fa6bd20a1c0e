// SPDX-License-Identifier: MIT
// How the plan of a draw follows from its state.
#include "draw_plan.h"

#include "pipeline/depth_stencil.h"
#include "format/format.h"
#include "pipeline/pipeline.h"
#include "triangle.h"

// Whether samples may be dropped after the fragment function.
static bool masks_samples(const struct rhw_pipeline_def *def)
{
    return def->alpha_to_coverage || def->program.uses & RHW_USE_SAMPLE_MASK;
}

// Whether fragments may be dropped, or moved, after the fragment function.
static bool drops_late(const struct rhw_pipeline_def *def)
{
    return def->program.uses & (RHW_USE_DISCARD | RHW_USE_DEPTH) || masks_samples(def);
}

// Whether depth is tested after it: for that reason, since the function has effects for fragments that fail too, or
// reads what depth was before.
static bool tests_late(const struct rhw_pipeline_def *def)
{
    return !def->program.early_fragment_tests &&
           (drops_late(def) || def->program.uses & (RHW_USE_EFFECTS | RHW_USE_TEST_INPUT));
}

static enum rhw_sampling choose_sampling(const struct rhw_pipeline_data *pipeline, int samples)
{
    const uint32_t each = RHW_USE_SAMPLE | RHW_USE_TARGET_INPUT;
    return samples == 1                        ? RHW_SAMPLING_CENTER
           : pipeline->def.program.uses & each ? RHW_SAMPLING_SAMPLE
                                               : pipeline->sampling;
}

// Whether nobody sees that a draw has a fragment function: no target takes its colours, it drops and moves nothing, has
// no effects, and is not counted. A shader of Vulkan may write a colour into a pass that keeps depth alone.
static bool is_unseen(const struct rhw_pipeline_data *pipeline,
                      const struct rhw_depth_stencil_state *depth_stencil)
{
    const struct rhw_pipeline_def *const def = &pipeline->def;
    bool is_written = false;
    for (int i = 0; i < def->target_count; i++) {
        is_written |= def->targets[i].write_mask != 0;
    }
    return !is_written && !drops_late(def) && !(def->program.uses & RHW_USE_EFFECTS) &&
           !depth_stencil->counts;
}

static enum rhw_shading choose_shading(const struct rhw_pipeline_data *pipeline,
                                       const struct rhw_depth_stencil_state *depth_stencil,
                                       enum rhw_phase phase, int samples, enum rhw_paths paths)
{
    const uint32_t uses = pipeline->def.program.uses;
    // What groups can be filled with together.
    const uint32_t together = RHW_USE_COORD | RHW_USE_DISCARD | RHW_USE_DEPTH | RHW_USE_FACING | RHW_USE_IDS |
                              RHW_USE_EFFECTS | RHW_USE_LAYER | RHW_USE_TARGET_INPUT;
    const enum rhw_sampling sampling = choose_sampling(pipeline, samples);
    const bool per_sample = sampling == RHW_SAMPLING_SAMPLE;
    const bool has_fragment = pipeline->fragment || pipeline->def.program.fragment1;
    if (!has_fragment || phase == RHW_PHASE_DEPTH || is_unseen(pipeline, depth_stencil)) {
        return RHW_SHADING_NONE;
    }
    // What a fragment function sees of samples, and does to them, is kept by rows; and in other groups a pixel may be
    // twice, which effects must not meet.
    const bool by_rows =
        samples > 1 && (masks_samples(&pipeline->def) || uses & (RHW_USE_DEPTH | RHW_USE_EFFECTS) ||
                        sampling == RHW_SAMPLING_CENTROID);
    if (paths == RHW_PATHS_GENERAL || by_rows) {
        return RHW_SHADING_ROWS;
    }
    if (uses == 0 && pipeline->varying_components == 0 && !masks_samples(&pipeline->def)) {
        return RHW_SHADING_CONSTANT;
    }
    // Groups of single samples are told of their sample by rows.
    if (!(uses & ~(together | (per_sample ? RHW_USE_SAMPLE : 0)))) {
        return RHW_SHADING_SMOOTH;
    }
    return per_sample || uses & RHW_USE_TARGET_INPUT ? RHW_SHADING_ROWS : RHW_SHADING_ANY;
}

// 1 and −1 for comparisons that let depth move one way alone.
static int direction_of(enum rhw_compare compare)
{
    switch (compare) {
    case RHW_COMPARE_LESS:
    case RHW_COMPARE_LESS_EQUAL: return 1;
    case RHW_COMPARE_GREATER:
    case RHW_COMPARE_GREATER_EQUAL: return -1;
    default: return 0;
    }
}

static enum rhw_depth_mode choose_depth_mode(const struct rhw_pipeline_def *def,
                                             const struct rhw_depth_stencil_state *depth_stencil,
                                             enum rhw_shading shading)
{
    const uint32_t uses = def->program.uses;
    if (!def->depth_test && !depth_stencil->needs_stencil_test) {
        return RHW_DEPTH_NONE;
    }
    if (shading == RHW_SHADING_NONE || !tests_late(def)) {
        return RHW_DEPTH_EARLY;
    }
    // A fragment that fails an ordering test now fails it later too, as depth only moves that way meanwhile. How many
    // do so now depends on the path: what is counted is tested once.
    const bool can_reject = !(uses & (RHW_USE_DEPTH | RHW_USE_EFFECTS | RHW_USE_TEST_INPUT)) &&
                            direction_of(def->depth_compare) != 0 && !depth_stencil->tests_stencil &&
                            !depth_stencil->tests_bounds && !depth_stencil->counts;
    return can_reject ? RHW_DEPTH_EARLY_REJECT : RHW_DEPTH_LATE;
}

static enum rhw_rule_name name_of(struct rhw_depth_rule rule)
{
    for (int i = 0; i < RHW_RULE_ANY; i++) {
        const struct rhw_depth_rule named = rhw_named_rules[i];
        if (rule.compare == named.compare && rule.write == named.write && rule.open == named.open) {
            return (enum rhw_rule_name)i;
        }
    }
    return RHW_RULE_ANY;
}

// How depth is tested in a phase. Of fragments with equal depth the first wins with LESS and GREATER (`strict`), the
// last with the others.
static void plan_rules(struct rhw_draw_plan *plan, const struct rhw_pipeline_def *def, enum rhw_phase phase)
{
    const enum rhw_compare compare = def->depth_test ? def->depth_compare : RHW_COMPARE_ALWAYS;
    const bool strict = compare == RHW_COMPARE_LESS || compare == RHW_COMPARE_GREATER;
    const bool early = plan->depth_mode == RHW_DEPTH_EARLY;
    plan->late = (struct rhw_depth_rule){compare, plan->moves_depth, RHW_OPEN_IGNORED};
    plan->early = (struct rhw_depth_rule){compare, plan->moves_depth && early, RHW_OPEN_IGNORED};
    if (phase == RHW_PHASE_DEPTH) {
        plan->early.open = RHW_OPEN_MARK;
    } else if (phase == RHW_PHASE_SHADE && early) {
        plan->early =
            (struct rhw_depth_rule){RHW_COMPARE_EQUAL, false, strict ? RHW_OPEN_CLAIM : RHW_OPEN_IGNORED};
    } else if (phase == RHW_PHASE_SHADE && strict) {
        plan->early.open = RHW_OPEN_TRY;
        plan->late.open = RHW_OPEN_CLOSE;
    }
}

// Returns true if a draw does no more than to change stencil by what the depth test says.
static bool tests_whole_blocks(const struct rhw_draw_plan *plan, const struct rhw_pipeline_def *def,
                               const struct rhw_depth_stencil_state *depth_stencil)
{
    return depth_stencil->tests_stencil && depth_stencil->face[0].compare == RHW_COMPARE_ALWAYS &&
           depth_stencil->face[1].compare == RHW_COMPARE_ALWAYS && !depth_stencil->tests_bounds &&
           !depth_stencil->counts_by_test && def->depth_test && direction_of(def->depth_compare) != 0 &&
           !plan->moves_depth && plan->shading == RHW_SHADING_NONE && plan->early.open == RHW_OPEN_IGNORED;
}

static enum rhw_fragment_test choose_test(const struct rhw_draw_plan *plan,
                                          const struct rhw_pipeline_def *def,
                                          const struct rhw_depth_stencil_state *depth_stencil, int samples,
                                          enum rhw_paths paths)
{
    if (!depth_stencil->needs_stencil_test) {
        return RHW_TEST_DEPTH;
    }
    if (paths == RHW_PATHS_GENERAL || !plan->tests_early || depth_stencil->tests_bounds ||
        plan->early.open != RHW_OPEN_IGNORED) {
        return RHW_TEST_STENCIL;
    }
    return samples == 1 && tests_whole_blocks(plan, def, depth_stencil) ? RHW_TEST_WHOLE_BLOCKS
                                                                        : RHW_TEST_MASKS;
}

static void plan_depth(struct rhw_draw_plan *plan, const struct rhw_pipeline_def *def,
                       const struct rhw_depth_stencil_state *depth_stencil, enum rhw_phase phase, int samples,
                       enum rhw_paths paths)
{
    const enum rhw_compare compare = def->depth_compare;
    const bool general = paths == RHW_PATHS_GENERAL;
    plan->is_biased = depth_stencil->is_biased;
    plan->moves_depth = def->depth_test && !def->depth_read_only;
    plan->depth_mode = choose_depth_mode(def, depth_stencil, plan->shading);
    plan_rules(plan, def, phase);
    plan->tests_early = plan->depth_mode == RHW_DEPTH_EARLY || plan->depth_mode == RHW_DEPTH_EARLY_REJECT;
    plan->test = choose_test(plan, def, depth_stencil, samples, paths);
    plan->early_name = general || plan->test != RHW_TEST_DEPTH ? RHW_RULE_ANY : name_of(plan->early);
    // What lies behind a bound may still round to it, or change the stencil.
    const bool can_be_bounded = depth_stencil->rejects_early && depth_stencil->depth_steps == 0;
    plan->depth_direction = def->depth_test && !general && can_be_bounded ? direction_of(compare) : 0;
    plan->ends_bounds = plan->moves_depth && plan->depth_direction == 0 && compare != RHW_COMPARE_EQUAL &&
                        compare != RHW_COMPARE_NEVER;
}

// Integers have no part of themselves. Without a target there is a colour where alpha decides about coverage; what
// targets[0] says then is nothing.
static bool weighs_alpha(const struct rhw_pipeline_data *pipeline)
{
    return pipeline->is_smooth && pipeline->output_count != 0 &&
           (pipeline->def.target_count == 0 ||
            !rhw_format_is_integer(rhw_format_info(pipeline->def.targets[0].format)));
}

// Sets the special paths that the draw has. Where pixels have several samples, groups of small triangles are no rows,
// and open pixels are not kept by sample. A triangle whose depth is biased, or that nothing shades, is not drawn as a
// tiny one where pixels have one sample.
static void plan_paths(struct rhw_draw_plan *plan, enum rhw_phase phase, int samples)
{
    const bool is_forward = phase != RHW_PHASE_BACKWARDS;
    plan->draws_spans = samples == 1;
    if (plan->test != RHW_TEST_DEPTH || plan->shading == RHW_SHADING_CONSTANT) {
        return;
    }
    if (samples == 1) {
        plan->draws_small = true;
        plan->draws_tiny = is_forward && plan->shading != RHW_SHADING_NONE && !plan->is_biased;
    } else {
        plan->draws_small = is_forward && (plan->shading == RHW_SHADING_NONE || plan->collects);
        plan->draws_tiny = samples == 4 && plan->draws_small && !plan->is_biased;
    }
}

static struct rhw_draw_plan plan_of(const struct rhw_pipeline_data *pipeline,
                                    const struct rhw_depth_stencil_state *depth_stencil, enum rhw_phase phase,
                                    int samples, enum rhw_paths paths)
{
    const uint32_t uses = pipeline->def.program.uses;
    const bool reads_targets = uses & RHW_USE_TARGET_INPUT;
    // Groups of programs that ask what is fully covered, and of smooth pipelines, are rows. The order of fragments
    // depends on the path, and where it would show there is one path.
    const bool is_general =
        uses & RHW_USE_FULLY_COVERED || pipeline->is_smooth || pipeline->def.program.uses_atomic_results;
    const enum rhw_paths shading_paths = is_general ? RHW_PATHS_GENERAL : paths;
    // Programs that read targets are drawn by rows of blocks, which are filled together.
    paths = reads_targets ? RHW_PATHS_GENERAL : shading_paths;
    struct rhw_draw_plan plan = {.reads_targets = reads_targets,
                                 .shading =
                                     choose_shading(pipeline, depth_stencil, phase, samples, shading_paths),
                                 .sampling = choose_sampling(pipeline, samples),
                                 .weighs_alpha = weighs_alpha(pipeline),
                                 .masks_samples = masks_samples(&pipeline->def)};
    const bool shades = plan.shading != RHW_SHADING_NONE;
    plan.collects = (plan.shading == RHW_SHADING_SMOOTH || plan.shading == RHW_SHADING_ANY) &&
                    plan.sampling == RHW_SAMPLING_CENTER && !reads_targets;
    plan_depth(&plan, &pipeline->def, depth_stencil, phase, samples, paths);
    plan.drops = plan.depth_mode >= RHW_DEPTH_LATE || plan.masks_samples || uses & RHW_USE_DISCARD;
    plan.is_skipped = phase == RHW_PHASE_DEPTH && (uses & RHW_USE_DISCARD || plan.masks_samples);
    plan.keeps_depth =
        shades && (plan.depth_mode == RHW_DEPTH_LATE || plan.depth_mode == RHW_DEPTH_EARLY_REJECT ||
                   uses & (RHW_USE_COORD | RHW_USE_DEPTH));
    plan.needs_depth = plan.depth_mode != RHW_DEPTH_NONE || plan.keeps_depth;
    plan.keeps_identity = plan.shading == RHW_SHADING_SMOOTH && uses & (RHW_USE_FACING | RHW_USE_IDS);
    const bool screen = pipeline->any_noperspective || uses & (RHW_USE_BARYCENTRIC | RHW_USE_POINT_COORD);
    plan.needs_screen = plan.shading == RHW_SHADING_ROWS || (shades && screen);
    plan.fills_more =
        plan.shading == RHW_SHADING_SMOOTH &&
        (uses & RHW_USE_COORD || pipeline->any_noperspective || pipeline->any_constant_derivatives);
    plan.needs_distance = shades && (pipeline->any_derivatives || uses & RHW_USE_BARYCENTRIC_DERIVATIVES);
    if (paths != RHW_PATHS_GENERAL && !plan.is_skipped) {
        plan_paths(&plan, phase, samples);
    }
    return plan;
}

void rhw_draw_plans_make(struct rhw_draw_plan plans[RHW_PHASE_COUNT],
                         const struct rhw_pipeline_data *pipeline,
                         const struct rhw_depth_stencil_state *depth_stencil, int samples,
                         enum rhw_paths paths)
{
    for (int phase = 0; phase < RHW_PHASE_COUNT; phase++) {
        plans[phase] = plan_of(pipeline, depth_stencil, (enum rhw_phase)phase, samples, paths);
    }
}
