// SPDX-License-Identifier: MIT
// The scene of deferred shading: four targets that say what each pixel shows, and 32 lights that read them.
#ifndef BENCH_SCENE_DEFERRED_H
#define BENCH_SCENE_DEFERRED_H

#include "bench_scene.h"

bool bench_make_deferred(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                         int height, char *why, size_t why_size);

#endif
