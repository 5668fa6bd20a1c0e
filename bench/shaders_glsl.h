// SPDX-License-Identifier: MIT
// The GLSL form of the benchmark's shaders: one text for OpenGL ES 3.00, which a peer gets, and for GLSL 4.50 as Vulkan
// has it, which rhw translates. What the two write in other ways are macros.
#ifndef BENCH_SHADERS_GLSL_H
#define BENCH_SHADERS_GLSL_H

#include "bench_scene.h"

enum bench_glsl_language { BENCH_GLSL_ES, BENCH_GLSL_VULKAN };

enum { BENCH_GLSL_PIECES = 7 };

// Source text in pieces. `u` is an array of vec4 that holds a struct bench_uniforms, `base` the texture. For OpenGL ES,
// attributes have the location of their enum bench_attribute. For Vulkan, they are counted among those that the shader
// reads; `u` is binding 0 of set 0, and textures are the bindings of set 1.
void bench_glsl(enum bench_glsl_language language, enum bench_shader shader,
                const char *vertex[BENCH_GLSL_PIECES], const char *fragment[BENCH_GLSL_PIECES]);

// shaders_glsl_passes.c: the pieces of definitions and the last. Textures are `map0` and on.
void bench_glsl_passes(enum bench_shader shader, const char *vertex[BENCH_GLSL_PIECES],
                       const char *fragment[BENCH_GLSL_PIECES]);

// The physically based ones, shaders_glsl_pbr.c: all pieces from the definitions on. `u` holds a struct
// bench_surface_uniforms, `f` (binding 1 of set 0) a struct bench_frame_uniforms, and `map0` to `map5` are the textures
// by their enum scene_slot.
void bench_glsl_pbr(enum bench_shader shader, const char *vertex[BENCH_GLSL_PIECES],
                    const char *fragment[BENCH_GLSL_PIECES]);

#endif
