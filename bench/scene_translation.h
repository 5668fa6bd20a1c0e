// SPDX-License-Identifier: MIT
// What a pipeline of translated shaders costs: reading SPIR-V, translating two stages, linking them, and the pipeline.
#ifndef BENCH_SCENE_TRANSLATION_H
#define BENCH_SCENE_TRANSLATION_H

#include "bench_scene.h"
#include "rhw/rhw.h"

bool bench_make_translation(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                            int height, char *why, size_t why_size);

// Make the pipeline, and destroy it.
bool bench_translate(rhw_context *context);

#endif
