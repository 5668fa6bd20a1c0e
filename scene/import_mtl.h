// SPDX-License-Identifier: MIT
// Wavefront material libraries.
#ifndef RHW_SCENE_IMPORT_MTL_H
#define RHW_SCENE_IMPORT_MTL_H

#include "import_phong.h"

struct rhw_mtl_material {
    struct rhw_phong phong;
    int32_t made[2]; ///< index in the model, without and with vertex colours; −1: not used yet
};

struct rhw_mtl {
    struct rhw_mtl_material *materials;
    size_t count, capacity;
};

/// Adds the materials of a library. False, with a warning, when it cannot be read.
bool rhw_mtl_read(struct rhw_import *import, struct rhw_mtl *mtl, const char *name);
/// The material with this name; a plain one is added if there is none. Returns its place.
size_t rhw_mtl_find(struct rhw_import *import, struct rhw_mtl *mtl, const char *name);
/// Its index in the model.
uint32_t rhw_mtl_use(struct rhw_import *import, struct rhw_mtl *mtl, size_t material, bool colored);

#endif
