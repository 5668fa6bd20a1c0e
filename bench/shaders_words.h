// SPDX-License-Identifier: MIT
// The benchmark's shaders as SPIR-V, compiled from the texts of shaders_glsl.h when this program was built.
#ifndef BENCH_SHADERS_WORDS_H
#define BENCH_SHADERS_WORDS_H

#include "bench_scene.h"

struct bench_words {
    const uint32_t *words;
    size_t size; // bytes; 0: the build had no glslangValidator
};

void bench_shader_words(enum bench_shader shader, struct bench_words *vertex, struct bench_words *fragment);

#endif
