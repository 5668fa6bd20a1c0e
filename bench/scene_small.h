// SPDX-License-Identifier: MIT
// Many passes into a small target, in which what a pass costs by itself shows.
#ifndef BENCH_SCENE_SMALL_H
#define BENCH_SCENE_SMALL_H

#include "bench_scene.h"

// Pixels of the target in each direction.
enum bench_small_variant { BENCH_SMALL_16 = 16, BENCH_SMALL_64 = 64, BENCH_SMALL_256 = 256 };

bool bench_make_small(const struct bench_scene_entry *entry, struct bench_scene *scene, int width, int height,
                      char *why, size_t why_size);

#endif
