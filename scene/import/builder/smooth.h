// SPDX-License-Identifier: MIT
// Smooth normals.
#ifndef SCENE_SMOOTH_H
#define SCENE_SMOOTH_H

#include "import.h"

/// Give a mesh of triangles normals that are smooth except across creases and folds of `polygons`, which may be NULL.
/// With `are_distinct`, no two positions have the same bytes.
void scene_import_make_smooth(struct scene_import *import, struct scene_mesh *mesh, const uint32_t *polygons,
                              bool are_distinct);

#endif
