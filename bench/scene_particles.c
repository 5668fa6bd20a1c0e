// SPDX-License-Identifier: MIT
// See scene_particles.h. The particles stand in a disc with two arms, most of them near its middle, a few pixels each.
#include "scene_particles.h"

#include "elementary.h"

#include <math.h>
#include <string.h>

enum { PARTICLES = 100000 };

static const struct scene_camera camera = {
    .eye = {0.0, 1.1, 2.0},
    .up = {0.0, 1.0, 0.0},
    .yfov = 0.8,
    .znear = 0.1,
    .zfar = 10.0,
};

// 0..1, the next of a sequence.
static double next(uint32_t *state)
{
    *state = *state * 1664525 + 1013904223;
    return (double)(*state >> 8) / 16777216.0;
}

static void place(float *to, uint32_t *state)
{
    const double radius = 0.05 + 1.2 * next(state), arm = next(state) < 0.5 ? 0.0 : 3.14159265358979;
    const double spread = next(state) - next(state), angle = arm + 4.0 * radius + 0.9 * spread;
    const double height = 0.15 * (next(state) - next(state)) * (1.3 - radius);
    const double age = next(state);
    const float particle[8] = {(float)(radius * scene_cos(angle)), (float)height,
                               (float)(radius * scene_sin(angle)), (float)(0.004 + 0.006 * next(state)),
                               (float)(1.0 - 0.5 * radius),        (float)(0.5 + 0.3 * age),
                               (float)(0.3 + 0.5 * radius),        (float)(0.2 + 0.5 * age)};
    memcpy(to, particle, sizeof particle);
}

static bool make_mesh(struct bench_mesh *mesh)
{
    static const float corners[4][3] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    uint32_t state = 1;
    mesh->has[BENCH_POSITION] = mesh->has[BENCH_PLACE] = mesh->has[BENCH_TINT] = true;
    if (!bench_mesh_allocate(mesh, 4, 6) || !bench_mesh_allocate_instances(mesh, PARTICLES)) {
        return false;
    }
    memcpy(mesh->vertices, corners, sizeof corners);
    memcpy(mesh->indices, indices, sizeof indices);
    for (uint32_t i = 0; i < PARTICLES; i++) {
        place(mesh->instances + 8 * (size_t)i, &state);
    }
    return true;
}

bool bench_make_particles(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                          int height, char *why, size_t why_size)
{
    (void)entry, (void)why, (void)why_size; // nothing but memory can fail
    static const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    static const float night[4] = {0.02f, 0.02f, 0.05f, 1.0f};
    double view[16];
    scene->mesh_count = scene->draw_count = 1;
    scene->unit = BENCH_TRIANGLES;
    scene->work = 2.0 * PARTICLES;
    // Blending rounds to 8 bits after each of some tens of layers, and the peer weighs in 8 bits too.
    scene->tolerance = (struct bench_tolerance){.color = 8, .outliers = 5e-5};
    if (!bench_scene_allocate(scene) || !make_mesh(&scene->meshes[0])) {
        return false;
    }
    memcpy(scene->passes[0].clear, night, sizeof night);
    struct bench_draw *const draw = &scene->draws[0];
    *draw = (struct bench_draw){.shader = BENCH_SHADER_PARTICLE,
                                .blend = BENCH_BLEND_OVER,
                                .uniforms = bench_look(&camera, (double)width / (double)height, identity)};
    // The camera's right and up in the world.
    scene_camera_view(&camera, view);
    for (int row = 0; row < 2; row++) {
        for (int column = 0; column < 3; column++) {
            draw->uniforms.world[4 * row + column] = (float)view[4 * column + row];
        }
    }
    return true;
}
