// SPDX-License-Identifier: MIT
// See scene_deferred.h. Two passes: the stage into colour, normal, distance and material, 20 bytes a pixel; and a
// triangle over the picture, whose shader fetches them and adds up the lights that reach the place.
#include "scene_deferred.h"

#include "elementary.h"
#include "scene_stage.h"

#include <string.h>

enum { STACKS = 32, TARGETS = 4, ITEMS = BENCH_STAGE_BODIES + 1, LAST = ITEMS };

static void set_passes(struct bench_scene *scene, int width, int height)
{
    static const enum bench_format formats[TARGETS] = {BENCH_RGBA8, BENCH_RGBA16F, BENCH_R32F, BENCH_RGBA8};
    scene->passes[0] = (struct bench_pass){
        .color_count = TARGETS, .depth = BENCH_PASS_DEPTH, .first_draw = 0, .draw_count = ITEMS};
    scene->passes[1] = (struct bench_pass){.color_count = 1,
                                           .colors = {BENCH_PICTURE},
                                           .depth = BENCH_PASS_NO_DEPTH,
                                           .first_draw = LAST,
                                           .draw_count = 1};
    for (int i = 0; i < TARGETS; i++) {
        scene->passes[0].colors[i] = i;
        scene->textures[i] = (struct bench_texture){.width = width,
                                                    .height = height,
                                                    .levels = 1,
                                                    .format = formats[i],
                                                    .filter = BENCH_FETCH,
                                                    .target = true};
    }
}

// One triangle over the whole picture; its normals are the rays of its corners, to distance 1 along the view.
static bool make_cover(struct bench_mesh *mesh, const struct scene_camera *camera, double aspect)
{
    static const float corners[3][2] = {{-1, -1}, {3, -1}, {-1, 3}};
    static const uint32_t indices[3] = {0, 1, 2};
    const double t = scene_tan(0.5 * camera->yfov);
    double view[16];
    mesh->has[BENCH_POSITION] = mesh->has[BENCH_NORMAL] = true;
    if (!bench_mesh_allocate(mesh, 3, 3)) {
        return false;
    }
    memcpy(mesh->indices, indices, sizeof indices);
    scene_camera_view(camera, view);
    for (int i = 0; i < 3; i++) {
        float *const to = mesh->vertices + 6 * i;
        const double x = (double)corners[i][0] * t * aspect, y = (double)corners[i][1] * t;
        memcpy(to, corners[i], sizeof corners[i]);
        for (int c = 0; c < 3; c++) { // rows of the view are right, up and back
            to[3 + c] = (float)(x * view[4 * c] + y * view[4 * c + 1] - view[4 * c + 2]);
        }
    }
    return true;
}

static struct bench_draw cover_picture(const struct scene_camera *camera, double aspect)
{
    static const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    struct bench_draw draw = {.shader = BENCH_SHADER_LIGHTS,
                              .mesh = 2,
                              .texture_count = TARGETS,
                              .textures = {0, 1, 2, 3},
                              .uniforms = bench_look(camera, aspect, identity)};
    for (int i = 0; i < 16; i++) {
        draw.uniforms.clip[i] = (float)identity[i];
    }
    return draw;
}

// In two rings over the stage, in the colours of the rainbow.
static void set_lights(float (*lights)[4])
{
    for (int i = 0; i < BENCH_LIGHTS; i++, lights += 2) {
        const double turn = 6.283185307179586 * i / (BENCH_LIGHTS / 2) + (i % 2 ? 0.2 : 0.0),
                     ring = i % 2 ? 3.0 : 6.0, radius = i % 2 ? 4.0 : 6.0;
        const float place[4] = {(float)(ring * scene_cos(turn)), 2.4f - 0.9f * (float)(i % 3),
                                (float)(ring * scene_sin(turn)), (float)(1.0 / (radius * radius))};
        memcpy(lights[0], place, sizeof place);
        for (int c = 0; c < 3; c++) {
            lights[1][c] = (float)(0.3 + 0.25 * scene_cos(turn - 2.0943951 * c));
        }
    }
}

bool bench_make_deferred(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                         int height, char *why, size_t why_size)
{
    (void)entry, (void)why, (void)why_size; // nothing but memory can fail
    const double aspect = (double)width / (double)height;
    scene->mesh_count = 3;
    scene->pass_count = 2;
    scene->texture_count = TARGETS;
    scene->draw_count = ITEMS + 1;
    scene->shared_count = 2 * BENCH_LIGHTS;
    scene->unit = BENCH_TRIANGLES;
    // The normal has 11 bits of fraction, and a highlight is steep.
    scene->tolerance = (struct bench_tolerance){.color = 2, .outliers = 2e-4};
    if (!bench_scene_allocate(scene) || !bench_stage_floor(&scene->meshes[0]) ||
        !bench_stage_ball(&scene->meshes[1], STACKS) ||
        !make_cover(&scene->meshes[2], &bench_stage_camera, aspect)) {
        return false;
    }
    set_passes(scene, width, height);
    set_lights(scene->shared);
    for (int i = 0; i < ITEMS; i++) {
        scene->draws[i] = bench_stage_draw(i - 1, i > 0, &bench_stage_camera, aspect);
        scene->draws[i].shader = BENCH_SHADER_SURFACE;
    }
    scene->draws[LAST] = cover_picture(&bench_stage_camera, aspect);
    scene->work = bench_stage_triangles(scene);
    return true;
}
