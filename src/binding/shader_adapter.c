// SPDX-License-Identifier: MIT
// The adapter turns a lane into a struct of plain floats and back. Nothing else differs from the 8-lane form, so both
// give equal bytes. Under validation (validation/validation.h) everything that the structs have room for goes through,
// with the rubbish that undeclared inputs and unwritten outputs hold.
#include "shader_adapter.h"

#include "binding/validation/validation.h"

// Store distances and the point size: the ones that the program has, and `all` of them under validation.
static void store_extras(const struct rhw_program *program, bool all, const struct rhw_vertex1 *one,
                         struct rhw_vertex *group, int lane)
{
    const int clips = all ? RHW_MAX_CLIP_DISTANCES : program->clip_distance_count;
    const int culls = all ? RHW_MAX_CULL_DISTANCES : program->cull_distance_count;
    for (int d = 0; d < clips; d++) {
        group->clip_distance[d][lane] = one->clip_distance[d];
    }
    for (int d = 0; d < culls; d++) {
        group->cull_distance[d][lane] = one->cull_distance[d];
    }
    group->point_size[lane] = one->point_size;
    group->viewport_index[lane] = one->viewport_index;
    group->layer[lane] = one->layer;
}

void rhw_vertex1_run(const struct rhw_pipeline_data *pipeline, struct rhw_vertex *groups, int count)
{
    const bool all = pipeline->validator != NULL;
    const int attributes = all ? RHW_MAX_ATTRIBUTES : pipeline->def.attribute_count;
    const int components = all ? rhw_validated_count(pipeline) : pipeline->varying_components;
    for (int i = 0; i < count * RHW_LANES; i++) {
        struct rhw_vertex *const group = &groups[i / RHW_LANES];
        const int lane = i % RHW_LANES;
        if (group->mask[lane] == 0) {
            continue;
        }
        float attribute[RHW_MAX_ATTRIBUTES][4] = {{0}};
        float varying[RHW_VALIDATED_COMPONENTS];
        float distance[2][RHW_MAX_CLIP_DISTANCES] = {{0}};
        for (int c = 0; c < components; c++) {
            varying[c] = all ? group->varying[c][lane] : 0;
        }
        for (int a = 0; a < attributes; a++) {
            for (int c = 0; c < 4; c++) {
                attribute[a][c] = group->attribute[a][c][lane];
            }
        }
        struct rhw_vertex1 one = {.attribute = (const float(*)[4])attribute,
                                  .vertex_index = group->vertex_index[lane],
                                  .instance_index = group->instance_index[lane],
                                  .uniforms = group->uniforms,
                                  .user = group->user,
                                  .bindings = group->bindings,
                                  .varying = varying,
                                  .clip_distance = distance[0],
                                  .cull_distance = distance[1],
                                  .point_size = all ? group->point_size[lane] : 1,
                                  .viewport_index = all ? group->viewport_index[lane] : 0,
                                  .layer = all ? group->layer[lane] : 0};
        for (int d = 0; d < RHW_MAX_CLIP_DISTANCES && all; d++) {
            distance[0][d] = group->clip_distance[d][lane];
            distance[1][d] = group->cull_distance[d][lane];
        }
        for (int c = 0; c < 4 && all; c++) {
            one.position[c] = group->position[c][lane];
        }
        pipeline->def.program.vertex1(&one);
        for (int c = 0; c < 4; c++) {
            group->position[c][lane] = one.position[c];
        }
        for (int c = 0; c < components; c++) {
            group->varying[c][lane] = varying[c];
        }
        store_extras(&pipeline->def.program, all, &one, group, lane);
    }
}

// Load the builtins that the program asked for.
static void load_builtins(const struct rhw_fragment *group, int lane, uint32_t uses,
                          struct rhw_fragment1 *one)
{
    one->depth = uses & RHW_USE_DEPTH ? group->depth[lane] : 0;
    one->depth_input = uses & RHW_USE_DEPTH_INPUT ? group->depth_input[lane] : 0;
    one->stencil_input = uses & RHW_USE_STENCIL_INPUT ? group->stencil_input[lane] : 0;
    for (int c = 0; c < 4 && uses & RHW_USE_COORD; c++) {
        one->coord[c] = group->coord[c][lane];
    }
    one->front_facing = uses & RHW_USE_FACING ? group->front_facing[lane] != 0 : false;
    if (uses & RHW_USE_IDS) {
        one->primitive = group->primitive[lane];
        one->instance = group->instance[lane];
        one->draw = group->draw[lane];
    }
    if (uses & RHW_USE_SAMPLE) {
        one->sample_id = group->sample_id[lane];
        one->sample_position[0] = group->sample_position[0][lane];
        one->sample_position[1] = group->sample_position[1][lane];
    }
    if (uses & RHW_USE_SAMPLE_MASK) {
        one->sample_mask = group->sample_mask[lane];
    }
    for (int c = 0; c < 3 && uses & RHW_USE_BARYCENTRIC; c++) {
        one->barycentric[c] = group->barycentric[c][lane];
        one->barycentric_noperspective[c] = group->barycentric_noperspective[c][lane];
    }
    for (int c = 0; c < 2 && uses & RHW_USE_POINT_COORD; c++) {
        one->point_coord[c] = group->point_coord[c][lane];
    }
    one->fully_covered = uses & RHW_USE_FULLY_COVERED ? group->fully_covered[lane] != 0 : false;
    if (uses & RHW_USE_LAYER) {
        one->layer = group->layer[lane];
        one->viewport_index = group->viewport_index[lane];
    }
    for (int c = 0; c < 3 && uses & RHW_USE_BARYCENTRIC_DERIVATIVES; c++) {
        one->barycentric_ddx[c] = group->barycentric_ddx[c][lane];
        one->barycentric_ddy[c] = group->barycentric_ddy[c][lane];
    }
}

static void run_fragment(const struct rhw_pipeline_data *pipeline, struct rhw_fragment *group, int lane)
{
    const bool all = pipeline->validator != NULL;
    const int components = all ? rhw_validated_count(pipeline) : pipeline->varying_components;
    const int targets = all ? RHW_MAX_COLOR_ATTACHMENTS : pipeline->output_count;
    const uint32_t uses = all ? UINT32_MAX : pipeline->def.program.uses;
    float varying[RHW_VALIDATED_COMPONENTS], ddx[RHW_VALIDATED_COMPONENTS], ddy[RHW_VALIDATED_COMPONENTS];
    float color[RHW_MAX_COLOR_ATTACHMENTS][4] = {{0}};
    for (int c = 0; c < components; c++) {
        varying[c] = group->varying[c][lane];
        ddx[c] = all || pipeline->component_derivatives[c] ? group->ddx[c][lane] : 0;
        ddy[c] = all || pipeline->component_derivatives[c] ? group->ddy[c][lane] : 0;
    }
    for (int t = 0; t < targets && uses & RHW_USE_COLOR_INPUT; t++) {
        for (int c = 0; c < 4; c++) {
            color[t][c] = group->color[t][c][lane];
        }
    }
    struct rhw_fragment1 one = {.varying = varying,
                                .ddx = ddx,
                                .ddy = ddy,
                                .uniforms = group->uniforms,
                                .user = group->user,
                                .bindings = group->bindings,
                                .color = color};
    load_builtins(group, lane, uses, &one);
    pipeline->def.program.fragment1(&one);
    for (int t = 0; t < targets; t++) {
        for (int c = 0; c < 4; c++) {
            group->color[t][c][lane] = color[t][c];
        }
    }
    if (uses & RHW_USE_DEPTH) {
        group->depth[lane] = one.depth;
    }
    if (uses & RHW_USE_SAMPLE_MASK) {
        group->sample_mask[lane] = one.sample_mask;
    }
    if (one.discard) {
        group->mask[lane] = 0;
    }
}

void rhw_fragment1_run(const struct rhw_pipeline_data *pipeline, struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count * RHW_LANES; i++) {
        if (groups[i / RHW_LANES].mask[i % RHW_LANES] != 0) {
            run_fragment(pipeline, &groups[i / RHW_LANES], i % RHW_LANES);
        }
    }
}
