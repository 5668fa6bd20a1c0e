// SPDX-License-Identifier: MIT
// The meshes of an OBJ file, which its parts become when all is read.
#include <stdlib.h>
#include <string.h>

#include "import/builder/complete_mesh.h"
#include "import/builder/import.h"
#include "import/builder/numbers.h"
#include "import/builder/origin.h"
#include "import/builder/pieces.h"
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

// Copy the positions of a part's corners. Parts of a file that are far from each other count each from a place of its
// own.
static void copy_positions(struct obj *obj, const struct part *part, struct scene_mesh *mesh)
{
    const size_t count = part->corner_count;
    if (obj->positions == NULL) {
        double(*exact)[3] = scene_import_allocate(obj->import, count, sizeof *exact);
        for (size_t i = 0; i < count; i++) {
            memcpy(exact[i], obj->read_positions[part->corners[i].position], sizeof exact[i]);
        }
        scene_import_keep_exact(obj->import, mesh, (const double(*)[3])exact);
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
        scene_import_triangulate(obj->import, mesh, polygon, size, next);
        scene_polygons_add(obj->import, polygons, (size_t)(next - mesh->indices) / 3, size - 2);
        for (uint32_t k = 0; k < 3 * (size - 2); k++) {
            *next++ += first;
        }
    }
    free(polygon);
}

static void add_part(struct obj *obj, struct part *part)
{
    struct scene_import *import = obj->import;
    const char *name = obj->objects[part->key.object];
    struct scene_mesh mesh = {.name = name, .primitive = part->key.primitive};
    copy_corners(obj, part, &mesh);
    struct scene_polygons polygons = {.count = 0};
    make_indices(obj, part, &mesh, &polygons);
    free(part->corners);
    free(part->sizes);
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

// Return true if parts of the file are far from each other.
static bool is_scattered(struct obj *obj)
{
    const struct scene_import_points points = {.exact = (const double(*)[3])obj->read_positions,
                                               .count = obj->position_count};
    struct scene_import_elements *const lists =
        scene_import_allocate(obj->import, obj->part_count, sizeof *lists);
    for (size_t i = 0; i < obj->part_count; i++) {
        const struct part *const part = &obj->parts[i];
        lists[i] = (struct scene_import_elements){.corners = part->corners,
                                                  .count = part->size_count,
                                                  .stride = sizeof *part->corners,
                                                  .sizes = part->sizes};
    }
    const struct scene_import_clusters clusters =
        scene_import_clusters_find(obj->import, &points, lists, obj->part_count);
    free(clusters.of_point);
    free(lists);
    return clusters.count > 1;
}

void scene_obj_add_parts(struct obj *obj)
{
    for (size_t i = 0; i < obj->part_count; i++) {
        check_corners(obj, &obj->parts[i]);
    }
    if (!is_scattered(obj)) {
        obj->positions =
            scene_import_settle(obj->import, obj->read_positions, obj->position_count, obj->origin);
    }
    for (size_t i = 0; i < obj->part_count; i++) {
        add_part(obj, &obj->parts[i]);
    }
}
