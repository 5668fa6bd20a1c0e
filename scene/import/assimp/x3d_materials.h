// SPDX-License-Identifier: MIT
// Materials of X3D 4 as assimp reads them.
#ifndef SCENE_IMPORT_X3D_MATERIALS_H
#define SCENE_IMPORT_X3D_MATERIALS_H

#include "edits.h"

/// The shininess of a material without light, as it is written for assimp. Files have 0 to 1.
#define SCENE_X3D_UNLIT (-1024.0f)

/// Write a tag of a material of X3D 4, from `tag` to `close`, as one of X3D 3. `text` is where the document begins.
/// Return false if it is another tag. Tell what is lost.
bool scene_assimp_write_material(struct scene_import *import, struct scene_edits *edits, const char *text,
                                 char *tag, char *close);

#endif
