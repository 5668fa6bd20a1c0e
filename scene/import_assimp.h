// SPDX-License-Identifier: MIT
// The two parts of the assimp reader.
#ifndef RHW_SCENE_IMPORT_ASSIMP_H
#define RHW_SCENE_IMPORT_ASSIMP_H

#include <assimp/scene.h>

#include "import.h"

/// Adds a material of the scene, converted to metallic-roughness. `colored`: its mesh has vertex colours.
uint32_t rhw_assimp_material(struct rhw_import *import, const struct aiScene *scene,
                             const struct aiMaterial *material, bool colored);
/// A name as the model keeps it.
const char *rhw_assimp_string(struct rhw_import *import, const struct aiString *string);

#endif
