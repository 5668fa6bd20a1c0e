// SPDX-License-Identifier: MIT
// The benchmark's GLSL shaders as C that rhw-shader wrote, compiled with the program (RHW_BENCH_EMITTED).
#ifndef BENCH_SHADERS_EMITTED_H
#define BENCH_SHADERS_EMITTED_H

#include "bench_scene.h"
#include "rhw/types.h"

// Return the program of a shader, or NULL where the build has none.
const struct rhw_program *bench_emitted_program(enum bench_shader shader);

#endif
