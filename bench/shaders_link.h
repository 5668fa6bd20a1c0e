// SPDX-License-Identifier: MIT
// The benchmark's GLSL shaders as linked programs.
#ifndef BENCH_SHADERS_LINK_H
#define BENCH_SHADERS_LINK_H

#include "bench_scene.h"
#include "rhw/spirv.h"

// Translate and link a shader. Return NULL, with a message of RHW_SHADER_MESSAGE bytes, where that cannot be done. All
// programs have the same sets, so that draws of any shader fill them alike: two blocks of uniforms, and textures.
rhw_shader_program *bench_link_shader(enum bench_shader shader, bool is_interpreted, char *message);

#endif
