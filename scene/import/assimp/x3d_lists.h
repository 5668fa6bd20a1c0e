// SPDX-License-Identifier: MIT
// Lists of numbers in an X3D, and the faces that indices make.
#ifndef SCENE_IMPORT_X3D_LISTS_H
#define SCENE_IMPORT_X3D_LISTS_H

#include "collada_markup.h"
#include "import/builder/import.h"

/// Numbers as they are written.
struct scene_x3d_numbers {
    struct scene_collada_value *list;
    size_t count;
};

struct scene_x3d_indices {
    int64_t *list; ///< below 0 at the end of a face
    size_t count;
};

/// How indices make faces.
enum scene_x3d_order {
    SCENE_X3D_POLYGONS, ///< an index below 0 ends each
    SCENE_X3D_TRIANGLES,
    SCENE_X3D_FANS, ///< an index below 0 ends each
    SCENE_X3D_STRIPS,
    SCENE_X3D_QUADS,
    SCENE_X3D_LINES ///< an index below 0 ends each
};

/// The corners of faces, or the ends of the pieces of lines, SIZE_MAX behind each.
struct scene_x3d_corners {
    size_t *list; ///< where the index of each corner stands among the indices
    size_t count;
    size_t *faces; ///< the number that each face has among all, also those that are left out
    size_t face_count;
    bool has_short; ///< some faces have fewer than three corners, quads than four, or lines one
};

/// What indices make.
enum scene_x3d_found { SCENE_X3D_NOTHING, SCENE_X3D_FACES };

/// Return the numbers of a list, which has none where its text is NULL.
struct scene_x3d_numbers scene_x3d_read_numbers(struct scene_import *import, struct scene_collada_value text);
struct scene_x3d_indices scene_x3d_read_indices(struct scene_import *import, struct scene_collada_value text);
/// Return the indices 0, 1, 2 … of points, a face of as many as each of the `counts` says, all in one where its text is
/// NULL.
struct scene_x3d_indices scene_x3d_count_up(struct scene_import *import, struct scene_collada_value counts,
                                            size_t points);
/// Return an index, or SIZE_MAX where the list has none or it is below 0.
size_t scene_x3d_index_at(const struct scene_x3d_indices *indices, size_t place);
bool scene_x3d_same_indices(const struct scene_x3d_indices *a, const struct scene_x3d_indices *b);
/// Find the corners of all faces, in the order that shows their front if `is_turned` is not set. An index of a point
/// that is not there ends the import.
enum scene_x3d_found scene_x3d_find_corners(struct scene_import *import,
                                            const struct scene_x3d_indices *indices,
                                            enum scene_x3d_order order, bool is_turned, size_t points,
                                            struct scene_x3d_corners *corners);

#endif
