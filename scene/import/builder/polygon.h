// SPDX-License-Identifier: MIT
// Polygons become triangles.
#ifndef SCENE_POLYGON_H
#define SCENE_POLYGON_H

#include <stdint.h>

/// Cut a polygon of 3 or more corners (indices of positions) into count − 2 triangles. The triangles are places in
/// `corners`.
void scene_import_triangulate(const float (*positions)[3], const uint32_t *corners, uint32_t count,
                              uint32_t *triangles);

#endif
