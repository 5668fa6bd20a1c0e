// SPDX-License-Identifier: MIT
// Normals and tangents for meshes that lack them.
#ifndef SCENE_NORMALS_H
#define SCENE_NORMALS_H

#include "import.h"

/// What a file without normals means.
enum scene_import_normals {
    SCENE_IMPORT_FLAT,  ///< one normal for each face (glTF 2.0 §3.7.2.1)
    SCENE_IMPORT_SMOOTH ///< smooth normals, except across creases
};

/// Make normals. `polygons` has the polygon that each triangle was cut from, or is NULL where none was. Triangles of
/// one polygon that are folded along their edge have a crease there. With `are_distinct`, no two positions have the
/// same bytes.
void scene_import_make_normals(struct scene_import *import, struct scene_mesh *mesh,
                               enum scene_import_normals kind, const uint32_t *polygons, bool are_distinct);
/// Turn the normals of a mesh, and tangents with them, of the triangles that have normals on the side from which their
/// corners run clockwise. A surface is shaded by the side that is seen, and the corners say which side that is. A
/// vertex of turned triangles and of others becomes two.
void scene_import_turn_normals(struct scene_import *import, struct scene_mesh *mesh);
/// Move the normal of a surface that a matrix moves, so that it stays upright where the matrix stretches unevenly. Make
/// it unit. A mirror turns it to the other side, as it does the order of the corners.
void scene_import_move_normal(const float matrix[16], float normal[3]);
/// Return true if at least one triangle of a mesh of triangles has an area.
bool scene_import_has_area(const struct scene_mesh *mesh);
void scene_import_make_tangents(struct scene_import *import, struct scene_mesh *mesh,
                                const struct scene_texture_slot *slot);

#endif
