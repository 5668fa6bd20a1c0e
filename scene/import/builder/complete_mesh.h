// SPDX-License-Identifier: MIT
// The last step of a mesh: arrays of a file become what struct scene_mesh promises.
#ifndef SCENE_COMPLETE_MESH_H
#define SCENE_COMPLETE_MESH_H

#include "normals.h"

/// Complete a mesh whose arrays hold what the file had. Drop numbers that are not finite and vertices that nobody uses.
/// Join equal vertices if `join` is set. Make normals and, where the material's normal map needs them, tangents.
void scene_import_complete_mesh(struct scene_import *import, uint32_t mesh, enum scene_import_normals normals,
                                bool join);
/// Complete a mesh as scene_import_complete_mesh does. `polygons` has the polygon that each triangle was cut from, or
/// is NULL. A polygon that is folded keeps its fold, where normals are made.
void scene_import_complete_polygons(struct scene_import *import, uint32_t mesh,
                                    enum scene_import_normals normals, bool join, uint32_t *polygons);

#endif
