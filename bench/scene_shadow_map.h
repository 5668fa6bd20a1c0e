// SPDX-License-Identifier: MIT
// The scene of a shadow map: 100,000 triangles of balls over a floor, drawn as the light sees them and as the eye does.
#ifndef BENCH_SCENE_SHADOW_MAP_H
#define BENCH_SCENE_SHADOW_MAP_H

#include "bench_scene.h"

bool bench_make_shadow_map(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                           int height, char *why, size_t why_size);

#endif
