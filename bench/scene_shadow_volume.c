// SPDX-License-Identifier: MIT
// See scene_shadow_volume.h. One pass: everything in the ambient light, which leaves depth; the volumes, which count in
// stencil where they lie behind it (W. Bilodeau, M. Songy and J. Carmack's "z-fail"); and everything again in the light
// itself, where the count is 0.
#include "scene_shadow_volume.h"

#include "scene_stage.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STACKS = 10, BODIES = 2 * BENCH_STAGE_BODIES, ITEMS = BODIES + 1 };

static const double reach = 14.0; // of a shadow: below the floor
static const float ambient = 0.3f;

// A closed body as triangles of numbered corners.
struct solid {
    float (*corners)[3];
    uint32_t (*triangles)[3];
    uint32_t triangle_count;
};

static void face_normal(const struct solid *solid, uint32_t triangle, float normal[3])
{
    const float *const a = solid->corners[solid->triangles[triangle][0]],
                       *const b = solid->corners[solid->triangles[triangle][1]],
                       *const c = solid->corners[solid->triangles[triangle][2]];
    const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]},
                 v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int i = 0; i < 3; i++) {
        normal[i] = (float)(n[i] / length);
    }
}

// Adds the two triangles that open where the faces on both sides of an edge part, for every edge; each stands in two
// triangles, in opposite directions. Corner k of triangle t is vertex 3 t + k.
static void index_edges(const struct solid *solid, uint32_t *index)
{
    const uint32_t corners = 3 * solid->triangle_count;
    const uint32_t *const at = solid->triangles[0];
    for (uint32_t i = 0; i < corners; i++) {
        const uint32_t next = i % 3 == 2 ? i - 2 : i + 1;
        for (uint32_t j = i + 1; j < corners; j++) {
            const uint32_t after = j % 3 == 2 ? j - 2 : j + 1;
            if (at[i] == at[after] && at[next] == at[j]) {
                const uint32_t quad[6] = {next, i, after, next, after, j};
                memcpy(index, quad, sizeof quad);
                index += 6;
            }
        }
    }
}

// Every triangle with corners of its own, so that they have its normal; a volume has its edges too.
static bool make_mesh(struct bench_mesh *mesh, const struct solid *solid, bool volume)
{
    const uint32_t corners = 3 * solid->triangle_count;
    mesh->has[BENCH_POSITION] = mesh->has[BENCH_NORMAL] = true;
    if (!bench_mesh_allocate(mesh, corners, volume ? corners + 3 * corners : corners)) {
        return false;
    }
    for (uint32_t i = 0; i < corners; i++) {
        float *const to = mesh->vertices + 6 * (size_t)i;
        memcpy(to, solid->corners[solid->triangles[i / 3][i % 3]], sizeof *solid->corners);
        face_normal(solid, i / 3, to + 3);
        mesh->indices[i] = i;
    }
    if (volume) {
        index_edges(solid, mesh->indices + corners);
    }
    return true;
}

// A ball of the stage, whose poles and seam are single corners here.
static bool make_ball(struct solid *solid)
{
    enum { SLICES = 2 * STACKS, CORNERS = (STACKS + 1) * (SLICES + 1) };
    static float corners[CORNERS][3];
    static uint32_t triangles[2 * STACKS * SLICES][3];
    struct bench_mesh ball = {0};
    const bool made = bench_stage_ball(&ball, STACKS);
    *solid = (struct solid){corners, triangles, 0};
    for (uint32_t i = 0; made && i < CORNERS; i++) {
        memcpy(corners[i], ball.vertices + 6 * (size_t)i, sizeof *corners);
    }
    for (uint32_t i = 0; made && i < ball.index_count; i += 3) {
        uint32_t *const to = triangles[solid->triangle_count];
        for (int k = 0; k < 3; k++) {
            const uint32_t row = ball.indices[i + (uint32_t)k] / (SLICES + 1),
                           column = ball.indices[i + (uint32_t)k] % (SLICES + 1);
            to[k] = row * (SLICES + 1) + (row % STACKS == 0 ? 0 : column % SLICES);
        }
        solid->triangle_count += to[0] != to[1] && to[1] != to[2] && to[2] != to[0]; // at a pole two are one
    }
    free(ball.vertices);
    free(ball.indices);
    return made;
}

static void make_box(struct solid *solid)
{
    static float corners[8][3];
    static uint32_t triangles[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                        {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    for (int i = 0; i < 8; i++) {
        for (int c = 0; c < 3; c++) {
            corners[i][c] = i >> c & 1 ? 0.7f : -0.7f;
        }
    }
    *solid = (struct solid){corners, triangles, 12};
}

// 0 the floor, 1 and 2 the box and its volume, 3 and 4 those of the ball.
static bool make_meshes(struct bench_mesh *meshes)
{
    struct solid box, ball;
    make_box(&box);
    return make_ball(&ball) && bench_stage_floor(&meshes[0]) && make_mesh(&meshes[1], &box, false) &&
           make_mesh(&meshes[2], &box, true) && make_mesh(&meshes[3], &ball, false) &&
           make_mesh(&meshes[4], &ball, true);
}

// The floor, or a body: each place of the stage has a ball, and a box above it.
static struct bench_draw make_item(int item, double aspect)
{
    if (item == 0) {
        return bench_stage_draw(BENCH_STAGE_FLOOR, 0, &bench_stage_camera, aspect);
    }
    const int place = (item - 1) / 2;
    const bool is_box = item % 2 == 0;
    double world[16];
    float color[4];
    bench_stage_place(place, world, color);
    if (is_box) {
        world[13] += 1.3;
        world[12] += 0.9;
        for (int i = 0; i < 12; i++) {
            world[i] *= 0.6;
        }
    }
    struct bench_draw draw = bench_stage_draw(place, is_box ? 1 : 3, &bench_stage_camera, aspect);
    draw.uniforms = bench_look(&bench_stage_camera, aspect, world);
    memcpy(draw.uniforms.color, color, sizeof color);
    return draw;
}

// The way of the light as the model has it: its rotation undone, and its size.
static void set_volume(struct bench_draw *draw)
{
    struct bench_uniforms *const u = &draw->uniforms;
    double size = 0.0;
    for (int c = 0; c < 3; c++) {
        size += (double)u->world[c] * (double)u->world[c];
    }
    for (int c = 0; c < 3; c++) {
        double sum = 0.0;
        for (int row = 0; row < 3; row++) {
            sum += (double)u->world[4 * row + c] * (double)u->light[row];
        }
        u->color[c] = (float)(-sum / size * reach);
    }
    draw->shader = BENCH_SHADER_VOLUME;
    draw->mesh++;
    draw->cull_back = false;
    draw->depth = BENCH_DEPTH_TEST;
    draw->stencil = BENCH_STENCIL_COUNT;
}

static void make_draws(struct bench_scene *scene, double aspect)
{
    for (int i = 0; i < ITEMS; i++) {
        struct bench_draw *const dark = &scene->draws[i], *const lit = &scene->draws[ITEMS + BODIES + i];
        *dark = *lit = make_item(i, aspect);
        for (int c = 0; c < 3; c++) {
            dark->uniforms.color[c] *= ambient;
            lit->uniforms.color[c] *= 1.0f - ambient;
        }
        dark->shader = BENCH_SHADER_FLAT;
        lit->uniforms.ambient = 0.0f;
        lit->depth = BENCH_DEPTH_EQUAL;
        lit->blend = BENCH_BLEND_ADD;
        lit->stencil = BENCH_STENCIL_ZERO;
    }
    for (int i = 1; i < ITEMS; i++) {
        struct bench_draw *const volume = &scene->draws[ITEMS + i - 1];
        *volume = make_item(i, aspect);
        set_volume(volume);
    }
}

bool bench_make_shadow_volumes(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                               int height, char *why, size_t why_size)
{
    (void)entry, (void)why, (void)why_size; // nothing but memory can fail
    scene->mesh_count = 5;
    scene->draw_count = 2 * ITEMS + BODIES;
    scene->unit = BENCH_TRIANGLES;
    // A pixel of a shadow's edge, or of a body's, may be in one image alone.
    scene->tolerance.outliers = 2e-4;
    if (!bench_scene_allocate(scene) || !make_meshes(scene->meshes)) {
        return false;
    }
    scene->passes[0].depth = BENCH_PASS_DEPTH_STENCIL;
    make_draws(scene, (double)width / (double)height);
    scene->work = bench_stage_triangles(scene);
    return true;
}
