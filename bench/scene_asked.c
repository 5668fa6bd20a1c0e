// SPDX-License-Identifier: MIT
// See scene_asked.h.
#include "scene_asked.h"

#include <string.h>

#include "scene_floor.h"
#include "scene_sphere.h"

// Coordinates and derivatives are added in parts that keep the colour between 0 and 1. Derivatives are greater the fewer
// pixels there are.
static void set_uniforms(struct bench_uniforms *uniforms, enum bench_shader shader, int width)
{
    static const float scale[4] = {1.0f / 16384, 1.0f / 16384, 0.05f, 0.01f};
    memcpy(uniforms->color, scale, sizeof scale);
    uniforms->cutoff = shader == BENCH_SHADER_DISCARD ? 0.6f : 0.25f * (float)width / 1920;
}

// The peer takes derivatives as differences of 2×2 pixels. Layers that read what is there are rounded to 8 bits one
// after the other. A sample of an edge may be in one image alone.
static void set_tolerance(struct bench_scene *scene, enum bench_shader shader)
{
    const bool slopes = shader == BENCH_SHADER_SLOPES || shader == BENCH_SHADER_COORD_SLOPES;
    struct bench_tolerance *const tolerance = &scene->tolerance;
    tolerance->color = slopes ? 4 : shader == BENCH_SHADER_INPUT ? 4 : 1;
    tolerance->outliers = 1e-3;
    if (scene->samples > 1) {
        tolerance->color = 64;
    }
}

bool bench_make_asked(const struct bench_scene_entry *entry, struct bench_scene *scene, int width, int height,
                      char *why, size_t why_size)
{
    const enum bench_shader shader = (enum bench_shader)(entry->variant / BENCH_ASKED_STAGES);
    const enum bench_asked_stage asked = (enum bench_asked_stage)(entry->variant % BENCH_ASKED_STAGES);
    const bool is_mesh = asked == BENCH_ASKED_MESH || asked == BENCH_ASKED_MESH_SAMPLES;
    const struct bench_scene_entry stage = {entry->name, entry->what,
                                            is_mesh ? bench_make_sphere : bench_make_floor,
                                            is_mesh ? (int)BENCH_SPHERE_82K_COLOR : (int)BENCH_FLOOR_COLOR};
    if (!stage.make(&stage, scene, width, height, why, why_size)) {
        return false;
    }
    scene->samples = asked >= BENCH_ASKED_FILL_SAMPLES ? 4 : 0;
    set_tolerance(scene, shader);
    for (uint32_t i = 0; i < scene->draw_count; i++) {
        struct bench_draw *const draw = &scene->draws[i];
        draw->shader = shader;
        set_uniforms(&draw->uniforms, shader, width);
        if (shader == BENCH_SHADER_MOVE) {
            draw->depth = BENCH_DEPTH_LESS;
            draw->uniforms.color[3] = 1.0f - 0.05f * (float)i; // later floors are nearer
        }
    }
    return true;
}
