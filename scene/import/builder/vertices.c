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
    char *const taken = scene_import_allocate_any(import, count, size);
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
    unsigned char *const is_used = scene_import_allocate(import, mesh->vertex_count, sizeof *is_used);
    uint32_t used = 0;
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        is_used[mesh->indices[i]] = 1;
    }
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        used += is_used[i];
    }
    if (used < mesh->vertex_count) {
        uint32_t *const place = scene_import_allocate_any(import, mesh->vertex_count, sizeof *place);
        uint32_t *const source = scene_import_allocate_any(import, used, sizeof *source);
        uint32_t next = 0;
        for (uint32_t i = 0; i < mesh->vertex_count; i++) {
            if (is_used[i] != 0) {
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
    free(is_used);
}

// A table of vertices by content. A slot holds a vertex or none. Twice as many slots as vertices keep the runs of
// occupied slots short. Above the bits of the vertex stand some of its hash, so that another vertex of a run is seldom
// looked at: its bytes are far away in memory.
struct vertex_table {
    uint32_t *slots;
    uint32_t mask;
    uint32_t vertex_bits; // all ones are no vertex
    uint32_t count;       // slots that hold a vertex
};

// Make a table of at least so many slots, of a mesh of so many vertices.
static struct vertex_table make_table(struct scene_import *import, size_t least, uint32_t vertices)
{
    size_t size = 16, bits = 16;
    while (size < least) {
        size *= 2;
    }
    while (bits <= vertices) {
        bits *= 2;
    }
    struct vertex_table table = {.slots = scene_import_allocate_any(import, size, sizeof(uint32_t)),
                                 .mask = (uint32_t)(size - 1),
                                 .vertex_bits = (uint32_t)(bits - 1)};
    memset(table.slots, 0xff, size * sizeof(uint32_t));
    return table;
}

// Return a word of 8 bytes.
static uint64_t word_at(const void *bytes)
{
    uint64_t word;
    memcpy(&word, bytes, sizeof word);
    return word;
}

// Add two words to a hash.
static uint64_t mix(uint64_t hash, uint64_t first, uint64_t second)
{
    const uint64_t factor = 0x9e3779b97f4a7c15u;
    hash = (hash ^ first) * factor;
    hash = (hash ^ hash >> 32 ^ second) * factor;
    return hash ^ hash >> 32;
}

// Return the bits of a number, of which −0 has those of 0.
static uint64_t bits_of(float number)
{
    const float sum = number + 0.0f;
    uint32_t bits;
    memcpy(&bits, &sum, sizeof bits);
    return bits;
}

// The arrays of a mesh as bytes, for comparing whole vertices.
struct vertex_bytes {
    const char *arrays[6];
    size_t sizes[6];
    int count;
    bool are_places; // vertices are equal at one place, where −0 and 0 are one number
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

static const float *place_of(const struct vertex_bytes *bytes, uint32_t vertex)
{
    return (const float *)bytes->arrays[0] + 3 * (size_t)vertex;
}

static inline uint64_t hash_of(const struct vertex_bytes *bytes, uint32_t vertex)
{
    uint64_t hash = 0;
    if (bytes->are_places) {
        const float *const p = place_of(bytes, vertex);
        return mix(hash, bits_of(p[0]) | bits_of(p[1]) << 32, bits_of(p[2]));
    }
    for (int k = 0; k < bytes->count; k++) {
        // The first 8 bytes of an element and its last are all of its 8 to 16.
        const char *const element = bytes->arrays[k] + vertex * bytes->sizes[k];
        hash = mix(hash, word_at(element), word_at(element + bytes->sizes[k] - 8));
    }
    return hash;
}

static inline bool same_vertex(const struct vertex_bytes *bytes, uint32_t a, uint32_t b)
{
    if (bytes->are_places) {
        const float *const p = place_of(bytes, a), *const q = place_of(bytes, b);
        return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
    }
    for (int i = 0; i < bytes->count; i++) {
        const size_t size = bytes->sizes[i];
        const char *const one = bytes->arrays[i] + a * size, *const other = bytes->arrays[i] + b * size;
        if (word_at(one) != word_at(other) || word_at(one + size - 8) != word_at(other + size - 8)) {
            return false;
        }
    }
    return true;
}

enum { SOME = 32 }; // slots that are on their way from memory together

// Find the hashes of some vertices, and ask for their slots.
static uint32_t ask(const struct vertex_bytes *bytes, const struct vertex_table *table, uint32_t start,
                    uint32_t count, uint64_t hashes[SOME])
{
    const uint32_t some = count - start < SOME ? count - start : SOME;
    for (uint32_t i = 0; i < some; i++) {
        hashes[i] = hash_of(bytes, start + i);
        __builtin_prefetch(&table->slots[(uint32_t)hashes[i] & table->mask], 1);
    }
    return some;
}

// Return the first vertex that is equal to one. Add the vertex if there is none.
static uint32_t find_or_add(const struct vertex_bytes *bytes, struct vertex_table *table, uint32_t vertex,
                            uint64_t hash)
{
    const uint32_t bits = table->vertex_bits, mark = (uint32_t)(hash >> 32) & ~bits;
    uint32_t slot = (uint32_t)hash & table->mask, found = table->slots[slot];
    while (found != none && ((found & ~bits) != mark || !same_vertex(bytes, found & bits, vertex))) {
        slot = (slot + 1) & table->mask;
        found = table->slots[slot];
    }
    if (found == none) {
        table->slots[slot] = mark | vertex;
        table->count++;
        return vertex;
    }
    return found & bits;
}

// Make room for some vertices more. No two that are in the table are equal.
static void grow(struct scene_import *import, const struct vertex_bytes *bytes, struct vertex_table *table,
                 uint32_t vertices)
{
    const struct vertex_table before = *table;
    if (2 * ((size_t)before.count + SOME) <= (size_t)before.mask + 1) {
        return;
    }
    *table = make_table(import, 4 * ((size_t)before.mask + 1), vertices);
    for (size_t i = 0; i <= before.mask; i++) {
        if (before.slots[i] != none) {
            const uint32_t vertex = before.slots[i] & before.vertex_bits;
            uint32_t slot = (uint32_t)hash_of(bytes, vertex) & table->mask;
            while (table->slots[slot] != none) {
                slot = (slot + 1) & table->mask;
            }
            table->slots[slot] = before.slots[i];
        }
    }
    table->count = before.count;
    free(before.slots);
}

// Write the first vertex that is equal to each to `first`, which is itself where none before is. A table for the number
// of different vertices that is expected fits the caches better than one for all.
static void find_first(struct scene_import *import, const struct vertex_bytes *bytes, uint32_t count,
                       uint32_t expected, uint32_t *first)
{
    struct vertex_table table = make_table(import, 2 * ((size_t)expected + SOME), count);
    uint64_t hashes[2][SOME];
    uint32_t some = ask(bytes, &table, 0, count, hashes[0]);
    for (uint32_t start = 0, turn = 0; some > 0; turn ^= 1) {
        const uint32_t here = some;
        grow(import, bytes, &table, count);
        some = ask(bytes, &table, start + here, count, hashes[turn ^ 1]);
        for (uint32_t i = 0; i < here; i++) {
            first[start + i] = find_or_add(bytes, &table, start + i, hashes[turn][i]);
        }
        start += here;
    }
    free(table.slots);
}

static bool has_negative_zero(const struct scene_mesh *mesh)
{
    bool found = false;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        for (int c = 0; c < 3; c++) {
            found |= mesh->positions[i][c] == 0 && __builtin_signbit(mesh->positions[i][c]);
        }
    }
    return found;
}

uint32_t *scene_import_weld_positions(struct scene_import *import, const struct scene_mesh *mesh,
                                      bool are_distinct)
{
    uint32_t *const group = scene_import_allocate_any(import, mesh->vertex_count, sizeof *group);
    if (are_distinct && !has_negative_zero(mesh)) {
        for (uint32_t i = 0; i < mesh->vertex_count; i++) {
            group[i] = i;
        }
        return group;
    }
    const struct vertex_bytes places = {.arrays = {(const char *)mesh->positions}, .are_places = true};
    find_first(import, &places, mesh->vertex_count, mesh->vertex_count, group);
    return group;
}

bool scene_import_join_vertices(struct scene_import *import, struct scene_mesh *mesh)
{
    uint32_t *const place = scene_import_allocate_any(import, mesh->vertex_count, sizeof *place);
    uint32_t *const source = scene_import_allocate_any(import, mesh->vertex_count, sizeof *source);
    const struct vertex_bytes bytes = bytes_of(mesh);
    uint32_t count = 0;
    // Where each corner has a vertex of its own, six stand at most places.
    const uint32_t usual = mesh->vertex_count / (mesh->vertex_count < mesh->index_count ? 1 : 4);
    find_first(import, &bytes, mesh->vertex_count, usual, place);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        if (place[i] == i) {
            source[count] = i;
            place[i] = count++;
        } else {
            place[i] = place[place[i]]; // the first vertex has its new number
        }
    }
    if (count < mesh->vertex_count) {
        for (uint32_t i = 0; i < mesh->index_count; i++) {
            mesh->indices[i] = place[mesh->indices[i]];
        }
        scene_import_gather_vertices(import, mesh, source, count);
    }
    free(place);
    free(source);
    return bytes.count == 1;
}
