// SPDX-License-Identifier: MIT
// The points of a grid stand in rows along x, at the heights that are listed. The texture covers the grid once.
#include "x3d_made.h"

#include <stdlib.h>

static size_t size_of(char *tag, char *close, const char *name)
{
    const double most = 1 << 24, number = scene_x3d_number_of(tag, close, name, 0);
    return number >= 2 && number <= most ? (size_t)number : 0;
}

bool scene_x3d_make_grid(struct scene_import *import, char *tag, char *close, struct scene_x3d_made *made)
{
    const size_t columns = size_of(tag, close, "xDimension"), rows = size_of(tag, close, "zDimension");
    const double wide = scene_x3d_number_of(tag, close, "xSpacing", 1),
                 deep = scene_x3d_number_of(tag, close, "zSpacing", 1);
    size_t heights, count = columns * rows;
    double *const height = scene_x3d_numbers_of(import, tag, close, "height", "", &heights);
    const bool is_whole = count > 0 && heights / columns >= rows;
    if (is_whole) {
        struct scene_x3d_vertices vertices = scene_x3d_allocate_vertices(import, count);
        for (size_t i = 0; i < count; i++) {
            const double x = (double)(i % columns), z = (double)(i / columns);
            vertices.points[i][0] = (float)(x * wide);
            vertices.points[i][1] = (float)height[i];
            vertices.points[i][2] = (float)(z * deep);
            vertices.places[i][0] = (float)(x / (double)(columns - 1));
            vertices.places[i][1] = (float)(z / (double)(rows - 1));
        }
        vertices.count = count;
        scene_x3d_write_vertices(import, &vertices, false, made);
        made->index.list =
            scene_import_allocate_any(import, 5 * (columns - 1) * (rows - 1), sizeof *made->index.list);
        for (size_t i = 0; i < columns * (rows - 1); i++) {
            if (i % columns + 1 < columns) {
                scene_x3d_add_index(made, i + columns);
                scene_x3d_add_index(made, i + columns + 1);
                scene_x3d_add_index(made, i + 1);
                scene_x3d_add_index(made, i);
                scene_x3d_end_face(made);
            }
        }
    }
    free(height);
    return is_whole;
}
