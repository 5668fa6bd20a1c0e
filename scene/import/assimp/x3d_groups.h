// SPDX-License-Identifier: MIT
// Groups of an X3D as assimp reads them.
#ifndef SCENE_IMPORT_X3D_GROUPS_H
#define SCENE_IMPORT_X3D_GROUPS_H

#include "edits.h"

/// A text, which assimp passes over where it reads nodes.
#define SCENE_X3D_FILLER "x"

/// Return the text of a document with groups in the places where they are used again, a 0 behind it. `text` is freed
/// where it is another one. Of groups that are used where they are not known yet, or that would make the text much
/// larger, the uses stay. With `has_own_names` sets of faces and lines are written again too, as documents that show it
/// may have sets of their names.
char *scene_assimp_repeat_groups(struct scene_import *import, char *text, size_t *size, bool has_own_names);
/// Write a tag of a group, from `tag` to `close`, as one that assimp reads. `text` is where the document begins. Return
/// false if it is another tag. Tell of groups that are used again.
bool scene_assimp_write_group(struct scene_import *import, struct scene_edits *edits, const char *text,
                              char *tag, char *close);

#endif
