// SPDX-License-Identifier: MIT
// The vertices of a PLY. Their rows are nearly always of one size, and whole in the file. The numbers of binary rows
// are loaded from known places then.
#include <stdlib.h>
#include <string.h>

#include "import/builder/origin.h"
#include "import/builder/pieces.h"
#include "ply_load.h"

static void allocate_vertices(struct ply *ply, const bool present[TARGETS], uint32_t count)
{
    struct scene_mesh *mesh = &ply->mesh;
    if (!present[X] || !present[Y] || !present[Z]) {
        scene_import_fail(ply->import, "its vertices have no positions");
    }
    mesh->vertex_count = count;
    ply->read_positions = scene_import_allocate_any(ply->import, count, sizeof *ply->read_positions);
    if (present[NX] && present[NY] && present[NZ]) {
        mesh->normals = scene_import_allocate_any(ply->import, count, sizeof *mesh->normals);
    }
    if (present[U] && present[V]) {
        mesh->uvs[0] = scene_import_allocate_any(ply->import, count, sizeof *mesh->uvs[0]);
    }
}

static void store_vertex(struct ply *ply, uint32_t i, const double place[3], const float values[TARGETS])
{
    struct scene_mesh *mesh = &ply->mesh;
    memcpy(ply->read_positions[i], place, sizeof ply->read_positions[i]);
    if (mesh->normals != NULL) {
        memcpy(mesh->normals[i], values + NX, sizeof mesh->normals[i]);
    }
    if (mesh->uvs[0] != NULL) {
        mesh->uvs[0][i][0] = values[U];
        mesh->uvs[0][i][1] = 1 - values[V]; // the format's v points up
    }
    if (ply->vertex_colors.present) {
        scene_ply_add_color(ply, &ply->vertex_colors, values);
    }
}

// Read rows number by number.
static void read_rows(struct ply *ply, const struct element *element, const enum target *targets)
{
    float values[TARGETS + 1] = {0};
    double place[3];
    for (ply->row = 0; ply->row < element->count; ply->row++) {
        for (int i = 0; i < element->property_count; i++) {
            if (targets[i] == UNUSED) {
                scene_ply_skip(ply, &element->properties[i]);
            } else {
                const double number = scene_ply_number(ply, element->properties[i].type);
                values[targets[i]] = (float)number;
                if (targets[i] <= Z) {
                    place[targets[i] - X] = number;
                }
            }
        }
        store_vertex(ply, (uint32_t)ply->row, place, values);
    }
}

// Return the bytes of a binary row. Return 0 if rows are text or not all of one size.
static size_t row_size(const struct ply *ply, const struct element *element)
{
    size_t size = 0;
    for (int i = 0; i < element->property_count; i++) {
        if (ply->encoding == ASCII || element->properties[i].count_type != TYPE_NONE) {
            return 0;
        }
        size += scene_ply_type_size(element->properties[i].type);
    }
    return size;
}

// Return true if a row is x, y and z as floats.
static bool has_floats_alone(const struct element *element, const enum target *targets)
{
    bool is_so = element->property_count == 3;
    for (int i = 0; i < 3 && is_so; i++) {
        is_so = targets[i] == (enum target)(X + i) && element->properties[i].type == TYPE_FLOAT;
    }
    return is_so;
}

// Load rows that are x, y and z as floats, and whole. Return false if they cannot stay floats.
static bool load_floats(struct ply *ply, const struct element *element)
{
    const size_t count = (size_t)element->count;
    float(*const points)[3] = scene_import_allocate_any(ply->import, count, sizeof *points);
    for (size_t i = 0; i < count; i++) {
        for (size_t c = 0; c < 3; c++) {
            const unsigned char *const bytes = ply->cursor + sizeof *points * i + sizeof **points * c;
            const uint32_t word = scene_ply_load_32(bytes, ply->encoding == BIG_ENDIAN_BINARY);
            memcpy(&points[i][c], &word, sizeof word);
        }
    }
    if (!scene_import_stay_floats(ply->import, (const float(*)[3])points, count)) {
        free(points);
        return false;
    }
    ply->mesh.vertex_count = (uint32_t)count;
    ply->mesh.positions = points;
    ply->cursor += count * sizeof *points;
    ply->row = element->count;
    return true;
}

// Load rows that are whole.
static void load_rows(struct ply *ply, const struct element *element, const enum target *targets)
{
    const bool is_big = ply->encoding == BIG_ENDIAN_BINARY;
    const uint32_t count = (uint32_t)element->count;
    const unsigned char *row = ply->cursor;
    float values[TARGETS + 1] = {0};
    double place[3];
    for (uint32_t k = 0; k < count; k++) {
        for (int i = 0; i < element->property_count; i++) {
            const enum type type = element->properties[i].type;
            if (targets[i] != UNUSED) {
                const double number = scene_ply_load(row, type, is_big);
                values[targets[i]] = (float)number;
                if (targets[i] <= Z) {
                    place[targets[i] - X] = number;
                }
            }
            row += scene_ply_type_size(type);
        }
        store_vertex(ply, k, place, values);
    }
    ply->cursor = row;
    ply->row = element->count;
}

void scene_ply_read_vertices(struct ply *ply, const struct element *element)
{
    enum target targets[MOST_PROPERTIES];
    bool present[TARGETS + 1] = {false};
    for (int i = 0; i < element->property_count; i++) {
        targets[i] = scene_ply_target(&element->properties[i]);
        present[targets[i]] = true;
        if (targets[i] == UNUSED) {
            scene_ply_tell_of_property(ply, element->properties[i].name);
        }
    }
    if (ply->mesh.positions != NULL) {
        scene_import_fail(ply->import, "has two lists of vertices");
    }
    scene_ply_find_colors(element, &ply->vertex_colors);
    if (ply->vertex_colors.present) {
        scene_import_reserve(ply->import, &ply->vertex_colors.rows, &ply->vertex_colors.capacity,
                             (size_t)element->count, sizeof *ply->vertex_colors.rows);
    }
    const size_t size = row_size(ply, element);
    const bool are_whole = size > 0 && (size_t)(ply->end - ply->cursor) / size >= (size_t)element->count;
    if (are_whole && has_floats_alone(element, targets) && load_floats(ply, element)) {
        return;
    }
    allocate_vertices(ply, present, (uint32_t)element->count);
    if (are_whole) {
        load_rows(ply, element, targets);
    } else {
        read_rows(ply, element, targets);
    }
    scene_import_keep_exact(ply->import, &ply->mesh, (const double(*)[3])ply->read_positions);
    ply->mesh.positions =
        scene_import_settle(ply->import, ply->read_positions, (size_t)element->count, ply->origin);
}
