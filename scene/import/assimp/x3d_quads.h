// SPDX-License-Identifier: MIT
// Quads of an X3D as faces.
#ifndef SCENE_IMPORT_X3D_QUADS_H
#define SCENE_IMPORT_X3D_QUADS_H

#include "collada_markup.h"
#include "edits.h"
#include "x3d_names.h"

/// What is kept between the tags of a document. At its beginning all but `largest` is zero.
struct scene_x3d_quads {
    size_t written, largest; ///< bytes of all sets that were written, and how many they may be
    bool is_open;            ///< the last set was written, and not its end
    struct scene_x3d_names
        names; ///< size: how many points a list of points has; 0 is that of a set that was written
};

/// Write a tag of a set of quads, from `tag` to `close`, as that of a set of faces. `text` is where the document
/// begins. Return false if it is another tag, of which one of a list of points is kept. Tell of quads that cannot be
/// written so.
bool scene_assimp_write_quads(struct scene_import *import, struct scene_edits *edits,
                              struct scene_x3d_quads *quads, const char *text, char *tag, char *close,
                              const char *end);

#endif
