// SPDX-License-Identifier: MIT
// The sphere scenes: a UV sphere with bumps, from many pixels per triangle to few.
#ifndef BENCH_SCENE_SPHERE_H
#define BENCH_SCENE_SPHERE_H

#include "bench_scene.h"

enum bench_sphere_variant {
    BENCH_SPHERE_10K,
    BENCH_SPHERE_82K,
    BENCH_SPHERE_82K_FLAT,
    BENCH_SPHERE_82K_COLOR, // the colour of a vertex is its normal, without light
    BENCH_SPHERE_1M,
    BENCH_SPHERE_1M_TEXTURE,
    BENCH_SPHERE_1M_DEPTH,
    BENCH_SPHERE_1M_SAMPLES, // 4 a pixel
    BENCH_SPHERE_1M_LINES,
    BENCH_SPHERE_1M_POINTS
};

bool bench_make_sphere(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                       int height, char *why, size_t why_size);

#endif
