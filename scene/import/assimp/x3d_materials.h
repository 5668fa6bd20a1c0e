// SPDX-License-Identifier: MIT
// Materials of X3D 4 as assimp reads them.
#ifndef SCENE_IMPORT_X3D_MATERIALS_H
#define SCENE_IMPORT_X3D_MATERIALS_H

#include "edits.h"

/// The shininess of a material without light, as it is written for assimp. Files have 0 to 1.
#define SCENE_X3D_UNLIT (-1024.0f)

/// What is kept between the tags of a document. At its beginning all is zero.
struct scene_x3d_materials {
    bool is_open, is_unlit; ///< within a material, and one without light
    const char *left;       ///< the name of the texture that is left out until its end; else NULL
    size_t left_length;
};

/// Write a tag of a material of X3D 4, from `tag` to `close`, or of a texture in one, as those of X3D 3. The document
/// begins at `text`. Return false if it is another tag, or one of a texture that is used. Tell what is lost.
bool scene_assimp_write_material(struct scene_import *import, struct scene_edits *edits,
                                 struct scene_x3d_materials *materials, const char *text, char *tag,
                                 char *close);

#endif
