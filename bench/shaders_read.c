// SPDX-License-Identifier: MIT
// What the benchmark's shaders read of vertices and uniforms, in any of their forms.
#include "shaders_bench.h"

#include <string.h>

enum {
    P = 1 << BENCH_POSITION,
    N = 1 << BENCH_NORMAL,
    T = 1 << BENCH_UV,
    C = 1 << BENCH_COLOR,
    TANGENT = 1 << BENCH_TANGENT,
    PLACE = 1 << BENCH_PLACE,
    TINT = 1 << BENCH_TINT
};

const uint32_t bench_shader_attributes[BENCH_SHADERS] = {
    [BENCH_SHADER_FLAT] = P,
    [BENCH_SHADER_LITERAL] = P,
    [BENCH_SHADER_COLOR] = P | C,
    [BENCH_SHADER_TEXTURE] = P | T,
    [BENCH_SHADER_LIT] = P | N,
    [BENCH_SHADER_LIT_POINT] = P | N,
    [BENCH_SHADER_LIT_FLAT] = P | N,
    [BENCH_SHADER_LIT_TEXTURE] = P | N | T,
    [BENCH_SHADER_LIT_MASKED] = P | N | T,
    [BENCH_SHADER_DEPTH] = P,
    [BENCH_SHADER_PARTICLE] = P | PLACE | TINT,
    [BENCH_SHADER_VOLUME] = P | N,
    [BENCH_SHADER_SCREEN] = P | C,
    [BENCH_SHADER_COORD] = P | C,
    [BENCH_SHADER_SLOPES] = P | C,
    [BENCH_SHADER_COORD_SLOPES] = P | C,
    [BENCH_SHADER_DISCARD] = P | C,
    [BENCH_SHADER_MOVE] = P | C,
    [BENCH_SHADER_MANY] = P | C,
    [BENCH_SHADER_SAMPLE] = P | C,
    [BENCH_SHADER_INPUT] = P | C,
    [BENCH_SHADER_SHADOWED] = P | N,
    [BENCH_SHADER_REFLECT] = P | N,
    [BENCH_SHADER_SURFACE] = P | N,
    [BENCH_SHADER_LIGHTS] = P | N,
    [BENCH_SHADER_PBR_BASE] = P | N | T,
    [BENCH_SHADER_PBR_MAPPED] = P | N | T | TANGENT,
    [BENCH_SHADER_PBR_MASKED] = P | N | T | TANGENT,
    [BENCH_SHADER_PBR_FULL] = P | N | T | TANGENT,
    [BENCH_SHADER_PBR_BASE_SHADOWED] = P | N | T,
    [BENCH_SHADER_PBR_MAPPED_SHADOWED] = P | N | T | TANGENT,
    [BENCH_SHADER_PBR_MASKED_SHADOWED] = P | N | T | TANGENT,
    [BENCH_SHADER_PBR_FULL_SHADOWED] = P | N | T | TANGENT,
    [BENCH_SHADER_PBR_HAIR] = P | N | T,
    [BENCH_SHADER_PBR_GLASS] = P | N | T,
    [BENCH_SHADER_PBR_BASE_LINEAR] = P | N | T,
    [BENCH_SHADER_PBR_CAST] = P | T,
    [BENCH_SHADER_PBR_CAST_MASKED] = P | T,
};

const uint32_t bench_shader_shared[BENCH_SHADERS] = {
    [BENCH_SHADER_SHADOWED] = 4,
    [BENCH_SHADER_LIGHTS] = 2 * BENCH_LIGHTS,
};

size_t bench_uniforms_copy(const struct bench_scene *scene, const struct bench_draw *draw, float *to)
{
    const size_t own = sizeof draw->uniforms / sizeof *to, shared = 4 * bench_shader_shared[draw->shader];
    memcpy(to, &draw->uniforms, own * sizeof *to);
    memcpy(to + own, scene->shared, shared * sizeof *to);
    return own + shared;
}
