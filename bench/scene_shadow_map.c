// SPDX-License-Identifier: MIT
// See scene_shadow_map.h. Two passes: depth from the light, and the picture, whose shader compares with it.
#include "scene_shadow_map.h"

#include "scene_stage.h"

#include <string.h>

enum { STACKS = 32, SIZE = 2048, ITEMS = BENCH_STAGE_BODIES + 1 };

static const double bias = 0.002; // of the depth range: a surface must not shade itself

// Along the light of bench_look.
static const struct scene_camera light = {
    .eye = {9.6, 12.8, 12.0},
    .up = {0.0, 1.0, 0.0},
    .orthographic = true,
    .ymag = 8.5,
    .znear = 5.0,
    .zfar = 40.0,
};

// From the world to u, v and depth of the map; its first row of texels is the upper one.
static void share_map(struct bench_scene *scene)
{
    static const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const struct bench_uniforms seen = bench_look(&light, 1.0, identity);
    for (int row = 0; row < 3; row++) {
        const float half = row == 1 ? -0.5f : 0.5f;
        for (int column = 0; column < 4; column++) {
            scene->shared[row][column] = half * seen.clip[4 * column + row];
        }
        scene->shared[row][3] += 0.5f;
    }
    scene->shared[2][3] -= (float)bias;
    scene->shared[3][0] = 1.0f / SIZE;
}

bool bench_make_shadow_map(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                           int height, char *why, size_t why_size)
{
    (void)entry, (void)why, (void)why_size; // nothing but memory can fail
    const double aspect = (double)width / (double)height;
    scene->mesh_count = scene->pass_count = 2;
    scene->texture_count = 1;
    scene->draw_count = 2 * ITEMS;
    scene->shared_count = 4;
    scene->unit = BENCH_TRIANGLES;
    // Where a shadow begins, depths decide that are hardly apart.
    scene->tolerance = (struct bench_tolerance){.color = 3, .outliers = 5e-4};
    if (!bench_scene_allocate(scene) || !bench_stage_floor(&scene->meshes[0]) ||
        !bench_stage_ball(&scene->meshes[1], STACKS)) {
        return false;
    }
    scene->textures[0] = (struct bench_texture){.width = SIZE,
                                                .height = SIZE,
                                                .levels = 1,
                                                .format = BENCH_D32F,
                                                .filter = BENCH_COMPARE,
                                                .target = true};
    scene->passes[0] = (struct bench_pass){.depth = BENCH_PASS_DEPTH_KEPT, .draw_count = ITEMS};
    scene->passes[1] = (struct bench_pass){.color_count = 1,
                                           .colors = {BENCH_PICTURE},
                                           .depth = BENCH_PASS_DEPTH,
                                           .first_draw = ITEMS,
                                           .draw_count = ITEMS};
    share_map(scene);
    for (int i = 0; i < ITEMS; i++) {
        const int number = i - 1; // BENCH_STAGE_FLOOR first
        const uint32_t mesh = i > 0;
        struct bench_draw *const seen = &scene->draws[i], *const shown = &scene->draws[ITEMS + i];
        *seen = bench_stage_draw(number, mesh, &light, 1.0);
        seen->shader = BENCH_SHADER_DEPTH;
        *shown = bench_stage_draw(number, mesh, &bench_stage_camera, aspect);
        shown->shader = BENCH_SHADER_SHADOWED;
        shown->texture_count = 1;
    }
    scene->work = bench_stage_triangles(scene);
    return true;
}
