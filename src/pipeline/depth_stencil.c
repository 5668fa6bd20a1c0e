// SPDX-License-Identifier: MIT
// The decisions about depth and stencil that hold for a whole draw.
#include "depth_stencil.h"

#include <math.h>
#include <string.h>

#include "context/misuse.h"

static int32_t mask_of(uint16_t mask)
{
    return mask == 0 ? 0xff : mask == RHW_STENCIL_NO_BITS ? 0 : mask;
}

static struct rhw_stencil_rule rule_of(const struct rhw_stencil_face *face, bool is_on, uint8_t reference)
{
    return (struct rhw_stencil_rule){.compare = is_on && face->compares ? face->compare : RHW_COMPARE_ALWAYS,
                                     .fail = face->fail,
                                     .depth_fail = face->depth_fail,
                                     .pass = face->pass,
                                     .read_mask = mask_of(face->read_mask),
                                     .write_mask = mask_of(face->write_mask),
                                     .reference = reference};
}

static void set_masks(struct rhw_stencil_rule face[2], const struct rhw_stencil_masks *masks)
{
    face[0].read_mask = masks->read_front;
    face[0].write_mask = masks->write_front;
    face[1].read_mask = masks->read_back;
    face[1].write_mask = masks->write_back;
}

// Return the depth above which a float is what rounding makes of it. With 24 bits, steps are as far from each other as
// floats between 1/2 and 1: z = N·2^-24 is nearest to step N − 1, to which the nearest float is z.
static float kept_above(double depth_steps)
{
    return depth_steps == 0 ? -INFINITY : depth_steps == 0xffffff ? 0.5f : INFINITY;
}

static bool keeps_failed(const struct rhw_stencil_rule *rule)
{
    return rule->write_mask == 0 || (rule->fail == RHW_STENCIL_KEEP && rule->depth_fail == RHW_STENCIL_KEEP);
}

// Return true if a topology has polygons. Points and lines have no depth bias; polygons that are drawn as points or
// lines have it.
static bool draws_polygons(enum rhw_topology topology)
{
    return topology == RHW_TRIANGLE_LIST || topology == RHW_TRIANGLE_STRIP || topology == RHW_TRIANGLE_FAN ||
           topology == RHW_TRIANGLE_LIST_ADJACENCY || topology == RHW_TRIANGLE_STRIP_ADJACENCY;
}

// Return true if the samples that pass are not the fragments that are shaded: there are fewer, or more, or no
// fragments.
static bool counts_by_test(const struct rhw_pipeline_def *def, bool many_samples)
{
    const struct rhw_program *const program = &def->program;
    const bool has_fragment = program->fragment[RHW_ISA_BASELINE] != NULL || program->fragment1 != NULL;
    return many_samples || !has_fragment || def->alpha_to_coverage ||
           program->uses & (RHW_USE_DISCARD | RHW_USE_DEPTH | RHW_USE_SAMPLE_MASK | RHW_USE_EFFECTS);
}

void rhw_depth_stencil_init(struct rhw_depth_stencil_state *state, const struct rhw_pipeline_def *def,
                            const struct rhw_depth_stencil_setting *setting, double depth_steps)
{
    memset(state, 0, sizeof *state);
    state->tests_stencil = def->stencil_test;
    state->tests_bounds = def->depth_bounds_test;
    state->depth_steps = def->depth_test ? depth_steps : 0;
    state->depth_margin = state->depth_steps != 0 ? (float)(2 / state->depth_steps) : 0;
    state->kept_above = kept_above(state->depth_steps);
    state->counts = setting->counts;
    state->counts_by_test = state->counts && counts_by_test(def, setting->many_samples);
    state->needs_stencil_test =
        state->tests_stencil || state->tests_bounds || state->depth_steps != 0 || state->counts_by_test;
    state->face[0] = rule_of(&def->stencil_front, def->stencil_test, setting->reference[0]);
    state->face[1] = rule_of(&def->stencil_back, def->stencil_test, setting->reference[1]);
    if (setting->has_masks) {
        set_masks(state->face, &setting->masks);
    }
    state->rejects_early =
        !state->tests_stencil || (keeps_failed(&state->face[0]) && keeps_failed(&state->face[1]));
    state->bounds_least = setting->bounds_least;
    state->bounds_most = setting->bounds_most;
    state->bias = setting->has_bias ? setting->bias : def->depth_bias;
    state->is_biased = draws_polygons(def->topology) && (state->bias.constant != 0 || state->bias.slope != 0);
}

static bool face_writes(const struct rhw_stencil_face *face, int mask)
{
    return mask != 0 && (face->fail != RHW_STENCIL_KEEP || face->depth_fail != RHW_STENCIL_KEEP ||
                         face->pass != RHW_STENCIL_KEEP);
}

// Points and lines face the front, and are not culled.
bool rhw_writes_stencil(const struct rhw_pipeline_def *def, const struct rhw_depth_stencil_setting *setting)
{
    const bool has_masks = setting->has_masks, has_sides = draws_polygons(def->topology);
    const int front = has_masks ? setting->masks.write_front : mask_of(def->stencil_front.write_mask);
    const int back = has_masks ? setting->masks.write_back : mask_of(def->stencil_back.write_mask);
    const bool draws_front = !has_sides || !(def->cull == RHW_CULL_FRONT || def->cull == RHW_CULL_BOTH);
    const bool draws_back = has_sides && !(def->cull == RHW_CULL_BACK || def->cull == RHW_CULL_BOTH);
    return def->stencil_test && ((draws_front && face_writes(&def->stencil_front, front)) ||
                                 (draws_back && face_writes(&def->stencil_back, back)));
}

bool rhw_check_depth_bias(const struct rhw_context *context, const struct rhw_depth_bias *bias,
                          const char *where)
{
    return rhw_check(context, isfinite(bias->constant) && isfinite(bias->slope) && isfinite(bias->clamp),
                     "%s: depth_bias is %g, %g, %g; all must be finite", where, (double)bias->constant,
                     (double)bias->slope, (double)bias->clamp);
}
