// SPDX-License-Identifier: MIT
// Vertex functions under validation.
#include <string.h>

#include "findings.h"
#include "shader_adapter.h"
#include "watch.h"

// One run of the function over one group.
struct vertex_run {
    struct rhw_bindings textures;
    struct rhw_vertex group;
    rhw_float attribute[RHW_MAX_ATTRIBUTES][4];
    rhw_float varying[RHW_WATCH_COMPONENTS];
    rhw_float distance[2][RHW_MAX_CLIP_DISTANCES]; // clip, cull
};

// What a run may hold other rubbish in than the first: bits.
enum { ATTRIBUTES = 1, UNIFORMS = 2, EVERYTHING = 3 };

static void run(const struct rhw_watch *watch, const struct rhw_vertex *group, uint32_t changed, bool second,
                struct vertex_run *out)
{
    const struct rhw_pipeline_data *const pipeline = watch->pipeline;
    const rhw_float input = rhw_watch_rubbish(rhw_watch_input[(changed & ATTRIBUTES) != 0]);
    const rhw_float output = rhw_watch_rubbish(rhw_watch_output[second]);
    for (int i = 0; i < RHW_MAX_ATTRIBUTES; i++) {
        for (int c = 0; c < 4; c++) {
            out->attribute[i][c] = i < pipeline->def.attribute_count ? group->attribute[i][c] : input;
        }
    }
    for (int i = 0; i < RHW_WATCH_COMPONENTS; i++) {
        out->varying[i] = output;
    }
    for (int i = 0; i < RHW_MAX_CLIP_DISTANCES; i++) {
        out->distance[0][i] = out->distance[1][i] = output;
    }
    out->textures = *group->textures;
    out->textures.site =
        (struct rhw_sample_site){watch->findings, rhw_watch_draw(group->uniforms)->draw, watch->name};
    out->group = *group;
    out->group.textures = &out->textures;
    out->group.attribute = (const rhw_float(*)[4])out->attribute;
    out->group.uniforms = rhw_watch_uniforms(group->uniforms, (changed & UNIFORMS) != 0);
    out->group.user = watch->user;
    out->group.varying = out->varying;
    out->group.clip_distance = out->distance[0];
    out->group.cull_distance = out->distance[1];
    out->group.point_size = output;
    for (int c = 0; c < 4; c++) {
        out->group.position[c] = output;
    }
    if (watch->vertex) {
        watch->vertex(&out->group, 1);
    } else {
        rhw_vertex1_run(pipeline, &out->group, 1);
    }
}

static int distances_of(const struct rhw_program *program, int which)
{
    return which == 0 ? program->clip_distance_count : program->cull_distance_count;
}

static bool same(const struct rhw_watch *watch, const struct vertex_run *a, const struct vertex_run *b)
{
    const struct rhw_program *const program = &watch->pipeline->def.program;
    const int components = watch->pipeline->varying_components;
    bool differs = false;
    const rhw_int all = rhw_splat_int(-1);
    for (int which = 0; which < 2; which++) {
        for (int i = 0; i < distances_of(program, which); i++) {
            differs |= rhw_any(rhw_watch_differs(a->distance[which][i], b->distance[which][i], all));
        }
    }
    if (program->writes_point_size) {
        differs |= rhw_any(rhw_watch_differs(a->group.point_size, b->group.point_size, all));
    }
    for (int c = 0; c < 4; c++) {
        differs |= rhw_any(rhw_watch_differs(a->group.position[c], b->group.position[c], all));
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

// Names an output that was not written, or one behind the last that was. False when there is none.
static bool check_outputs(const struct rhw_watch *watch, uint32_t draw, const struct vertex_run *first,
                          const struct vertex_run *second)
{
    const int components = watch->pipeline->varying_components;
    for (int c = 0; c < 4; c++) {
        if (is_rubbish(first->group.position[c], false) && is_rubbish(second->group.position[c], true)) {
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

// The same for distances and the point size.
static bool check_extras(const struct rhw_watch *watch, uint32_t draw, const struct vertex_run *first,
                         const struct vertex_run *second)
{
    static const char *const names[2] = {"clip_distance", "cull_distance"};
    const struct rhw_program *const program = &watch->pipeline->def.program;
    for (int which = 0; which < 2; which++) {
        const int count = distances_of(program, which);
        for (int i = 0; i < RHW_MAX_CLIP_DISTANCES; i++) {
            const bool written = !is_rubbish(first->distance[which][i], false) ||
                                 !is_rubbish(second->distance[which][i], true);
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
    const bool sized =
        !is_rubbish(first->group.point_size, false) || !is_rubbish(second->group.point_size, true);
    if (sized != program->writes_point_size) {
        rhw_findings_add(
            watch->findings, RHW_FINDING_MISUSE, draw,
            sized ? "the vertex function of %s writes point_size; its program's writes_point_size is false"
                  : "the vertex function of %s does not write point_size; its program's writes_point_size is "
                    "true",
            watch->name);
        return true;
    }
    return false;
}

static __attribute__((cold)) void name_input(const struct rhw_watch *watch, uint32_t draw,
                                             const struct rhw_vertex *group, const struct vertex_run *first)
{
    struct vertex_run other;
    run(watch, group, ATTRIBUTES, false, &other);
    const bool attributes = !same(watch, first, &other);
    run(watch, group, UNIFORMS, false, &other);
    const bool uniforms = !same(watch, first, &other);
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

void rhw_watched_vertex(struct rhw_vertex *groups, int count)
{
    const struct rhw_watch *const watch = groups->user;
    const int components = watch->pipeline->varying_components;
    for (int g = 0; g < count; g++) {
        struct vertex_run first, second;
        run(watch, &groups[g], 0, false, &first);
        run(watch, &groups[g], EVERYTHING, true, &second);
        const uint32_t draw = rhw_watch_draw(groups[g].uniforms)->draw;
        if (!check_outputs(watch, draw, &first, &second) && !check_extras(watch, draw, &first, &second) &&
            !same(watch, &first, &second)) {
            name_input(watch, draw, &groups[g], &first);
        }
        memcpy(groups[g].position, first.group.position, sizeof first.group.position);
        const struct rhw_program *const program = &watch->pipeline->def.program;
        memcpy(groups[g].clip_distance, first.distance[0],
               (size_t)distances_of(program, 0) * sizeof first.distance[0][0]);
        memcpy(groups[g].cull_distance, first.distance[1],
               (size_t)distances_of(program, 1) * sizeof first.distance[1][0]);
        groups[g].point_size = first.group.point_size;
        memcpy(groups[g].varying, first.varying, (size_t)components * sizeof first.varying[0]);
    }
}
