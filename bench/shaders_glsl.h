// SPDX-License-Identifier: MIT
// The GLSL ES 3.00 form of the benchmark's shaders.
#ifndef BENCH_SHADERS_GLSL_H
#define BENCH_SHADERS_GLSL_H

#include "bench_scene.h"

enum { BENCH_GLSL_PIECES = 4 };

// Source text in pieces. Attributes have the location of their enum bench_attribute; `u` is an array of vec4
// that holds a struct bench_uniforms, `base` the texture.
void bench_glsl(enum bench_shader shader, const char *vertex[BENCH_GLSL_PIECES],
                const char *fragment[BENCH_GLSL_PIECES]);

// Those of shaders_glsl_passes.c: the first piece and the last. Textures are `map0` and on.
void bench_glsl_passes(enum bench_shader shader, const char *vertex[BENCH_GLSL_PIECES],
                       const char *fragment[BENCH_GLSL_PIECES]);

// The physically based ones, shaders_glsl_pbr.c: `u` holds a struct bench_surface_uniforms, `f` a struct
// bench_frame_uniforms, and `map0` to `map4` are the textures by their enum scene_slot.
void bench_glsl_pbr(enum bench_shader shader, const char *vertex[BENCH_GLSL_PIECES],
                    const char *fragment[BENCH_GLSL_PIECES]);

#endif
