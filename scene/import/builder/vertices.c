// SPDX-License-Identifier: MIT
// Vertices that are equal are found with a table of their bytes.
#include "vertices.h"

#include <stdlib.h>
#include <string.h>

static const uint32_t none = UINT32_MAX;

// Return what an array has of some vertices, and free the array if it is given away.
static void *take(struct scene_import *import, void *array, size_t size, const uint32_t *source,
                  uint32_t count, bool is_given)
{
    if (array == NULL) {
        return NULL;
    }
    char *const taken = scene_import_allocate(import, count, size);
    for (uint32_t i = 0; i < count; i++) {
        memcpy(taken + i * size, (const char *)array + source[i] * size, size);
    }
    if (is_given) {
        free(array);
    }
    return taken;
}

static void take_vertices(struct scene_import *import, struct scene_mesh *mesh, const uint32_t *source,
                          uint32_t count, bool are_given)
{
    mesh->positions = take(import, mesh->positions, sizeof *mesh->positions, source, count, are_given);
    mesh->exact = take(import, mesh->exact, sizeof *mesh->exact, source, count, are_given);
    mesh->normals = take(import, mesh->normals, sizeof *mesh->normals, source, count, are_given);
    mesh->tangents = take(import, mesh->tangents, sizeof *mesh->tangents, source, count, are_given);
    for (int set = 0; set < SCENE_UV_SETS; set++) {
        mesh->uvs[set] = take(import, mesh->uvs[set], sizeof *mesh->uvs[set], source, count, are_given);
    }
    mesh->colors = take(import, mesh->colors, sizeof *mesh->colors, source, count, are_given);
    mesh->vertex_count = count;
}

void scene_import_copy_vertices(struct scene_import *import, struct scene_mesh *mesh, const uint32_t *source,
                                uint32_t count)
{
    take_vertices(import, mesh, source, count, false);
}

void scene_import_gather_vertices(struct scene_import *import, struct scene_mesh *mesh,
                                  const uint32_t *source, uint32_t count)
{
    take_vertices(import, mesh, source, count, true);
}

void scene_import_drop_unused_vertices(struct scene_import *import, struct scene_mesh *mesh)
{
    uint32_t *place = scene_import_allocate(import, mesh->vertex_count, sizeof *place);
    uint32_t used = 0;
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        used += place[mesh->indices[i]] == 0;
        place[mesh->indices[i]] = 1;
    }
    if (used == mesh->vertex_count) {
        free(place);
        return;
    }
    uint32_t *source = scene_import_allocate(import, used, sizeof *source);
    uint32_t next = 0;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        if (place[i] != 0) {
            source[next] = i;
            place[i] = next++;
        }
    }
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        mesh->indices[i] = place[mesh->indices[i]];
    }
    scene_import_gather_vertices(import, mesh, source, used);
    free(source);
    free(place);
}

// A table of vertices by content. A slot holds a vertex or none. Twice as many slots as vertices keep the runs of
// occupied slots short.
struct vertex_table {
    uint32_t *slots;
    uint32_t mask;
};

static struct vertex_table make_table(struct scene_import *import, uint32_t vertices)
{
    size_t size = 16;
    while (size < (size_t)vertices * 2) {
        size *= 2;
    }
    struct vertex_table table = {scene_import_allocate(import, size, sizeof(uint32_t)), (uint32_t)(size - 1)};
    memset(table.slots, 0xff, size * sizeof(uint32_t));
    return table;
}

static uint64_t mix(uint64_t hash, const void *bytes, size_t size)
{
    for (size_t i = 0; i < size; i += sizeof(uint32_t)) {
        uint32_t word;
        memcpy(&word, (const char *)bytes + i, sizeof word);
        hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 29;
    }
    return hash;
}

uint32_t *scene_import_weld_positions(struct scene_import *import, const struct scene_mesh *mesh)
{
    uint32_t *group = scene_import_allocate(import, mesh->vertex_count, sizeof *group);
    struct vertex_table table = make_table(import, mesh->vertex_count);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const float *p = mesh->positions[i];
        const float key[3] = {p[0] + 0.0f, p[1] + 0.0f, p[2] + 0.0f}; // −0 and 0 are one place
        uint32_t slot = (uint32_t)mix(0, key, sizeof key) & table.mask;
        for (; table.slots[slot] != none; slot = (slot + 1) & table.mask) {
            const float *q = mesh->positions[table.slots[slot]];
            if (q[0] == p[0] && q[1] == p[1] && q[2] == p[2]) {
                break;
            }
        }
        if (table.slots[slot] == none) {
            table.slots[slot] = i;
        }
        group[i] = table.slots[slot];
    }
    free(table.slots);
    return group;
}

// The arrays of a mesh as bytes, for comparing whole vertices.
struct vertex_bytes {
    const char *arrays[6];
    size_t sizes[6];
    int count;
};

static struct vertex_bytes bytes_of(const struct scene_mesh *mesh)
{
    struct vertex_bytes bytes = {.count = 0};
    const void *arrays[] = {mesh->positions, mesh->normals, mesh->tangents,
                            mesh->uvs[0],    mesh->uvs[1],  mesh->colors};
    const size_t sizes[] = {12, 12, 16, 8, 8, 16};
    for (int i = 0; i < 6; i++) {
        if (arrays[i] != NULL) {
            bytes.arrays[bytes.count] = arrays[i];
            bytes.sizes[bytes.count++] = sizes[i];
        }
    }
    return bytes;
}

static bool same_vertex(const struct vertex_bytes *bytes, uint32_t a, uint32_t b)
{
    for (int i = 0; i < bytes->count; i++) {
        if (memcmp(bytes->arrays[i] + a * bytes->sizes[i], bytes->arrays[i] + b * bytes->sizes[i],
                   bytes->sizes[i]) != 0) {
            return false;
        }
    }
    return true;
}

void scene_import_join_vertices(struct scene_import *import, struct scene_mesh *mesh)
{
    const struct vertex_bytes bytes = bytes_of(mesh);
    struct vertex_table table = make_table(import, mesh->vertex_count);
    uint32_t *place = scene_import_allocate(import, mesh->vertex_count, sizeof *place);
    uint32_t *source = scene_import_allocate(import, mesh->vertex_count, sizeof *source);
    uint32_t count = 0;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        uint64_t hash = 0;
        for (int k = 0; k < bytes.count; k++) {
            hash = mix(hash, bytes.arrays[k] + i * bytes.sizes[k], bytes.sizes[k]);
        }
        uint32_t slot = (uint32_t)hash & table.mask;
        while (table.slots[slot] != none && !same_vertex(&bytes, table.slots[slot], i)) {
            slot = (slot + 1) & table.mask;
        }
        if (table.slots[slot] == none) {
            table.slots[slot] = i;
            place[i] = count;
            source[count++] = i;
        } else {
            place[i] = place[table.slots[slot]];
        }
    }
    if (count < mesh->vertex_count) {
        for (uint32_t i = 0; i < mesh->index_count; i++) {
            mesh->indices[i] = place[mesh->indices[i]];
        }
        scene_import_gather_vertices(import, mesh, source, count);
    }
    free(table.slots);
    free(place);
    free(source);
}
