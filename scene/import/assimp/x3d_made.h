// SPDX-License-Identifier: MIT
// Geometry of an X3D that is described by other numbers than those of its points, as the set that it becomes.
#ifndef SCENE_IMPORT_X3D_MADE_H
#define SCENE_IMPORT_X3D_MADE_H

#include "x3d_lists.h"

/// What a corner may have.
enum scene_x3d_purpose {
    SCENE_X3D_POINTS,
    SCENE_X3D_NORMALS,
    SCENE_X3D_COLORS,
    SCENE_X3D_PLACES, ///< texture coordinates
    SCENE_X3D_PURPOSES
};

struct scene_x3d_made {
    bool is_textured;                ///< set before it is made
    char *lists[SCENE_X3D_PURPOSES]; ///< what its points have; NULL for what the file says, or is made later
    struct scene_x3d_indices index;  ///< the faces
};

/// Make a set of the geometry whose tag ends at `close`. Return false if it has no faces, or numbers that are none.
/// Free what `made` has then too.
typedef bool scene_x3d_make(struct scene_import *import, char *tag, char *close, struct scene_x3d_made *made);

scene_x3d_make scene_x3d_make_grid;
scene_x3d_make scene_x3d_make_extrusion;
scene_x3d_make scene_x3d_make_box;
scene_x3d_make scene_x3d_make_sphere;
scene_x3d_make scene_x3d_make_cone;
scene_x3d_make scene_x3d_make_cylinder;
scene_x3d_make scene_x3d_make_rectangle;
scene_x3d_make scene_x3d_make_disk;

/// Points with what they have.
struct scene_x3d_vertices {
    float (*points)[3], (*normals)[3], (*places)[2];
    size_t count;
};

/// Return room for as many as `most` vertices.
struct scene_x3d_vertices scene_x3d_allocate_vertices(struct scene_import *import, size_t most);
/// Write vertices as the lists of `made`, and free them.
void scene_x3d_write_vertices(struct scene_import *import, const struct scene_x3d_vertices *vertices,
                              bool has_normals, struct scene_x3d_made *made);

/// Return the number of an attribute, or `usual` where it has none.
double scene_x3d_number_of(char *tag, char *close, const char *name, double usual);
/// Return the cosine of a crease angle in radians, −1 from half a turn on, 1 where all is flat.
double scene_x3d_crease_cosine(double angle);
/// Return true for an attribute that is false.
bool scene_x3d_is_false(char *tag, char *close, const char *name);
/// Return the numbers of an attribute, or of `usual` where the tag has none, and how many there are. These are 0 if
/// one of them is no number.
double *scene_x3d_numbers_of(struct scene_import *import, char *tag, char *close, const char *name,
                             const char *usual, size_t *count);
/// Return texture coordinates for points whose file gives none, as the standard makes them of their bounds (ISO/IEC
/// 19775-1 13.3.6). Return NULL if the points have no size, or are no numbers.
char *scene_x3d_make_places(struct scene_import *import, const struct scene_x3d_numbers *points);
/// Add an index to as many as `made` has room for.
void scene_x3d_add_index(struct scene_x3d_made *made, size_t index);
/// End a face.
void scene_x3d_end_face(struct scene_x3d_made *made);

#endif
