// SPDX-License-Identifier: MIT
// See scene_floor.h. The camera looks down so far that the horizon is above the picture: a floor then covers
// all of it, and W grows almost eightfold from the lower edge to the upper one. Every layer is one quad, a
// little larger than the picture.
#include "scene_floor.h"

#include <string.h>

#include "elementary.h"

enum { LAYERS = 8 };

static const double yfov = 0.8, pitch = 0.5105; // radians
static const double overlap = 1.02;             // of half the picture
static const double texels_per_unit = 2048.0;   // magnified nowhere, far floors down to the fifth level

static const float layer_color[LAYERS][4] = {
    {0.85f, 0.20f, 0.15f, 1.0f}, {0.90f, 0.55f, 0.10f, 1.0f}, {0.80f, 0.80f, 0.20f, 1.0f},
    {0.30f, 0.70f, 0.25f, 1.0f}, {0.15f, 0.65f, 0.70f, 1.0f}, {0.20f, 0.35f, 0.85f, 1.0f},
    {0.55f, 0.25f, 0.75f, 1.0f}, {0.95f, 0.75f, 0.60f, 1.0f},
};

static const struct scene_camera camera = {
    .target = {0.0, -0.48861, -0.87250}, // sine and cosine of the pitch
    .up = {0.0, 1.0, 0.0},
    .yfov = 0.8,
    .znear = 0.1,
    .zfar = 100.0,
};

// Floors at distances 2.0 to 0.6 below the eye; a vertex is where the ray of a corner of the picture meets the floor.
static void place_vertices(struct bench_mesh *mesh, int layer, double aspect)
{
    const double depth = 2.0 - 0.2 * layer, t = scene_tan(0.5 * yfov) * overlap;
    const uint32_t stride = bench_mesh_stride(mesh);
    for (int i = 0; i < 4; i++) {
        const double x = i & 1 ? t * aspect : -t * aspect, y = i & 2 ? t : -t;
        const double down = scene_sin(pitch) - y * scene_cos(pitch),
                     ahead = scene_cos(pitch) + y * scene_sin(pitch);
        const double position[3] = {x * depth / down, -depth, -ahead * depth / down};
        float *to = mesh->vertices + (size_t)i * stride;
        for (int c = 0; c < 3; c++) {
            *to++ = (float)position[c];
        }
        if (mesh->has[BENCH_UV]) {
            *to++ = (float)(position[0] * texels_per_unit / 1024.0);
            *to++ = (float)(position[2] * texels_per_unit / 1024.0);
        }
        if (mesh->has[BENCH_COLOR]) {
            const float *const a = layer_color[layer], *const b = layer_color[(layer + 1 + i) % LAYERS];
            for (int c = 0; c < 3; c++) {
                *to++ = 0.5f * (a[c] + b[c]);
            }
            *to++ = 0.25f + 0.15f * (float)i; // opacity, where it is blended
        }
    }
    static const uint32_t indices[6] = {0, 1, 3, 0, 3, 2};
    memcpy(mesh->indices, indices, sizeof indices);
}

// Blending rounds to 8 bits after each of 8 layers, and the peer weighs in 8 bits too; it takes one level of
// detail for 2×2 pixels and filters texels in 8 bits. With anisotropy it weighs the texels of an ellipse, not samples along
// an axis as Vulkan has it; test_anisotropy.c holds those against the formula.
static void set_tolerance(struct bench_tolerance *tolerance, enum bench_floor_variant variant)
{
    if (variant == BENCH_FLOOR_BLEND) {
        tolerance->color = 4;
    } else if (variant == BENCH_FLOOR_ANISOTROPIC) {
        tolerance->color = 64;
        tolerance->outliers = 5e-5;
    } else if (variant >= BENCH_FLOOR_TEXTURE) {
        tolerance->color = 6;
        tolerance->outliers = 5e-5;
    }
}

bool bench_make_floor(const struct bench_scene_entry *entry, struct bench_scene *scene, int width, int height,
                      char *why, size_t why_size)
{
    (void)why, (void)why_size; // nothing but memory can fail
    static const enum bench_shader shaders[] = {[BENCH_FLOOR_FLAT] = BENCH_SHADER_FLAT,
                                                [BENCH_FLOOR_LITERAL] = BENCH_SHADER_LITERAL,
                                                [BENCH_FLOOR_PAINTER_FREE] = BENCH_SHADER_TEXTURE,
                                                [BENCH_FLOOR_COLOR] = BENCH_SHADER_COLOR,
                                                [BENCH_FLOOR_BLEND] = BENCH_SHADER_COLOR,
                                                [BENCH_FLOOR_TEXTURE] = BENCH_SHADER_TEXTURE,
                                                [BENCH_FLOOR_ANISOTROPIC] = BENCH_SHADER_TEXTURE,
                                                [BENCH_FLOOR_OVERDRAW] = BENCH_SHADER_TEXTURE,
                                                [BENCH_FLOOR_PAINTER] = BENCH_SHADER_TEXTURE};
    static const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const enum bench_floor_variant variant = (enum bench_floor_variant)entry->variant;
    const enum bench_shader shader = shaders[variant];
    const double aspect = (double)width / (double)height;
    scene->mesh_count = scene->draw_count = LAYERS;
    scene->texture_count = shader == BENCH_SHADER_TEXTURE;
    scene->shades_all = variant < BENCH_FLOOR_OVERDRAW;
    scene->max_anisotropy = variant == BENCH_FLOOR_ANISOTROPIC ? 16 : 0;
    scene->unit = BENCH_FRAGMENTS;
    scene->work = (double)LAYERS * width * height;
    set_tolerance(&scene->tolerance, variant);
    if (!bench_scene_allocate(scene) ||
        (scene->texture_count && !bench_texture_checker(&scene->textures[0]))) {
        return false;
    }
    if (variant == BENCH_FLOOR_PAINTER_FREE) {
        scene->passes[0].depth = BENCH_PASS_NO_DEPTH;
    }
    for (int i = 0; i < LAYERS; i++) {
        struct bench_mesh *const mesh = &scene->meshes[i];
        mesh->has[BENCH_POSITION] = true;
        mesh->has[BENCH_UV] = shader == BENCH_SHADER_TEXTURE;
        mesh->has[BENCH_COLOR] = shader == BENCH_SHADER_COLOR;
        if (!bench_mesh_allocate(mesh, 4, 6)) {
            return false;
        }
        place_vertices(mesh, i, aspect);
        struct bench_draw *const draw = &scene->draws[i];
        *draw =
            (struct bench_draw){.shader = shader,
                                .depth = variant == BENCH_FLOOR_OVERDRAW ? BENCH_DEPTH_LESS : BENCH_DEPTH_OFF,
                                .blend = variant == BENCH_FLOOR_BLEND ? BENCH_BLEND_OVER : BENCH_BLEND_OFF,
                                .mesh = (uint32_t)i,
                                .texture_count = (int)scene->texture_count,
                                .uniforms = bench_look(&camera, aspect, identity)};
        memcpy(draw->uniforms.color, layer_color[i], sizeof draw->uniforms.color);
    }
    return true;
}
