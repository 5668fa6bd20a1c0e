// SPDX-License-Identifier: MIT
// A set of faces or lines in an X3D, with what belongs to its corners.
#ifndef SCENE_IMPORT_X3D_SET_H
#define SCENE_IMPORT_X3D_SET_H

#include "x3d_lists.h"
#include "x3d_made.h"
#include "x3d_names.h"

/// What belongs to corners, and how it is written.
struct scene_x3d_property {
    const char *name, *list, *written;
    enum scene_x3d_purpose purpose;
    size_t width; ///< numbers of each
};

struct scene_x3d_kind {
    const char *name;
    enum scene_x3d_order order;
    const char *index,
        *counts; ///< the attributes that have indices, and numbers of corners; NULL where it has none
    bool has_crease_angle;
    scene_x3d_make *make; ///< NULL where its points are in the file
    const char *told;     ///< what is told where nothing is made
    bool is_for_textures; ///< without a texture assimp makes it right
    bool is_solid;        ///< assimp makes it too, in another way
};

/// What a set has of one property.
struct scene_x3d_part {
    const struct scene_x3d_property *property; ///< NULL where it has none
    char *tag, *close;                         ///< NULL where it is not in the file
    struct scene_collada_value list;
    struct scene_x3d_numbers numbers;
    struct scene_x3d_indices
        index; ///< none where it goes by the indices of the points, or by the order of faces
    bool is_of_faces;
    bool is_lacking; ///< some corners have none of it, so that it is not used
};

struct scene_x3d_set {
    const struct scene_x3d_kind *kind;
    char *tag, *close;
    struct scene_x3d_made made;
    struct scene_x3d_part parts[SCENE_X3D_PURPOSES];
    struct scene_x3d_indices index;
    struct scene_x3d_corners corners;
    bool is_parted; ///< each corner is a point of its own, as it has more than goes by the number of its point, or as
                    ///< there are more points than corners
};

/// Return the property, or the kind of set, that a tag is. Return NULL if it is none.
const struct scene_x3d_property *scene_x3d_find_property(const char *tag);
const struct scene_x3d_kind *scene_x3d_find_kind(const char *tag);
/// Return a bit that no other kind has.
unsigned scene_x3d_kind_bit(const struct scene_x3d_kind *kind);
bool scene_x3d_is_quads(const struct scene_x3d_kind *kind);
bool scene_x3d_is_lines(const struct scene_x3d_kind *kind);
/// Return the list of a property, or of the one of `lists` that it uses again, which count from `text`. Its text is
/// NULL where there is none that can be written between quotation marks.
struct scene_collada_value scene_x3d_list_of(const struct scene_x3d_names *lists, const char *text, char *tag,
                                             char *close, const struct scene_x3d_property *property);
/// Find the parts of a set. Return where it ends, or NULL where that is not known.
const char *scene_x3d_find_parts(const struct scene_x3d_names *lists, const char *text,
                                 struct scene_x3d_set *set, const char *end);
/// Return which tuple of a part belongs to a corner of a face. Return SIZE_MAX where none does.
size_t scene_x3d_tuple_of(const struct scene_x3d_set *set, const struct scene_x3d_part *part, size_t corner,
                          size_t face);
/// Read a set whose parts are found. Return what it has. Tell of parts that lack some of what its corners have.
enum scene_x3d_found scene_x3d_read_set(struct scene_import *import, struct scene_x3d_set *set);
void scene_x3d_free_set(const struct scene_x3d_set *set);

#endif
