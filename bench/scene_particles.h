// SPDX-License-Identifier: MIT
// The particle scene: 100,000 instances of a quad that faces the camera, blended one over the other.
#ifndef BENCH_SCENE_PARTICLES_H
#define BENCH_SCENE_PARTICLES_H

#include "bench_scene.h"

bool bench_make_particles(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                          int height, char *why, size_t why_size);

#endif
