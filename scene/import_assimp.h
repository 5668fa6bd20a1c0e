// SPDX-License-Identifier: MIT
// The parts of the assimp reader.
#ifndef SCENE_IMPORT_ASSIMP_H
#define SCENE_IMPORT_ASSIMP_H

#include <assimp/cfileio.h>
#include <assimp/scene.h>

#include "import.h"

/// Adds a material of the scene, converted to metallic-roughness. `colored`: its mesh has vertex colours.
uint32_t scene_assimp_material(struct scene_import *import, const struct aiScene *scene,
                               const struct aiMaterial *material, bool colored);
/// A name as the model keeps it.
const char *scene_assimp_string(struct scene_import *import, const struct aiString *string);
/// What opens files within import->confine and the model itself; it lives as long as `import`.
struct aiFileIO scene_assimp_files(struct scene_import *import);

#endif
