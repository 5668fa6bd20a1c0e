// SPDX-License-Identifier: MIT
// Quads of an X3D as faces.
#ifndef SCENE_IMPORT_X3D_QUADS_H
#define SCENE_IMPORT_X3D_QUADS_H

#include "collada_markup.h"
#include "edits.h"
#include "import/builder/hash_table.h"

/// What is kept between the tags of a document. A zeroed struct is that of its beginning.
struct scene_x3d_quads {
    bool is_open;                      ///< the last set was written, and not its end
    struct scene_collada_value *names; ///< sets that were written have them, and are used again by them
    size_t count, capacity;
    struct scene_hash_table places;
};

/// Write a tag of a set of quads, from `tag` to `close`, as that of a set of faces. `text` is where the document
/// begins. Return false if it is another tag. Tell of quads that cannot be written so.
bool scene_assimp_write_quads(struct scene_import *import, struct scene_edits *edits,
                              struct scene_x3d_quads *quads, const char *text, char *tag, char *close,
                              const char *end);
void scene_assimp_free_quads(struct scene_x3d_quads *quads);

#endif
