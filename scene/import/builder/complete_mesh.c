// SPDX-License-Identifier: MIT
// Completes one mesh: arrays of a file become what struct scene_mesh promises.
#include "complete_mesh.h"

#include <stdlib.h>

#include "numbers.h"
#include "pieces.h"
#include "vertices.h"

static void drop_infinite_primitives(struct scene_import *import, struct scene_mesh *mesh, uint32_t *polygons)
{
    if (scene_import_finite(mesh->positions[0], 3 * (size_t)mesh->vertex_count)) {
        return;
    }
    const uint32_t corners = scene_mesh_corners(mesh);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < mesh->index_count; i += corners) {
        bool finite = true;
        for (uint32_t k = 0; k < corners; k++) {
            finite = finite && scene_import_finite(mesh->positions[mesh->indices[i + k]], 3);
        }
        if (finite && polygons != NULL) {
            polygons[kept / corners] = polygons[i / corners];
        }
        for (uint32_t k = 0; k < corners && finite; k++) {
            mesh->indices[kept++] = mesh->indices[i + k];
        }
    }
    if (kept < mesh->index_count) {
        scene_import_warn(
            import, "mesh \"%s\": primitives with positions that are not finite are left out, %u of them",
            mesh->name, (mesh->index_count - kept) / corners);
    }
    mesh->index_count = kept;
}

static void zero_what_is_not_finite(float *values, size_t count)
{
    if (values == NULL || scene_import_finite(values, count)) {
        return;
    }
    for (size_t i = 0; i < count; i++) {
        if (!scene_import_finite(&values[i], 1)) {
            values[i] = 0;
        }
    }
}

// Scale to length 1. Return false when there is no direction in the vector.
static bool normalize(float vector[3])
{
    const double x = vector[0], y = vector[1], z = vector[2];
    const double square = x * x + y * y + z * z;
    if (!(square > 1e-60 && square < 1e60)) {
        return false;
    }
    const double length = __builtin_sqrt(square);
    vector[0] = (float)(x / length);
    vector[1] = (float)(y / length);
    vector[2] = (float)(z / length);
    return true;
}

// Make the normals of the file unit vectors. A mesh with a normal that has no direction loses them all.
static void check_normals(struct scene_import *import, struct scene_mesh *mesh)
{
    bool good = mesh->normals != NULL;
    for (uint32_t i = 0; i < mesh->vertex_count && good; i++) {
        good = normalize(mesh->normals[i]);
    }
    if (good || mesh->normals == NULL) {
        return;
    }
    scene_import_warn(import, "mesh \"%s\" has normals of no length; they are made from its faces",
                      mesh->name);
    free(mesh->normals);
    mesh->normals = NULL;
}

static void check_tangents(struct scene_mesh *mesh)
{
    bool good = mesh->tangents != NULL && mesh->normals != NULL;
    for (uint32_t i = 0; i < mesh->vertex_count && good; i++) {
        good = normalize(mesh->tangents[i]);
        mesh->tangents[i][3] = mesh->tangents[i][3] < 0 ? -1.0f : 1.0f;
    }
    if (good) {
        return;
    }
    free(mesh->tangents);
    mesh->tangents = NULL;
}

// Return the slot whose texture coordinates tangents follow. Return NULL if the material needs none.
static const struct scene_texture_slot *find_tangent_slot(const struct scene_material *material)
{
    const struct scene_texture_slot *slots = material->slots;
    const bool turned = material->layers.used && material->layers.anisotropy > 0;
    return slots[SCENE_SLOT_NORMAL].image >= 0             ? &slots[SCENE_SLOT_NORMAL]
           : slots[SCENE_SLOT_CLEARCOAT_NORMAL].image >= 0 ? &slots[SCENE_SLOT_CLEARCOAT_NORMAL]
           : turned                                        ? &slots[SCENE_SLOT_ANISOTROPY]
                                                           : NULL;
}

static void complete(struct scene_import *import, struct scene_mesh *mesh, enum scene_import_normals normals,
                     bool join, uint32_t *polygons)
{
    if (mesh->vertex_count == 0) {
        mesh->index_count = 0;
    }
    const uint32_t rest = mesh->index_count % scene_mesh_corners(mesh);
    if (rest > 0) {
        scene_import_warn(import, "mesh \"%s\": its last %u corners make no whole %s and are left out",
                          mesh->name, rest, mesh->primitive == SCENE_PRIMITIVE_LINES ? "line" : "triangle");
    }
    mesh->index_count -= rest;
    if (mesh->index_count > 0) {
        drop_infinite_primitives(import, mesh, polygons);
    }
    scene_import_drop_unused_vertices(import, mesh);
    if (mesh->vertex_count == 0) {
        return;
    }
    for (int set = 0; set < SCENE_UV_SETS; set++) {
        zero_what_is_not_finite((float *)mesh->uvs[set], 2 * (size_t)mesh->vertex_count);
    }
    zero_what_is_not_finite((float *)mesh->colors, 4 * (size_t)mesh->vertex_count);
    check_normals(import, mesh);
    check_tangents(mesh);
    const bool are_distinct = join && scene_import_join_vertices(import, mesh); // by their positions
    if (mesh->primitive != SCENE_PRIMITIVE_TRIANGLES) {
        return;
    }
    const bool has_normals = mesh->normals != NULL;
    if (!has_normals) {
        scene_import_make_normals(import, mesh, normals, polygons, are_distinct);
        if (normals == SCENE_IMPORT_FLAT) {
            scene_import_join_vertices(import,
                                       // The triangles of one flat face share their vertices again.
                                       mesh);
        }
    }
    const struct scene_texture_slot *slot = find_tangent_slot(&import->model.materials[mesh->material]);
    if (slot == NULL || mesh->uvs[slot->uv_set] == NULL) {
        free(mesh->tangents);
        mesh->tangents = NULL;
    } else if (mesh->tangents == NULL) {
        scene_import_make_tangents(import, mesh, slot);
    }
    if (has_normals && import->sides_are_open) {
        scene_import_turn_normals(import, mesh);
    }
}

// What a mesh is completed with.
struct completion {
    enum scene_import_normals normals;
    bool join;
};

static void complete_piece(struct scene_import *import, struct scene_mesh *mesh, uint32_t *polygons,
                           const void *context)
{
    const struct completion *const completion = context;
    complete(import, mesh, completion->normals, completion->join, polygons);
}

void scene_import_complete_polygons(struct scene_import *import, uint32_t index,
                                    enum scene_import_normals normals, bool join, uint32_t *polygons)
{
    const struct completion completion = {normals, join};
    if (import->model.meshes[index].exact != NULL) {
        scene_import_cut_exact(import, index, polygons, complete_piece, &completion);
    } else {
        complete(import, &import->model.meshes[index], normals, join, polygons);
    }
}

void scene_import_complete_mesh(struct scene_import *import, uint32_t index,
                                enum scene_import_normals normals, bool join)
{
    scene_import_complete_polygons(import, index, normals, join, NULL);
}
