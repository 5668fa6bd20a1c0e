// SPDX-License-Identifier: MIT
// Smoothing groups of a 3DS. Faces that meet are smooth where they have a group in common, and a face in no group is
// flat, but assimp 5.2.5 takes it for smooth with all that it meets. So it gets one of the 32 groups, in which no face
// beside it is. Many programs write no groups at all. There faces are smooth together across edges that are no creases.
#include "smoothing_groups.h"

#include "chunks_3ds.h"
#include "import/builder/vector.h"

#include <stdlib.h>
#include <string.h>

enum { POINT = 12, FACE = 8, GROUP = 4, GROUPS = 32 };

struct mesh {
    size_t points, point_count;
    size_t faces, face_count;
    struct scene_3ds_chunk list; // the faces, and what belongs to them
    size_t list_end;   // where the last chunk of the list ends, behind which may be bytes that are none
    size_t groups;     // place of the groups of the faces, or 0
    uint32_t *corners; // three for each face: points at one place have one number
    uint32_t *sets;    // a bit for each group that a face is in
    uint32_t *parts;   // for each face without a group: the first face of those that it is smooth with
};

struct work {
    struct scene_import *import;
    struct scene_edits *edits;
    const unsigned char *bytes;
};

// Read a count and so many things of a size. Return the place of the first, or 0 if they are not there.
static size_t read_list(struct scene_3ds_chunks content, size_t size, size_t *count)
{
    const size_t length = content.end - content.at;
    *count = length < 2 ? 0 : scene_3ds_number(content.bytes + content.at, 2);
    return *count > 0 && *count <= (length - 2) / size ? content.at + 2 : 0;
}

static struct mesh read_mesh(struct scene_3ds_chunks chunks)
{
    struct mesh mesh = {.points = 0};
    struct scene_3ds_chunk chunk;
    while (scene_3ds_next(&chunks, &chunk)) {
        if (chunk.kind == SCENE_3DS_POINTS) {
            mesh.points = read_list(chunk.content, POINT, &mesh.point_count);
        } else if (chunk.kind == SCENE_3DS_FACES) {
            mesh.faces = read_list(chunk.content, FACE, &mesh.face_count);
            mesh.list = chunk;
        }
    }
    struct scene_3ds_chunks lists = {chunks.bytes, mesh.faces + FACE * mesh.face_count,
                                     mesh.list.content.end};
    while (mesh.faces != 0 && scene_3ds_next(&lists, &chunk)) {
        const bool has_all = (chunk.content.end - chunk.content.at) / GROUP >= mesh.face_count;
        mesh.groups = chunk.kind == SCENE_3DS_SMOOTHING && has_all ? chunk.content.at : mesh.groups;
    }
    mesh.list_end = lists.at;
    return mesh;
}

// A point, and its number.
struct numbered {
    float place[3];
    uint32_t number;
};

static int compare_points(const void *a, const void *b)
{
    return memcmp(a, b, sizeof(float[3]));
}

// Number the points, those at one place alike, and set the corners of faces. Return false if a face refers to a point
// that is not there.
static bool set_corners(const struct work *work, struct mesh *mesh)
{
    struct numbered *const points = scene_import_allocate(work->import, mesh->point_count, sizeof *points);
    uint32_t *const numbers = scene_import_allocate(work->import, mesh->point_count, sizeof *numbers);
    bool are_there = true;
    for (size_t i = 0; i < mesh->point_count; i++) {
        memcpy(points[i].place, work->bytes + mesh->points + POINT * i, POINT);
        for (int c = 0; c < 3; c++) {
            points[i].place[c] += 0.0f; // -0 is 0
        }
        points[i].number = (uint32_t)i;
    }
    qsort(points, mesh->point_count, sizeof *points, compare_points);
    for (size_t i = 0; i < mesh->point_count; i++) {
        const bool is_same = i > 0 && compare_points(&points[i - 1], &points[i]) == 0;
        numbers[points[i].number] = is_same ? numbers[points[i - 1].number] : points[i].number;
    }
    for (size_t i = 0; i < 3 * mesh->face_count; i++) {
        const size_t point = scene_3ds_number(work->bytes + mesh->faces + FACE * (i / 3) + 2 * (i % 3), 2);
        are_there = are_there && point < mesh->point_count;
        mesh->corners[i] = are_there ? numbers[point] : 0;
    }
    free(points);
    free(numbers);
    return are_there;
}

// The edge of a face from one point to another of a greater number.
struct edge {
    uint32_t from, to, face;
};

static int compare_edges(const void *a, const void *b)
{
    const struct edge *const x = a, *const y = b;
    return x->from != y->from ? (x->from > y->from) - (x->from < y->from)
           : x->to != y->to   ? (x->to > y->to) - (x->to < y->to)
                              : (x->face > y->face) - (x->face < y->face);
}

static void find_normal(const struct work *work, const struct mesh *mesh, uint32_t face, double normal[3])
{
    float places[3][3];
    double a[3], b[3];
    for (uint32_t i = 0; i < 3; i++) {
        memcpy(places[i], work->bytes + mesh->points + POINT * (size_t)mesh->corners[3 * face + i], POINT);
    }
    scene_vector_between(places[0], places[1], a);
    scene_vector_between(places[0], places[2], b);
    scene_vector_unit(a);
    scene_vector_unit(b);
    scene_cross(a, b, normal);
    scene_vector_unit(normal);
}

static uint32_t find_part(const struct mesh *mesh, uint32_t face)
{
    while (mesh->parts[face] != face) {
        mesh->parts[face] = mesh->parts[mesh->parts[face]];
        face = mesh->parts[face];
    }
    return face;
}

// Join the faces on both sides of each edge that is no crease, which is one of more than 60 degrees.
static void join_faces(const struct work *work, struct mesh *mesh)
{
    const size_t count = 3 * mesh->face_count;
    struct edge *const edges = scene_import_allocate(work->import, count, sizeof *edges);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t a = mesh->corners[i], b = mesh->corners[i % 3 == 2 ? i - 2u : i + 1u];
        edges[i] = (struct edge){a < b ? a : b, a < b ? b : a, i / 3};
    }
    qsort(edges, count, sizeof *edges, compare_edges);
    for (size_t i = 1; i < count; i++) {
        double before[3], after[3];
        if (edges[i].from != edges[i - 1].from || edges[i].to != edges[i - 1].to) {
            continue;
        }
        find_normal(work, mesh, edges[i - 1].face, before);
        find_normal(work, mesh, edges[i].face, after);
        const uint32_t a = find_part(mesh, edges[i - 1].face), b = find_part(mesh, edges[i].face);
        if (scene_dot(before, after) >= 0.5) {
            mesh->parts[a < b ? b : a] = a < b ? a : b;
        }
    }
    free(edges);
}

// A face of a part.
struct member {
    uint32_t part, face;
};

static int compare_members(const void *a, const void *b)
{
    const struct member *const x = a, *const y = b;
    return x->part != y->part ? (x->part > y->part) - (x->part < y->part)
                              : (x->face > y->face) - (x->face < y->face);
}

// Give each part of faces a group that is none of those of the faces that it meets. Where all are taken, it is any.
static void set_groups(const struct work *work, struct mesh *mesh)
{
    struct member *const members = scene_import_allocate(work->import, mesh->face_count, sizeof *members);
    uint32_t *const taken = scene_import_allocate(work->import, mesh->point_count, sizeof *taken);
    size_t count = 0;
    for (uint32_t i = 0; i < mesh->face_count; i++) {
        for (uint32_t k = 0; k < 3; k++) {
            taken[mesh->corners[3 * i + k]] |= mesh->sets[i];
        }
        if (mesh->sets[i] == 0) {
            members[count++] = (struct member){find_part(mesh, i), i};
        }
    }
    qsort(members, count, sizeof *members, compare_members);
    for (size_t first = 0, end; first < count; first = end) {
        uint32_t near = 0;
        for (end = first; end < count && members[end].part == members[first].part; end++) {
            for (uint32_t k = 0; k < 3; k++) {
                near |= taken[mesh->corners[3 * members[end].face + k]];
            }
        }
        const int group = ~near != 0 ? __builtin_ctz(~near) : (int)(first % GROUPS);
        for (size_t i = first; i < end; i++) {
            mesh->sets[members[i].face] = 1u << group;
            for (uint32_t k = 0; k < 3; k++) {
                taken[mesh->corners[3 * members[i].face + k]] |= 1u << group;
            }
        }
    }
    free(members);
    free(taken);
}

static void write_number(unsigned char *bytes, size_t number, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        bytes[i] = (unsigned char)(number >> 8 * i);
    }
}

// Write another number of 4 bytes.
static void add_number(const struct work *work, size_t at, size_t number)
{
    unsigned char *const bytes = scene_import_allocate(work->import, 4, 1);
    write_number(bytes, number, 4);
    scene_edits_add(work->import, work->edits, (struct scene_edit){at, 4, (char *)bytes, 4});
}

// Add the chunk of groups behind those of the list of faces. Return its size.
static size_t add_chunk(const struct work *work, const struct mesh *mesh)
{
    const size_t size = SCENE_3DS_HEAD + GROUP * mesh->face_count;
    unsigned char *const bytes = scene_import_allocate(work->import, size, 1);
    write_number(bytes, SCENE_3DS_SMOOTHING, 2);
    write_number(bytes + 2, size, 4);
    for (size_t i = 0; i < mesh->face_count; i++) {
        write_number(bytes + SCENE_3DS_HEAD + GROUP * i, mesh->sets[i], GROUP);
    }
    scene_edits_add(work->import, work->edits, (struct scene_edit){mesh->list_end, 0, (char *)bytes, size});
    add_number(work, mesh->list.at + 2, mesh->list.content.end - mesh->list.at + size);
    return size;
}

// Give the faces of a mesh groups. Return how much longer it becomes.
static size_t group_mesh(const struct work *work, struct scene_3ds_chunks chunks)
{
    struct mesh mesh = read_mesh(chunks);
    size_t longer = 0, ungrouped = 0;
    if (mesh.points == 0 || mesh.faces == 0) {
        return 0;
    }
    mesh.corners = scene_import_allocate(work->import, 3 * mesh.face_count, sizeof *mesh.corners);
    mesh.sets = scene_import_allocate(work->import, mesh.face_count, sizeof *mesh.sets);
    mesh.parts = scene_import_allocate(work->import, mesh.face_count, sizeof *mesh.parts);
    for (uint32_t i = 0; i < mesh.face_count; i++) {
        mesh.sets[i] =
            mesh.groups == 0 ? 0 : (uint32_t)scene_3ds_number(work->bytes + mesh.groups + GROUP * i, GROUP);
        mesh.parts[i] = i;
        ungrouped += mesh.sets[i] == 0;
    }
    if (ungrouped > 0 && set_corners(work, &mesh)) {
        if (mesh.groups == 0) {
            join_faces(work, &mesh);
        }
        set_groups(work, &mesh);
        longer = mesh.groups == 0 ? add_chunk(work, &mesh) : 0;
        for (uint32_t i = 0; i < mesh.face_count && mesh.groups != 0; i++) {
            add_number(work, mesh.groups + GROUP * i, mesh.sets[i]);
        }
    }
    free(mesh.corners);
    free(mesh.sets);
    free(mesh.parts);
    return longer;
}

// Give the faces of all meshes within chunks groups. Return how much longer the chunks become.
static size_t group_chunks(const struct work *work, struct scene_3ds_chunks chunks, int depth)
{
    enum { DEEPEST = 4 };
    size_t longer = 0;
    struct scene_3ds_chunk chunk;
    while (depth < DEEPEST && scene_3ds_next(&chunks, &chunk)) {
        const size_t more =
            chunk.kind == SCENE_3DS_MESH ? group_mesh(work, chunk.content)
            : chunk.kind == SCENE_3DS_FILE || chunk.kind == SCENE_3DS_EDITOR || chunk.kind == SCENE_3DS_OBJECT
                ? group_chunks(work, chunk.content, depth + 1)
                : 0;
        if (more > 0) {
            add_number(work, chunk.at + 2, chunk.content.end - chunk.at + more);
        }
        longer += more;
    }
    return longer;
}

void scene_assimp_group_faces(struct scene_import *import, struct scene_edits *edits, const void *bytes,
                              size_t size)
{
    const struct work work = {import, edits, bytes};
    group_chunks(&work, (struct scene_3ds_chunks){bytes, 0, size}, 0);
}
