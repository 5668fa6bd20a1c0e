// SPDX-License-Identifier: MIT
// Around most points of most meshes the faces are even: they lie near one direction, which is the normal of the point.
// One pass over the faces finds these directions, and a second one the points where a face is not near. The corners of
// these alone are sorted by point, and compared with each other.
#include "smooth.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "face_weights.h"
#include "rhw/rhw.h"
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

// A corner at an uneven point.
struct corner {
    double weight;
    uint32_t number; // place among the corners of the faces that are kept
    uint32_t vertex; // its new vertex
};

struct smoothing {
    const struct scene_mesh *mesh;
    const struct scene_face_functions *functions;
    double crease_cosine, even_cosine;
    const uint32_t *polygons; // polygon of each face; NULL if no face was cut from one
    bool *folded;             // faces next to a fold of their polygon; NULL if there are no polygons
    uint32_t *point;          // point of each vertex: the first vertex at its place
    struct scene_face_point *points;
    bool *uneven;                 // points whose corners are compared with each other
    uint32_t *kept;               // faces with a corner at an uneven point
    double (*normals_of_kept)[3]; // their unit normals
    uint32_t *start;              // corners around an uneven point p are start[p] .. start[p + 1]
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

// Return where a corner of a face that is kept stands in the indices of the mesh.
static size_t place_of(const struct smoothing *smoothing, uint32_t number)
{
    return 3 * (size_t)smoothing->kept[number / 3] + number % 3;
}

// Return the next batch of faces, the first of which is `first`, with their points.
static void take_batch(const struct smoothing *smoothing, uint32_t first, struct scene_face_batch *batch)
{
    const uint32_t *const corners = smoothing->mesh->indices + 3 * (size_t)first;
    const uint32_t total = face_total(smoothing);
    batch->count = total - first < SCENE_FACE_BATCH ? total - first : SCENE_FACE_BATCH;
    for (uint32_t i = 0; i < batch->count; i++) {
        batch->faces[i] = first + i;
        for (uint32_t k = 0; k < 3; k++) {
            batch->points[i][k] = smoothing->point[corners[3 * i + k]];
            // Points come from memory while the batch is weighed.
            __builtin_prefetch(&smoothing->points[batch->points[i][k]], 1);
        }
    }
}

// Even points ---------------------------------------------------------------------------------------

// Find the axes of all points.
static void sum_all(struct smoothing *smoothing)
{
    const uint32_t total = face_total(smoothing);
    struct scene_face_batch batch;
    for (uint32_t face = 0; face < total; face += batch.count) {
        take_batch(smoothing, face, &batch);
        smoothing->functions->weigh(smoothing->mesh, &batch);
        smoothing->functions->add(&batch, smoothing->points);
    }
    smoothing->functions->make_directions(smoothing->points, smoothing->mesh->vertex_count);
}

// Mark the faces next to folds. Faces of one polygon follow each other.
static void find_folds(struct scene_import *import, struct smoothing *smoothing, const uint32_t *polygons)
{
    const uint32_t total = face_total(smoothing);
    double before[3] = {0, 0, 0};
    struct scene_face_batch batch;
    smoothing->polygons = polygons;
    smoothing->folded = scene_import_allocate(import, total, sizeof *smoothing->folded);
    for (uint32_t face = 0; face < total; face += batch.count) {
        take_batch(smoothing, face, &batch);
        smoothing->functions->find_normals(smoothing->mesh, &batch);
        for (uint32_t i = 0; i < batch.count; i++) {
            const uint32_t here = face + i;
            const double normal[3] = {batch.normals[0][i], batch.normals[1][i], batch.normals[2][i]};
            if (here > 0 && polygons[here - 1] == polygons[here] && scene_dot(before, normal) < fold_cosine) {
                smoothing->folded[here - 1] = smoothing->folded[here] = true;
            }
            memcpy(before, normal, sizeof before);
        }
    }
}

// Mark the points from whose axis a face of a batch is more than 30°, or at which one is next to a fold.
static void mark_uneven(struct smoothing *smoothing, const struct scene_face_batch *batch)
{
    const struct scene_face_point *const points = smoothing->points;
    const bool *const folded = smoothing->folded;
    const double even_cosine = smoothing->even_cosine;
    for (uint32_t i = 0; i < batch->count; i++) {
        const double normal[3] = {batch->normals[0][i], batch->normals[1][i], batch->normals[2][i]};
        const bool is_folded = folded != NULL && folded[batch->faces[i]];
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t point = batch->points[i][k];
            if (is_folded || !(scene_dot(points[point].sum, normal) >= even_cosine)) {
                smoothing->uneven[point] |= points[point].sum[3] <= MOST_FACES;
            }
        }
    }
}

// Mark the points at which several vertices stand, a face is more than 30° from the axis or one is next to a fold. No
// two faces around another point are a crease apart. Return the number of corners at marked points.
static uint32_t find_uneven(struct smoothing *smoothing)
{
    const uint32_t vertices = smoothing->mesh->vertex_count, total = face_total(smoothing);
    bool *const uneven = smoothing->uneven;
    for (uint32_t i = 0; i < vertices; i++) {
        uneven[smoothing->point[i]] |= smoothing->point[i] != i;
    }
    struct scene_face_batch batch;
    for (uint32_t face = 0; face < total; face += batch.count) {
        take_batch(smoothing, face, &batch);
        smoothing->functions->find_normals(smoothing->mesh, &batch);
        mark_uneven(smoothing, &batch);
    }
    uint32_t corners = 0;
    for (uint32_t point = 0; point < vertices; point++) {
        corners += uneven[point] ? (uint32_t)smoothing->points[point].sum[3] : 0;
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
    return smoothing->normals_of_kept[corner->number / 3];
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

// Return true if the faces of two corners are of one polygon, which is folded between them.
static bool are_folded(const struct smoothing *smoothing, const struct corner *a, const struct corner *b)
{
    const uint32_t *const polygons = smoothing->polygons, *const kept = smoothing->kept;
    return polygons != NULL && polygons[kept[a->number / 3]] == polygons[kept[b->number / 3]] &&
           scene_dot(face_of(smoothing, a), face_of(smoothing, b)) < fold_cosine;
}

// Return true if the faces of two corners at one point share an edge there that is no crease.
static bool are_joined(const struct smoothing *smoothing, const struct corner *a, const struct corner *b)
{
    const uint32_t corners[2] = {a->number, b->number};
    uint32_t ends[2][2]; // points at the other ends of each face's two edges
    for (int i = 0; i < 2; i++) {
        const size_t first = place_of(smoothing, corners[i] / 3 * 3);
        for (uint32_t k = 0; k < 2; k++) {
            ends[i][k] = point_of(smoothing, first + (corners[i] + 1 + k) % 3);
        }
    }
    const bool meet = ends[0][0] == ends[1][0] || ends[0][0] == ends[1][1] || ends[0][1] == ends[1][0] ||
                      ends[0][1] == ends[1][1];
    return meet && !are_folded(smoothing, a, b) &&
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
        if (smoothing->folded[smoothing->kept[corners.list[i].number / 3]]) {
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
        corner->vertex = find_or_add(smoothing, first,
                                     smoothing->mesh->indices[place_of(smoothing, corner->number)], normal);
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

// Keep the faces of a batch, of which as many as `kept` are kept already, and take their corners at uneven points.
static void take_corners(struct smoothing *smoothing, struct scene_face_batch *batch, uint32_t kept,
                         uint32_t *next)
{
    smoothing->functions->weigh(smoothing->mesh, batch);
    for (uint32_t i = 0; i < batch->count; i++, kept++) {
        smoothing->kept[kept] = batch->faces[i];
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t point = batch->points[i][k];
            smoothing->normals_of_kept[kept][k] = batch->normals[k][i];
            if (smoothing->uneven[point]) {
                smoothing->corners[next[point]++] =
                    (struct corner){.weight = batch->weights[k][i], .number = 3 * kept + k};
            }
        }
    }
}

// Sort the corners at uneven points by the point, by counting, and weigh them.
static void sort_corners(struct scene_import *import, struct smoothing *smoothing, uint32_t corners)
{
    const struct scene_mesh *mesh = smoothing->mesh;
    const bool *const uneven = smoothing->uneven;
    const uint32_t *const point_of_vertex = smoothing->point, total = face_total(smoothing);
    const uint32_t most = corners < total ? corners : total; // faces that are kept
    smoothing->kept = scene_import_allocate_any(import, most, sizeof *smoothing->kept);
    smoothing->normals_of_kept = scene_import_allocate_any(import, most, sizeof *smoothing->normals_of_kept);
    smoothing->start =
        scene_import_allocate(import, (size_t)mesh->vertex_count + 2, sizeof *smoothing->start);
    smoothing->corners = scene_import_allocate_any(import, corners, sizeof *smoothing->corners);
    smoothing->newest = scene_import_allocate(import, mesh->vertex_count, sizeof *smoothing->newest);
    uint32_t *next = smoothing->start + 1, kept = 0;
    for (uint32_t point = 0; point < mesh->vertex_count; point++) {
        next[point + 1] = next[point] + (uneven[point] ? (uint32_t)smoothing->points[point].sum[3] : 0);
    }
    struct scene_face_batch batch = {.count = 0};
    for (uint32_t face = 0; face < total; face++) {
        const uint32_t *const corner = mesh->indices + 3 * (size_t)face;
        const uint32_t points[3] = {point_of_vertex[corner[0]], point_of_vertex[corner[1]],
                                    point_of_vertex[corner[2]]};
        if (uneven[points[0]] || uneven[points[1]] || uneven[points[2]]) {
            memcpy(batch.points[batch.count], points, sizeof points);
            batch.faces[batch.count++] = face;
        }
        if (batch.count == SCENE_FACE_BATCH || (face == total - 1 && batch.count > 0)) {
            take_corners(smoothing, &batch, kept, next);
            kept += batch.count;
            batch.count = 0;
        }
    }
}

// Make the new vertices, point by point. Set those of the corners at uneven points, and of each even point.
static void make_vertices(struct smoothing *smoothing)
{
    for (uint32_t number = 0; number < smoothing->mesh->vertex_count; number++) {
        double *const sum = smoothing->points[number].sum;
        if (smoothing->uneven[number]) {
            const uint32_t first = smoothing->start[number], end = smoothing->start[number + 1];
            smooth_point(smoothing, (struct corners){smoothing->corners + first, end - first});
        } else if (sum[3] > 0) {
            smoothing->source[smoothing->count] = number;
            scene_vector_narrow(sum, smoothing->normals[smoothing->count]);
            sum[3] = smoothing->count++;
        }
    }
}

// Give the corners of the mesh, of which `corners` are at uneven points, their new vertices.
static void number_corners(struct smoothing *smoothing, uint32_t *indices, uint32_t corners)
{
    const uint32_t vertices = smoothing->mesh->vertex_count, count = smoothing->mesh->index_count;
    const struct scene_face_point *const points = smoothing->points;
    const struct corner *const list = smoothing->corners;
    // The points of vertices are known no more then. A table of new vertices alone has an eighth of the bytes.
    uint32_t *const new_vertex = smoothing->point;
    for (uint32_t i = 0; i < vertices; i++) {
        new_vertex[i] = (uint32_t)points[new_vertex[i]].sum[3];
    }
    for (uint32_t i = 0; i < count; i++) {
        indices[i] = new_vertex[indices[i]];
    }
    for (uint32_t i = 0; i < corners; i++) {
        indices[place_of(smoothing, list[i].number)] = list[i].vertex;
    }
}

// Entry ---------------------------------------------------------------------------------------------

// Return the functions of the best instruction set of the machine. All of them find the same.
static const struct scene_face_functions *find_functions(void)
{
    static const struct scene_face_functions *const functions[RHW_ISA_COUNT] =
        RHW_ISA_TABLE(&scene_face_functions);
    int isa = RHW_ISA_COUNT - 1;
    while (isa > RHW_ISA_BASELINE && (functions[isa] == NULL || !rhw_isa_supported((enum rhw_isa)isa))) {
        isa--;
    }
    return functions[isa];
}

static void release(struct smoothing *smoothing)
{
    void *const arrays[] = {smoothing->folded, smoothing->point,   smoothing->points,
                            smoothing->uneven, smoothing->kept,    smoothing->normals_of_kept,
                            smoothing->start,  smoothing->corners, smoothing->source,
                            smoothing->newest};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++) {
        free(arrays[i]);
    }
}

// Make each vertex a point, also those at one place.
static uint32_t *own_points(struct scene_import *import, uint32_t vertices)
{
    uint32_t *const point = scene_import_allocate_any(import, vertices, sizeof *point);
    for (uint32_t i = 0; i < vertices; i++) {
        point[i] = i;
    }
    return point;
}

void scene_import_make_smooth(struct scene_import *import, struct scene_mesh *mesh, const uint32_t *polygons,
                              bool are_distinct)
{
    const uint32_t vertices = mesh->vertex_count;
    struct smoothing smoothing = {.mesh = mesh,
                                  .functions = find_functions(),
                                  .crease_cosine = usual_crease_cosine,
                                  .even_cosine = usual_even_cosine};
    // The axis of faces that all meet within the angle is at most half of it away from each.
    if (import->has_creases) {
        smoothing.crease_cosine = import->crease_cosine;
        smoothing.even_cosine = sqrt((1 + import->crease_cosine) / 2);
    }
    smoothing.point = import->has_own_points ? own_points(import, vertices)
                                             : scene_import_weld_positions(import, mesh, are_distinct);
    smoothing.points = scene_import_allocate(import, vertices, sizeof *smoothing.points);
    smoothing.uneven = scene_import_allocate(import, vertices, sizeof *smoothing.uneven);
    sum_all(&smoothing);
    if (polygons != NULL) {
        find_folds(import, &smoothing, polygons);
    }
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
