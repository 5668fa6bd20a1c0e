// SPDX-License-Identifier: MIT
// See ground.h. Light from above at some 40 degrees throws shadows that are a little longer than the model is high. The
// ground is whole within this distance, and gone at two and a half times the distance.
#include "ground.h"

#include <string.h>

#include "draw/camera/camera.h"
#include "elementary.h"
#include "draw/camera/subject.h"

static const double shadow_length = 1.3, fade = 2.5;

static void set_vertex(struct scene_ground *ground, int vertex, const double place[3], const double up[3],
                       float alpha)
{
    for (int c = 0; c < 3; c++) {
        ground->positions[vertex][c] = (float)place[c];
        ground->normals[vertex][c] = (float)up[c];
        ground->colors[vertex][c] = 0.0f;
    }
    ground->colors[vertex][3] = alpha;
}

// Two rings around the middle; `sides` and up make a right-handed system.
static void make_rings(struct scene_ground *ground, const double middle[3], const double up[3],
                       double sides[2][3], double radius)
{
    set_vertex(ground, 0, middle, up, 1.0f);
    uint32_t *index = ground->indices;
    for (int k = 0; k < SCENE_GROUND_SPOKES; k++) {
        double sine, cosine, place[2][3];
        scene_sin_cos_degrees(360.0 * k / SCENE_GROUND_SPOKES, &sine, &cosine);
        for (int c = 0; c < 3; c++) {
            const double along = (sides[0][c] * cosine + sides[1][c] * sine) * radius;
            place[0][c] = middle[c] + along;
            place[1][c] = middle[c] + along * fade;
        }
        set_vertex(ground, 1 + k, place[0], up, 1.0f);
        set_vertex(ground, 1 + SCENE_GROUND_SPOKES + k, place[1], up, 0.0f);
        const uint32_t a = 1 + (uint32_t)k, b = 1 + (uint32_t)(k + 1) % SCENE_GROUND_SPOKES;
        const uint32_t corners[9] = {
            0, a, b, a, a + SCENE_GROUND_SPOKES, b + SCENE_GROUND_SPOKES, a, b + SCENE_GROUND_SPOKES, b};
        memcpy(index, corners, sizeof corners);
        index += 9;
    }
}

static void lay_out(struct scene_ground *ground, const struct scene_model *model, enum scene_axis axis)
{
    const struct scene_subject subject = scene_subject_find(model);
    double up[3] = {0.0, 1.0, 0.0}, sides[2][3] = {{0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}};
    double middle[3], half[3];
    scene_axis_turn(axis, up);
    scene_axis_turn(axis, sides[0]);
    scene_axis_turn(axis, sides[1]);
    for (int c = 0; c < 3; c++) {
        const double low = subject.box.low[c], high = subject.box.high[c];
        middle[c] = 0.5 * (low + high);
        half[c] = 0.5 * (high - low);
    }
    double across = 0.0, height = 0.0;
    for (int c = 0; c < 3; c++) { // axes are those of the world
        across += half[c] * half[c] * (1.0 - up[c] * up[c]);
        height += half[c] * up[c] * up[c];
    }
    for (int c = 0; c < 3; c++) {
        middle[c] -= up[c] * height;
    }
    const double radius = __builtin_sqrt(across) + shadow_length * 2.0 * height;
    make_rings(ground, middle, up, sides, radius > 0.0 ? radius : 1.0);
}

enum rhw_result scene_ground_make(struct scene_ground *ground, rhw_context *context,
                                  const struct scene_model *model, enum scene_axis up)
{
    scene_ground_destroy(ground);
    lay_out(ground, model, up);
    ground->mesh = (struct scene_mesh){.name = "",
                                       .vertex_count = SCENE_GROUND_VERTICES,
                                       .index_count = SCENE_GROUND_SPOKES * 9,
                                       .indices = ground->indices,
                                       .positions = ground->positions,
                                       .normals = ground->normals,
                                       .colors = ground->colors};
    ground->material = (struct scene_material){.name = "",
                                               .base_color = {1, 1, 1, 1},
                                               .roughness = 1,
                                               .normal_scale = 1,
                                               .alpha_mode = SCENE_ALPHA_BLEND,
                                               .is_ground = true};
    for (int s = 0; s < SCENE_SLOT_COUNT; s++) {
        ground->material.slots[s].image = -1;
    }
    ground->instance = (struct scene_instance){.name = "", .object = 1};
    for (int i = 0; i < 16; i += 5) {
        ground->instance.world[i] = 1.0f;
    }
    ground->model = (struct scene_model){.path = "",
                                         .mesh_count = 1,
                                         .material_count = 1,
                                         .instance_count = 1,
                                         .meshes = &ground->mesh,
                                         .materials = &ground->material,
                                         .instances = &ground->instance};
    const enum rhw_result result = scene_upload_create(context, &ground->model, &ground->upload);
    ground->is_made = result == RHW_OK;
    return result;
}

void scene_ground_destroy(struct scene_ground *ground)
{
    if (ground->is_made) {
        scene_upload_destroy(&ground->upload);
    }
    ground->is_made = false;
}
