// SPDX-License-Identifier: MIT
// Polygons of thousands of corners become triangles.
#ifndef SCENE_LARGE_POLYGON_H
#define SCENE_LARGE_POLYGON_H

#include <stdbool.h>
#include <stdint.h>

/// Cut a polygon in a plane, whose corners run counter-clockwise, into count − 2 triangles of places in `points`.
/// Return false if it takes too much time or memory. The triangles are a fan from there on.
bool scene_import_cut_large(const double (*points)[2], uint32_t count, uint32_t *triangles);

#endif
