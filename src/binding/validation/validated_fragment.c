// SPDX-License-Identifier: MIT
// Fragment functions under validation.
#include <stdio.h>
#include <string.h>

#include "format/format.h"
#include "binding/shader_adapter.h"
#include "validation.h"

// One run of the function over a pair of groups.
struct fragment_run {
    struct rhw_bindings bindings[RHW_VALIDATED_GROUPS];
    struct rhw_fragment group[RHW_VALIDATED_GROUPS];
    rhw_float varying[RHW_VALIDATED_GROUPS][RHW_VALIDATED_COMPONENTS];
    rhw_float ddx[RHW_VALIDATED_GROUPS][RHW_VALIDATED_COMPONENTS],
        ddy[RHW_VALIDATED_GROUPS][RHW_VALIDATED_COMPONENTS];
    rhw_float color[RHW_VALIDATED_GROUPS][RHW_MAX_COLOR_ATTACHMENTS][4];
};

// What may hold other rubbish than in the first run, a bit each: what the program can leave undeclared.
enum {
    VARYINGS = 1 << 24, // a bit above enum rhw_fragment_use
    DERIVATIVES = 1 << 25,
    UNIFORMS = 1 << 26,
    EVERYTHING = -1
};

static const struct {
    int32_t bit;
    const char *message; // what is read; then what the program lacks
} undeclared[] = {
    {VARYINGS, "reads a varying behind the last component"},
    {DERIVATIVES, "reads ddx or ddy of a varying that does not ask for derivatives"},
    {UNIFORMS, "reads uniforms behind uniform_size"},
    {RHW_USE_COORD, "reads coord; RHW_USE_COORD is missing in its program's uses"},
    {RHW_USE_FACING, "reads front_facing; RHW_USE_FACING is missing in its program's uses"},
    {RHW_USE_IDS, "reads primitive, instance or draw; RHW_USE_IDS is missing in its program's uses"},
    {RHW_USE_BARYCENTRIC, "reads barycentric weights; RHW_USE_BARYCENTRIC is missing in its program's uses"},
    {RHW_USE_BARYCENTRIC_DERIVATIVES, "reads derivatives of barycentric weights; "
                                      "RHW_USE_BARYCENTRIC_DERIVATIVES is missing in its program's uses"},
    {RHW_USE_SAMPLE, "reads sample_id or sample_position; RHW_USE_SAMPLE is missing in its program's uses"},
    {RHW_USE_SAMPLE_MASK, "reads sample_mask; RHW_USE_SAMPLE_MASK is missing in its program's uses"},
    {RHW_USE_POINT_COORD, "reads point_coord; RHW_USE_POINT_COORD is missing in its program's uses"},
    {RHW_USE_FULLY_COVERED, "reads fully_covered; RHW_USE_FULLY_COVERED is missing in its program's uses"},
    {RHW_USE_DEPTH_INPUT, "reads depth_input; RHW_USE_DEPTH_INPUT is missing in its program's uses"},
    {RHW_USE_STENCIL_INPUT, "reads stencil_input; RHW_USE_STENCIL_INPUT is missing in its program's uses"},
    {RHW_USE_LAYER, "reads layer or viewport_index; RHW_USE_LAYER is missing in its program's uses"},
    {RHW_USE_DEPTH, "reads depth; RHW_USE_DEPTH is missing in its program's uses"},
};

// Fill `count` vectors with rubbish, of the second kind where `other` is true.
static void spoil(rhw_float *values, int count, bool other)
{
    for (int i = 0; i < count; i++) {
        values[i] = rhw_validator_rubbish(rhw_validator_input[other]);
    }
}

// Fill builtins with rubbish. Integers may be used as indices: their rubbish is small.
static void spoil_builtins(struct rhw_fragment *group, uint32_t uses, int32_t changed)
{
    if (!(uses & RHW_USE_COORD)) {
        spoil(group->coord, 4, changed & RHW_USE_COORD);
    }
    if (!(uses & RHW_USE_FACING)) {
        group->front_facing = rhw_splat_int(changed & RHW_USE_FACING ? 0 : -1);
    }
    if (!(uses & RHW_USE_IDS)) {
        group->primitive = group->instance = group->draw = rhw_splat_int(changed & RHW_USE_IDS ? 0 : 1);
    }
    if (!(uses & RHW_USE_BARYCENTRIC)) {
        spoil(group->barycentric, 3, changed & RHW_USE_BARYCENTRIC);
        spoil(group->barycentric_noperspective, 3, changed & RHW_USE_BARYCENTRIC);
    }
    if (!(uses & RHW_USE_BARYCENTRIC_DERIVATIVES)) {
        spoil(group->barycentric_ddx, 3, changed & RHW_USE_BARYCENTRIC_DERIVATIVES);
        spoil(group->barycentric_ddy, 3, changed & RHW_USE_BARYCENTRIC_DERIVATIVES);
    }
    if (!(uses & RHW_USE_SAMPLE)) {
        group->sample_id = rhw_splat_int(changed & RHW_USE_SAMPLE ? 0 : 1);
        spoil(group->sample_position, 2, changed & RHW_USE_SAMPLE);
    }
    if (!(uses & RHW_USE_SAMPLE_MASK)) {
        group->sample_mask = rhw_splat_int(changed & RHW_USE_SAMPLE_MASK ? 0 : -1);
    }
    if (!(uses & RHW_USE_POINT_COORD)) {
        spoil(group->point_coord, 2, changed & RHW_USE_POINT_COORD);
    }
    if (!(uses & RHW_USE_FULLY_COVERED)) {
        group->fully_covered = rhw_splat_int(changed & RHW_USE_FULLY_COVERED ? 0 : -1);
    }
    if (!(uses & RHW_USE_DEPTH_INPUT)) {
        spoil(&group->depth_input, 1, changed & RHW_USE_DEPTH_INPUT);
    }
    if (!(uses & RHW_USE_STENCIL_INPUT)) {
        group->stencil_input = rhw_splat_int(changed & RHW_USE_STENCIL_INPUT ? 0 : 1);
    }
    if (!(uses & RHW_USE_LAYER)) {
        group->layer = group->viewport_index = rhw_splat_int(changed & RHW_USE_LAYER ? 0 : 1);
    }
    if (!(uses & RHW_USE_DEPTH)) {
        spoil(&group->depth, 1, changed & RHW_USE_DEPTH);
    }
}

static bool has_effects(const struct rhw_validator *validator)
{
    return validator->uses & RHW_USE_EFFECTS;
}

// Give group g of a run what the pipeline has for it, and rubbish where the pipeline has nothing.
static void prepare(const struct rhw_validator *validator, const struct rhw_fragment *group, int32_t changed,
                    bool second, int g, struct fragment_run *out)
{
    const struct rhw_pipeline_data *const pipeline = validator->pipeline;
    const int components = rhw_validated_count(pipeline);
    spoil(out->varying[g], components, changed & VARYINGS);
    spoil(out->ddx[g], components, changed & DERIVATIVES);
    spoil(out->ddy[g], components, changed & DERIVATIVES);
    for (int i = 0; i < pipeline->varying_components; i++) {
        out->varying[g][i] = group->varying[i];
        if (pipeline->component_derivatives[i]) {
            out->ddx[g][i] = group->ddx[i];
            out->ddy[g][i] = group->ddy[i];
        }
    }
    for (int t = 0; t < RHW_MAX_COLOR_ATTACHMENTS; t++) {
        for (int c = 0; c < 4; c++) {
            out->color[g][t][c] = rhw_validator_rubbish(rhw_validator_output[second]);
        }
    }
    if (validator->uses & RHW_USE_COLOR_INPUT) {
        memcpy(out->color[g], group->color, (size_t)pipeline->def.target_count * sizeof group->color[0]);
    }
    rhw_bindings_copy(group->bindings, &out->bindings[g]);
    out->bindings[g].drops_effects = !has_effects(validator);
    if (changed == 0) { // in other runs coordinates may come from another rubbish
        out->bindings[g].site = rhw_validator_site(validator, group->uniforms, &group->mask);
    }
    struct rhw_fragment *const copy = &out->group[g];
    *copy = *group;
    copy->varying = out->varying[g];
    copy->ddx = out->ddx[g];
    copy->ddy = out->ddy[g];
    copy->color = out->color[g];
    copy->bindings = &out->bindings[g];
    copy->uniforms = rhw_validator_uniforms(group->uniforms, changed & UNIFORMS);
    copy->user = validator->user;
    spoil_builtins(copy, validator->uses, changed);
}

static void run_groups(const struct rhw_validator *validator,
                       const struct rhw_fragment *const pair[RHW_VALIDATED_GROUPS], int32_t changed,
                       bool second, int count, struct fragment_run *out)
{
    for (int g = 0; g < count; g++) {
        prepare(validator, pair[g], changed, second, g, out);
    }
    if (validator->fragment) {
        validator->fragment(out->group, count);
    } else {
        rhw_fragment1_run(validator->pipeline, out->group, count);
    }
}

static void run(const struct rhw_validator *validator,
                const struct rhw_fragment *const pair[RHW_VALIDATED_GROUPS], int32_t changed, bool second,
                struct fragment_run *out)
{
    run_groups(validator, pair, changed, second, RHW_VALIDATED_GROUPS, out);
}

static bool is_source_alpha(enum rhw_blend_factor factor)
{
    return factor == RHW_BLEND_SRC_ALPHA || factor == RHW_BLEND_ONE_MINUS_SRC_ALPHA ||
           factor == RHW_BLEND_SRC_ALPHA_SATURATED;
}

// Return true if blending reads the source's alpha. MIN and MAX ignore the factors.
static bool reads_source_alpha(const struct rhw_blend_component *color)
{
    return color->operation != RHW_BLEND_MIN && color->operation != RHW_BLEND_MAX &&
           (is_source_alpha(color->src) || is_source_alpha(color->dst));
}

// Return the channels that are needed of the second source, which stands behind the only target.
static unsigned second_channels(const struct rhw_color_target *target, unsigned kept)
{
    const unsigned colors = RHW_WRITE_RED | RHW_WRITE_GREEN | RHW_WRITE_BLUE;
    const enum rhw_blend_factor color[2] = {target->color.src, target->color.dst};
    const enum rhw_blend_factor alpha[2] = {target->alpha.src, target->alpha.dst};
    unsigned needed = 0;
    for (int i = 0; i < 2; i++) {
        const bool whole = color[i] == RHW_BLEND_SRC1 || color[i] == RHW_BLEND_ONE_MINUS_SRC1;
        const bool by_alpha = color[i] >= RHW_BLEND_SRC1_ALPHA && kept & colors;
        needed |= whole ? kept & colors : by_alpha ? RHW_WRITE_ALPHA : 0;
        needed |= alpha[i] >= RHW_BLEND_SRC1 ? kept & RHW_WRITE_ALPHA : 0;
    }
    return needed;
}

// Return the channels of target t that a pass needs, a bit each: those it keeps, and the alpha that colours are blended
// by.
static unsigned needed_channels(const struct rhw_validator *validator, int t)
{
    const struct rhw_pipeline_def *const def = &validator->pipeline->def;
    if (t >= validator->pipeline->output_count) {
        return 0;
    }
    if (def->target_count == 0) {
        return RHW_WRITE_ALPHA; // alpha decides about coverage
    }
    const bool is_second = t >= def->target_count;
    const struct rhw_color_target *const target = &def->targets[is_second ? 0 : t];
    const unsigned kept = target->write_mask & ((1u << rhw_format_info(target->format)->channels) - 1);
    if (is_second) {
        return second_channels(target, kept);
    }
    const bool any_color = kept & (RHW_WRITE_RED | RHW_WRITE_GREEN | RHW_WRITE_BLUE);
    const bool blends = target->blend && any_color && reads_source_alpha(&target->color);
    return kept | (blends || (t == 0 && def->alpha_to_coverage) ? RHW_WRITE_ALPHA : 0);
}

// Return the lanes of `mask` in which two runs have different results for a group.
static rhw_int differing(const struct rhw_validator *validator, const struct rhw_fragment *a,
                         const struct rhw_fragment *b, rhw_int mask)
{
    rhw_int lanes = rhw_splat_int(0);
    for (int t = 0; t < validator->pipeline->output_count; t++) {
        for (int c = 0; c < 4; c++) {
            if (needed_channels(validator, t) & 1u << c) {
                lanes |= rhw_validator_differs(a->color[t][c], b->color[t][c], mask);
            }
        }
    }
    if (validator->uses & RHW_USE_DISCARD) {
        lanes |= (a->mask != b->mask) & mask;
    }
    if (validator->uses & RHW_USE_SAMPLE_MASK) {
        lanes |= (a->sample_mask != b->sample_mask) & mask;
    }
    if (validator->uses & RHW_USE_DEPTH) {
        lanes |= rhw_validator_differs(a->depth, b->depth, mask);
    }
    return lanes;
}

static int first_lane(rhw_int lanes)
{
    int lane = 0;
    while (lane < RHW_LANES - 1 && lanes[lane] == 0) {
        lane++;
    }
    return lane;
}

// Tell what is wrong with a fragment, and which pixel it is.
static void report(const struct rhw_validator *validator, const struct rhw_fragment *group, rhw_int lanes,
                   enum rhw_validation_kind kind, const char *what)
{
    const int lane = first_lane(lanes);
    rhw_validation_messages_add(validator->validation, kind, rhw_validator_draw(group->uniforms)->draw,
                                "the fragment function of %s %s; at pixel %d, %d", validator->name, what,
                                (int)group->coord[0][lane], (int)group->coord[1][lane]);
}

static void report_channel(const struct rhw_validator *validator, const struct rhw_fragment *group,
                           rhw_int lanes, enum rhw_validation_kind kind, const char *verb, int t, int c)
{
    char what[96];
    snprintf(what, sizeof what, "%s color[%d][%d]", verb, t, c);
    report(validator, group, lanes, kind, what);
}

// Tell channels that were not written, and channels that were written and no target has. Return false when there is
// none.
static bool check_channels(const struct rhw_validator *validator, const struct rhw_fragment *group,
                           const struct rhw_fragment *first, const struct rhw_fragment *second, rhw_int mask)
{
    for (int t = 0; t < RHW_MAX_COLOR_ATTACHMENTS; t++) {
        for (int c = 0; c < 4; c++) {
            const bool needed = needed_channels(validator, t) & 1u << c;
            if (needed && rhw_validator_unwritten(first->color[t][c], second->color[t][c], mask)) {
                report_channel(validator, group, mask, RHW_VALIDATION_MISUSE, "does not write", t, c);
                return true;
            }
            if (t >= validator->pipeline->output_count &&
                rhw_any(((rhw_int)first->color[t][c] != (int32_t)rhw_validator_output[0]) & mask)) {
                // One program may serve pipelines of more targets, and of depth alone.
                report_channel(validator, group, mask, RHW_VALIDATION_WARNING,
                               "has no such target in its pipeline and writes", t, c);
            }
        }
    }
    return false;
}

// Tell results other than colours that were written and not declared: discarded fragments, depth, the sample mask.
// Return false when there is none.
static bool check_side_results(const struct rhw_validator *validator, const struct rhw_fragment *group,
                               const struct rhw_fragment *first, rhw_int mask)
{
    const rhw_int gone = (first->mask == 0) & mask;
    if (!(validator->uses & RHW_USE_DISCARD) && rhw_any(gone)) {
        report(validator, group, gone, RHW_VALIDATION_MISUSE,
               "discards fragments; RHW_USE_DISCARD is missing in its program's uses");
        return true;
    }
    const rhw_int moved = ((rhw_int)first->depth != (int32_t)rhw_validator_input[0]) & mask;
    if (!(validator->uses & RHW_USE_DEPTH) && rhw_any(moved)) {
        report(validator, group, moved, RHW_VALIDATION_MISUSE,
               "writes depth; RHW_USE_DEPTH is missing in its program's uses");
        return true;
    }
    const rhw_int dropped = (first->sample_mask != -1) & mask;
    if (!(validator->uses & RHW_USE_SAMPLE_MASK) && rhw_any(dropped)) {
        report(validator, group, dropped, RHW_VALIDATION_MISUSE,
               "writes sample_mask; RHW_USE_SAMPLE_MASK is missing in its program's uses");
        return true;
    }
    return false;
}

// Change one thing after the other, to find the one that the result depends on.
static __attribute__((cold)) void name_input(const struct rhw_validator *validator,
                                             const struct rhw_fragment *const pair[RHW_VALIDATED_GROUPS],
                                             int g, const struct rhw_fragment *first, rhw_int lanes)
{
    const struct rhw_fragment *const group = pair[g];
    for (size_t i = 0; i < sizeof undeclared / sizeof undeclared[0]; i++) {
        struct fragment_run other;
        run(validator, pair, undeclared[i].bit, false, &other);
        if (rhw_any(differing(validator, first, &other.group[g], lanes))) {
            report(validator, group, lanes, RHW_VALIDATION_MISUSE, undeclared[i].message);
            return;
        }
    }
    report(validator, group, lanes, RHW_VALIDATION_MISUSE, "gives two results for the same inputs");
}

static bool is_integer(const struct rhw_validator *validator, int t)
{
    const struct rhw_pipeline_def *const def = &validator->pipeline->def;
    return t < def->target_count && rhw_format_is_integer(rhw_format_info(def->targets[t].format));
}

static void warn_of_nan(const struct rhw_validator *validator, const struct rhw_fragment *group,
                        const struct rhw_fragment *first, rhw_int mask)
{
    for (int t = 0; t < validator->pipeline->output_count; t++) {
        for (int c = 0; c < 4 && !is_integer(validator, t); c++) {
            const rhw_float value = first->color[t][c];
            const rhw_int nan = (value != value) & mask;
            if (needed_channels(validator, t) & 1u << c && rhw_any(nan)) {
                report_channel(validator, group, nan, RHW_VALIDATION_WARNING, "gives NaN in", t, c);
                return;
            }
        }
    }
}

// Return the lanes whose results are kept.
static rhw_int live_lanes(const struct rhw_validator *validator, const struct rhw_fragment *group,
                          const struct rhw_fragment *first)
{
    return validator->uses & RHW_USE_DISCARD ? first->mask & group->mask : group->mask;
}

// Return the lanes in which the function wrote a channel that is needed.
static rhw_int written_lanes(const struct rhw_validator *validator, const struct rhw_fragment *first,
                             const struct rhw_fragment *second)
{
    rhw_int lanes = rhw_splat_int(0);
    for (int t = 0; t < validator->pipeline->output_count; t++) {
        for (int c = 0; c < 4; c++) {
            if (needed_channels(validator, t) & 1u << c) {
                lanes |= ((rhw_int)first->color[t][c] != (int32_t)rhw_validator_output[0]) |
                         ((rhw_int)second->color[t][c] != (int32_t)rhw_validator_output[1]);
            }
        }
    }
    return lanes;
}

// Return true if the function wrote to the first group of a pair, and nothing to the second, which has fragments to
// keep.
static bool forgets_second(const struct rhw_validator *validator,
                           const struct rhw_fragment *const pair[RHW_VALIDATED_GROUPS],
                           const struct fragment_run *first, const struct fragment_run *second)
{
    const rhw_int live = live_lanes(validator, pair[1], &first->group[1]);
    return rhw_any(live) && !rhw_any(written_lanes(validator, &first->group[1], &second->group[1]) & live) &&
           rhw_any(written_lanes(validator, &first->group[0], &second->group[0]));
}

// Compare group g of both runs.
static void check_group(const struct rhw_validator *validator,
                        const struct rhw_fragment *const pair[RHW_VALIDATED_GROUPS], int g,
                        const struct fragment_run *first_run, const struct fragment_run *second_run)
{
    const struct rhw_fragment *const group = pair[g];
    const struct rhw_fragment *const first = &first_run->group[g], *const second = &second_run->group[g];
    const rhw_int live = live_lanes(validator, group, first);
    const rhw_int lanes = differing(validator, first, second, live);
    if (validator->fragment && g > 0 && forgets_second(validator, pair, first_run, second_run)) {
        report(validator, group, live, RHW_VALIDATION_MISUSE,
               "works on the first of its groups alone; it must work on `count` of them");
    } else if (!check_channels(validator, group, first, second, live) &&
               !check_side_results(validator, group, first, group->mask)) {
        if (rhw_any(lanes)) {
            name_input(validator, pair, g, first, lanes);
        } else {
            warn_of_nan(validator, group, first, live);
        }
    }
}

static void take_results(const struct rhw_validator *validator, const struct rhw_fragment *first,
                         struct rhw_fragment *group)
{
    memcpy(group->color, first->color, (size_t)validator->pipeline->output_count * sizeof first->color[0]);
    if (validator->uses & RHW_USE_DISCARD) {
        group->mask = first->mask;
    }
    if (validator->uses & RHW_USE_DEPTH) {
        group->depth = first->depth;
    }
    if (validator->uses & RHW_USE_SAMPLE_MASK) {
        group->sample_mask = first->sample_mask;
    }
}

// Call a function with effects, once for each group.
static void run_once(const struct rhw_validator *validator, struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g += RHW_VALIDATED_GROUPS) {
        const int left = count - g < RHW_VALIDATED_GROUPS ? count - g : RHW_VALIDATED_GROUPS;
        const struct rhw_fragment *const pair[RHW_VALIDATED_GROUPS] = {&groups[g], &groups[g + left - 1]};
        struct fragment_run first;
        run_groups(validator, pair, 0, false, left, &first);
        for (int i = 0; i < left; i++) {
            take_results(validator, &first.group[i], &groups[g + i]);
        }
    }
}

void rhw_validated_fragment(struct rhw_fragment *groups, int count)
{
    const struct rhw_validator *const validator = groups->user;
    if (has_effects(validator)) {
        run_once(validator, groups, count);
        return;
    }
    for (int g = 0; g < count; g += RHW_VALIDATED_GROUPS) {
        const bool is_pair = g + 1 < count;
        const struct rhw_fragment *const pair[RHW_VALIDATED_GROUPS] = {&groups[g],
                                                                       &groups[is_pair ? g + 1 : g]};
        struct fragment_run first, second;
        run(validator, pair, 0, false, &first);
        run(validator, pair, EVERYTHING, true, &second);
        check_group(validator, pair, 0, &first, &second);
        check_group(validator, pair, 1, &first, &second);
        take_results(validator, &first.group[0], &groups[g]);
        if (is_pair) {
            take_results(validator, &first.group[1], &groups[g + 1]);
        }
    }
}
