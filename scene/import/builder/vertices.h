// SPDX-License-Identifier: MIT
// The vertices of a mesh: which of them are equal, and the arrays that are made of them.
#ifndef SCENE_VERTICES_H
#define SCENE_VERTICES_H

#include "import.h"

/// Give every corner of the triangles the vertex `source[corner]`, and each of these vertices its own copy.
void scene_import_gather_vertices(struct scene_import *import, struct scene_mesh *mesh,
                                  const uint32_t *source, uint32_t count);
/// Give a mesh copies of its vertices: vertex i is what `source[i]` was. What it had is not freed.
void scene_import_copy_vertices(struct scene_import *import, struct scene_mesh *mesh, const uint32_t *source,
                                uint32_t count);
/// Return an array in which `group[v]` is the lowest vertex whose position equals that of v. With `are_distinct`, no
/// two positions have the same bytes.
uint32_t *scene_import_weld_positions(struct scene_import *import, const struct scene_mesh *mesh,
                                      bool are_distinct);
/// Make one vertex of all vertices that are equal in every attribute. Return true if these are positions alone.
bool scene_import_join_vertices(struct scene_import *import, struct scene_mesh *mesh);
/// Drop the vertices that no index names.
void scene_import_drop_unused_vertices(struct scene_import *import, struct scene_mesh *mesh);

#endif
