// SPDX-License-Identifier: MIT
// Around most points of most meshes the faces are even: they lie near one direction, which is the normal of the point.
// One pass over the faces finds these directions, and a second one the points where a face is not near. The corners of
// these alone are sorted by point, and compared with each other.
#include "smooth.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "face_weights.h"
#include "vector.h"
#include "vertices.h"

// The cosine of 60°. Two faces that meet at a sharper angle have an edge between them that is meant to be seen.
// Neighbours on anything modelled as round meet at less; the faces of boxes and the rims of pipes meet at more.
static const double usual_crease_cosine = 0.5;

// The cosine of 30°. Programs that make quads of triangles in pairs make some across an edge that is meant to be seen.
// Quads of round surfaces are folded by less.
static const double fold_cosine = 0.8660254037844387;

// The cosine of 30°. Of faces that are no further from one axis, no two are a crease apart.
static const double usual_even_cosine = 0.8660254037844387;

// The most faces around one point that are compared pair by pair. Where more meet, as only a hostile file has it, all
// are averaged.
enum { MOST_FACES = 256 };

// What is known of a point: of the first vertex at a place, in which all vertices there are one.
struct point {
    double axis[3];      // sum of the weighted normals of the faces around it, and then its direction
    uint32_t face_count; // number of corners at it; later the new vertex of an even point
    bool is_uneven;      // its corners are compared with each other
};

// A corner at an uneven point.
struct corner {
    double weight;
    uint32_t number; // place in the indices of the mesh
    uint32_t vertex; // its new vertex
};

struct smoothing {
    const struct scene_mesh *mesh;
    double crease_cosine, even_cosine;
    double (*faces)[3];       // unit normals
    const uint32_t *polygons; // polygon of each face; NULL if no face was cut from one
    bool *folded;             // faces next to a fold of their polygon; NULL if there are no polygons
    uint32_t *point;          // point of each vertex: the first vertex at its place
    struct point *points;
    uint32_t *start; // corners around an uneven point p are start[p] .. start[p + 1]
    struct corner *corners;
    uint32_t
        *newest; // number, from 1, of the last new vertex that was made from each vertex; 0 if there is none
    uint32_t *source; // vertex from which each new vertex was made
    float (*normals)[3];
    uint32_t count; // number of new vertices
};

static uint32_t face_total(const struct smoothing *smoothing)
{
    return smoothing->mesh->index_count / 3;
}

static uint32_t point_of(const struct smoothing *smoothing, size_t corner)
{
    return smoothing->point[smoothing->mesh->indices[corner]];
}

// Even points ---------------------------------------------------------------------------------------

static void add_batch(struct smoothing *smoothing, const struct scene_face_batch *batch)
{
    const uint32_t *const indices = smoothing->mesh->indices, *const point_of_vertex = smoothing->point;
    struct point *const points = smoothing->points;
    double(*const faces)[3] = smoothing->faces;
    for (uint32_t i = 0; i < batch->count; i++) {
        const size_t face = batch->faces[i];
        const double normal[3] = {batch->normals[0][i], batch->normals[1][i], batch->normals[2][i]};
        memcpy(faces[face], normal, sizeof normal);
        for (uint32_t k = 0; k < 3; k++) {
            struct point *const point = &points[point_of_vertex[indices[3 * face + k]]];
            point->face_count++;
            for (int c = 0; c < 3; c++) {
                point->axis[c] += normal[c] * batch->weights[k][i];
            }
        }
    }
}

// Find the normals of all faces and the axes of all points.
static void sum_all(struct smoothing *smoothing)
{
    const uint32_t total = face_total(smoothing);
    struct scene_face_batch batch;
    for (uint32_t face = 0; face < total; face += batch.count) {
        batch.count = total - face < SCENE_FACE_BATCH ? total - face : SCENE_FACE_BATCH;
        for (uint32_t i = 0; i < batch.count; i++) {
            batch.faces[i] = face + i;
            for (uint32_t k = 0; k < 3; k++) {
                // Points come from memory while the batch is weighed.
                __builtin_prefetch(&smoothing->points[point_of(smoothing, 3 * (size_t)(face + i) + k)], 1);
            }
        }
        scene_face_batch_weigh(smoothing->mesh, &batch);
        add_batch(smoothing, &batch);
    }
    for (uint32_t point = 0; point < smoothing->mesh->vertex_count; point++) {
        scene_vector_unit(smoothing->points[point].axis);
    }
}

// Return true if two faces are of one polygon, which is folded between them.
static bool are_folded(const struct smoothing *smoothing, uint32_t a, uint32_t b)
{
    return smoothing->polygons != NULL && smoothing->polygons[a] == smoothing->polygons[b] &&
           scene_dot(smoothing->faces[a], smoothing->faces[b]) < fold_cosine;
}

// Mark the faces next to folds. Faces of one polygon follow each other.
static void find_folds(struct scene_import *import, struct smoothing *smoothing, const uint32_t *polygons)
{
    const uint32_t count = face_total(smoothing);
    smoothing->polygons = polygons;
    smoothing->folded =
        polygons == NULL ? NULL : scene_import_allocate(import, count, sizeof *smoothing->folded);
    for (uint32_t i = 1; polygons != NULL && i < count; i++) {
        if (are_folded(smoothing, i - 1, i)) {
            smoothing->folded[i - 1] = smoothing->folded[i] = true;
        }
    }
}

// Mark the points at which several vertices stand, a face is more than 30° from the axis or one is next to a fold. No
// two faces around another point are a crease apart. Return the number of corners at marked points.
static uint32_t find_uneven(struct smoothing *smoothing)
{
    const struct scene_mesh *const mesh = smoothing->mesh;
    struct point *const points = smoothing->points;
    const uint32_t *const point_of_vertex = smoothing->point, total = face_total(smoothing);
    double(*const faces)[3] = smoothing->faces;
    const bool *const folded = smoothing->folded;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        points[point_of_vertex[i]].is_uneven |= point_of_vertex[i] != i;
    }
    for (uint32_t face = 0; face < total; face++) {
        const bool is_folded = folded != NULL && folded[face];
        const double normal[3] = {faces[face][0], faces[face][1], faces[face][2]};
        const uint32_t *const corners = mesh->indices + 3 * (size_t)face;
        for (uint32_t k = 0; k < 3; k++) {
            struct point *const point = &points[point_of_vertex[corners[k]]];
            if (is_folded || !(scene_dot(point->axis, normal) >= smoothing->even_cosine)) {
                point->is_uneven |= point->face_count <= MOST_FACES;
            }
        }
    }
    uint32_t corners = 0;
    for (uint32_t point = 0; point < mesh->vertex_count; point++) {
        corners += points[point].is_uneven ? points[point].face_count : 0;
    }
    return corners;
}

// Uneven points -------------------------------------------------------------------------------------

// Return the new vertex with this source and normal among those made since `first`. Add it if there is none.
static uint32_t find_or_add(struct smoothing *smoothing, uint32_t first, uint32_t source,
                            const float normal[3])
{
    for (uint32_t i = smoothing->newest[source]; i > first; i--) {
        if (smoothing->source[i - 1] == source &&
            memcmp(smoothing->normals[i - 1], normal, sizeof smoothing->normals[0]) == 0) {
            return i - 1;
        }
    }
    smoothing->newest[source] = smoothing->count + 1;
    smoothing->source[smoothing->count] = source;
    memcpy(smoothing->normals[smoothing->count], normal, sizeof smoothing->normals[0]);
    return smoothing->count++;
}

// Some of the corners around one point.
struct corners {
    struct corner *list;
    uint32_t count;
};

static const double *face_of(const struct smoothing *smoothing, const struct corner *corner)
{
    return smoothing->faces[corner->number / 3];
}

// Sum over the corners whose faces are no further than a crease from `axis`. If `axis` is NULL, sum over all.
static void sum_faces(const struct smoothing *smoothing, struct corners corners, const double *axis,
                      double sum[3])
{
    memset(sum, 0, 3 * sizeof *sum);
    for (uint32_t i = 0; i < corners.count; i++) {
        const double *face = face_of(smoothing, &corners.list[i]);
        if (axis != NULL && scene_dot(axis, face) < smoothing->crease_cosine) {
            continue;
        }
        for (int c = 0; c < 3; c++) {
            sum[c] += face[c] * corners.list[i].weight;
        }
    }
}

static bool all_within(const struct smoothing *smoothing, struct corners corners, const double axis[3],
                       double cosine)
{
    uint32_t near = 0;
    while (near < corners.count && scene_dot(axis, face_of(smoothing, &corners.list[near])) >= cosine) {
        near++;
    }
    return near == corners.count;
}

// Return true if the faces of two corners at one point share an edge there that is no crease.
static bool are_joined(const struct smoothing *smoothing, const struct corner *a, const struct corner *b)
{
    const uint32_t corners[2] = {a->number, b->number};
    uint32_t ends[2][2]; // points at the other ends of each face's two edges
    for (int i = 0; i < 2; i++) {
        const uint32_t first = corners[i] / 3 * 3;
        for (uint32_t k = 0; k < 2; k++) {
            ends[i][k] = point_of(smoothing, first + (corners[i] + 1 + k) % 3);
        }
    }
    const bool meet = ends[0][0] == ends[1][0] || ends[0][0] == ends[1][1] || ends[0][1] == ends[1][0] ||
                      ends[0][1] == ends[1][1];
    return meet && !are_folded(smoothing, corners[0] / 3, corners[1] / 3) &&
           scene_dot(face_of(smoothing, a), face_of(smoothing, b)) >= smoothing->crease_cosine;
}

// Reorder the corners so that corners whose faces are joined, one with the next, stand together. Return how many there
// are in the first group.
static uint32_t gather_group(const struct smoothing *smoothing, struct corners corners)
{
    uint32_t grouped = 1;
    for (uint32_t i = 0; i < grouped; i++) {
        for (uint32_t k = grouped; k < corners.count; k++) {
            if (are_joined(smoothing, &corners.list[i], &corners.list[k])) {
                const struct corner corner = corners.list[k];
                corners.list[k] = corners.list[grouped];
                corners.list[grouped++] = corner;
            }
        }
    }
    return grouped;
}

// Return true if all faces lie within 30° of one axis and none is next to a fold. No two are a crease apart then, so
// that no pairs are compared.
static bool are_even(const struct smoothing *smoothing, struct corners corners)
{
    double axis[3];
    for (uint32_t i = 0; i < corners.count && smoothing->folded != NULL; i++) {
        if (smoothing->folded[corners.list[i].number / 3]) {
            return false;
        }
    }
    sum_faces(smoothing, corners, NULL, axis);
    scene_vector_unit(axis);
    return all_within(smoothing, corners, axis, smoothing->even_cosine);
}

// Give a group its normals. It has one, so that a ridge is not torn where it is a little sharper, unless its faces look
// away from each other, as around the tip of a cone. Each of these faces goes with the faces that are near it.
static void smooth_group(struct smoothing *smoothing, struct corners group, uint32_t first)
{
    double all[3], axis[3];
    float normal[3];
    sum_faces(smoothing, group, NULL, all);
    memcpy(axis, all, sizeof axis);
    scene_vector_unit(axis);
    scene_vector_to_normal(all, normal);
    const bool one = group.count > MOST_FACES || all_within(smoothing, group, axis, smoothing->crease_cosine);
    for (uint32_t i = 0; i < group.count; i++) {
        struct corner *const corner = &group.list[i];
        if (!one) {
            double sum[3];
            sum_faces(smoothing, group, face_of(smoothing, corner), sum);
            scene_vector_to_normal(sum, normal);
        }
        corner->vertex = find_or_add(smoothing, first, smoothing->mesh->indices[corner->number], normal);
    }
}

// Give the corners around one point their new vertices.
static void smooth_point(struct smoothing *smoothing, struct corners corners)
{
    const uint32_t first = smoothing->count;
    while (corners.count > 0) {
        const bool whole = corners.count > MOST_FACES || are_even(smoothing, corners);
        const uint32_t grouped = whole ? corners.count : gather_group(smoothing, corners);
        smooth_group(smoothing, (struct corners){corners.list, grouped}, first);
        corners.list += grouped;
        corners.count -= grouped;
    }
}

// Take the corners at uneven points of the faces of a batch, weighed.
static void take_corners(struct smoothing *smoothing, struct scene_face_batch *batch, uint32_t *next)
{
    scene_face_batch_weigh(smoothing->mesh, batch);
    for (uint32_t i = 0; i < batch->count; i++) {
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t number = 3 * batch->faces[i] + k, point = point_of(smoothing, number);
            if (smoothing->points[point].is_uneven) {
                smoothing->corners[next[point]++] =
                    (struct corner){.weight = batch->weights[k][i], .number = number};
            }
        }
    }
    batch->count = 0;
}

// Sort the corners at uneven points by the point, by counting, and weigh them.
static void sort_corners(struct scene_import *import, struct smoothing *smoothing, uint32_t corners)
{
    const struct scene_mesh *mesh = smoothing->mesh;
    const struct point *const points = smoothing->points;
    smoothing->start =
        scene_import_allocate(import, (size_t)mesh->vertex_count + 2, sizeof *smoothing->start);
    smoothing->corners = scene_import_allocate_any(import, corners, sizeof *smoothing->corners);
    smoothing->newest = scene_import_allocate(import, mesh->vertex_count, sizeof *smoothing->newest);
    uint32_t *next = smoothing->start + 1;
    for (uint32_t point = 0; point < mesh->vertex_count; point++) {
        next[point + 1] = next[point] + (points[point].is_uneven ? points[point].face_count : 0);
    }
    struct scene_face_batch batch = {.count = 0};
    const uint32_t *const point_of_vertex = smoothing->point, total = face_total(smoothing);
    for (uint32_t face = 0; face < total; face++) {
        const uint32_t *const corner = mesh->indices + 3 * (size_t)face;
        if (points[point_of_vertex[corner[0]]].is_uneven || points[point_of_vertex[corner[1]]].is_uneven ||
            points[point_of_vertex[corner[2]]].is_uneven) {
            batch.faces[batch.count++] = face;
        }
        if (batch.count == SCENE_FACE_BATCH) {
            take_corners(smoothing, &batch, next);
        }
    }
    if (batch.count > 0) {
        take_corners(smoothing, &batch, next);
    }
}

// Entry ---------------------------------------------------------------------------------------------

// Make the new vertices, point by point. Set those of the corners at uneven points, and of each even point.
static void make_vertices(struct smoothing *smoothing)
{
    for (uint32_t number = 0; number < smoothing->mesh->vertex_count; number++) {
        struct point *const point = &smoothing->points[number];
        if (point->is_uneven) {
            const uint32_t first = smoothing->start[number], end = smoothing->start[number + 1];
            smooth_point(smoothing, (struct corners){smoothing->corners + first, end - first});
        } else if (point->face_count > 0) {
            smoothing->source[smoothing->count] = number;
            scene_vector_narrow(point->axis, smoothing->normals[smoothing->count]);
            point->face_count = smoothing->count++;
        }
    }
}

// Give the corners of the mesh, of which `corners` are at uneven points, their new vertices.
static void number_corners(struct smoothing *smoothing, uint32_t *indices, uint32_t corners)
{
    const uint32_t vertices = smoothing->mesh->vertex_count, count = smoothing->mesh->index_count;
    const struct point *const points = smoothing->points;
    const struct corner *const list = smoothing->corners;
    // The points of vertices are known no more then. A table of new vertices alone has an eighth of the bytes.
    uint32_t *const new_vertex = smoothing->point;
    for (uint32_t i = 0; i < vertices; i++) {
        new_vertex[i] = points[new_vertex[i]].face_count;
    }
    for (uint32_t i = 0; i < count; i++) {
        indices[i] = new_vertex[indices[i]];
    }
    for (uint32_t i = 0; i < corners; i++) {
        indices[list[i].number] = list[i].vertex;
    }
}

static void release(struct smoothing *smoothing)
{
    void *const arrays[] = {smoothing->faces, smoothing->folded,  smoothing->point,  smoothing->points,
                            smoothing->start, smoothing->corners, smoothing->source, smoothing->newest};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++) {
        free(arrays[i]);
    }
}

void scene_import_make_smooth(struct scene_import *import, struct scene_mesh *mesh, const uint32_t *polygons)
{
    const uint32_t vertices = mesh->vertex_count;
    struct smoothing smoothing = {
        .mesh = mesh, .crease_cosine = usual_crease_cosine, .even_cosine = usual_even_cosine};
    // The axis of faces that all meet within the angle is at most half of it away from each.
    if (import->has_creases) {
        smoothing.crease_cosine = import->crease_cosine;
        smoothing.even_cosine = sqrt((1 + import->crease_cosine) / 2);
    }
    smoothing.point = scene_import_weld_positions(import, mesh);
    smoothing.faces = scene_import_allocate_any(import, face_total(&smoothing), sizeof *smoothing.faces);
    smoothing.points = scene_import_allocate(import, vertices, sizeof *smoothing.points);
    sum_all(&smoothing);
    find_folds(import, &smoothing, polygons);
    const uint32_t corners = find_uneven(&smoothing);
    // A new vertex is of a point, or of a corner at an uneven one.
    const size_t most = (size_t)vertices + corners;
    smoothing.source = scene_import_allocate_any(import, most, sizeof *smoothing.source);
    smoothing.normals = scene_import_allocate_any(import, most, sizeof *smoothing.normals);
    if (corners > 0) {
        sort_corners(import, &smoothing, corners);
    }
    make_vertices(&smoothing);
    if (corners > 0 || smoothing.count < vertices) {
        number_corners(&smoothing, mesh->indices, corners);
        scene_import_gather_vertices(import, mesh, smoothing.source, smoothing.count);
    }
    mesh->normals = smoothing.normals;
    release(&smoothing);
}
