// SPDX-License-Identifier: MIT
// Quads of an X3D as faces.
#ifndef SCENE_IMPORT_X3D_QUADS_H
#define SCENE_IMPORT_X3D_QUADS_H

#include "collada_markup.h"
#include "edits.h"

/// Write a tag of a set of quads, from `tag` to `close`, as that of a set of faces. `text` is where the document
/// begins, and `is_open`, false at first, is kept between its tags. Return false if it is another tag. Tell of quads
/// that cannot be written so.
bool scene_assimp_write_quads(struct scene_import *import, struct scene_edits *edits, bool *is_open,
                              const char *text, char *tag, char *close, const char *end);

#endif
