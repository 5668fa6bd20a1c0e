// SPDX-License-Identifier: MIT
// See scene_reflection.h. Seven passes: the surroundings into each face of a cube of 256², and the picture. The ball
// stands in the middle of the stage.
#include "scene_reflection.h"

#include "scene_stage.h"

#include <string.h>

enum {
    STACKS = 32,
    MIRROR_STACKS = 64,
    SIZE = 256,
    FACES = 6,
    ITEMS = BENCH_STAGE_BODIES /* less the mirror, and the floor */
};

static const float sky[4] = {0.35f, 0.5f, 0.75f, 1.0f};

// Right, up and ahead as the texels of a face run (Vulkan 1.3, "Cube Map Face Selection"). They are mirrored: what is in
// front turns clockwise.
static const double axes[FACES][3][3] = {
    {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}, {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}},
    {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},  {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
};

// Model to clip coordinates of a face, seen from `eye`: a quarter turn wide and high.
static void look_at_face(int face, const double eye[3], const double world[16], float clip[16])
{
    const double near = 0.5, far = 150.0;
    double view[16] = {[15] = 1.0}, both[16];
    for (int row = 0; row < 3; row++) {
        for (int c = 0; c < 3; c++) {
            view[4 * c + row] = axes[face][row][c];
            view[12 + row] -= axes[face][row][c] * eye[c];
        }
    }
    scene_matrix_multiply(view, world, both);
    for (int c = 0; c < 4; c++) {
        const double ahead = both[4 * c + 2], one = c == 3 ? 1.0 : 0.0;
        clip[4 * c] = (float)both[4 * c];
        clip[4 * c + 1] = (float)both[4 * c + 1];
        clip[4 * c + 2] =
            (float)((far + near) / (far - near) * ahead - 2.0 * far * near / (far - near) * one);
        clip[4 * c + 3] = (float)ahead;
    }
}

static void make_face(struct bench_scene *scene, int face, const double eye[3], double aspect)
{
    struct bench_draw *const draws = &scene->draws[face * ITEMS];
    scene->passes[face] = (struct bench_pass){.color_count = 1,
                                              .face = face,
                                              .depth = BENCH_PASS_DEPTH,
                                              .first_draw = (uint32_t)(face * ITEMS),
                                              .draw_count = ITEMS};
    memcpy(scene->passes[face].clear, sky, sizeof sky);
    for (int i = 0; i < ITEMS; i++) {
        double world[16];
        float color[4];
        const int number = i - 1 < BENCH_STAGE_MIDDLE ? i - 1 : i;
        bench_stage_place(number, world, color);
        draws[i] = bench_stage_draw(number, i > 0, &bench_stage_camera, aspect);
        draws[i].cull_back = false;
        look_at_face(face, eye, world, draws[i].uniforms.clip);
        for (int c = 0; c < 3; c++) {
            draws[i].uniforms.eye[c] = (float)eye[c];
        }
    }
}

static void make_picture(struct bench_scene *scene, double aspect)
{
    const uint32_t first = FACES * ITEMS;
    struct bench_draw *const mirror = &scene->draws[first + ITEMS];
    static const float silver[4] = {0.9f, 0.9f, 0.9f, 1.0f};
    scene->passes[FACES] = (struct bench_pass){.color_count = 1,
                                               .colors = {BENCH_PICTURE},
                                               .depth = BENCH_PASS_DEPTH,
                                               .first_draw = first,
                                               .draw_count = ITEMS + 1};
    for (int i = 0; i < ITEMS; i++) {
        const int number = i - 1 < BENCH_STAGE_MIDDLE ? i - 1 : i;
        scene->draws[first + (uint32_t)i] = bench_stage_draw(number, i > 0, &bench_stage_camera, aspect);
    }
    *mirror = bench_stage_draw(BENCH_STAGE_MIDDLE, 2, &bench_stage_camera, aspect);
    mirror->shader = BENCH_SHADER_REFLECT;
    mirror->texture_count = 1;
    memcpy(mirror->uniforms.color, silver, sizeof silver);
}

bool bench_make_reflection(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                           int height, char *why, size_t why_size)
{
    (void)entry, (void)why, (void)why_size; // nothing but memory can fail
    const double aspect = (double)width / (double)height;
    double middle[16];
    float color[4];
    scene->mesh_count = 3;
    scene->texture_count = 1;
    scene->pass_count = FACES + 1;
    scene->draw_count = (FACES + 1) * ITEMS + 1;
    scene->unit = BENCH_TRIANGLES;
    // The peer filters in 8 bits, and where the cube shows an edge little decides which texels are mixed.
    scene->tolerance = (struct bench_tolerance){.color = 6, .outliers = 2e-4};
    if (!bench_scene_allocate(scene) || !bench_stage_floor(&scene->meshes[0]) ||
        !bench_stage_ball(&scene->meshes[1], STACKS) || !bench_stage_ball(&scene->meshes[2], MIRROR_STACKS)) {
        return false;
    }
    scene->textures[0] = (struct bench_texture){.width = SIZE,
                                                .height = SIZE,
                                                .levels = 1,
                                                .format = BENCH_RGBA8,
                                                .filter = BENCH_LINEAR,
                                                .target = true,
                                                .cube = true};
    bench_stage_place(BENCH_STAGE_MIDDLE, middle, color);
    for (int face = 0; face < FACES; face++) {
        make_face(scene, face, &middle[12], aspect);
    }
    make_picture(scene, aspect);
    scene->work = bench_stage_triangles(scene);
    return true;
}
