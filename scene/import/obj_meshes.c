// SPDX-License-Identifier: MIT
// The meshes of an OBJ file, which its parts become when all is read.
#include <stdlib.h>
#include <string.h>

#include "import/builder/complete_mesh.h"
#include "import/builder/import.h"
#include "import/builder/numbers.h"
#include "import/builder/origin.h"
#include "import/builder/place.h"
#include "import/builder/polygon.h"
#include "obj.h"

// Meshes --------------------------------------------------------------------------------------------

// Check the corners of a part. Faces may name texture coordinates or normals that never came. Only positions are
// indispensable.
static void check_corners(struct obj *obj, struct part *part)
{
    bool has_uv = part->key.has_uv, has_normal = part->key.has_normal;
    for (size_t i = 0; i < part->corner_count; i++) {
        const struct corner *corner = &part->corners[i];
        if (corner->position >= obj->position_count) {
            scene_import_fail(obj->import, "a face refers to vertex %u of %zu", corner->position + 1,
                              obj->position_count);
        }
        has_uv = has_uv && corner->uv < obj->uv_count;
        has_normal = has_normal && corner->normal < obj->normal_count;
    }
    if (has_uv != part->key.has_uv || has_normal != part->key.has_normal) {
        scene_import_warn(obj->import, "faces refer to %s that are not there",
                          has_normal != part->key.has_normal ? "normals" : "texture coordinates");
    }
    part->key.has_uv = has_uv;
    part->key.has_normal = has_normal;
}

static void copy_positions(struct obj *obj, const struct part *part, struct scene_mesh *mesh)
{
    const size_t count = part->corner_count;
    if (obj->positions == NULL) {
        double(*exact)[3] = scene_import_allocate(obj->import, count, sizeof *exact);
        for (size_t i = 0; i < count; i++) {
            memcpy(exact[i], obj->read_positions[part->corners[i].position], sizeof exact[i]);
        }
        mesh->positions = scene_import_settle(obj->import, exact, count, obj->origin);
        return;
    }
    mesh->positions = scene_import_allocate(obj->import, count, sizeof *mesh->positions);
    for (size_t i = 0; i < count; i++) {
        memcpy(mesh->positions[i], obj->positions[part->corners[i].position], sizeof mesh->positions[i]);
    }
}

static void copy_corners(struct obj *obj, const struct part *part, struct scene_mesh *mesh)
{
    struct scene_import *import = obj->import;
    const size_t count = part->corner_count;
    mesh->vertex_count = (uint32_t)count;
    copy_positions(obj, part, mesh);
    if (part->key.has_uv) {
        mesh->uvs[0] = scene_import_allocate(import, count, sizeof *mesh->uvs[0]);
    }
    if (part->key.has_normal) {
        mesh->normals = scene_import_allocate(import, count, sizeof *mesh->normals);
    }
    if (obj->colored) {
        mesh->colors = scene_import_allocate(import, count, sizeof *mesh->colors);
    }
    for (size_t i = 0; i < count; i++) {
        const struct corner *corner = &part->corners[i];
        if (mesh->uvs[0] != NULL) {
            memcpy(mesh->uvs[0][i], obj->uvs[corner->uv], sizeof mesh->uvs[0][i]);
        }
        if (mesh->normals != NULL) {
            memcpy(mesh->normals[i], obj->normals[corner->normal], sizeof mesh->normals[i]);
        }
        if (mesh->colors != NULL) {
            memcpy(mesh->colors[i], obj->colors[corner->position], sizeof mesh->colors[i]);
        }
    }
}

static void make_indices(struct obj *obj, const struct part *part, struct scene_mesh *mesh,
                         struct scene_polygons *polygons)
{
    const bool triangles = part->key.primitive == SCENE_PRIMITIVE_TRIANGLES;
    size_t count = 0;
    for (size_t i = 0; i < part->size_count; i++) {
        count += triangles ? 3 * ((size_t)part->sizes[i] - 2) : part->sizes[i];
    }
    if (count > UINT32_MAX) {
        scene_import_fail(obj->import, "has too many faces");
    }
    mesh->index_count = (uint32_t)count;
    mesh->indices = scene_import_allocate(obj->import, count, sizeof *mesh->indices);
    uint32_t *next = mesh->indices, first = 0;
    uint32_t *polygon = NULL;
    size_t polygon_capacity = 0;
    for (size_t i = 0; i < part->size_count; first += part->sizes[i++]) {
        const uint32_t size = part->sizes[i];
        scene_import_reserve(obj->import, &polygon, &polygon_capacity, size, sizeof *polygon);
        for (uint32_t k = 0; k < size; k++) {
            polygon[k] = first + k;
        }
        if (!triangles) {
            memcpy(next, polygon, size * sizeof *next);
            next += size;
            continue;
        }
        scene_import_triangulate(obj->import, (const float(*)[3])mesh->positions, polygon, size, next);
        scene_polygons_add(obj->import, polygons, (size_t)(next - mesh->indices) / 3, size - 2);
        for (uint32_t k = 0; k < 3 * (size - 2); k++) {
            *next++ += first;
        }
    }
    free(polygon);
}

static void free_part(struct part *part)
{
    free(part->corners);
    free(part->sizes);
    free(part->clusters);
}

static void add_part(struct obj *obj, struct part *part)
{
    struct scene_import *import = obj->import;
    const char *name = obj->objects[part->key.object];
    struct scene_mesh mesh = {.name = name, .primitive = part->key.primitive};
    copy_corners(obj, part, &mesh);
    struct scene_polygons polygons = {.count = 0};
    make_indices(obj, part, &mesh, &polygons);
    free_part(part);
    mesh.material = scene_mtl_use(import, &obj->mtl, part->key.material, obj->colored);
    *scene_import_add_mesh(import) = mesh;
    scene_import_place_mesh(import, obj->origin);
    struct scene_instance *instance = scene_import_add_instance(import);
    instance->name = name;
    instance->mesh = import->model.mesh_count - 1;
    instance->object = part->key.object + 1;
    scene_import_identity(instance->world);
    const bool flat = part->key.smoothing == SMOOTHING_OFF;
    scene_import_complete_polygons(import, instance->mesh, flat ? SCENE_IMPORT_FLAT : SCENE_IMPORT_SMOOTH,
                                   true, polygons.of_triangle);
    free(polygons.of_triangle);
}

// Clusters ----------------------------------------------------------------------------------------------

static struct scene_box box_corners(const struct obj *obj, const struct corner *corners, size_t count)
{
    struct scene_box box = scene_box_empty();
    for (size_t i = 0; i < count; i++) {
        scene_box_extend_to(&box, obj->read_positions[corners[i].position]);
    }
    return box;
}

// Return the number of elements of a part that are one for its clusters. Points have no size that could tell how far
// they are from others.
static size_t elements_at_once(const struct part *part)
{
    return part->key.primitive == SCENE_PRIMITIVE_POINTS ? part->size_count : 1;
}

static void find_clusters(struct obj *obj)
{
    for (size_t i = 0; i < obj->part_count; i++) {
        struct part *const part = &obj->parts[i];
        const size_t step = elements_at_once(part);
        check_corners(obj, part);
        part->clusters = scene_import_allocate(obj->import, part->size_count, sizeof *part->clusters);
        for (size_t k = 0, first = 0; k < part->size_count; first += step * part->sizes[k], k += step) {
            const struct scene_box box = box_corners(obj, part->corners + first, step * part->sizes[k]);
            part->clusters[k] = (uint8_t)scene_import_clusters_add(&obj->clusters, &box);
        }
    }
    scene_import_clusters_join(&obj->clusters);
}

static struct part *piece_of(const struct obj *obj, const struct part *part, size_t element,
                             struct part pieces[SCENE_IMPORT_CLUSTERS])
{
    return &pieces[obj->clusters.joined[part->clusters[element]]];
}

// Move the elements of a part to pieces, whose capacities are known.
static void fill_pieces(struct obj *obj, struct part *part, struct part pieces[SCENE_IMPORT_CLUSTERS])
{
    const size_t step = elements_at_once(part);
    for (size_t k = 0, first = 0; k < part->size_count; first += step * part->sizes[k], k += step) {
        struct part *const piece = piece_of(obj, part, k, pieces);
        const size_t corners = step * part->sizes[k];
        if (piece->corners == NULL) {
            piece->key = part->key;
            piece->corners =
                scene_import_allocate(obj->import, piece->corner_capacity, sizeof *part->corners);
            piece->sizes = scene_import_allocate(obj->import, piece->size_capacity, sizeof *part->sizes);
        }
        memcpy(piece->corners + piece->corner_count, part->corners + first, corners * sizeof *part->corners);
        memcpy(piece->sizes + piece->size_count, part->sizes + k, step * sizeof *part->sizes);
        piece->corner_count += corners;
        piece->size_count += step;
    }
    free_part(part);
}

// Add the elements of a part, those of each cluster as a part of their own.
static void add_split_part(struct obj *obj, struct part *part)
{
    const size_t step = elements_at_once(part);
    struct part pieces[SCENE_IMPORT_CLUSTERS] = {0};
    for (size_t k = 0; k < part->size_count; k += step) {
        struct part *const piece = piece_of(obj, part, k, pieces);
        piece->corner_capacity += step * part->sizes[k];
        piece->size_capacity += step;
    }
    if (piece_of(obj, part, 0, pieces)->size_capacity == part->size_count) {
        add_part(obj, part);
        return;
    }
    fill_pieces(obj, part, pieces);
    for (uint32_t i = 0; i < obj->clusters.count; i++) {
        if (pieces[i].size_count > 0) {
            add_part(obj, &pieces[i]);
        }
    }
}

void scene_obj_add_parts(struct obj *obj)
{
    find_clusters(obj);
    const bool is_one = obj->clusters.count < 2;
    if (is_one) {
        obj->positions =
            scene_import_settle(obj->import, obj->read_positions, obj->position_count, obj->origin);
    }
    for (size_t i = 0; i < obj->part_count; i++) {
        (is_one ? add_part : add_split_part)(obj, &obj->parts[i]);
    }
}
