// SPDX-License-Identifier: MIT
// The scene of stencil shadow volumes: bodies with flat faces throw shadows on a floor and on each other.
#ifndef BENCH_SCENE_SHADOW_VOLUME_H
#define BENCH_SCENE_SHADOW_VOLUME_H

#include "bench_scene.h"

bool bench_make_shadow_volumes(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                               int height, char *why, size_t why_size);

#endif
