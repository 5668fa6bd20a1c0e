// SPDX-License-Identifier: MIT
// See scene_stage.h.
#include "scene_stage.h"

#include "elementary.h"

#include <string.h>

enum { SIDE = 5 };

static const double pi = 3.14159265358979323846;
static const double spacing = 2.4;

const struct scene_camera bench_stage_camera = {
    .eye = {0.0, 6.0, 11.0},
    .up = {0.0, 1.0, 0.0},
    .yfov = 0.8,
    .znear = 0.5,
    .zfar = 150.0,
};

bool bench_stage_floor(struct bench_mesh *mesh)
{
    static const float vertices[4][6] = {
        {-90, 0, 90, 0, 1, 0}, {90, 0, 90, 0, 1, 0}, {90, 0, -90, 0, 1, 0}, {-90, 0, -90, 0, 1, 0}};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    mesh->has[BENCH_POSITION] = mesh->has[BENCH_NORMAL] = true;
    if (!bench_mesh_allocate(mesh, 4, 6)) {
        return false;
    }
    memcpy(mesh->vertices, vertices, sizeof vertices);
    memcpy(mesh->indices, indices, sizeof indices);
    return true;
}

bool bench_stage_ball(struct bench_mesh *mesh, uint32_t stacks)
{
    const uint32_t slices = 2 * stacks;
    mesh->has[BENCH_POSITION] = mesh->has[BENCH_NORMAL] = true;
    if (!bench_mesh_allocate(mesh, (stacks + 1) * (slices + 1), 6 * stacks * slices)) {
        return false;
    }
    float *to = mesh->vertices;
    uint32_t *index = mesh->indices;
    for (uint32_t i = 0; i <= stacks; i++) {
        for (uint32_t k = 0; k <= slices; k++, to += 6) {
            const double theta = pi * i / stacks, phi = 2.0 * pi * k / slices, s = scene_sin(theta);
            to[0] = to[3] = (float)(s * scene_cos(phi));
            to[1] = to[4] = (float)scene_cos(theta);
            to[2] = to[5] = (float)(s * scene_sin(phi));
            if (i < stacks && k < slices) {
                const uint32_t a = i * (slices + 1) + k, b = a + slices + 1;
                const uint32_t quad[6] = {a, a + 1, b, a + 1, b + 1, b};
                memcpy(index, quad, sizeof quad);
                index += 6;
            }
        }
    }
    return true;
}

// Bodies turn and differ in size and height.
void bench_stage_place(int number, double world[16], float color[4])
{
    static const float gray[4] = {0.7f, 0.7f, 0.72f, 1.0f};
    static const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    if (number == BENCH_STAGE_FLOOR) {
        memcpy(world, identity, sizeof identity);
        memcpy(color, gray, sizeof gray);
        return;
    }
    const int column = number % SIDE, row = number / SIDE;
    const double size = number == BENCH_STAGE_MIDDLE ? 1.1 : 0.45 + 0.07 * (number * 7 % 6);
    const double turn = 0.7 * number + 0.3, c = size * scene_cos(turn), s = size * scene_sin(turn);
    const double place[16] = {c,
                              0,
                              -s,
                              0,
                              0,
                              size,
                              0,
                              0,
                              s,
                              0,
                              c,
                              0,
                              spacing * (column - SIDE / 2),
                              1.15 + 0.12 * (number * 5 % 7),
                              spacing * (row - SIDE / 2),
                              1};
    const float paint[4] = {0.3f + 0.15f * (float)column, 0.75f - 0.08f * (float)(number * 3 % 7),
                            0.9f - 0.15f * (float)row, 1.0f};
    memcpy(world, place, sizeof place);
    memcpy(color, paint, sizeof paint);
}

struct bench_draw bench_stage_draw(int number, uint32_t mesh, const struct scene_camera *camera,
                                   double aspect)
{
    double world[16];
    float color[4];
    bench_stage_place(number, world, color);
    struct bench_draw draw = {.shader = BENCH_SHADER_LIT,
                              .depth = BENCH_DEPTH_LESS,
                              .cull_back = true,
                              .mesh = mesh,
                              .uniforms = bench_look(camera, aspect, world)};
    memcpy(draw.uniforms.color, color, sizeof color);
    return draw;
}

double bench_stage_triangles(const struct bench_scene *scene)
{
    double triangles = 0.0;
    for (uint32_t i = 0; i < scene->draw_count; i++) {
        triangles += scene->meshes[scene->draws[i].mesh].index_count / 3;
    }
    return triangles;
}
