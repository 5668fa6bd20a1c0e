// SPDX-License-Identifier: MIT
// Scenes of little work, in which what a frame, a draw, a context or a texture costs by itself shows.
#ifndef BENCH_SCENE_LATENCY_H
#define BENCH_SCENE_LATENCY_H

#include "bench_scene.h"

enum bench_latency_variant {
    BENCH_LATENCY_EMPTY,
    BENCH_LATENCY_DRAWS,
    BENCH_LATENCY_DRAWS_TEXTURES,
    BENCH_LATENCY_DRAWS_STATE,
    BENCH_LATENCY_DRAWS_RECORDED,
    BENCH_LATENCY_DRAWS_REPLAYED,
    BENCH_LATENCY_WRITES_NONE,
    BENCH_LATENCY_WRITES_BETWEEN,
    BENCH_LATENCY_CONTEXT,
    BENCH_LATENCY_TEXTURE,
    BENCH_LATENCY_MIPS
};

bool bench_make_latency(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                        int height, char *why, size_t why_size);

#endif
