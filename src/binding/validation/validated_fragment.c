// SPDX-License-Identifier: MIT
// Fragment functions under validation.
#include <stdio.h>
#include <string.h>

#include "findings.h"
#include "format/format.h"
#include "binding/shader_adapter.h"
#include "validation.h"

// One run of the function over a pair of groups.
struct fragment_run {
    struct rhw_bindings textures[RHW_WATCH_GROUPS];
    struct rhw_fragment group[RHW_WATCH_GROUPS];
    rhw_float varying[RHW_WATCH_GROUPS][RHW_WATCH_COMPONENTS];
    rhw_float ddx[RHW_WATCH_GROUPS][RHW_WATCH_COMPONENTS], ddy[RHW_WATCH_GROUPS][RHW_WATCH_COMPONENTS];
    rhw_float color[RHW_WATCH_GROUPS][RHW_MAX_COLOR_ATTACHMENTS][4];
};

// What may hold other rubbish than in the first run, a bit each: what the program can leave undeclared.
enum {
    VARYINGS = 1 << 24, // above enum rhw_fragment_use
    DERIVATIVES = 1 << 25,
    UNIFORMS = 1 << 26,
    EVERYTHING = -1
};

static const struct {
    int32_t bit;
    const char *message; // what is read; then what it lacks
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

// `count` vectors: rubbish, of the second kind where `other`.
static void spoil(rhw_float *values, int count, bool other)
{
    for (int i = 0; i < count; i++) {
        values[i] = rhw_watch_rubbish(rhw_watch_input[other]);
    }
}

// Integers may be used as indices: their rubbish is small.
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

static bool has_effects(const struct rhw_watch *watch)
{
    return watch->uses & RHW_USE_EFFECTS;
}

// Gives group g of a run what the pipeline has for it, and rubbish where that is nothing.
static void prepare(const struct rhw_watch *watch, const struct rhw_fragment *group, int32_t changed,
                    bool second, int g, struct fragment_run *out)
{
    const struct rhw_pipeline_data *const pipeline = watch->pipeline;
    spoil(out->varying[g], RHW_WATCH_COMPONENTS, changed & VARYINGS);
    spoil(out->ddx[g], RHW_WATCH_COMPONENTS, changed & DERIVATIVES);
    spoil(out->ddy[g], RHW_WATCH_COMPONENTS, changed & DERIVATIVES);
    for (int i = 0; i < pipeline->varying_components; i++) {
        out->varying[g][i] = group->varying[i];
        if (pipeline->component_derivatives[i]) {
            out->ddx[g][i] = group->ddx[i];
            out->ddy[g][i] = group->ddy[i];
        }
    }
    for (int t = 0; t < RHW_MAX_COLOR_ATTACHMENTS; t++) {
        for (int c = 0; c < 4; c++) {
            out->color[g][t][c] = rhw_watch_rubbish(rhw_watch_output[second]);
        }
    }
    if (watch->uses & RHW_USE_COLOR_INPUT) {
        memcpy(out->color[g], group->color, (size_t)pipeline->def.target_count * sizeof group->color[0]);
    }
    out->textures[g] = *group->textures;
    out->textures[g].drops_effects = !has_effects(watch);
    if (changed == 0) { // else coordinates may come from another rubbish
        out->textures[g].site = rhw_watch_site(watch, group->uniforms, &group->mask);
    }
    struct rhw_fragment *const copy = &out->group[g];
    *copy = *group;
    copy->varying = out->varying[g];
    copy->ddx = out->ddx[g];
    copy->ddy = out->ddy[g];
    copy->color = out->color[g];
    copy->textures = &out->textures[g];
    copy->uniforms = rhw_watch_uniforms(group->uniforms, changed & UNIFORMS);
    copy->user = watch->user;
    spoil_builtins(copy, watch->uses, changed);
}

static void run_groups(const struct rhw_watch *watch, const struct rhw_fragment *const pair[RHW_WATCH_GROUPS],
                       int32_t changed, bool second, int count, struct fragment_run *out)
{
    for (int g = 0; g < count; g++) {
        prepare(watch, pair[g], changed, second, g, out);
    }
    if (watch->fragment) {
        watch->fragment(out->group, count);
    } else {
        rhw_fragment1_run(watch->pipeline, out->group, count);
    }
}

static void run(const struct rhw_watch *watch, const struct rhw_fragment *const pair[RHW_WATCH_GROUPS],
                int32_t changed, bool second, struct fragment_run *out)
{
    run_groups(watch, pair, changed, second, RHW_WATCH_GROUPS, out);
}

static bool is_source_alpha(enum rhw_blend_factor factor)
{
    return factor == RHW_BLEND_SRC_ALPHA || factor == RHW_BLEND_ONE_MINUS_SRC_ALPHA ||
           factor == RHW_BLEND_SRC_ALPHA_SATURATED;
}

// MIN and MAX ignore the factors.
static bool reads_source_alpha(const struct rhw_blend_component *color)
{
    return color->operation != RHW_BLEND_MIN && color->operation != RHW_BLEND_MAX &&
           (is_source_alpha(color->src) || is_source_alpha(color->dst));
}

// Of the second source, which stands behind the only target.
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

// Channels of target t that a pass needs, a bit each: those it keeps, and the alpha that colours are blended by.
static unsigned needed_channels(const struct rhw_watch *watch, int t)
{
    const struct rhw_pipeline_def *const def = &watch->pipeline->def;
    if (t >= watch->pipeline->output_count) {
        return 0;
    }
    if (def->target_count == 0) {
        return RHW_WRITE_ALPHA; // which decides about coverage
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

// Lanes of `mask` in which two runs have different results for a group.
static rhw_int differing(const struct rhw_watch *watch, const struct rhw_fragment *a,
                         const struct rhw_fragment *b, rhw_int mask)
{
    rhw_int lanes = rhw_splat_int(0);
    for (int t = 0; t < watch->pipeline->output_count; t++) {
        for (int c = 0; c < 4; c++) {
            if (needed_channels(watch, t) & 1u << c) {
                lanes |= rhw_watch_differs(a->color[t][c], b->color[t][c], mask);
            }
        }
    }
    if (watch->uses & RHW_USE_DISCARD) {
        lanes |= (a->mask != b->mask) & mask;
    }
    if (watch->uses & RHW_USE_SAMPLE_MASK) {
        lanes |= (a->sample_mask != b->sample_mask) & mask;
    }
    if (watch->uses & RHW_USE_DEPTH) {
        lanes |= rhw_watch_differs(a->depth, b->depth, mask);
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

// Tells what is wrong with a fragment, and which pixel it is.
static void report(const struct rhw_watch *watch, const struct rhw_fragment *group, rhw_int lanes,
                   enum rhw_finding_kind kind, const char *what)
{
    const int lane = first_lane(lanes);
    rhw_findings_add(watch->findings, kind, rhw_watch_draw(group->uniforms)->draw,
                     "the fragment function of %s %s; at pixel %d, %d", watch->name, what,
                     (int)group->coord[0][lane], (int)group->coord[1][lane]);
}

static void report_channel(const struct rhw_watch *watch, const struct rhw_fragment *group, rhw_int lanes,
                           enum rhw_finding_kind kind, const char *verb, int t, int c)
{
    char what[96];
    snprintf(what, sizeof what, "%s color[%d][%d]", verb, t, c);
    report(watch, group, lanes, kind, what);
}

// Looks for channels that were not written, and those written that no target has. False when there is none.
static bool check_channels(const struct rhw_watch *watch, const struct rhw_fragment *group,
                           const struct rhw_fragment *first, const struct rhw_fragment *second, rhw_int mask)
{
    for (int t = 0; t < RHW_MAX_COLOR_ATTACHMENTS; t++) {
        for (int c = 0; c < 4; c++) {
            const bool needed = needed_channels(watch, t) & 1u << c;
            if (needed && rhw_watch_unwritten(first->color[t][c], second->color[t][c], mask)) {
                report_channel(watch, group, mask, RHW_FINDING_MISUSE, "does not write", t, c);
                return true;
            }
            if (t >= watch->pipeline->output_count &&
                rhw_any(((rhw_int)first->color[t][c] != (int32_t)rhw_watch_output[0]) & mask)) {
                // One program may serve pipelines of more targets, and of depth alone.
                report_channel(watch, group, mask, RHW_FINDING_WARNING,
                               "has no such target in its pipeline and writes", t, c);
            }
        }
    }
    return false;
}

// The same for what is no colour.
static bool check_side_results(const struct rhw_watch *watch, const struct rhw_fragment *group,
                               const struct rhw_fragment *first, rhw_int mask)
{
    const rhw_int gone = (first->mask == 0) & mask;
    if (!(watch->uses & RHW_USE_DISCARD) && rhw_any(gone)) {
        report(watch, group, gone, RHW_FINDING_MISUSE,
               "discards fragments; RHW_USE_DISCARD is missing in its program's uses");
        return true;
    }
    const rhw_int moved = ((rhw_int)first->depth != (int32_t)rhw_watch_input[0]) & mask;
    if (!(watch->uses & RHW_USE_DEPTH) && rhw_any(moved)) {
        report(watch, group, moved, RHW_FINDING_MISUSE,
               "writes depth; RHW_USE_DEPTH is missing in its program's uses");
        return true;
    }
    const rhw_int dropped = (first->sample_mask != -1) & mask;
    if (!(watch->uses & RHW_USE_SAMPLE_MASK) && rhw_any(dropped)) {
        report(watch, group, dropped, RHW_FINDING_MISUSE,
               "writes sample_mask; RHW_USE_SAMPLE_MASK is missing in its program's uses");
        return true;
    }
    return false;
}

// Changes one thing after the other, to find the one that the result depends on.
static __attribute__((cold)) void name_input(const struct rhw_watch *watch,
                                             const struct rhw_fragment *const pair[RHW_WATCH_GROUPS], int g,
                                             const struct rhw_fragment *first, rhw_int lanes)
{
    const struct rhw_fragment *const group = pair[g];
    for (size_t i = 0; i < sizeof undeclared / sizeof undeclared[0]; i++) {
        struct fragment_run other;
        run(watch, pair, undeclared[i].bit, false, &other);
        if (rhw_any(differing(watch, first, &other.group[g], lanes))) {
            report(watch, group, lanes, RHW_FINDING_MISUSE, undeclared[i].message);
            return;
        }
    }
    report(watch, group, lanes, RHW_FINDING_MISUSE, "gives two results for the same inputs");
}

static bool is_integer(const struct rhw_watch *watch, int t)
{
    const struct rhw_pipeline_def *const def = &watch->pipeline->def;
    return t < def->target_count && rhw_format_is_integer(rhw_format_info(def->targets[t].format));
}

static void warn_of_nan(const struct rhw_watch *watch, const struct rhw_fragment *group,
                        const struct rhw_fragment *first, rhw_int mask)
{
    for (int t = 0; t < watch->pipeline->output_count; t++) {
        for (int c = 0; c < 4 && !is_integer(watch, t); c++) {
            const rhw_float value = first->color[t][c];
            const rhw_int nan = (value != value) & mask;
            if (needed_channels(watch, t) & 1u << c && rhw_any(nan)) {
                report_channel(watch, group, nan, RHW_FINDING_WARNING, "gives NaN in", t, c);
                return;
            }
        }
    }
}

// Lanes whose results are kept.
static rhw_int live_lanes(const struct rhw_watch *watch, const struct rhw_fragment *group,
                          const struct rhw_fragment *first)
{
    return watch->uses & RHW_USE_DISCARD ? first->mask & group->mask : group->mask;
}

// Lanes in which the function wrote a channel that is needed.
static rhw_int written_lanes(const struct rhw_watch *watch, const struct rhw_fragment *first,
                             const struct rhw_fragment *second)
{
    rhw_int lanes = rhw_splat_int(0);
    for (int t = 0; t < watch->pipeline->output_count; t++) {
        for (int c = 0; c < 4; c++) {
            if (needed_channels(watch, t) & 1u << c) {
                lanes |= ((rhw_int)first->color[t][c] != (int32_t)rhw_watch_output[0]) |
                         ((rhw_int)second->color[t][c] != (int32_t)rhw_watch_output[1]);
            }
        }
    }
    return lanes;
}

// Whether the function wrote to the first group of a pair, and nothing to the second, which has fragments to keep.
static bool forgets_second(const struct rhw_watch *watch,
                           const struct rhw_fragment *const pair[RHW_WATCH_GROUPS],
                           const struct fragment_run *first, const struct fragment_run *second)
{
    const rhw_int live = live_lanes(watch, pair[1], &first->group[1]);
    return rhw_any(live) && !rhw_any(written_lanes(watch, &first->group[1], &second->group[1]) & live) &&
           rhw_any(written_lanes(watch, &first->group[0], &second->group[0]));
}

// Looks at group g of both runs.
static void check_group(const struct rhw_watch *watch,
                        const struct rhw_fragment *const pair[RHW_WATCH_GROUPS], int g,
                        const struct fragment_run *first_run, const struct fragment_run *second_run)
{
    const struct rhw_fragment *const group = pair[g];
    const struct rhw_fragment *const first = &first_run->group[g], *const second = &second_run->group[g];
    const rhw_int live = live_lanes(watch, group, first);
    const rhw_int lanes = differing(watch, first, second, live);
    if (watch->fragment && g > 0 && forgets_second(watch, pair, first_run, second_run)) {
        report(watch, group, live, RHW_FINDING_MISUSE,
               "works on the first of its groups alone; it must work on `count` of them");
    } else if (!check_channels(watch, group, first, second, live) &&
               !check_side_results(watch, group, first, group->mask)) {
        if (rhw_any(lanes)) {
            name_input(watch, pair, g, first, lanes);
        } else {
            warn_of_nan(watch, group, first, live);
        }
    }
}

static void take_results(const struct rhw_watch *watch, const struct rhw_fragment *first,
                         struct rhw_fragment *group)
{
    memcpy(group->color, first->color, (size_t)watch->pipeline->output_count * sizeof first->color[0]);
    if (watch->uses & RHW_USE_DISCARD) {
        group->mask = first->mask;
    }
    if (watch->uses & RHW_USE_DEPTH) {
        group->depth = first->depth;
    }
    if (watch->uses & RHW_USE_SAMPLE_MASK) {
        group->sample_mask = first->sample_mask;
    }
}

// Calls a function with effects, once for each group.
static void run_once(const struct rhw_watch *watch, struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g += RHW_WATCH_GROUPS) {
        const int left = count - g < RHW_WATCH_GROUPS ? count - g : RHW_WATCH_GROUPS;
        const struct rhw_fragment *const pair[RHW_WATCH_GROUPS] = {&groups[g], &groups[g + left - 1]};
        struct fragment_run first;
        run_groups(watch, pair, 0, false, left, &first);
        for (int i = 0; i < left; i++) {
            take_results(watch, &first.group[i], &groups[g + i]);
        }
    }
}

void rhw_watched_fragment(struct rhw_fragment *groups, int count)
{
    const struct rhw_watch *const watch = groups->user;
    if (has_effects(watch)) {
        run_once(watch, groups, count);
        return;
    }
    for (int g = 0; g < count; g += RHW_WATCH_GROUPS) {
        const bool is_pair = g + 1 < count;
        const struct rhw_fragment *const pair[RHW_WATCH_GROUPS] = {&groups[g], &groups[is_pair ? g + 1 : g]};
        struct fragment_run first, second;
        run(watch, pair, 0, false, &first);
        run(watch, pair, EVERYTHING, true, &second);
        check_group(watch, pair, 0, &first, &second);
        check_group(watch, pair, 1, &first, &second);
        take_results(watch, &first.group[0], &groups[g]);
        if (is_pair) {
            take_results(watch, &first.group[1], &groups[g + 1]);
        }
    }
}
