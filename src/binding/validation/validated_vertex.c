// SPDX-License-Identifier: MIT
// Vertex functions under validation.
#include <string.h>

#include "binding/shader_adapter.h"
#include "validation.h"

// One run of the function over a pair of groups.
struct vertex_run {
    struct rhw_bindings bindings[RHW_VALIDATED_GROUPS];
    struct rhw_vertex group[RHW_VALIDATED_GROUPS];
    rhw_float attribute[RHW_VALIDATED_GROUPS][RHW_MAX_ATTRIBUTES][4];
    rhw_float varying[RHW_VALIDATED_GROUPS][RHW_VALIDATED_COMPONENTS];
    rhw_float distance[RHW_VALIDATED_GROUPS][2][RHW_MAX_CLIP_DISTANCES]; // distances to clip by, and to cull by
};

// What may hold other rubbish than in the first run, a bit each.
enum { ATTRIBUTES = 1, UNIFORMS = 2, EVERYTHING = 3 };

static bool has_effects(const struct rhw_validator *validator)
{
    return validator->pipeline->def.program.vertex_effects;
}

// Give group g of a run what the pipeline has for it, and rubbish where the pipeline has nothing.
static void prepare(const struct rhw_validator *validator, const struct rhw_vertex *group, uint32_t changed,
                    bool second, int g, struct vertex_run *out)
{
    const struct rhw_pipeline_data *const pipeline = validator->pipeline;
    const rhw_float input = rhw_validator_rubbish(rhw_validator_input[(changed & ATTRIBUTES) != 0]);
    const rhw_float output = rhw_validator_rubbish(rhw_validator_output[second]);
    for (int i = 0; i < RHW_MAX_ATTRIBUTES; i++) {
        for (int c = 0; c < 4; c++) {
            out->attribute[g][i][c] = i < pipeline->def.attribute_count ? group->attribute[i][c] : input;
        }
    }
    for (int i = 0; i < rhw_validated_count(pipeline); i++) {
        out->varying[g][i] = output;
    }
    for (int i = 0; i < RHW_MAX_CLIP_DISTANCES; i++) {
        out->distance[g][0][i] = out->distance[g][1][i] = output;
    }
    rhw_bindings_copy(group->bindings, &out->bindings[g]);
    out->bindings[g].drops_effects = !has_effects(validator);
    if (changed == 0) {
        out->bindings[g].site = rhw_validator_site(validator, group->uniforms, NULL);
    }
    struct rhw_vertex *const copy = &out->group[g];
    *copy = *group;
    copy->bindings = &out->bindings[g];
    copy->attribute = (const rhw_float(*)[4])out->attribute[g];
    copy->uniforms = rhw_validator_uniforms(group->uniforms, (changed & UNIFORMS) != 0);
    copy->user = validator->user;
    copy->varying = out->varying[g];
    copy->clip_distance = out->distance[g][0];
    copy->cull_distance = out->distance[g][1];
    copy->point_size = output;
    copy->viewport_index = copy->layer = (rhw_int)output;
    for (int c = 0; c < 4; c++) {
        copy->position[c] = output;
    }
}

static void run_groups(const struct rhw_validator *validator,
                       const struct rhw_vertex *const pair[RHW_VALIDATED_GROUPS], uint32_t changed,
                       bool second, int count, struct vertex_run *out)
{
    for (int g = 0; g < count; g++) {
        prepare(validator, pair[g], changed, second, g, out);
    }
    if (validator->vertex) {
        validator->vertex(out->group, count);
    } else {
        rhw_vertex1_run(validator->pipeline, out->group, count);
    }
}

static void run(const struct rhw_validator *validator,
                const struct rhw_vertex *const pair[RHW_VALIDATED_GROUPS], uint32_t changed, bool second,
                struct vertex_run *out)
{
    run_groups(validator, pair, changed, second, RHW_VALIDATED_GROUPS, out);
}

static int distances_of(const struct rhw_program *program, int which)
{
    return which == 0 ? program->clip_distance_count : program->cull_distance_count;
}

static const rhw_float *distances_at(const struct rhw_vertex *group, int which)
{
    return which == 0 ? group->clip_distance : group->cull_distance;
}

static bool same(const struct rhw_validator *validator, const struct rhw_vertex *a,
                 const struct rhw_vertex *b)
{
    const struct rhw_program *const program = &validator->pipeline->def.program;
    const int components = validator->pipeline->varying_components;
    bool differs = false;
    const rhw_int all = rhw_splat_int(-1);
    for (int which = 0; which < 2; which++) {
        for (int i = 0; i < distances_of(program, which); i++) {
            differs |=
                rhw_any(rhw_validator_differs(distances_at(a, which)[i], distances_at(b, which)[i], all));
        }
    }
    if (program->writes_point_size) {
        differs |= rhw_any(rhw_validator_differs(a->point_size, b->point_size, all));
    }
    if (program->writes_viewport_index) {
        differs |= rhw_any(a->viewport_index != b->viewport_index);
    }
    if (program->writes_layer) {
        differs |= rhw_any(a->layer != b->layer);
    }
    for (int c = 0; c < 4; c++) {
        differs |= rhw_any(rhw_validator_differs(a->position[c], b->position[c], all));
    }
    for (int i = 0; i < components; i++) {
        differs |= rhw_any(rhw_validator_differs(a->varying[i], b->varying[i], all));
    }
    return !differs;
}

static bool is_rubbish(rhw_float value, bool second)
{
    return !rhw_any((rhw_int)value != (int32_t)rhw_validator_output[second]);
}

static bool has_position(const struct rhw_vertex *first, const struct rhw_vertex *second, int c)
{
    return !is_rubbish(first->position[c], false) || !is_rubbish(second->position[c], true);
}

// Return true if nothing of a group's position was written.
static bool is_untouched(const struct rhw_vertex *first, const struct rhw_vertex *second)
{
    bool written = false;
    for (int c = 0; c < 4; c++) {
        written |= has_position(first, second, c);
    }
    return !written;
}

// Name an output that was not written, or one behind the last that was written and not declared. Return false when
// there is none.
static bool check_outputs(const struct rhw_validator *validator, uint32_t draw,
                          const struct rhw_vertex *first, const struct rhw_vertex *second)
{
    const int components = validator->pipeline->varying_components;
    for (int c = 0; c < 4; c++) {
        if (!has_position(first, second, c)) {
            rhw_validation_messages_add(validator->validation, RHW_VALIDATION_MISUSE, draw,
                                        "the vertex function of %s does not write position[%d]",
                                        validator->name, c);
            return true;
        }
    }
    for (int i = 0; i < rhw_validated_count(validator->pipeline); i++) {
        const bool written = !is_rubbish(first->varying[i], false) || !is_rubbish(second->varying[i], true);
        if (written != (i < components)) {
            rhw_validation_messages_add(
                validator->validation, RHW_VALIDATION_MISUSE, draw,
                written ? "the vertex function of %s writes varying[%d]; its program has %d components"
                        : "the vertex function of %s does not write varying[%d]; its program has %d "
                          "components",
                validator->name, i, components);
            return true;
        }
    }
    return false;
}

// Name an output that the program declares by writes_NAME and did not write, or wrote and does not declare. Return
// false when there is none.
static bool check_scalar(const struct rhw_validator *validator, uint32_t draw, rhw_float first,
                         rhw_float second, const char *name, bool declared)
{
    const bool written = !is_rubbish(first, false) || !is_rubbish(second, true);
    if (written != declared) {
        rhw_validation_messages_add(
            validator->validation, RHW_VALIDATION_MISUSE, draw,
            written ? "the vertex function of %s writes %s; its program's writes_%s is false"
                    : "the vertex function of %s does not write %s; its program's writes_%s is true",
            validator->name, name, name);
    }
    return written != declared;
}

// Name a distance, the point size or a route that was not written, or was written and not declared. Return false when
// there is none.
static bool check_extras(const struct rhw_validator *validator, uint32_t draw, const struct rhw_vertex *first,
                         const struct rhw_vertex *second)
{
    static const char *const names[2] = {"clip_distance", "cull_distance"};
    const struct rhw_program *const program = &validator->pipeline->def.program;
    for (int which = 0; which < 2; which++) {
        const int count = distances_of(program, which);
        for (int i = 0; i < RHW_MAX_CLIP_DISTANCES; i++) {
            const bool written = !is_rubbish(distances_at(first, which)[i], false) ||
                                 !is_rubbish(distances_at(second, which)[i], true);
            if (written != (i < count)) {
                rhw_validation_messages_add(
                    validator->validation, RHW_VALIDATION_MISUSE, draw,
                    written ? "the vertex function of %s writes %s[%d]; its program has %d"
                            : "the vertex function of %s does not write %s[%d]; its program has %d",
                    validator->name, names[which], i, count);
                return true;
            }
        }
    }
    return check_scalar(validator, draw, first->point_size, second->point_size, "point_size",
                        program->writes_point_size) ||
           check_scalar(validator, draw, (rhw_float)first->viewport_index, (rhw_float)second->viewport_index,
                        "viewport_index", program->writes_viewport_index) ||
           check_scalar(validator, draw, (rhw_float)first->layer, (rhw_float)second->layer, "layer",
                        program->writes_layer);
}

// Name an output that some lanes were left without. Return false when there is none.
static __attribute__((cold)) bool name_lanes(const struct rhw_validator *validator, uint32_t draw,
                                             const struct rhw_vertex *first, const struct rhw_vertex *second)
{
    static const char message[] = "the vertex function of %s does not write %s[%d] in every lane";
    static const char *const names[2] = {"clip_distance", "cull_distance"};
    const struct rhw_program *const program = &validator->pipeline->def.program;
    const rhw_int all = rhw_splat_int(-1);
    for (int c = 0; c < 4; c++) {
        if (rhw_validator_unwritten(first->position[c], second->position[c], all)) {
            rhw_validation_messages_add(validator->validation, RHW_VALIDATION_MISUSE, draw, message,
                                        validator->name, "position", c);
            return true;
        }
    }
    for (int i = 0; i < validator->pipeline->varying_components; i++) {
        if (rhw_validator_unwritten(first->varying[i], second->varying[i], all)) {
            rhw_validation_messages_add(validator->validation, RHW_VALIDATION_MISUSE, draw, message,
                                        validator->name, "varying", i);
            return true;
        }
    }
    for (int which = 0; which < 2; which++) {
        for (int i = 0; i < distances_of(program, which); i++) {
            if (rhw_validator_unwritten(distances_at(first, which)[i], distances_at(second, which)[i], all)) {
                rhw_validation_messages_add(validator->validation, RHW_VALIDATION_MISUSE, draw, message,
                                            validator->name, names[which], i);
                return true;
            }
        }
    }
    if (program->writes_point_size && rhw_validator_unwritten(first->point_size, second->point_size, all)) {
        rhw_validation_messages_add(validator->validation, RHW_VALIDATION_MISUSE, draw,
                                    "the vertex function of %s does not write point_size in every lane",
                                    validator->name);
        return true;
    }
    return false;
}

static __attribute__((cold)) void name_input(const struct rhw_validator *validator, uint32_t draw,
                                             const struct rhw_vertex *const pair[RHW_VALIDATED_GROUPS], int g,
                                             const struct rhw_vertex *first)
{
    struct vertex_run other;
    run(validator, pair, ATTRIBUTES, false, &other);
    const bool attributes = !same(validator, first, &other.group[g]);
    run(validator, pair, UNIFORMS, false, &other);
    const bool uniforms = !same(validator, first, &other.group[g]);
    if (attributes) {
        rhw_validation_messages_add(
            validator->validation, RHW_VALIDATION_MISUSE, draw,
            "the vertex function of %s reads an attribute behind the last; the pipeline has %d",
            validator->name, validator->pipeline->def.attribute_count);
    } else if (uniforms) {
        rhw_validation_messages_add(
            validator->validation, RHW_VALIDATION_MISUSE, draw,
            "the vertex function of %s reads uniforms behind uniform_size, which is %u", validator->name,
            (unsigned)validator->pipeline->def.program.uniform_size);
    } else {
        rhw_validation_messages_add(validator->validation, RHW_VALIDATION_MISUSE, draw,
                                    "the vertex function of %s gives two results for the same inputs",
                                    validator->name);
    }
}

// Compare group g of both runs.
static void check_group(const struct rhw_validator *validator,
                        const struct rhw_vertex *const pair[RHW_VALIDATED_GROUPS], int g,
                        const struct vertex_run *first_run, const struct vertex_run *second_run)
{
    const struct rhw_vertex *const first = &first_run->group[g], *const second = &second_run->group[g];
    const uint32_t draw = rhw_validator_draw(pair[g]->uniforms)->draw;
    if (g > 0 && is_untouched(first, second) && !is_untouched(&first_run->group[0], &second_run->group[0])) {
        rhw_validation_messages_add(
            validator->validation, RHW_VALIDATION_MISUSE, draw,
            "the vertex function of %s works on the first of its groups alone; it must work on "
            "`count` of them",
            validator->name);
    } else if (!check_outputs(validator, draw, first, second) &&
               !check_extras(validator, draw, first, second) && !same(validator, first, second) &&
               !name_lanes(validator, draw, first, second)) {
        name_input(validator, draw, pair, g, first);
    }
}

static void take_results(const struct rhw_validator *validator, const struct rhw_vertex *first,
                         struct rhw_vertex *group)
{
    memcpy(group->position, first->position, sizeof first->position);
    memcpy(group->varying, first->varying,
           (size_t)validator->pipeline->varying_components * sizeof first->varying[0]);
    const struct rhw_program *const program = &validator->pipeline->def.program;
    memcpy(group->clip_distance, first->clip_distance,
           (size_t)distances_of(program, 0) * sizeof first->clip_distance[0]);
    memcpy(group->cull_distance, first->cull_distance,
           (size_t)distances_of(program, 1) * sizeof first->cull_distance[0]);
    group->point_size = first->point_size;
    group->viewport_index = first->viewport_index;
    group->layer = first->layer;
}

// Call a function with effects, once for each group.
static void run_once(const struct rhw_validator *validator, struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g += RHW_VALIDATED_GROUPS) {
        const int left = count - g < RHW_VALIDATED_GROUPS ? count - g : RHW_VALIDATED_GROUPS;
        const struct rhw_vertex *const pair[RHW_VALIDATED_GROUPS] = {&groups[g], &groups[g + left - 1]};
        struct vertex_run first;
        run_groups(validator, pair, 0, false, left, &first);
        for (int i = 0; i < left; i++) {
            take_results(validator, &first.group[i], &groups[g + i]);
        }
    }
}

void rhw_validated_vertex(struct rhw_vertex *groups, int count)
{
    const struct rhw_validator *const validator = groups->user;
    if (has_effects(validator)) {
        run_once(validator, groups, count);
        return;
    }
    for (int g = 0; g < count; g += RHW_VALIDATED_GROUPS) {
        const bool is_pair = g + 1 < count;
        const struct rhw_vertex *const pair[RHW_VALIDATED_GROUPS] = {&groups[g],
                                                                     &groups[is_pair ? g + 1 : g]};
        struct vertex_run first, second;
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
