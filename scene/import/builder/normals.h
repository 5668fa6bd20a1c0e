// SPDX-License-Identifier: MIT
// Normals and tangents for meshes that lack them.
#ifndef SCENE_NORMALS_H
#define SCENE_NORMALS_H

#include "import.h"

/// What a file without normals means.
enum scene_import_normals {
    SCENE_IMPORT_FLAT,  ///< glTF 2.0 §3.7.2.1: one per face
    SCENE_IMPORT_SMOOTH ///< smooth, except across creases
};

void scene_import_make_normals(struct scene_import *import, struct scene_mesh *mesh,
                               enum scene_import_normals kind);
/// Turns normals, and tangents with them, of the triangles that have normals on the side from which their corners run
/// clockwise: a surface is shaded by the side that is seen, and which that is the corners say. A vertex of such triangles
/// and of others becomes two.
void scene_import_turn_normals(struct scene_import *import, struct scene_mesh *mesh);
/// Whether some triangle of a mesh of triangles has an area.
bool scene_import_has_area(const struct scene_mesh *mesh);
void scene_import_make_tangents(struct scene_import *import, struct scene_mesh *mesh,
                                const struct scene_texture_slot *slot);

#endif
