// SPDX-License-Identifier: MIT
// Vertex functions under validation.
#include <string.h>

#include "findings.h"
#include "binding/shader_adapter.h"
#include "validation.h"

// One run of the function over a pair of groups.
struct vertex_run {
    struct rhw_bindings textures[RHW_WATCH_GROUPS];
    struct rhw_vertex group[RHW_WATCH_GROUPS];
    rhw_float attribute[RHW_WATCH_GROUPS][RHW_MAX_ATTRIBUTES][4];
    rhw_float varying[RHW_WATCH_GROUPS][RHW_WATCH_COMPONENTS];
    rhw_float distance[RHW_WATCH_GROUPS][2][RHW_MAX_CLIP_DISTANCES]; // clip, cull
};

// What a run may hold other rubbish in than the first: bits.
enum { ATTRIBUTES = 1, UNIFORMS = 2, EVERYTHING = 3 };

static bool has_effects(const struct rhw_watch *watch)
{
    return watch->pipeline->def.program.vertex_effects;
}

// Gives group g of a run what the pipeline has for it, and rubbish where that is nothing.
static void prepare(const struct rhw_watch *watch, const struct rhw_vertex *group, uint32_t changed,
                    bool second, int g, struct vertex_run *out)
{
    const struct rhw_pipeline_data *const pipeline = watch->pipeline;
    const rhw_float input = rhw_watch_rubbish(rhw_watch_input[(changed & ATTRIBUTES) != 0]);
    const rhw_float output = rhw_watch_rubbish(rhw_watch_output[second]);
    for (int i = 0; i < RHW_MAX_ATTRIBUTES; i++) {
        for (int c = 0; c < 4; c++) {
            out->attribute[g][i][c] = i < pipeline->def.attribute_count ? group->attribute[i][c] : input;
        }
    }
    for (int i = 0; i < RHW_WATCH_COMPONENTS; i++) {
        out->varying[g][i] = output;
    }
    for (int i = 0; i < RHW_MAX_CLIP_DISTANCES; i++) {
        out->distance[g][0][i] = out->distance[g][1][i] = output;
    }
    out->textures[g] = *group->textures;
    out->textures[g].drops_effects = !has_effects(watch);
    if (changed == 0) {
        out->textures[g].site = rhw_watch_site(watch, group->uniforms, NULL);
    }
    struct rhw_vertex *const copy = &out->group[g];
    *copy = *group;
    copy->textures = &out->textures[g];
    copy->attribute = (const rhw_float(*)[4])out->attribute[g];
    copy->uniforms = rhw_watch_uniforms(group->uniforms, (changed & UNIFORMS) != 0);
    copy->user = watch->user;
    copy->varying = out->varying[g];
    copy->clip_distance = out->distance[g][0];
    copy->cull_distance = out->distance[g][1];
    copy->point_size = output;
    copy->viewport_index = copy->layer = (rhw_int)output;
    for (int c = 0; c < 4; c++) {
        copy->position[c] = output;
    }
}

static void run_groups(const struct rhw_watch *watch, const struct rhw_vertex *const pair[RHW_WATCH_GROUPS],
                       uint32_t changed, bool second, int count, struct vertex_run *out)
{
    for (int g = 0; g < count; g++) {
        prepare(watch, pair[g], changed, second, g, out);
    }
    if (watch->vertex) {
        watch->vertex(out->group, count);
    } else {
        rhw_vertex1_run(watch->pipeline, out->group, count);
    }
}

static void run(const struct rhw_watch *watch, const struct rhw_vertex *const pair[RHW_WATCH_GROUPS],
                uint32_t changed, bool second, struct vertex_run *out)
{
    run_groups(watch, pair, changed, second, RHW_WATCH_GROUPS, out);
}

static int distances_of(const struct rhw_program *program, int which)
{
    return which == 0 ? program->clip_distance_count : program->cull_distance_count;
}

static const rhw_float *distances_at(const struct rhw_vertex *group, int which)
{
    return which == 0 ? group->clip_distance : group->cull_distance;
}

static bool same(const struct rhw_watch *watch, const struct rhw_vertex *a, const struct rhw_vertex *b)
{
    const struct rhw_program *const program = &watch->pipeline->def.program;
    const int components = watch->pipeline->varying_components;
    bool differs = false;
    const rhw_int all = rhw_splat_int(-1);
    for (int which = 0; which < 2; which++) {
        for (int i = 0; i < distances_of(program, which); i++) {
            differs |= rhw_any(rhw_watch_differs(distances_at(a, which)[i], distances_at(b, which)[i], all));
        }
    }
    if (program->writes_point_size) {
        differs |= rhw_any(rhw_watch_differs(a->point_size, b->point_size, all));
    }
    if (program->writes_viewport_index) {
        differs |= rhw_any(a->viewport_index != b->viewport_index);
    }
    if (program->writes_layer) {
        differs |= rhw_any(a->layer != b->layer);
    }
    for (int c = 0; c < 4; c++) {
        differs |= rhw_any(rhw_watch_differs(a->position[c], b->position[c], all));
    }
    for (int i = 0; i < components; i++) {
        differs |= rhw_any(rhw_watch_differs(a->varying[i], b->varying[i], all));
    }
    return !differs;
}

static bool is_rubbish(rhw_float value, bool second)
{
    return !rhw_any((rhw_int)value != (int32_t)rhw_watch_output[second]);
}

static bool has_position(const struct rhw_vertex *first, const struct rhw_vertex *second, int c)
{
    return !is_rubbish(first->position[c], false) || !is_rubbish(second->position[c], true);
}

// Whether nothing of a group's position was written.
static bool is_untouched(const struct rhw_vertex *first, const struct rhw_vertex *second)
{
    bool written = false;
    for (int c = 0; c < 4; c++) {
        written |= has_position(first, second, c);
    }
    return !written;
}

// Names an output that was not written, or one behind the last that was. False when there is none.
static bool check_outputs(const struct rhw_watch *watch, uint32_t draw, const struct rhw_vertex *first,
                          const struct rhw_vertex *second)
{
    const int components = watch->pipeline->varying_components;
    for (int c = 0; c < 4; c++) {
        if (!has_position(first, second, c)) {
            rhw_findings_add(watch->findings, RHW_FINDING_MISUSE, draw,
                             "the vertex function of %s does not write position[%d]", watch->name, c);
            return true;
        }
    }
    for (int i = 0; i < RHW_WATCH_COMPONENTS; i++) {
        const bool written = !is_rubbish(first->varying[i], false) || !is_rubbish(second->varying[i], true);
        if (written != (i < components)) {
            rhw_findings_add(
                watch->findings, RHW_FINDING_MISUSE, draw,
                written ? "the vertex function of %s writes varying[%d]; its program has %d components"
                        : "the vertex function of %s does not write varying[%d]; its program has %d "
                          "components",
                watch->name, i, components);
            return true;
        }
    }
    return false;
}

// The same for an output that the program declares by writes_NAME.
static bool check_scalar(const struct rhw_watch *watch, uint32_t draw, rhw_float first, rhw_float second,
                         const char *name, bool declared)
{
    const bool written = !is_rubbish(first, false) || !is_rubbish(second, true);
    if (written != declared) {
        rhw_findings_add(watch->findings, RHW_FINDING_MISUSE, draw,
                         written
                             ? "the vertex function of %s writes %s; its program's writes_%s is false"
                             : "the vertex function of %s does not write %s; its program's writes_%s is true",
                         watch->name, name, name);
    }
    return written != declared;
}

// The same for distances, the point size and the route.
static bool check_extras(const struct rhw_watch *watch, uint32_t draw, const struct rhw_vertex *first,
                         const struct rhw_vertex *second)
{
    static const char *const names[2] = {"clip_distance", "cull_distance"};
    const struct rhw_program *const program = &watch->pipeline->def.program;
    for (int which = 0; which < 2; which++) {
        const int count = distances_of(program, which);
        for (int i = 0; i < RHW_MAX_CLIP_DISTANCES; i++) {
            const bool written = !is_rubbish(distances_at(first, which)[i], false) ||
                                 !is_rubbish(distances_at(second, which)[i], true);
            if (written != (i < count)) {
                rhw_findings_add(watch->findings, RHW_FINDING_MISUSE, draw,
                                 written
                                     ? "the vertex function of %s writes %s[%d]; its program has %d"
                                     : "the vertex function of %s does not write %s[%d]; its program has %d",
                                 watch->name, names[which], i, count);
                return true;
            }
        }
    }
    return check_scalar(watch, draw, first->point_size, second->point_size, "point_size",
                        program->writes_point_size) ||
           check_scalar(watch, draw, (rhw_float)first->viewport_index, (rhw_float)second->viewport_index,
                        "viewport_index", program->writes_viewport_index) ||
           check_scalar(watch, draw, (rhw_float)first->layer, (rhw_float)second->layer, "layer",
                        program->writes_layer);
}

// Names an output that some lanes were left without. False when there is none.
static __attribute__((cold)) bool name_lanes(const struct rhw_watch *watch, uint32_t draw,
                                             const struct rhw_vertex *first, const struct rhw_vertex *second)
{
    static const char message[] = "the vertex function of %s does not write %s[%d] in every lane";
    static const char *const names[2] = {"clip_distance", "cull_distance"};
    const struct rhw_program *const program = &watch->pipeline->def.program;
    const rhw_int all = rhw_splat_int(-1);
    for (int c = 0; c < 4; c++) {
        if (rhw_watch_unwritten(first->position[c], second->position[c], all)) {
            rhw_findings_add(watch->findings, RHW_FINDING_MISUSE, draw, message, watch->name, "position", c);
            return true;
        }
    }
    for (int i = 0; i < watch->pipeline->varying_components; i++) {
        if (rhw_watch_unwritten(first->varying[i], second->varying[i], all)) {
            rhw_findings_add(watch->findings, RHW_FINDING_MISUSE, draw, message, watch->name, "varying", i);
            return true;
        }
    }
    for (int which = 0; which < 2; which++) {
        for (int i = 0; i < distances_of(program, which); i++) {
            if (rhw_watch_unwritten(distances_at(first, which)[i], distances_at(second, which)[i], all)) {
                rhw_findings_add(watch->findings, RHW_FINDING_MISUSE, draw, message, watch->name,
                                 names[which], i);
                return true;
            }
        }
    }
    if (program->writes_point_size && rhw_watch_unwritten(first->point_size, second->point_size, all)) {
        rhw_findings_add(watch->findings, RHW_FINDING_MISUSE, draw,
                         "the vertex function of %s does not write point_size in every lane", watch->name);
        return true;
    }
    return false;
}

static __attribute__((cold)) void name_input(const struct rhw_watch *watch, uint32_t draw,
                                             const struct rhw_vertex *const pair[RHW_WATCH_GROUPS], int g,
                                             const struct rhw_vertex *first)
{
    struct vertex_run other;
    run(watch, pair, ATTRIBUTES, false, &other);
    const bool attributes = !same(watch, first, &other.group[g]);
    run(watch, pair, UNIFORMS, false, &other);
    const bool uniforms = !same(watch, first, &other.group[g]);
    if (attributes) {
        rhw_findings_add(watch->findings, RHW_FINDING_MISUSE, draw,
                         "the vertex function of %s reads an attribute behind the last; the pipeline has %d",
                         watch->name, watch->pipeline->def.attribute_count);
    } else if (uniforms) {
        rhw_findings_add(watch->findings, RHW_FINDING_MISUSE, draw,
                         "the vertex function of %s reads uniforms behind uniform_size, which is %u",
                         watch->name, (unsigned)watch->pipeline->def.program.uniform_size);
    } else {
        rhw_findings_add(watch->findings, RHW_FINDING_MISUSE, draw,
                         "the vertex function of %s gives two results for the same inputs", watch->name);
    }
}

// Looks at group g of both runs.
static void check_group(const struct rhw_watch *watch, const struct rhw_vertex *const pair[RHW_WATCH_GROUPS],
                        int g, const struct vertex_run *first_run, const struct vertex_run *second_run)
{
    const struct rhw_vertex *const first = &first_run->group[g], *const second = &second_run->group[g];
    const uint32_t draw = rhw_watch_draw(pair[g]->uniforms)->draw;
    if (g > 0 && is_untouched(first, second) && !is_untouched(&first_run->group[0], &second_run->group[0])) {
        rhw_findings_add(watch->findings, RHW_FINDING_MISUSE, draw,
                         "the vertex function of %s works on the first of its groups alone; it must work on "
                         "`count` of them",
                         watch->name);
    } else if (!check_outputs(watch, draw, first, second) && !check_extras(watch, draw, first, second) &&
               !same(watch, first, second) && !name_lanes(watch, draw, first, second)) {
        name_input(watch, draw, pair, g, first);
    }
}

static void take_results(const struct rhw_watch *watch, const struct rhw_vertex *first,
                         struct rhw_vertex *group)
{
    memcpy(group->position, first->position, sizeof first->position);
    memcpy(group->varying, first->varying,
           (size_t)watch->pipeline->varying_components * sizeof first->varying[0]);
    const struct rhw_program *const program = &watch->pipeline->def.program;
    memcpy(group->clip_distance, first->clip_distance,
           (size_t)distances_of(program, 0) * sizeof first->clip_distance[0]);
    memcpy(group->cull_distance, first->cull_distance,
           (size_t)distances_of(program, 1) * sizeof first->cull_distance[0]);
    group->point_size = first->point_size;
    group->viewport_index = first->viewport_index;
    group->layer = first->layer;
}

// Calls a function with effects, once for each group.
static void run_once(const struct rhw_watch *watch, struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g += RHW_WATCH_GROUPS) {
        const int left = count - g < RHW_WATCH_GROUPS ? count - g : RHW_WATCH_GROUPS;
        const struct rhw_vertex *const pair[RHW_WATCH_GROUPS] = {&groups[g], &groups[g + left - 1]};
        struct vertex_run first;
        run_groups(watch, pair, 0, false, left, &first);
        for (int i = 0; i < left; i++) {
            take_results(watch, &first.group[i], &groups[g + i]);
        }
    }
}

void rhw_watched_vertex(struct rhw_vertex *groups, int count)
{
    const struct rhw_watch *const watch = groups->user;
    if (has_effects(watch)) {
        run_once(watch, groups, count);
        return;
    }
    for (int g = 0; g < count; g += RHW_WATCH_GROUPS) {
        const bool is_pair = g + 1 < count;
        const struct rhw_vertex *const pair[RHW_WATCH_GROUPS] = {&groups[g], &groups[is_pair ? g + 1 : g]};
        struct vertex_run first, second;
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
