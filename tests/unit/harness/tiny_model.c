// SPDX-License-Identifier: MIT
// See tiny_model.h.
#include "tiny_model.h"

#include <math.h>
#include <string.h>

void tiny_assert_close(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance)) {
        fail_msg("%.9g instead of %.9g (tolerance %g)", value, expected, tolerance);
    }
}

void tiny_identity(float m[16])
{
    memset(m, 0, 16 * sizeof *m);
    m[0] = m[5] = m[10] = m[15] = 1.0f;
}

void tiny_set_bounds(struct tiny *t)
{
    for (int i = 0; i < 3; i++) {
        t->mesh.bounds_min[i] = t->mesh.bounds_max[i] = t->positions[0][i];
        for (int v = 1; v < 4; v++) {
            t->mesh.bounds_min[i] = fminf(t->mesh.bounds_min[i], t->positions[v][i]);
            t->mesh.bounds_max[i] = fmaxf(t->mesh.bounds_max[i], t->positions[v][i]);
        }
        t->model.bounds_min[i] = t->mesh.bounds_min[i];
        t->model.bounds_max[i] = t->mesh.bounds_max[i];
    }
}

void tiny_make(struct tiny *t)
{
    memset(t, 0, sizeof *t);
    static const float corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    static const uint32_t order[6] = {0, 1, 2, 0, 2, 3};
    for (int v = 0; v < 4; v++) {
        t->positions[v][0] = corners[v][0];
        t->positions[v][1] = corners[v][1];
        t->normals[v][2] = 1.0f;
        t->tangents[v][0] = t->tangents[v][3] = 1.0f;
        t->uvs[v][0] = corners[v][0] * 0.5f + 0.5f;
        t->uvs[v][1] = 0.5f - corners[v][1] * 0.5f;
    }
    memcpy(t->indices, order, sizeof order);
    t->mesh = (struct scene_mesh){.name = "square",
                                  .vertex_count = 4,
                                  .index_count = 6,
                                  .indices = t->indices,
                                  .positions = t->positions,
                                  .normals = t->normals,
                                  .uvs = {t->uvs, NULL}};
    t->material = (struct scene_material){.name = "m",
                                          .base_color = {1, 1, 1, 1},
                                          .roughness = 1,
                                          .normal_scale = 1,
                                          .occlusion_strength = 1,
                                          .alpha_cutoff = 0.5f,
                                          .unlit = true};
    for (int s = 0; s < SCENE_SLOT_COUNT; s++) {
        t->material.slots[s] = (struct scene_texture_slot){.image = -1, .transform = {1, 0, 0, 0, 1, 0}};
    }
    for (uint32_t i = 0; i < 2; i++) {
        t->instances[i] = (struct scene_instance){.name = "n", .object = i + 1};
        tiny_identity(t->instances[i].world);
    }
    t->image = (struct scene_image){.name = "i",
                                    .width = 2,
                                    .height = 2,
                                    .used_as_color = true,
                                    .used_as_data = true,
                                    .size = sizeof t->texels,
                                    .texels = t->texels};
    t->model = (struct scene_model){.path = "tiny",
                                    .format = "none",
                                    .mesh_count = 1,
                                    .material_count = 1,
                                    .image_count = 1,
                                    .instance_count = 1,
                                    .meshes = &t->mesh,
                                    .materials = &t->material,
                                    .images = &t->image,
                                    .instances = t->instances,
                                    .lights = &t->light};
    tiny_set_bounds(t);
}

struct scene_view tiny_view(const struct tiny *t, int size)
{
    struct scene_view view = scene_view_default(&t->model);
    view.width = view.height = size;
    view.camera = (struct scene_camera){
        .eye = {0, 0, 5}, .up = {0, 1, 0}, .orthographic = true, .ymag = 2.0, .znear = 1.0, .zfar = 9.0};
    view.background = SCENE_BACKGROUND_COLOR;
    view.background_color[0] = 10;
    view.background_color[1] = 200;
    view.background_color[2] = 30;
    return view;
}

struct scene_pictures tiny_draw(const struct tiny *t, const struct scene_view *view)
{
    const struct rhw_context_def def = rhw_context_def_default();
    rhw_context *context;
    struct scene *scene;
    struct scene_pictures pictures;
    assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
    assert_int_equal(scene_create(context, &t->model, &scene), RHW_OK);
    assert_int_equal(scene_draw(scene, view, &pictures, NULL), RHW_OK);
    scene_destroy(scene);
    rhw_context_destroy(context);
    return pictures;
}

double tiny_light_at(const struct scene_pictures *pictures, double x, double y)
{
    const int column = (int)((x + 2.0) / 4.0 * pictures->width),
              row = (int)((2.0 - y) / 4.0 * pictures->height);
    return (double)pictures->linear[4 * (row * pictures->width + column)];
}
