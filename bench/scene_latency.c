// SPDX-License-Identifier: MIT
// See scene_latency.h. The 10,000 draws are cubes in a field of 100 × 100, each with a matrix and a colour of
// its own; they are small, so that pixels do not count.
#include "scene_latency.h"

#include "elementary.h"

#include <string.h>

enum {
    SIDE = 100,
    FACES = 6,
    TEXTURES = 64,
    LARGE_MESH = (1 << 20) / 24, // vertices of a mebibyte
    LARGE_DRAWS = 1000
};

static const double size = 0.1; // half an edge; cubes stand 1.6 apart

static const struct scene_camera camera = {
    .eye = {0.0, 60.0, 110.0},
    .up = {0.0, 1.0, 0.0},
    .yfov = 0.8,
    .znear = 1.0,
    .zfar = 300.0,
};

// Four vertices per face; `axis` is the one that the face looks along. `room` vertices or more are made, of which the
// others are in no face.
static bool make_cube(struct bench_mesh *mesh, uint32_t room, bool is_textured)
{
    const int stride = is_textured ? 8 : 6;
    mesh->has[BENCH_POSITION] = mesh->has[BENCH_NORMAL] = true;
    mesh->has[BENCH_UV] = is_textured;
    if (!bench_mesh_allocate(mesh, room > 4 * FACES ? room : 4 * FACES, 6 * FACES)) {
        return false;
    }
    float *to = mesh->vertices;
    for (int face = 0; face < FACES; face++) {
        const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        const float sign = face & 1 ? 1.0f : -1.0f;
        for (int i = 0; i < 4; i++, to += stride) {
            to[axis] = sign;
            to[u] = (i & 1 ? 1.0f : -1.0f) * sign; // keeps the winding of the opposite face
            to[v] = i & 2 ? 1.0f : -1.0f;
            to[3 + axis] = sign;
            if (is_textured) {
                to[6] = i & 1 ? 1.0f : 0.0f;
                to[7] = i & 2 ? 1.0f : 0.0f;
            }
        }
        const uint32_t first = (uint32_t)(4 * face);
        const uint32_t quad[6] = {first, first + 1, first + 3, first, first + 3, first + 2};
        memcpy(mesh->indices + 6 * face, quad, sizeof quad);
    }
    return true;
}

static void place_cube(struct bench_draw *draw, int number, double aspect, bool is_textured)
{
    const int column = number % SIDE, row = number / SIDE;
    const double turn = 0.37 * number, c = size * scene_cos(turn), s = size * scene_sin(turn);
    const double x = 1.6 * (column - 0.5 * (SIDE - 1)), z = 1.6 * (row - 0.5 * (SIDE - 1));
    const double world[16] = {c, 0, -s, 0, 0, size, 0, 0, s, 0, c, 0, x, 0, z, 1};
    *draw = (struct bench_draw){.shader = is_textured ? BENCH_SHADER_LIT_TEXTURE : BENCH_SHADER_LIT,
                                .texture_count = is_textured,
                                .textures = {(uint32_t)number % TEXTURES},
                                .depth = BENCH_DEPTH_LESS,
                                .cull_back = true,
                                .uniforms = bench_look(&camera, aspect, world)};
    const float color[4] = {0.2f + 0.006f * (float)column, 0.5f, 0.8f - 0.006f * (float)row, 1.0f};
    memcpy(draw->uniforms.color, color, sizeof color);
}

// Give a draw another pipeline and another scissor than its neighbours have. Scissors cut cubes off at the edges of the
// picture, so that one which is not set shows. They leave out as many rows above as below, as renderers count them from
// either.
static void change_state(struct bench_draw *draw, int number, int width, int height)
{
    const int margin_x = number % 3 * width / 16, margin_y = number % 5 * height / 32;
    const int scissor[4] = {margin_x, margin_y, width - 2 * margin_x, height - 2 * margin_y};
    draw->cull_back = number % 2 == 0;
    draw->blend = number / 2 % 2 == 0 ? BENCH_BLEND_OFF : BENCH_BLEND_OVER;
    draw->has_scissor = true;
    memcpy(draw->scissor, scissor, sizeof scissor);
}

// Texels without a pattern: what decoding one costs may depend on the one before it.
static bool make_noise(struct bench_texture *texture, int size_in_texels, uint32_t state)
{
    texture->format = BENCH_SRGB8_ALPHA8;
    if (!bench_texture_allocate(texture, size_in_texels, size_in_texels)) {
        return false;
    }
    for (size_t i = 0; i < (size_t)size_in_texels * (size_t)size_in_texels * 4; i++) {
        state = state * 1664525 + 1013904223;
        texture->texels[0][i] = (uint8_t)(state >> 24);
    }
    bench_texture_fill_mips(texture);
    return true;
}

bool bench_make_latency(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                        int height, char *why, size_t why_size)
{
    const bool changes_state = entry->variant == BENCH_LATENCY_DRAWS_STATE;
    const bool is_textured = changes_state || entry->variant == BENCH_LATENCY_DRAWS_TEXTURES;
    (void)why, (void)why_size; // nothing is missing
    scene->keeps_triangles = entry->variant == BENCH_LATENCY_DRAWS_REPLAYED;
    scene->replays = scene->keeps_triangles || entry->variant == BENCH_LATENCY_DRAWS_RECORDED;
    scene->writes_between = entry->variant == BENCH_LATENCY_WRITES_BETWEEN;
    const bool is_large = scene->writes_between || entry->variant == BENCH_LATENCY_WRITES_NONE;
    const bool draws = is_textured || scene->replays || is_large || entry->variant == BENCH_LATENCY_DRAWS;
    scene->opens_context = entry->variant == BENCH_LATENCY_CONTEXT;
    scene->opens_texture = entry->variant == BENCH_LATENCY_TEXTURE;
    scene->makes_mips = entry->variant == BENCH_LATENCY_MIPS;
    scene->mesh_count = draws;
    scene->texture_count = is_textured ? TEXTURES : scene->makes_mips;
    scene->draw_count = is_large ? LARGE_DRAWS : draws ? SIDE * SIDE : 0;
    scene->unit = BENCH_DRAWS;
    scene->work = scene->draw_count;
    scene->tolerance.outliers = draws ? 5e-5 : 0.0;
    if (!bench_scene_allocate(scene) ||
        (draws && !make_cube(&scene->meshes[0], is_large ? LARGE_MESH : 0, is_textured))) {
        return false;
    }
    for (uint32_t i = 0; i < scene->texture_count; i++) {
        if (!make_noise(&scene->textures[i], is_textured ? 32 : 2048, i + 1)) {
            return false;
        }
    }
    for (uint32_t i = 0; i < scene->draw_count; i++) {
        place_cube(&scene->draws[i], (int)i, (double)width / (double)height, is_textured);
        if (changes_state) {
            change_state(&scene->draws[i], (int)i, width, height);
        }
    }
    return true;
}
