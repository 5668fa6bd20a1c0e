// SPDX-License-Identifier: MIT
// See scene_small.h. Each pass clears the target and draws a ball, lit and a little further turned; the picture shows what
// the last one left.
#include "scene_small.h"

#include "elementary.h"
#include "scene_stage.h"

#include <string.h>

enum { STACKS = 8, PASSES_16 = 2000, PASSES_64 = 500, PASSES_256 = 100 };

static const struct scene_camera camera = {
    .eye = {0.0, 0.0, 4.0},
    .up = {0.0, 1.0, 0.0},
    .yfov = 0.6,
    .znear = 1.0,
    .zfar = 10.0,
};

// A rectangle in front of the camera that the whole of the texture lies on.
static bool make_screen(struct bench_mesh *mesh)
{
    static const uint32_t indices[6] = {0, 1, 3, 0, 3, 2};
    mesh->has[BENCH_POSITION] = mesh->has[BENCH_UV] = true;
    if (!bench_mesh_allocate(mesh, 4, 6)) {
        return false;
    }
    float *to = mesh->vertices;
    for (int i = 0; i < 4; i++) {
        const float u = (float)(i & 1), v = (float)(i >> 1);
        const float vertex[5] = {2.0f * u - 1.0f, 2.0f * v - 1.0f, 0.0f, u, v};
        memcpy(to, vertex, sizeof vertex);
        to += 5;
    }
    memcpy(mesh->indices, indices, sizeof indices);
    return true;
}

static void make_pass(struct bench_scene *scene, uint32_t number)
{
    const double turn = 0.01 * number, c = scene_cos(turn), s = scene_sin(turn);
    const double world[16] = {c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0, 0, 0, 1};
    static const float color[4] = {0.8f, 0.5f, 0.2f, 1.0f};
    struct bench_draw *const draw = &scene->draws[number];
    scene->passes[number] = (struct bench_pass){.color_count = 1,
                                                .depth = BENCH_PASS_DEPTH,
                                                .clear = {0.1f, 0.2f, 0.3f, 1.0f},
                                                .first_draw = number,
                                                .draw_count = 1};
    *draw = (struct bench_draw){.shader = BENCH_SHADER_LIT,
                                .depth = BENCH_DEPTH_LESS,
                                .cull_back = true,
                                .uniforms = bench_look(&camera, 1.0, world)};
    memcpy(draw->uniforms.color, color, sizeof color);
}

static void make_picture(struct bench_scene *scene, uint32_t number, double aspect)
{
    static const double world[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    scene->passes[number] = (struct bench_pass){.color_count = 1,
                                                .colors = {BENCH_PICTURE},
                                                .depth = BENCH_PASS_DEPTH,
                                                .first_draw = number,
                                                .draw_count = 1};
    scene->draws[number] = (struct bench_draw){.shader = BENCH_SHADER_TEXTURE,
                                               .mesh = 1,
                                               .texture_count = 1,
                                               .uniforms = bench_look(&camera, aspect, world)};
}

bool bench_make_small(const struct bench_scene_entry *entry, struct bench_scene *scene, int width, int height,
                      char *why, size_t why_size)
{
    (void)why, (void)why_size; // nothing but memory can fail
    const int size = entry->variant;
    const uint32_t passes = size == BENCH_SMALL_16   ? PASSES_16
                            : size == BENCH_SMALL_64 ? PASSES_64
                                                     : PASSES_256;
    scene->mesh_count = 2;
    scene->texture_count = 1;
    scene->pass_count = scene->draw_count = passes + 1;
    scene->unit = BENCH_DRAWS;
    scene->work = passes;
    // An edge of the ball is magnified: what one pixel of the target differs by is seen in thousands of the picture.
    scene->tolerance = (struct bench_tolerance){.color = 3, .outliers = 5e-3};
    if (!bench_scene_allocate(scene) || !bench_stage_ball(&scene->meshes[0], STACKS) ||
        !make_screen(&scene->meshes[1])) {
        return false;
    }
    scene->textures[0] = (struct bench_texture){.width = size,
                                                .height = size,
                                                .levels = 1,
                                                .format = BENCH_RGBA8,
                                                .filter = BENCH_LINEAR,
                                                .target = true};
    for (uint32_t i = 0; i < passes; i++) {
        make_pass(scene, i);
    }
    make_picture(scene, passes, (double)width / (double)height);
    return true;
}
