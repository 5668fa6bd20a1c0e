// SPDX-License-Identifier: MIT
// The vertices of a mesh: which are equal, and arrays of others made of them.
#ifndef SCENE_VERTICES_H
#define SCENE_VERTICES_H

#include "import.h"

/// Gives every corner of the triangles the vertex `source[corner]`, and each such vertex its own copy.
void scene_import_gather_vertices(struct scene_import *import, struct scene_mesh *mesh,
                                  const uint32_t *source, uint32_t count);
/// `group[v]` = the lowest vertex whose position equals that of v.
uint32_t *scene_import_weld_positions(struct scene_import *import, const struct scene_mesh *mesh);
/// Makes one vertex of all that are equal in every attribute.
void scene_import_join_vertices(struct scene_import *import, struct scene_mesh *mesh);
/// Drops the vertices that no index names.
void scene_import_drop_unused_vertices(struct scene_import *import, struct scene_mesh *mesh);

#endif
