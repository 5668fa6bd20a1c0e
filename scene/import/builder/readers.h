// SPDX-License-Identifier: MIT
// The readers of model files. Each fills the model from import->model.path. kind.c chooses one of them.
#ifndef SCENE_READERS_H
#define SCENE_READERS_H

#include "import.h"

bool scene_import_is_gltf(const char *path, const unsigned char *start, size_t size);
void scene_import_gltf(struct scene_import *import);
void scene_import_obj(struct scene_import *import);
bool scene_import_is_ply(const char *path, const unsigned char *start, size_t size);
void scene_import_ply(struct scene_import *import);
bool scene_import_is_off(const unsigned char *start, size_t size);
void scene_import_off(struct scene_import *import);
void scene_import_3mf(struct scene_import *import);
void scene_import_stl(struct scene_import *import);
void scene_import_xyz(struct scene_import *import);
/// Fail the import if an FBX is cut. assimp reads it.
void scene_import_check_fbx(struct scene_import *import);
void scene_import_assimp(struct scene_import *import);

#endif
