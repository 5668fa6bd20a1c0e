// SPDX-License-Identifier: MIT
// Polygons of many corners become triangles.
#ifndef SCENE_LARGE_POLYGON_H
#define SCENE_LARGE_POLYGON_H

#include <stdbool.h>
#include <stdint.h>

/// Return twice the signed area of a triangle.
static inline double scene_import_area(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Write the corners of a triangle.
static inline void scene_import_emit(uint32_t *out, uint32_t a, uint32_t b, uint32_t c)
{
    out[0] = a;
    out[1] = b;
    out[2] = c;
}

/// Cut a polygon in a plane, whose corners run counter-clockwise, into count − 2 triangles of places in `points`.
/// Return false if that takes more than `most_looks` looks at corners, or too much memory. The triangles are a fan from
/// there on. Add the looks that it took to `looks`.
bool scene_import_cut_large(const double (*points)[2], uint32_t count, uint64_t most_looks, uint64_t *looks,
                            uint32_t *triangles);

#endif
