// SPDX-License-Identifier: MIT
// The 8-lane form of the benchmark's shaders; shaders_glsl.h has their twins.
#ifndef BENCH_SHADERS_BENCH_H
#define BENCH_SHADERS_BENCH_H

#include "bench_scene.h"
#include "rhw/isa.h"
#include "rhw/types.h"

// Which vertex attributes a shader reads: bit 1 << enum bench_attribute.
extern const uint32_t bench_shader_attributes[BENCH_SHADERS];

// vec4s that a shader reads of the scene's shared uniforms, behind those of its draw.
extern const uint32_t bench_shader_shared[BENCH_SHADERS];
enum {
    BENCH_MANY = 16, // varyings of BENCH_SHADER_MANY
    BENCH_SHARED_MAX = 2 * BENCH_LIGHTS,
    BENCH_UNIFORMS_MAX = sizeof(struct bench_uniforms) / sizeof(float) + 4 * BENCH_SHARED_MAX
};
// Both one after the other; the number of floats.
size_t bench_uniforms_copy(const struct bench_scene *scene, const struct bench_draw *draw, float *to);

// Functions of every instruction set, varyings and uniform size. Attribute i of the pipeline is the i-th that
// the shader reads.
void bench_program(struct rhw_program *program, enum bench_shader shader);

struct bench_shader_table {
    rhw_vertex_function *vertex[BENCH_SHADERS];
    rhw_fragment_function *fragment[BENCH_SHADERS]; // NULL: depth only
};
RHW_ISA_DECLARE(const struct bench_shader_table, bench_shader_table);
RHW_ISA_DECLARE(const struct bench_shader_table, bench_pass_shader_table); // from BENCH_SHADER_SHADOWED on

#endif
