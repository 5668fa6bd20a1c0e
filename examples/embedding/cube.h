// SPDX-License-Identifier: MIT
// What every recipe draws: a turning cube, its colours those of its corners. For C and C++.
#ifndef CUBE_H
#define CUBE_H

#include <string.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

// The uniforms: the angle that the cube is turned by, and how many times as wide as high the picture is.
struct cube_view {
    float cosine, sine, aspect;
};

enum { CUBE_VERTICES = 36 };

// The bits of a corner's number are its x, y and z. A face goes counter-clockwise as seen from outside.
static inline void cube_vertex(struct rhw_vertex1 *v)
{
    static const unsigned char faces[6][4] = {{0, 1, 3, 2}, {5, 4, 6, 7}, {1, 5, 7, 3},
                                              {4, 0, 2, 6}, {2, 3, 7, 6}, {4, 5, 1, 0}};
    static const unsigned char halves[6] = {0, 1, 2, 0, 2, 3};
    struct cube_view view;
    memcpy(&view, v->uniforms, sizeof view);
    const int corner = faces[v->vertex_index / 6][halves[v->vertex_index % 6]];
    float at[3];
    for (int i = 0; i < 3; i++) {
        at[i] = corner >> i & 1 ? 1.0f : -1.0f;
        v->varying[i] = 0.5f + 0.5f * at[i];
    }
    // About its own axis; then seen from above, by an eye 5 away.
    const float x = view.cosine * at[0] + view.sine * at[2], z = view.cosine * at[2] - view.sine * at[0];
    const float w = 5 - 0.6f * at[1] + 0.8f * z;
    v->position[0] = 2 * x / view.aspect;
    v->position[1] = 2 * (0.8f * at[1] + 0.6f * z);
    v->position[2] = (w - 2) * (8.0f / 6.0f); // depth 0 at a distance of 2, 1 at 8
    v->position[3] = w;
}

static inline void cube_fragment(struct rhw_fragment1 *f)
{
    memcpy(f->color[0], f->varying, 3 * sizeof(float));
    f->color[0][3] = 1;
}

static inline struct rhw_pipeline_def cube_pipeline_def(void)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program.vertex1 = cube_vertex;
    def.program.fragment1 = cube_fragment;
    def.program.varyings[0].components = 3;
    def.program.varying_count = 1;
    def.program.uniform_size = sizeof(struct cube_view);
    def.cull = RHW_CULL_BACK;
    def.depth_test = true;
    def.targets[0].format = RHW_FORMAT_RGBA8_SRGB;
    return def;
}

static inline enum rhw_result cube_pipeline(rhw_context *context, rhw_pipeline *pipeline)
{
    const struct rhw_pipeline_def def = cube_pipeline_def();
    return rhw_pipeline_create(context, &def, pipeline);
}

// One frame: clears the picture and draws the cube, turned by `angle`.
static inline enum rhw_result cube_draw(rhw_context *context, rhw_pipeline pipeline, rhw_texture picture,
                                        float angle)
{
    struct cube_view view;
    struct rhw_pass_def def = rhw_pass_def_default();
    const float backdrop[4] = {0.02f, 0.02f, 0.03f, 1};
    def.colors[0].texture = picture;
    memcpy(def.colors[0].clear, backdrop, sizeof backdrop);
    def.depth.enabled = true;
    def.depth.store = RHW_STORE_DISCARD; // depth of this pass alone: it needs no texture
    rhw_pass pass;
    const enum rhw_result result = rhw_pass_begin(context, &def, &pass);
    if (result != RHW_OK) {
        return result;
    }
    view.cosine = rhw_cos1(angle);
    view.sine = rhw_sin1(angle);
    view.aspect =
        (float)rhw_texture_width(context, picture, 0) / (float)rhw_texture_height(context, picture, 0);
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_uniforms(context, pass, &view, sizeof view);
    rhw_pass_draw(context, pass, 0, CUBE_VERTICES, 0, 1);
    return rhw_pass_end(context, pass, NULL);
}

#endif
