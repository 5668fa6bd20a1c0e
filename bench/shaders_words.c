// SPDX-License-Identifier: MIT
// See shaders_words.h.
#include "shaders_words.h"

#include "words.inc"

#define ROW(shader, vertex, fragment) [shader] = {{vertex, sizeof vertex}, {fragment, sizeof fragment}},

static const struct {
    struct bench_words vertex, fragment;
} words[BENCH_SHADERS] = {SHADERS(ROW)};

void bench_shader_words(enum bench_shader shader, struct bench_words *vertex, struct bench_words *fragment)
{
    *vertex = words[shader].vertex;
    *fragment = words[shader].fragment;
}
