// SPDX-License-Identifier: MIT
// The last step of a mesh: what a file gives becomes what struct scene_mesh promises.
#ifndef SCENE_COMPLETE_MESH_H
#define SCENE_COMPLETE_MESH_H

#include "normals.h"

/// Completes a mesh whose arrays hold what the file had: drops what is not finite and vertices nobody uses,
/// joins equal vertices if asked, makes normals and, where the material's normal map needs them, tangents.
void scene_import_complete_mesh(struct scene_import *import, uint32_t mesh, enum scene_import_normals normals,
                                bool join);

#endif
