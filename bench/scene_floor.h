// SPDX-License-Identifier: MIT
// The fill scenes: 8 floors in perspective, each over the whole picture, drawn from far to near.
#ifndef BENCH_SCENE_FLOOR_H
#define BENCH_SCENE_FLOOR_H

#include "bench_scene.h"

enum bench_floor_variant {
    BENCH_FLOOR_FLAT,
    BENCH_FLOOR_LITERAL,
    BENCH_FLOOR_COLOR,
    BENCH_FLOOR_BLEND,
    BENCH_FLOOR_TEXTURE,
    BENCH_FLOOR_ANISOTROPIC,
    BENCH_FLOOR_OVERDRAW,
    BENCH_FLOOR_PAINTER,
    BENCH_FLOOR_PAINTER_FREE
};

// The variant of `entry` is one of these.
bool bench_make_floor(const struct bench_scene_entry *entry, struct bench_scene *scene, int width, int height,
                      char *why, size_t why_size);

#endif
