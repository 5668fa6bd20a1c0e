// SPDX-License-Identifier: MIT
// A model as bytes, for another process of the same machine and the same build, as multiprocessing has them.
#ifndef SCENE_MODEL_BYTES_H
#define SCENE_MODEL_BYTES_H

#include "model.h"

/// Copy the model into bytes of malloc, which the caller frees. Return NULL if there is no memory.
void *scene_model_write(const struct scene_model *model, size_t *size);
/// Make a model of bytes that scene_model_write made, and copy them. Return NULL if they are not exactly that, or there
/// is no memory, with one line in `error`. The caller frees the model with scene_model_free.
struct scene_model *scene_model_read(const void *bytes, size_t size, char *error, size_t error_size);

#endif
