// SPDX-License-Identifier: MIT
// What the files of the PLY reader share: the header, the numbers behind it, and what these have become.
#ifndef SCENE_PLY_H
#define SCENE_PLY_H

#include "import/builder/import.h"
#include "import/builder/polygon.h"
#include "import/builder/text_lines.h"

enum type {
    TYPE_NONE,
    TYPE_INT8,
    TYPE_UINT8,
    TYPE_INT16,
    TYPE_UINT16,
    TYPE_INT32,
    TYPE_UINT32,
    TYPE_FLOAT,
    TYPE_DOUBLE
};

enum encoding { ASCII, LITTLE_ENDIAN_BINARY, BIG_ENDIAN_BINARY };

// What a property that is no list is for.
enum target { X, Y, Z, NX, NY, NZ, U, V, RED, GREEN, BLUE, ALPHA, TARGETS, UNUSED = TARGETS };

enum { MOST_ELEMENTS = 32, MOST_PROPERTIES = 256, MOST_TEXTURES = 256 };

struct property {
    struct scene_word name;
    enum type type, count_type; // count_type is TYPE_NONE where the property is no list
};

struct element {
    struct scene_word name;
    int64_t count;
    struct property *properties;
    int property_count;
};

// Colours of rows, as the file has them until they are decoded.
struct ply_colors {
    bool present;
    enum type type, alpha_type; // TYPE_NONE if the file has no alpha
    float (*rows)[4];
    size_t count, capacity;
};

struct ply {
    struct scene_import *import;
    enum encoding encoding;
    struct element elements[MOST_ELEMENTS];
    int element_count;
    struct scene_word textures[MOST_TEXTURES]; // names in "comment TextureFile"
    int texture_count;
    const unsigned char *cursor, *end;
    struct scene_text text; // lines of ASCII data
    struct scene_line line;
    const struct element *element; // element being read, for messages
    int64_t row;
    struct scene_mesh mesh;
    double (*read_positions)[3]; // until all are read
    double origin[3];            // what was subtracted from the positions
    size_t index_capacity, index_count;
    uint32_t *edges;
    size_t edge_capacity, edge_count;
    float (*wedges)[2]; // texture coordinates of each corner; NULL if there are none
    size_t wedge_capacity;
    struct ply_colors vertex_colors, face_colors, edge_colors;
    bool translucent;        // some vertex or face is
    uint32_t small_faces;    // number of faces with fewer than three corners
    uint32_t stray_textures; // number of faces whose texture is not there
    struct scene_polygons polygons;
    bool has_rows;  // triangles have `rows`
    uint32_t *rows; // row of each triangle, by which face_colors and face_textures know it
    uint32_t row_count;
    size_t row_capacity;
    int32_t *face_textures; // number of the texture of each row, −1 for none; NULL if the file has none
    size_t face_texture_count, face_texture_capacity;
};

/// Read the header from the lines of ply->text.
void scene_ply_read_header(struct ply *ply);
/// Return what a property is for by its name. Lists are for nothing here.
enum target scene_ply_target(const struct property *property);

/// Return the bytes of a number.
size_t scene_ply_type_size(enum type type);
/// Read one number of the data.
double scene_ply_number(struct ply *ply, enum type type);
/// Return how many numbers the list that follows has.
int64_t scene_ply_count(struct ply *ply, const struct property *property);
void scene_ply_skip(struct ply *ply, const struct property *property);

/// Look whether the rows of an element have colours.
void scene_ply_find_colors(const struct element *element, struct ply_colors *colors);
/// Add the colour of a row. `values` has a number for each target.
void scene_ply_add_color(struct ply *ply, struct ply_colors *colors, const float *values);
/// Make the colours of the rows linear. Return true if any is translucent.
bool scene_ply_decode_colors(struct ply_colors *colors);

/// Return true for a property of a face that is read.
bool scene_ply_reads_of_face(const struct property *property);
/// Tell of a property that is not read if, by its name, it would change how a surface looks.
void scene_ply_tell_of_property(struct ply *ply, struct scene_word name);

// Read the rows of an element.
void scene_ply_read_vertices(struct ply *ply, const struct element *element);
void scene_ply_read_faces(struct ply *ply, const struct element *element);
void scene_ply_read_strips(struct ply *ply, const struct element *element);
void scene_ply_read_edges(struct ply *ply, const struct element *element);

#endif
