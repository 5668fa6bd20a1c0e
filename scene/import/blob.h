// SPDX-License-Identifier: MIT
// A model as one position-independent run of bytes, for the way from the import process to its parent.
#ifndef SCENE_IMPORT_BLOB_H
#define SCENE_IMPORT_BLOB_H

#include <stdio.h>

#include "model.h"

/// Write the model to the file's current position, which must be 0. Return false if the file refuses.
bool scene_blob_write(const struct scene_model *model, FILE *file);
/// Make a model of the bytes, in place. Return NULL unless they are exactly what scene_blob_write writes and every
/// index, count and enum in them is in range: the process that wrote them read a file that nobody trusts.
struct scene_model *scene_blob_read(void *bytes, size_t size);

#endif
