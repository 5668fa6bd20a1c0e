// SPDX-License-Identifier: MIT
// Polygons become triangles.
#ifndef SCENE_POLYGON_H
#define SCENE_POLYGON_H

#include "import.h"

/// Which polygon each triangle of a mesh was cut from.
struct scene_polygons {
    uint32_t *of_triangle; ///< NULL as long as all polygons are triangles
    size_t capacity;
    uint32_t count; ///< number of polygons
};

/// Add a polygon that was cut into so many triangles, behind the triangles that are there.
void scene_polygons_add(struct scene_import *import, struct scene_polygons *polygons, size_t triangles_before,
                        size_t triangles);

/// Cut a polygon of 3 or more corners (vertices of a mesh that has no more than positions yet) into count − 2
/// triangles. The triangles are places in `corners`. Where the file's polygons have taken too long, a part of a polygon
/// is a fan, and counts as one.
void scene_import_triangulate(struct scene_import *import, const struct scene_mesh *mesh,
                              const uint32_t *corners, uint32_t count, uint32_t *triangles);

#endif
