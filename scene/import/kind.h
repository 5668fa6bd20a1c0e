// SPDX-License-Identifier: MIT
// The choice of a reader.
#ifndef SCENE_KIND_H
#define SCENE_KIND_H

#include "import/builder/import.h"

/// Read import->model.path by the reader that it is for.
void scene_import_read(struct scene_import *import);

#endif
