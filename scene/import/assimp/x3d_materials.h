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
    bool is_cut;            ///< a texture has no end
    bool lacks_appearance;  ///< within a shape that has had none so far
};

/// A tag of a document, which is from `text` to `end`.
struct scene_x3d_tag {
    const char *text, *end;
    char *tag, **close;
};

/// Write an empty appearance in front of the end of a shape that has none: assimp would take the first material of the
/// file, which may be that of any other shape.
void scene_x3d_write_appearance(struct scene_import *import, struct scene_edits *edits,
                                struct scene_x3d_materials *materials, const char *text, char *tag,
                                char *close);
/// Write a tag of a material of X3D 4 as that of X3D 3. Leave out a texture in one that is not that of its colour, and
/// move `close` to before its end tag. Return false if it is another tag, or one of a texture that is used. Tell what
/// is lost.
bool scene_assimp_write_material(struct scene_import *import, struct scene_edits *edits,
                                 struct scene_x3d_materials *materials, const struct scene_x3d_tag *found);
/// Write the tag of a transform of texture coordinates, from `tag` to `close`, without its center, from which assimp
/// would make another one. `text` is where the document begins.
void scene_x3d_write_texture_transform(struct scene_import *import, struct scene_edits *edits,
                                       const char *text, char *tag, char *close);

#endif
