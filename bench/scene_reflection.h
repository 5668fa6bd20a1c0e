// SPDX-License-Identifier: MIT
// The scene of cube reflections: a ball that shows its surroundings, which are drawn into the faces of a cube first.
#ifndef BENCH_SCENE_REFLECTION_H
#define BENCH_SCENE_REFLECTION_H

#include "bench_scene.h"

bool bench_make_reflection(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                           int height, char *why, size_t why_size);

#endif
