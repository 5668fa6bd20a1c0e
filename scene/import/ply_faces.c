// SPDX-License-Identifier: MIT
// Faces, triangle strips and edges of a PLY, and what stands beside their corners: colours, texture coordinates and
// numbers of textures.
#include <stdlib.h>
#include <string.h>

#include "ply_load.h"

static uint32_t checked_index(struct ply *ply, double index)
{
    if (!(index >= 0 && index < (double)ply->mesh.vertex_count)) {
        scene_import_fail(ply->import, "%s %lld refers to vertex %.0f of %u",
                          scene_word_string(ply->import, ply->element->name), (long long)ply->row, index,
                          ply->mesh.vertex_count);
    }
    return (uint32_t)index;
}

// Make room for texture coordinates of that many corners. They are 0 where an element has none.
static void reserve_wedges(struct ply *ply, size_t total)
{
    const size_t before = ply->wedge_capacity;
    scene_import_reserve(ply->import, &ply->wedges, &ply->wedge_capacity, total, sizeof *ply->wedges);
    memset(ply->wedges + before, 0, (ply->wedge_capacity - before) * sizeof *ply->wedges);
}

// Make room for triangles of the row that is being read.
static void reserve_indices(struct ply *ply, size_t more)
{
    if (ply->index_count + more > UINT32_MAX) {
        scene_import_fail(ply->import, "has too many faces");
    }
    const size_t total = ply->index_count + more;
    scene_import_reserve(ply->import, &ply->mesh.indices, &ply->index_capacity, total,
                         sizeof *ply->mesh.indices);
    if (ply->has_rows) {
        scene_import_reserve(ply->import, &ply->rows, &ply->row_capacity, total / 3, sizeof *ply->rows);
        for (size_t i = ply->index_count / 3; i < total / 3; i++) {
            ply->rows[i] = ply->row_count;
        }
    }
    if (ply->wedges != NULL) {
        reserve_wedges(ply, total);
    }
}

// What a property of a face is for.
enum use { USE_CORNERS, USE_WEDGES, USE_TEXTURE, USE_VALUE, USE_NONE };

static enum use use_of(const struct property *property)
{
    const struct scene_word name = property->name;
    if (property->count_type != TYPE_NONE) {
        return scene_word_is(name, "vertex_indices") || scene_word_is(name, "vertex_index") ? USE_CORNERS
               : scene_word_is(name, "texcoord")                                            ? USE_WEDGES
                                                                                            : USE_NONE;
    }
    return scene_word_is(name, "texnumber")       ? USE_TEXTURE
           : scene_ply_target(property) != UNUSED ? USE_VALUE
                                                  : USE_NONE;
}

bool scene_ply_reads_of_face(const struct property *property)
{
    return use_of(property) != USE_NONE;
}

// One row of an element.
struct face {
    enum use uses[MOST_PROPERTIES];
    enum target targets[MOST_PROPERTIES];
    uint32_t *corners;
    size_t corner_capacity;
    uint32_t *triangles;
    size_t triangle_capacity;
    float *wedges; // u, v, u, v, ...
    size_t wedge_capacity;
    int64_t count, wedge_count;
    int32_t texture;
    float values[TARGETS + 1];
};

// Prepare for the rows of an element. Where another element of faces has colours and this one has none, its faces are
// grey; where another one has alpha and this one has none, its faces are opaque.
static void prepare_face(const struct ply *ply, const struct element *element, struct face *face)
{
    const float grey = ply->face_colors.type == TYPE_UINT8 ? 170 : 0.666f;
    face->texture = -1;
    for (int target = RED; target <= BLUE; target++) {
        face->values[target] = grey;
    }
    const enum type alpha = ply->face_colors.alpha_type;
    face->values[ALPHA] = alpha == TYPE_UINT8 ? 255 : alpha == TYPE_UINT16 ? 65535 : 1;
    for (int i = 0; i < element->property_count; i++) {
        face->uses[i] = use_of(&element->properties[i]);
        face->targets[i] = scene_ply_target(&element->properties[i]);
    }
}

static void release_face(struct face *face)
{
    free(face->corners);
    free(face->triangles);
    free(face->wedges);
}

// Read the corners of a polygon. Room is made as the numbers come: a count alone must not ask for memory.
static void read_corners(struct ply *ply, const struct property *property, struct face *face)
{
    face->count = scene_ply_count(ply, property);
    for (int64_t k = 0; k < face->count; k++) {
        scene_import_reserve(ply->import, &face->corners, &face->corner_capacity, (size_t)k + 1,
                             sizeof *face->corners);
        face->corners[k] = checked_index(ply, scene_ply_number(ply, property->type));
    }
}

static void read_wedges(struct ply *ply, const struct property *property, struct face *face)
{
    face->wedge_count = scene_ply_count(ply, property);
    for (int64_t k = 0; k < face->wedge_count; k++) {
        scene_import_reserve(ply->import, &face->wedges, &face->wedge_capacity, (size_t)k + 1,
                             sizeof *face->wedges);
        face->wedges[k] = (float)scene_ply_number(ply, property->type);
    }
}

// Where triangles stand in rows that are a list of corners alone.
struct triangles {
    enum type count_type, type;
    size_t count_size, size; // bytes of a count and of an index
    bool is_big, are_plain;  // are_plain: rows have nothing else, and need nothing else
};

static struct triangles find_triangles(const struct ply *ply, const struct element *element,
                                       const struct face *face)
{
    const struct property *const list = &element->properties[0];
    return (struct triangles){
        .count_type = list->count_type,
        .type = list->type,
        .count_size = scene_ply_type_size(list->count_type),
        .size = scene_ply_type_size(list->type),
        .is_big = ply->encoding == BIG_ENDIAN_BINARY,
        .are_plain = ply->encoding != ASCII && element->property_count == 1 && face->uses[0] == USE_CORNERS &&
                     !ply->has_rows && ply->wedges == NULL &&
                     (list->type == TYPE_INT32 || list->type == TYPE_UINT32),
    };
}

// Load the triangles of rows up to one that is no triangle of good corners, or is the last that fits.
static void load_triangles(struct ply *ply, const struct element *element, const struct triangles *triangles)
{
    const size_t row = triangles->count_size + 3 * triangles->size;
    const uint32_t vertices = ply->mesh.vertex_count;
    while (ply->row < element->count && (size_t)(ply->end - ply->cursor) >= row &&
           ply->index_count + 3 <= ply->index_capacity) {
        const unsigned char *const corners = ply->cursor + triangles->count_size;
        uint32_t *const out = ply->mesh.indices + ply->index_count;
        bool is_good = scene_ply_load(ply->cursor, triangles->count_type, triangles->is_big) == 3;
        for (int k = 0; k < 3; k++) {
            out[k] = scene_ply_load_32(corners + 4 * k, triangles->is_big);
            // A negative index is above all others here.
            is_good = is_good && out[k] < vertices && out[k] <= INT32_MAX;
        }
        if (!is_good) {
            return;
        }
        ply->index_count += 3;
        ply->cursor += row;
        ply->row++;
        ply->row_count++;
    }
}

// Make room for triangles of all rows, as far as the file can hold them.
static void reserve_triangles(struct ply *ply, const struct element *element,
                              const struct triangles *triangles)
{
    const size_t fit = (size_t)(ply->end - ply->cursor) / (triangles->count_size + 3 * triangles->size);
    const size_t rows = (size_t)element->count < fit ? (size_t)element->count : fit;
    if (ply->index_count + 3 * rows <= UINT32_MAX) {
        scene_import_reserve(ply->import, &ply->mesh.indices, &ply->index_capacity,
                             ply->index_count + 3 * rows, sizeof *ply->mesh.indices);
    }
}

// Return the number of a texture of the file, or −1 for none. Count faces with one that the file does not have.
static int32_t texture_number(struct ply *ply, double number)
{
    const bool is_there = number >= 0 && number < ply->texture_count;
    ply->stray_textures += ply->texture_count > 1 && !is_there && number != -1;
    return is_there ? (int32_t)number : -1;
}

// Read what a row has beside its corners.
static void read_property(struct ply *ply, const struct property *property, int place, struct face *face)
{
    if (face->uses[place] == USE_TEXTURE) {
        face->texture = texture_number(ply, scene_ply_number(ply, property->type));
    } else if (face->uses[place] == USE_VALUE) {
        face->values[face->targets[place]] = (float)scene_ply_number(ply, property->type);
    } else {
        scene_ply_skip(ply, property);
    }
}

// Keep what the row says of its triangles, which know the row by its number.
static void end_row(struct ply *ply, const struct face *face)
{
    if (ply->face_colors.present) {
        scene_ply_add_color(ply, &ply->face_colors, face->values);
    }
    ply->row_count++;
    if (ply->texture_count > 1) {
        scene_import_reserve(ply->import, &ply->face_textures, &ply->face_texture_capacity,
                             ply->face_texture_count + 1, sizeof *ply->face_textures);
        ply->face_textures[ply->face_texture_count++] = face->texture;
    }
}

static void add_face(struct ply *ply, struct face *face)
{
    if (face->count < 3) {
        ply->small_faces++;
        return;
    }
    const uint32_t count = (uint32_t)face->count;
    const size_t corners = 3 * (size_t)(count - 2);
    scene_import_reserve(ply->import, &face->triangles, &face->triangle_capacity, corners,
                         sizeof *face->triangles);
    scene_import_triangulate(ply->import, &ply->mesh, face->corners, count, face->triangles);
    reserve_indices(ply, corners);
    scene_polygons_add(ply->import, &ply->polygons, ply->index_count / 3, count - 2);
    const bool wedged = face->wedge_count >= 2 * face->count;
    if (wedged && ply->wedges == NULL) {
        reserve_wedges(ply, ply->index_count + corners);
    }
    for (size_t i = 0; i < corners; i++) {
        const uint32_t corner = face->triangles[i];
        if (wedged) {
            ply->wedges[ply->index_count][0] = face->wedges[2 * corner];
            ply->wedges[ply->index_count][1] = 1 - face->wedges[2 * corner + 1];
        }
        ply->mesh.indices[ply->index_count++] = face->corners[corner];
    }
}

void scene_ply_read_faces(struct ply *ply, const struct element *element)
{
    struct face face = {.count = 0};
    prepare_face(ply, element, &face);
    const struct triangles triangles = find_triangles(ply, element, &face);
    if (triangles.are_plain) {
        reserve_triangles(ply, element, &triangles);
    }
    for (ply->row = 0; ply->row < element->count; ply->row++) {
        if (triangles.are_plain && ply->polygons.of_triangle == NULL) {
            load_triangles(ply, element, &triangles);
        }
        if (ply->row == element->count) {
            break;
        }
        face.count = face.wedge_count = 0;
        for (int i = 0; i < element->property_count; i++) {
            const struct property *property = &element->properties[i];
            if (face.uses[i] == USE_CORNERS) {
                read_corners(ply, property, &face);
            } else if (face.uses[i] == USE_WEDGES) {
                read_wedges(ply, property, &face);
            } else {
                read_property(ply, property, i, &face);
            }
        }
        add_face(ply, &face);
        end_row(ply, &face);
    }
    release_face(&face);
}

// Read a strip, in which −1 starts a new one.
static void read_strip(struct ply *ply, const struct property *property)
{
    const int64_t count = scene_ply_count(ply, property);
    uint32_t last[2] = {0, 0};
    int64_t length = 0;
    for (int64_t k = 0; k < count; k++) {
        const double value = scene_ply_number(ply, property->type);
        if (value == -1) {
            length = 0;
            continue;
        }
        const uint32_t index = checked_index(ply, value);
        if (length >= 2) {
            reserve_indices(ply, 3);
            scene_polygons_add(ply->import, &ply->polygons, ply->index_count / 3, 1);
            uint32_t *out = ply->mesh.indices + ply->index_count;
            out[0] = last[length % 2];
            out[1] = last[1 - length % 2];
            out[2] = index;
            ply->index_count += 3;
        }
        last[0] = last[1];
        last[1] = index;
        length++;
    }
}

void scene_ply_read_strips(struct ply *ply, const struct element *element)
{
    struct face face = {.count = 0};
    prepare_face(ply, element, &face);
    for (ply->row = 0; ply->row < element->count; ply->row++) {
        for (int i = 0; i < element->property_count; i++) {
            const struct property *property = &element->properties[i];
            if (face.uses[i] == USE_CORNERS) {
                read_strip(ply, property);
            } else {
                read_property(ply, property, i, &face);
            }
        }
        end_row(ply, &face);
    }
}

void scene_ply_read_edges(struct ply *ply, const struct element *element)
{
    scene_ply_find_colors(element, &ply->edge_colors);
    for (ply->row = 0; ply->row < element->count; ply->row++) {
        double ends[2] = {-1, -1};
        float values[TARGETS + 1] = {0};
        for (int i = 0; i < element->property_count; i++) {
            const struct property *property = &element->properties[i];
            const int end = scene_word_is(property->name, "vertex1")   ? 0
                            : scene_word_is(property->name, "vertex2") ? 1
                                                                       : -1;
            const enum target target = scene_ply_target(property);
            if (end >= 0 && property->count_type == TYPE_NONE) {
                ends[end] = scene_ply_number(ply, property->type);
            } else if (target != UNUSED) {
                values[target] = (float)scene_ply_number(ply, property->type);
            } else {
                scene_ply_skip(ply, property);
            }
        }
        scene_import_reserve(ply->import, &ply->edges, &ply->edge_capacity, ply->edge_count + 2,
                             sizeof *ply->edges);
        ply->edges[ply->edge_count++] = checked_index(ply, ends[0]);
        ply->edges[ply->edge_count++] = checked_index(ply, ends[1]);
        if (ply->edge_colors.present) {
            scene_ply_add_color(ply, &ply->edge_colors, values);
        }
    }
}
