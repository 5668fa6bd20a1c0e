// SPDX-License-Identifier: MIT
// Smoothing groups of a 3DS.
#ifndef SCENE_IMPORT_SMOOTHING_GROUPS_H
#define SCENE_IMPORT_SMOOTHING_GROUPS_H

#include "edits.h"

/// Give a group to faces of a 3DS that are in none, as assimp takes none for all. Where a mesh has no groups, its faces
/// are parted at creases.
void scene_assimp_group_faces(struct scene_import *import, struct scene_edits *edits, const void *bytes,
                              size_t size);

#endif
