// SPDX-License-Identifier: MIT
// The scenes that are model files of others: the Stanford bunny and Sponza.
#ifndef BENCH_SCENE_MODEL_H
#define BENCH_SCENE_MODEL_H

#include "bench_scene.h"

enum bench_model_variant { BENCH_MODEL_BUNNY, BENCH_MODEL_BUNNY_DEPTH, BENCH_MODEL_SPONZA };

bool bench_make_model(const struct bench_scene_entry *entry, struct bench_scene *scene, int width, int height,
                      char *why, size_t why_size);

#endif
