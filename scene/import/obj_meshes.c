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

// Corners -------------------------------------------------------------------------------------------

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

// The corners of a part that become vertices: `count` of them, by their numbers.
struct chosen {
    const uint32_t *corners;
    size_t count;
};

// Copy the positions of chosen corners. Parts of a file that are far from each other count each from a place of its
// own.
static void copy_positions(struct obj *obj, const struct part *part, struct chosen chosen,
                           struct scene_mesh *mesh)
{
    const size_t count = chosen.count;
    if (obj->positions == NULL) {
        double(*exact)[3] = scene_import_allocate_any(obj->import, count, sizeof *exact);
        for (size_t i = 0; i < count; i++) {
            memcpy(exact[i], obj->read_positions[part->corners[chosen.corners[i]].position], sizeof exact[i]);
        }
        scene_import_keep_exact(obj->import, mesh, (const double(*)[3])exact);
        mesh->positions = scene_import_settle(obj->import, exact, count, obj->origin);
        return;
    }
    mesh->positions = scene_import_allocate_any(obj->import, count, sizeof *mesh->positions);
    for (size_t i = 0; i < count; i++) {
        memcpy(mesh->positions[i], obj->positions[part->corners[chosen.corners[i]].position],
               sizeof mesh->positions[i]);
    }
}

static void copy_corners(struct obj *obj, const struct part *part, struct chosen chosen,
                         struct scene_mesh *mesh)
{
    struct scene_import *import = obj->import;
    const size_t count = chosen.count;
    mesh->vertex_count = (uint32_t)count;
    copy_positions(obj, part, chosen, mesh);
    if (part->key.has_uv) {
        mesh->uvs[0] = scene_import_allocate_any(import, count, sizeof *mesh->uvs[0]);
    }
    if (part->key.has_normal) {
        mesh->normals = scene_import_allocate_any(import, count, sizeof *mesh->normals);
    }
    if (obj->colored) {
        mesh->colors = scene_import_allocate_any(import, count, sizeof *mesh->colors);
    }
    for (size_t i = 0; i < count; i++) {
        const struct corner *corner = &part->corners[chosen.corners[i]];
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

// Vertices ------------------------------------------------------------------------------------------

// The vertices that corners have become so far. Those of one position follow each other in a list.
struct joining {
    uint32_t *next;    // vertex behind each in its list
    uint32_t *corners; // first corner of each vertex
    uint32_t count;
};

static bool is_same(const struct part *part, const struct corner *a, const struct corner *b)
{
    return (!part->key.has_uv || a->uv == b->uv) && (!part->key.has_normal || a->normal == b->normal);
}

// Return the vertex of a corner. It is a new one if no corner before names the same numbers.
static uint32_t find_vertex(struct obj *obj, const struct part *part, uint32_t number,
                            struct joining *joining)
{
    enum { MOST = 32 }; // vertices of a list that are looked at; others are joined later
    const struct corner *const corner = &part->corners[number];
    uint32_t *const first = &obj->first_vertices[corner->position];
    uint32_t vertex = *first;
    for (int i = 0; i < MOST && vertex != SCENE_OBJ_NONE; i++) {
        if (is_same(part, &part->corners[joining->corners[vertex]], corner)) {
            return vertex;
        }
        vertex = joining->next[vertex];
    }
    joining->corners[joining->count] = number;
    joining->next[joining->count] = *first;
    *first = joining->count;
    return joining->count++;
}

// Copy all corners of a part.
static void copy_all(struct obj *obj, const struct part *part, struct scene_mesh *mesh)
{
    const size_t count = part->corner_count;
    uint32_t *const corners = scene_import_allocate_any(obj->import, count, sizeof *corners);
    for (uint32_t i = 0; i < count; i++) {
        corners[i] = i;
    }
    copy_corners(obj, part, (struct chosen){corners, count}, mesh);
    free(corners);
}

// Make the vertices of a part from the corners that the indices name, one for all corners with the same numbers. The
// indices then name vertices, which stand in the order of their first corners.
static void join_corners(struct obj *obj, const struct part *part, struct scene_mesh *mesh)
{
    struct scene_import *const import = obj->import;
    const size_t count = part->corner_count;
    struct joining joining = {.next = scene_import_allocate_any(import, count, sizeof(uint32_t)),
                              .corners = scene_import_allocate_any(import, count, sizeof(uint32_t))};
    uint32_t *const vertices = scene_import_allocate(import, count, sizeof *vertices);
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        vertices[mesh->indices[i]] = 1; // used
    }
    for (uint32_t i = 0; i < count; i++) {
        vertices[i] = vertices[i] != 0 ? find_vertex(obj, part, i, &joining) : 0;
    }
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        mesh->indices[i] = vertices[mesh->indices[i]];
    }
    for (size_t i = 0; i < count; i++) {
        obj->first_vertices[part->corners[i].position] = SCENE_OBJ_NONE;
    }
    copy_corners(obj, part, (struct chosen){joining.corners, joining.count}, mesh);
    free(joining.next);
    free(joining.corners);
    free(vertices);
}

// Meshes --------------------------------------------------------------------------------------------

// Make the indices of a part, which are numbers of its corners. Where its corners are joined, polygons are cut by the
// positions of the file, and else by those of the mesh.
static void make_indices(struct obj *obj, const struct part *part, struct scene_mesh *mesh,
                         struct scene_polygons *polygons)
{
    const bool triangles = part->key.primitive == SCENE_PRIMITIVE_TRIANGLES;
    const struct scene_mesh all = {.positions = obj->positions};
    size_t count = 0;
    for (size_t i = 0; i < part->size_count; i++) {
        count += triangles ? 3 * ((size_t)part->sizes[i] - 2) : part->sizes[i];
    }
    if (count > UINT32_MAX) {
        scene_import_fail(obj->import, "has too many faces");
    }
    mesh->index_count = (uint32_t)count;
    mesh->indices = scene_import_allocate_any(obj->import, count, sizeof *mesh->indices);
    uint32_t *next = mesh->indices, first = 0;
    uint32_t *polygon = NULL;
    size_t polygon_capacity = 0;
    for (size_t i = 0; i < part->size_count; first += part->sizes[i++]) {
        const uint32_t size = part->sizes[i];
        scene_import_reserve(obj->import, &polygon, &polygon_capacity, size, sizeof *polygon);
        for (uint32_t k = 0; k < size && !triangles; k++) {
            *next++ = first + k;
        }
        if (!triangles) {
            continue;
        }
        for (uint32_t k = 0; k < size; k++) {
            polygon[k] = obj->joins_corners ? part->corners[first + k].position : first + k;
        }
        scene_import_triangulate(obj->import, obj->joins_corners ? &all : mesh, polygon, size, next);
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
    struct scene_polygons polygons = {.count = 0};
    if (!obj->joins_corners) {
        copy_all(obj, part, &mesh);
    }
    make_indices(obj, part, &mesh, &polygons);
    if (obj->joins_corners) {
        join_corners(obj, part, &mesh);
    }
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
    // Primitives with positions that are not finite are left out later, and with them the first corners of vertices.
    obj->joins_corners =
        obj->positions != NULL && scene_import_finite((const float *)obj->positions, 3 * obj->position_count);
    if (obj->joins_corners) {
        const size_t size = obj->position_count * sizeof *obj->first_vertices;
        obj->first_vertices =
            scene_import_allocate_any(obj->import, obj->position_count, sizeof *obj->first_vertices);
        memset(obj->first_vertices, 0xff, size);
    }
    for (size_t i = 0; i < obj->part_count; i++) {
        add_part(obj, &obj->parts[i]);
    }
    free(obj->first_vertices);
}
