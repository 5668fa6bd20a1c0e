// SPDX-License-Identifier: MIT
// See scene_sphere.h. The radius is 1 + 0.05 sin 20θ sin 20φ (θ from the pole, φ around it), so that a third
// of the triangles faces the camera and neighbours differ in size and facing.
#include "scene_sphere.h"

#include <math.h>
#include <string.h>

#include "elementary.h"

static const double pi = 3.14159265358979323846;
static const double turn = 0.6; // radians, about y

static const struct scene_camera camera = {
    .eye = {0.0, 0.0, 2.6},
    .up = {0.0, 1.0, 0.0},
    .yfov = 0.8,
    .znear = 0.1,
    .zfar = 10.0,
};

static void place_vertex(const struct bench_mesh *mesh, double theta, double phi, float *to)
{
    const double st = scene_sin(theta), ct = scene_cos(theta), sp = scene_sin(phi), cp = scene_cos(phi);
    const double r = 1.0 + 0.05 * scene_sin(20.0 * theta) * scene_sin(20.0 * phi);
    const double r_theta = scene_cos(20.0 * theta) * scene_sin(20.0 * phi); // 0.05 · 20 = 1
    const double r_phi = scene_sin(20.0 * theta) * scene_cos(20.0 * phi);
    const double out[3] = {st * cp, ct, st * sp};
    const double south[3] = {ct * cp, -st, ct * sp}, east[3] = {-sp, 0.0, cp};
    // At the poles the bumps vanish and so does the slope along φ.
    const double slope = st > 1e-9 ? r_phi / st : 0.0;
    double normal[3], length = 0.0;
    for (int c = 0; c < 3; c++) {
        normal[c] = r * out[c] - r_theta * south[c] - slope * east[c];
        length += normal[c] * normal[c];
    }
    for (int c = 0; c < 3; c++) {
        *to++ = (float)(r * out[c]);
    }
    if (mesh->has[BENCH_NORMAL]) {
        for (int c = 0; c < 3; c++) {
            *to++ = (float)(normal[c] / sqrt(length));
        }
    }
    if (mesh->has[BENCH_UV]) {
        *to++ = (float)(phi / pi * 2.0);
        *to++ = (float)(theta / pi * 2.0);
    }
    for (int c = 0; c < 4 && mesh->has[BENCH_COLOR]; c++) {
        *to++ = (float)(0.5 + 0.4 * (c < 3 ? normal[c] / sqrt(length) : sp));
    }
}

// Two triangles for each quad of the grid.
static void index_triangles(uint32_t *index, uint32_t stacks, uint32_t slices)
{
    for (uint32_t i = 0; i < stacks; i++) {
        for (uint32_t k = 0; k < slices; k++) {
            const uint32_t a = i * (slices + 1) + k, b = a + slices + 1;
            const uint32_t quad[6] = {a, a + 1, b, a + 1, b + 1, b};
            memcpy(index, quad, sizeof quad);
            index += 6;
        }
    }
}

// Two sides of each quad: one along its row, one down its column.
static void index_lines(uint32_t *index, uint32_t stacks, uint32_t slices)
{
    for (uint32_t i = 0; i < stacks; i++) {
        for (uint32_t k = 0; k < slices; k++) {
            const uint32_t a = i * (slices + 1) + k;
            const uint32_t sides[4] = {a, a + 1, a, a + slices + 1};
            memcpy(index, sides, sizeof sides);
            index += 4;
        }
    }
}

static void index_points(uint32_t *index, uint32_t vertices)
{
    for (uint32_t i = 0; i < vertices; i++) {
        index[i] = i;
    }
}

static bool make_mesh(struct bench_mesh *mesh, uint32_t stacks, uint32_t slices)
{
    const uint32_t vertices = (stacks + 1) * (slices + 1), quads = stacks * slices;
    const bool lines = mesh->topology == BENCH_LINE_LIST, points = mesh->topology == BENCH_POINT_LIST;
    if (!bench_mesh_allocate(mesh, vertices, points ? vertices : lines ? 4 * quads : 6 * quads)) {
        return false;
    }
    const uint32_t stride = bench_mesh_stride(mesh);
    float *to = mesh->vertices;
    for (uint32_t i = 0; i <= stacks; i++) {
        for (uint32_t k = 0; k <= slices; k++, to += stride) {
            place_vertex(mesh, pi * i / stacks, 2.0 * pi * k / slices, to);
        }
    }
    if (points) {
        index_points(mesh->indices, vertices);
    } else {
        (lines ? index_lines : index_triangles)(mesh->indices, stacks, slices);
    }
    return true;
}

// A vertex that falls between two subpixel positions may be snapped to either: a few pixels of edges differ,
// and depths where a surface is seen edge on.
static void set_tolerance(struct bench_tolerance *tolerance, enum bench_sphere_variant variant)
{
    tolerance->outliers = 5e-5;
    tolerance->depth = 1e-4;
    tolerance->color = variant == BENCH_SPHERE_1M_TEXTURE ? 6 : 1;
    if (variant == BENCH_SPHERE_1M_SAMPLES) { // a sample of an edge may be in one image alone
        tolerance->color = 64;
    }
    // Lines are rectangles here, a pixel wide, and to the peer the pixels whose diamonds they leave (Vulkan 1.3 §28.8.1):
    // as many, but on a steep piece of the grid not all the same ones.
    if (variant == BENCH_SPHERE_1M_LINES) {
        tolerance->outliers = 5e-2;
    }
    // A point is one pixel whole: the one that its position is in, rounded to 1/256. Half of that is rounded to even here and
    // up in the peer; so single points move to the next pixel, and what was behind them shows.
    if (variant == BENCH_SPHERE_1M_POINTS) {
        tolerance->outliers = 1e-4;
    }
}

// The sphere has twice as many slices, and two triangles for each quad: 4·stacks².
static uint32_t stacks_of(enum bench_sphere_variant variant)
{
    switch (variant) {
    case BENCH_SPHERE_10K: return 50;
    case BENCH_SPHERE_82K:
    case BENCH_SPHERE_82K_FLAT:
    case BENCH_SPHERE_82K_COLOR: return 143;
    case BENCH_SPHERE_1M_POINTS: return 706;
    default: return 500;
    }
}

static const struct {
    uint32_t vertices;
    enum bench_unit unit;
} forms[] = {[BENCH_TRIANGLE_LIST] = {3, BENCH_TRIANGLES},
             [BENCH_LINE_LIST] = {2, BENCH_LINES},
             [BENCH_POINT_LIST] = {1, BENCH_POINTS}};

bool bench_make_sphere(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                       int height, char *why, size_t why_size)
{
    (void)why, (void)why_size; // nothing but memory can fail
    const enum bench_sphere_variant variant = (enum bench_sphere_variant)entry->variant;
    const bool depth_only = variant == BENCH_SPHERE_1M_DEPTH, textured = variant == BENCH_SPHERE_1M_TEXTURE,
               colored = variant == BENCH_SPHERE_82K_COLOR;
    const enum bench_topology topology = variant == BENCH_SPHERE_1M_LINES    ? BENCH_LINE_LIST
                                         : variant == BENCH_SPHERE_1M_POINTS ? BENCH_POINT_LIST
                                                                             : BENCH_TRIANGLE_LIST;
    const uint32_t stacks = stacks_of(variant);
    scene->mesh_count = scene->draw_count = 1;
    scene->texture_count = textured;
    scene->has_color = !depth_only;
    scene->samples = variant == BENCH_SPHERE_1M_SAMPLES ? 4 : 0;
    scene->unit = forms[topology].unit;
    set_tolerance(&scene->tolerance, variant);
    if (!bench_scene_allocate(scene) || (textured && !bench_texture_checker(&scene->textures[0]))) {
        return false;
    }
    struct bench_mesh *const mesh = &scene->meshes[0];
    mesh->topology = topology;
    mesh->has[BENCH_POSITION] = true;
    mesh->has[BENCH_NORMAL] = !depth_only && !colored;
    mesh->has[BENCH_COLOR] = colored;
    mesh->has[BENCH_UV] = textured;
    if (!make_mesh(mesh, stacks, 2 * stacks)) {
        return false;
    }
    scene->work = mesh->index_count / forms[topology].vertices;
    const double world[16] = {scene_cos(turn), 0, -scene_sin(turn), 0, 0, 1, 0, 0,
                              scene_sin(turn), 0, scene_cos(turn),  0, 0, 0, 0, 1};
    struct bench_draw *const draw = &scene->draws[0];
    *draw = (struct bench_draw){.shader = depth_only                         ? BENCH_SHADER_DEPTH
                                          : textured                         ? BENCH_SHADER_LIT_TEXTURE
                                          : colored                          ? BENCH_SHADER_COLOR
                                          : variant == BENCH_SPHERE_82K_FLAT ? BENCH_SHADER_LIT_FLAT
                                          : topology == BENCH_POINT_LIST     ? BENCH_SHADER_LIT_POINT
                                                                             : BENCH_SHADER_LIT,
                                .texture_count = textured ? 1 : 0,
                                .depth = BENCH_DEPTH_LESS,
                                .cull_back = true,
                                .uniforms = bench_look(&camera, (double)width / (double)height, world)};
    const float color[4] = {0.85f, 0.55f, 0.3f, 1.0f};
    memcpy(draw->uniforms.color, color, sizeof color);
    return true;
}
