// SPDX-License-Identifier: MIT
// Around most points of most meshes the faces are even: they lie near one direction, which is the normal of the point.
// One pass over the faces finds these directions, and a second one the points where a face is not near. The corners of
// these alone are sorted by point, and compared with each other.
#include "smooth.h"

#include <stdlib.h>
#include <string.h>

#include "vector.h"
#include "vertices.h"

// The cosine of 60°. Two faces that meet at a sharper angle have an edge between them that is meant to be seen.
// Neighbours on anything modelled as round meet at less; the faces of boxes and the rims of pipes meet at more.
static const double crease_cosine = 0.5;

// The cosine of 30°. Programs that make quads of triangles in pairs make some across an edge that is meant to be seen.
// Quads of round surfaces are folded by less.
static const double fold_cosine = 0.8660254037844387;

// The cosine of 30°. Of faces that are no further from one axis, no two are a crease apart.
static const double even_cosine = 0.8660254037844387;

// The most faces around one point that are compared pair by pair. Where more meet, as only a hostile file has it, all
// are averaged.
enum { MOST_FACES = 256 };

struct smoothing {
    const struct scene_mesh *mesh;
    double (*faces)[3];       // unit normals
    const uint32_t *polygons; // polygon of each face; NULL if no face was cut from one
    bool *folded;             // faces next to a fold of their polygon; NULL if there are no polygons
    uint32_t *point;          // point of each vertex: the first vertex at its place
    double (*axes)[3];    // sum of the weighted normals of the faces around a point, and then its direction
    uint32_t *face_count; // number of corners at each point
    bool *is_uneven;      // points whose corners are compared with each other
    double *weights;      // weight of each corner at an uneven point
    uint32_t *start;      // corners around an uneven point p are start[p] .. start[p + 1]
    uint32_t *corners;
    uint32_t
        *newest; // number, from 1, of the last new vertex that was made from each vertex; 0 if there is none
    uint32_t *source; // vertex from which each new vertex was made
    float (*normals)[3];
    uint32_t count; // number of new vertices
};

// Find the normal of a face, and what it weighs at its corners: its angle there times its area. With weights of angles
// alone it would not matter at all how a polygon was cut into triangles, and with these it matters a little. But scans
// have triangles whose edges are a thousandth of their neighbours' and whose direction is noise, and by angles alone
// these would count as much as the others.
static void weigh_face(const struct scene_mesh *mesh, uint32_t face, double normal[3], double weights[3])
{
    const uint32_t *const corner = mesh->indices + 3 * (size_t)face;
    const float *const p = mesh->positions[corner[0]], *const q = mesh->positions[corner[1]],
                       *const r = mesh->positions[corner[2]];
    double a[3], b[3], opposite[3];
    scene_vector_between(p, q, a);
    scene_vector_between(p, r, b);
    scene_vector_between(q, r, opposite);
    scene_cross(a, b, normal);
    const double length = __builtin_sqrt(scene_dot(normal, normal));
    const double divisor = length > 0 ? length : 1;
    for (int c = 0; c < 3; c++) {
        normal[c] = length > 0 ? normal[c] / divisor : 0;
    }
    // An edge has the same unit vector from both ends, but for its sign.
    scene_vector_unit(a);
    scene_vector_unit(b);
    scene_vector_unit(opposite);
    weights[0] = length * scene_vector_angle(scene_dot(a, b));
    weights[1] = length * scene_vector_angle(-scene_dot(a, opposite));
    weights[2] = length * scene_vector_angle(scene_dot(b, opposite));
}

static uint32_t face_total(const struct smoothing *smoothing)
{
    return smoothing->mesh->index_count / 3;
}

static uint32_t point_of(const struct smoothing *smoothing, size_t corner)
{
    return smoothing->point[smoothing->mesh->indices[corner]];
}

// Even points ---------------------------------------------------------------------------------------

// Find the normals of all faces and the axes of all points.
static void sum_all(struct smoothing *smoothing)
{
    for (uint32_t face = 0; face < face_total(smoothing); face++) {
        double *const normal = smoothing->faces[face], weights[3];
        weigh_face(smoothing->mesh, face, normal, weights);
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t point = point_of(smoothing, 3 * (size_t)face + k);
            smoothing->face_count[point]++;
            for (int c = 0; c < 3; c++) {
                smoothing->axes[point][c] += normal[c] * weights[k];
            }
        }
    }
    for (uint32_t point = 0; point < smoothing->mesh->vertex_count; point++) {
        scene_vector_unit(smoothing->axes[point]);
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
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        smoothing->is_uneven[smoothing->point[i]] |= smoothing->point[i] != i;
    }
    for (uint32_t face = 0; face < face_total(smoothing); face++) {
        const bool is_folded = smoothing->folded != NULL && smoothing->folded[face];
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t point = point_of(smoothing, 3 * (size_t)face + k);
            const double cosine = scene_dot(smoothing->axes[point], smoothing->faces[face]);
            smoothing->is_uneven[point] |=
                (is_folded || !(cosine >= even_cosine)) && smoothing->face_count[point] <= MOST_FACES;
        }
    }
    uint32_t corners = 0;
    for (uint32_t point = 0; point < mesh->vertex_count; point++) {
        corners += smoothing->is_uneven[point] ? smoothing->face_count[point] : 0;
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
struct faces {
    const uint32_t *corners;
    uint32_t count;
};

static const double *face_of(const struct smoothing *smoothing, uint32_t corner)
{
    return smoothing->faces[corner / 3];
}

// Sum over the corners whose faces are no further than a crease from `axis`. If `axis` is NULL, sum over all.
static void sum_faces(const struct smoothing *smoothing, struct faces faces, const double *axis,
                      double sum[3])
{
    memset(sum, 0, 3 * sizeof *sum);
    for (uint32_t i = 0; i < faces.count; i++) {
        const double *face = face_of(smoothing, faces.corners[i]);
        if (axis != NULL && scene_dot(axis, face) < crease_cosine) {
            continue;
        }
        for (int c = 0; c < 3; c++) {
            sum[c] += face[c] * smoothing->weights[faces.corners[i]];
        }
    }
}

static bool all_within(const struct smoothing *smoothing, struct faces faces, const double axis[3],
                       double cosine)
{
    uint32_t near = 0;
    while (near < faces.count && scene_dot(axis, face_of(smoothing, faces.corners[near])) >= cosine) {
        near++;
    }
    return near == faces.count;
}

// Return true if the faces of two corners at one point share an edge there that is no crease.
static bool are_joined(const struct smoothing *smoothing, uint32_t a, uint32_t b)
{
    const uint32_t corners[2] = {a, b};
    uint32_t ends[2][2]; // points at the other ends of each face's two edges
    for (int i = 0; i < 2; i++) {
        const uint32_t first = corners[i] / 3 * 3;
        for (uint32_t k = 0; k < 2; k++) {
            ends[i][k] = smoothing->point[smoothing->mesh->indices[first + (corners[i] + 1 + k) % 3]];
        }
    }
    const bool meet = ends[0][0] == ends[1][0] || ends[0][0] == ends[1][1] || ends[0][1] == ends[1][0] ||
                      ends[0][1] == ends[1][1];
    return meet && !are_folded(smoothing, a / 3, b / 3) &&
           scene_dot(face_of(smoothing, a), face_of(smoothing, b)) >= crease_cosine;
}

// Reorder the corners so that corners whose faces are joined, one with the next, stand together. Return how many there
// are in the first group.
static uint32_t gather_group(const struct smoothing *smoothing, uint32_t *corners, uint32_t count)
{
    uint32_t grouped = 1;
    for (uint32_t i = 0; i < grouped; i++) {
        for (uint32_t k = grouped; k < count; k++) {
            if (are_joined(smoothing, corners[i], corners[k])) {
                const uint32_t corner = corners[k];
                corners[k] = corners[grouped];
                corners[grouped++] = corner;
            }
        }
    }
    return grouped;
}

// Return true if all faces lie within 30° of one axis and none is next to a fold. No two are a crease apart then, so
// that no pairs are compared.
static bool are_even(const struct smoothing *smoothing, struct faces faces)
{
    double axis[3];
    for (uint32_t i = 0; i < faces.count && smoothing->folded != NULL; i++) {
        if (smoothing->folded[faces.corners[i] / 3]) {
            return false;
        }
    }
    sum_faces(smoothing, faces, NULL, axis);
    scene_vector_unit(axis);
    return all_within(smoothing, faces, axis, even_cosine);
}

// Give a group its normals. It has one, so that a ridge is not torn where it is a little sharper, unless its faces look
// away from each other, as around the tip of a cone. Each of these faces goes with the faces that are near it.
static void smooth_group(struct smoothing *smoothing, struct faces group, uint32_t first, uint32_t *place)
{
    double all[3], axis[3];
    float normal[3];
    sum_faces(smoothing, group, NULL, all);
    memcpy(axis, all, sizeof axis);
    scene_vector_unit(axis);
    scene_vector_to_normal(all, normal);
    const bool one = group.count > MOST_FACES || all_within(smoothing, group, axis, crease_cosine);
    for (uint32_t i = 0; i < group.count; i++) {
        const uint32_t corner = group.corners[i];
        if (!one) {
            double sum[3];
            sum_faces(smoothing, group, face_of(smoothing, corner), sum);
            scene_vector_to_normal(sum, normal);
        }
        place[corner] = find_or_add(smoothing, first, smoothing->mesh->indices[corner], normal);
    }
}

// Give the corners around one point their new vertices in `place`.
static void smooth_point(struct smoothing *smoothing, uint32_t *corners, uint32_t count, uint32_t *place)
{
    const uint32_t first = smoothing->count;
    while (count > 0) {
        const bool whole = count > MOST_FACES || are_even(smoothing, (struct faces){corners, count});
        const uint32_t grouped = whole ? count : gather_group(smoothing, corners, count);
        smooth_group(smoothing, (struct faces){corners, grouped}, first, place);
        corners += grouped;
        count -= grouped;
    }
}

// Sort the corners at uneven points by the point, by counting, and weigh them.
static void sort_corners(struct scene_import *import, struct smoothing *smoothing, uint32_t corners)
{
    const struct scene_mesh *mesh = smoothing->mesh;
    smoothing->start =
        scene_import_allocate(import, (size_t)mesh->vertex_count + 2, sizeof *smoothing->start);
    smoothing->corners = scene_import_allocate(import, corners, sizeof *smoothing->corners);
    smoothing->newest = scene_import_allocate(import, mesh->vertex_count, sizeof *smoothing->newest);
    smoothing->weights = scene_import_allocate(import, mesh->index_count, sizeof *smoothing->weights);
    uint32_t *next = smoothing->start + 1;
    for (uint32_t point = 0; point < mesh->vertex_count; point++) {
        next[point + 1] = next[point] + (smoothing->is_uneven[point] ? smoothing->face_count[point] : 0);
    }
    for (uint32_t face = 0; face < face_total(smoothing); face++) {
        bool is_weighed = false;
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t corner = 3 * face + k, point = point_of(smoothing, corner);
            if (smoothing->is_uneven[point]) {
                smoothing->corners[next[point]++] = corner;
                is_weighed = true;
            }
        }
        if (is_weighed) {
            double normal[3];
            weigh_face(mesh, face, normal, smoothing->weights + 3 * (size_t)face);
        }
    }
}

// Entry ---------------------------------------------------------------------------------------------

// Make the new vertices, point by point. Set `place` of the corners at uneven points, and the new vertex of each even
// point in `face_count`, which is used no more.
static void make_vertices(struct smoothing *smoothing, uint32_t *place)
{
    for (uint32_t point = 0; point < smoothing->mesh->vertex_count; point++) {
        if (smoothing->is_uneven[point]) {
            const uint32_t first = smoothing->start[point], end = smoothing->start[point + 1];
            smooth_point(smoothing, smoothing->corners + first, end - first, place);
        } else if (smoothing->face_count[point] > 0) {
            smoothing->source[smoothing->count] = point;
            scene_vector_narrow(smoothing->axes[point], smoothing->normals[smoothing->count]);
            smoothing->face_count[point] = smoothing->count++;
        }
    }
}

static void number_corners(const struct smoothing *smoothing, uint32_t *indices, const uint32_t *place)
{
    const uint32_t count = smoothing->mesh->index_count;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t point = smoothing->point[indices[i]];
        indices[i] = smoothing->is_uneven[point] ? place[i] : smoothing->face_count[point];
    }
}

static void release(struct smoothing *smoothing)
{
    void *const arrays[] = {smoothing->faces,     smoothing->folded,  smoothing->point,
                            smoothing->axes,      smoothing->weights, smoothing->start,
                            smoothing->corners,   smoothing->source,  smoothing->face_count,
                            smoothing->is_uneven, smoothing->newest};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++) {
        free(arrays[i]);
    }
}

void scene_import_make_smooth(struct scene_import *import, struct scene_mesh *mesh, const uint32_t *polygons)
{
    const uint32_t vertices = mesh->vertex_count;
    struct smoothing smoothing = {.mesh = mesh};
    smoothing.point = scene_import_weld_positions(import, mesh);
    smoothing.faces = scene_import_allocate(import, face_total(&smoothing), sizeof *smoothing.faces);
    smoothing.axes = scene_import_allocate(import, vertices, sizeof *smoothing.axes);
    smoothing.face_count = scene_import_allocate(import, vertices, sizeof *smoothing.face_count);
    smoothing.is_uneven = scene_import_allocate(import, vertices, sizeof *smoothing.is_uneven);
    sum_all(&smoothing);
    find_folds(import, &smoothing, polygons);
    const uint32_t corners = find_uneven(&smoothing);
    smoothing.source = scene_import_allocate(import, mesh->index_count, sizeof *smoothing.source);
    smoothing.normals = scene_import_allocate(import, mesh->index_count, sizeof *smoothing.normals);
    if (corners > 0) {
        sort_corners(import, &smoothing, corners);
    }
    uint32_t *const place = scene_import_allocate(import, corners > 0 ? mesh->index_count : 0, sizeof *place);
    make_vertices(&smoothing, place);
    if (corners > 0 || smoothing.count < vertices) {
        number_corners(&smoothing, mesh->indices, place);
        scene_import_gather_vertices(import, mesh, smoothing.source, smoothing.count);
    }
    mesh->normals = smoothing.normals;
    free(place);
    release(&smoothing);
}
