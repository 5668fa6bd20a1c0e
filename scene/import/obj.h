// SPDX-License-Identifier: MIT
// An OBJ file that is being read.
#ifndef SCENE_OBJ_H
#define SCENE_OBJ_H

#include "import/builder/hash_table.h"
#include "import/builder/import.h"
#include "import/builder/text_lines.h"
#include "import/builder/unknown_words.h"
#include "mtl.h"

enum { SMOOTHING_NOT_SAID = -1, SMOOTHING_OFF = 0 };
enum { SCENE_OBJ_NUMBERS = 7 }; // the most numbers of a line that count
#define SCENE_OBJ_NONE UINT32_MAX

struct corner {
    uint32_t position, uv, normal; // uv and normal are SCENE_OBJ_NONE where the file gives none
};

struct part_key {
    uint32_t object;
    size_t material;
    int smoothing;
    enum scene_primitive primitive;
    bool has_uv, has_normal;
};

struct part {
    struct part_key key;
    struct corner *corners;
    size_t corner_count, corner_capacity;
    uint32_t *sizes; // number of corners of each polygon, line or point
    size_t size_count, size_capacity;
};

struct obj {
    struct scene_import *import;
    struct scene_text text;
    double (*read_positions)[3]; // until all are read, or where parts are far from each other until the end
    double origin[3];            // what was subtracted from the positions
    float (*positions)[3], (*colors)[4], (*uvs)[2], (*normals)[3];
    size_t position_count, position_capacity, color_capacity, painted_count, uv_count, uv_capacity,
        normal_count, normal_capacity;
    bool colored;
    float (*painted)[4]; // colours of ZBrush, which stand in comments
    size_t painted_capacity;
    const char **objects; // names of the objects
    size_t object_count, object_capacity;
    size_t first_part; // first part of the current object
    struct part *parts;
    size_t part_count, part_capacity, part; // part: the one of the face before
    struct scene_hash_table part_table;     // parts by their keys
    struct scene_mtl mtl;
    struct scene_unknown_words unknown;
    bool libraries_complete; // all libraries that were named are there
    size_t material;
    int smoothing;
    struct corner *polygon; // corners of the polygon being read
    size_t polygon_capacity;
    uint32_t small_faces;   // number of faces with fewer than three corners
    uint32_t small_lines;   // number of lines with fewer than two
    uint32_t zero_elements; // number of faces, lines and points with an index of 0
    bool has_zero_others;   // a texture coordinate or a normal has the index 0
    bool has_third_uv;      // texture coordinates have a third number, and it is not 0
    bool has_odd_numbers;   // two numbers follow a position, which is neither a weight nor a colour
    bool joins_corners;     // corners with the same numbers become one vertex at once
    // The last vertex of the part at each position. SCENE_OBJ_NONE where there is none.
    uint32_t *first_vertices;
};

// Add what a line has, by its numbers.

/// Add a vertex: x y z [w] or x y z [w] r g b. The number w weights free-form curves and says nothing about polygons.
void scene_obj_add_position(struct obj *obj, const double *values, int count);
/// Add texture coordinates: u [v [w]].
void scene_obj_add_uv(struct obj *obj, const double *values, int count);
void scene_obj_add_normal(struct obj *obj, const double values[3]);
/// Add a triangle or polygon, a line or a point of corners that are good.
void scene_obj_add_element(struct obj *obj, enum scene_primitive primitive, const struct corner *corners,
                           uint32_t count);

/// Tell of a statement that is not drawn, or that has no meaning, by its first word.
void scene_obj_tell_of_statement(struct obj *obj, struct scene_word key, struct scene_line line);
/// Read all lines that are plain, up to one that is not.
void scene_obj_read_plain(struct obj *obj);
/// Make meshes of all parts, and free the parts.
void scene_obj_add_parts(struct obj *obj);

#endif
