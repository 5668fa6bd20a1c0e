// SPDX-License-Identifier: MIT
// Wavefront material libraries.
#ifndef SCENE_IMPORT_MTL_H
#define SCENE_IMPORT_MTL_H

#include "import/builder/hash_table.h"
#include "import/builder/import.h"
#include "import/builder/phong.h"

struct scene_mtl_material {
    const char *name; ///< in the bytes of the file, whose encoding nobody knows; phong.name is for people
    struct scene_phong phong;
    const char *ambient; ///< name of the ambient texture; NULL if there is none
    int32_t made[2];     ///< index in the model, without and with vertex colours; −1 if not used yet
};

struct scene_mtl {
    struct scene_mtl_material *materials;
    size_t count, capacity;
    struct scene_hash_table names; ///< places of the materials by their names
};

/// Add the materials of a library, whose name is in the bytes of the file. Return false, with a warning, if it cannot
/// be read.
bool scene_mtl_read(struct scene_import *import, struct scene_mtl *mtl, const char *name);
/// Return the place of the material with this name, in the bytes of the file. If there is none, a plain one is added.
size_t scene_mtl_find(struct scene_import *import, struct scene_mtl *mtl, const char *name);
/// Return the index that the material has in the model.
uint32_t scene_mtl_use(struct scene_import *import, struct scene_mtl *mtl, size_t material, bool colored);

#endif
