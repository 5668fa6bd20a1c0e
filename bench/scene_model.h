// SPDX-License-Identifier: MIT
// The scenes that are model files of others: the Stanford bunny and Sponza; and reading such files.
#ifndef BENCH_SCENE_MODEL_H
#define BENCH_SCENE_MODEL_H

#include "bench_scene.h"
#include "model.h"

enum bench_model_variant {
    BENCH_MODEL_BUNNY,
    BENCH_MODEL_BUNNY_DEPTH,
    BENCH_MODEL_SPONZA,
    BENCH_MODEL_SPONZA_SAMPLES
};

bool bench_make_model(const struct bench_scene_entry *entry, struct bench_scene *scene, int width, int height,
                      char *why, size_t why_size);

// Finds a model file: an absolute path, or a name in the folder of models. False with a line in `why`.
bool bench_model_find(const char *file, char *path, size_t size, char *why, size_t why_size);
// Reads a model file that has something to draw: an absolute path, or a name in the folder of models, which is
// "../shared/models" of who works on rhw or where RHW_MODELS says. NULL with a line in `why`.
struct scene_model *bench_model_load(const char *file, char *why, size_t why_size);

extern const char bench_sponza_path[];
extern const char bench_bunny_path[];
extern const struct scene_camera bench_sponza_camera; // along the nave from one end

#endif
