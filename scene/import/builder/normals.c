// SPDX-License-Identifier: MIT
// Normals and tangents for meshes that lack them. Only + − × ÷ and square roots are used, so the result is equal
// everywhere. Sums are made in double.
#include "normals.h"

#include <stdlib.h>
#include <string.h>

#include "vertices.h"

// The cosine of 60°. Two faces that meet at a sharper angle have an edge between them that is meant to be seen.
// Neighbours on anything modelled as round meet at less; the faces of boxes and the rims of pipes meet at more.
static const double crease_cosine = 0.5;

// The cosine of 30°. Programs that make quads of triangles in pairs make some across an edge that is meant to be seen.
// Quads of round surfaces are folded by less.
static const double fold_cosine = 0.8660254037844387;

// The most faces around one point that are compared pair by pair. Where more meet, as only a hostile file has it, all
// are averaged.
enum { MOST_FACES = 256 };

static void subtract(const float a[3], const float b[3], double difference[3])
{
    for (int c = 0; c < 3; c++) {
        difference[c] = (double)a[c] - (double)b[c];
    }
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double product[3])
{
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

// Scale to length 1, or to 0 when there is no direction. Squares of doubles made of floats stay in range.
static void unit(double vector[3])
{
    const double length = __builtin_sqrt(dot(vector, vector));
    const double scale = length > 0 ? 1 / length : 0;
    for (int c = 0; c < 3; c++) {
        vector[c] *= scale;
    }
}

static void to_normal(const double sum[3], float normal[3])
{
    double direction[3] = {sum[0], sum[1], sum[2]};
    unit(direction);
    const bool none = direction[0] == 0 && direction[1] == 0 && direction[2] == 0;
    for (int c = 0; c < 3; c++) {
        normal[c] = none ? (c == 2 ? 1.0f : 0.0f) : (float)direction[c];
    }
}

void scene_import_move_normal(const float matrix[16], float normal[3])
{
    // The cofactors are the inverse transposed times the determinant.
    double axes[3][3], cofactors[3], sum[3] = {0, 0, 0};
    for (int i = 0; i < 9; i++) {
        axes[i / 3][i % 3] = (double)matrix[i / 3 * 4 + i % 3];
    }
    for (int i = 0; i < 3; i++) {
        cross(axes[(i + 1) % 3], axes[(i + 2) % 3], cofactors);
        for (int c = 0; c < 3; c++) {
            sum[c] += (double)normal[i] * cofactors[c];
        }
    }
    to_normal(sum, normal);
}

static void face_normal(const struct scene_mesh *mesh, uint32_t first_corner, double normal[3])
{
    const uint32_t *corner = mesh->indices + first_corner;
    double a[3], b[3];
    subtract(mesh->positions[corner[1]], mesh->positions[corner[0]], a);
    subtract(mesh->positions[corner[2]], mesh->positions[corner[0]], b);
    // The product of two long edges of a large mesh could leave the range.
    unit(a);
    unit(b);
    cross(a, b, normal);
    unit(normal);
}

static void make_flat(struct scene_import *import, struct scene_mesh *mesh)
{
    const uint32_t corners = mesh->index_count;
    scene_import_gather_vertices(import, mesh, mesh->indices, corners);
    mesh->normals = scene_import_allocate(import, corners, sizeof *mesh->normals);
    for (uint32_t i = 0; i < corners; i++) {
        mesh->indices[i] = i;
    }
    for (uint32_t i = 0; i < corners; i += 3) {
        double normal[3];
        face_normal(mesh, i, normal);
        to_normal(normal, mesh->normals[i]);
        memcpy(mesh->normals[i + 1], mesh->normals[i], sizeof mesh->normals[i]);
        memcpy(mesh->normals[i + 2], mesh->normals[i], sizeof mesh->normals[i]);
    }
}

// Smooth --------------------------------------------------------------------------------------------

struct smoothing {
    const struct scene_mesh *mesh;
    double (*faces)[3];       // unit normals
    double *weights;          // weight of each corner
    const uint32_t *polygons; // polygon of each face; NULL if no face was cut from one
    bool *folded;             // faces next to a fold of their polygon; NULL if there are no polygons
    uint32_t *start;          // corners around point p are start[p] .. start[p + 1]
    uint32_t *corners;
    uint32_t *point;  // point of each vertex; vertices at one place have one point
    uint32_t *source; // vertex from which each new vertex was made
    float (*normals)[3];
    uint32_t count; // number of new vertices
};

// Return the angle whose cosine is `cosine`, in radians. The error is below 7e-5 (Abramowitz and Stegun 4.4.45), ample
// for a weight, and equal on every machine.
static double angle_of(double cosine)
{
    const double x = cosine < 0 ? -cosine : cosine;
    const double clamped = x > 1 ? 1 : x;
    const double polynomial =
        1.5707288 + clamped * (-0.2121144 + clamped * (0.0742610 - 0.0187293 * clamped));
    const double angle = __builtin_sqrt(1 - clamped) * polynomial;
    return cosine < 0 ? 3.14159265358979324 - angle : angle;
}

static double corner_angle(const struct scene_mesh *mesh, uint32_t corner)
{
    const uint32_t first = corner / 3 * 3;
    const float *here = mesh->positions[mesh->indices[corner]];
    double a[3], b[3];
    subtract(mesh->positions[mesh->indices[first + (corner + 1) % 3]], here, a);
    subtract(mesh->positions[mesh->indices[first + (corner + 2) % 3]], here, b);
    unit(a);
    unit(b);
    return angle_of(dot(a, b));
}

// Set the normal of a face, and what it weighs at its corners: its angle there times its area. With weights of angles
// alone it would not matter at all how a polygon was cut into triangles, and with these it matters a little. But scans
// have triangles whose edges are a thousandth of their neighbours' and whose direction is noise, and by angles alone
// these would count as much as the others.
static void weigh_face(struct smoothing *smoothing, uint32_t first)
{
    const struct scene_mesh *mesh = smoothing->mesh;
    const uint32_t *corner = mesh->indices + first;
    double a[3], b[3], normal[3];
    subtract(mesh->positions[corner[1]], mesh->positions[corner[0]], a);
    subtract(mesh->positions[corner[2]], mesh->positions[corner[0]], b);
    cross(a, b, normal);
    const double length = __builtin_sqrt(dot(normal, normal));
    for (int c = 0; c < 3; c++) {
        smoothing->faces[first / 3][c] = length > 0 ? normal[c] / length : 0;
    }
    for (uint32_t k = 0; k < 3; k++) {
        smoothing->weights[first + k] = length * corner_angle(mesh, first + k);
    }
}

// Return the new vertex with this source and normal among those made since `first`. Add it if there is none.
static uint32_t find_or_add(struct smoothing *smoothing, uint32_t first, uint32_t source,
                            const float normal[3])
{
    for (uint32_t i = first; i < smoothing->count; i++) {
        if (smoothing->source[i] == source &&
            memcmp(smoothing->normals[i], normal, sizeof smoothing->normals[i]) == 0) {
            return i;
        }
    }
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
        if (axis != NULL && dot(axis, face) < crease_cosine) {
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
    while (near < faces.count && dot(axis, face_of(smoothing, faces.corners[near])) >= cosine) {
        near++;
    }
    return near == faces.count;
}

// Return true if two faces are of one polygon, which is folded between them.
static bool are_folded(const struct smoothing *smoothing, uint32_t a, uint32_t b)
{
    return smoothing->polygons != NULL && smoothing->polygons[a] == smoothing->polygons[b] &&
           dot(smoothing->faces[a], smoothing->faces[b]) < fold_cosine;
}

// Mark the faces next to folds. Faces of one polygon follow each other.
static void find_folds(struct scene_import *import, struct smoothing *smoothing, const uint32_t *polygons)
{
    const uint32_t count = smoothing->mesh->index_count / 3;
    smoothing->polygons = polygons;
    smoothing->folded =
        polygons == NULL ? NULL : scene_import_allocate(import, count, sizeof *smoothing->folded);
    for (uint32_t i = 1; polygons != NULL && i < count; i++) {
        if (are_folded(smoothing, i - 1, i)) {
            smoothing->folded[i - 1] = smoothing->folded[i] = true;
        }
    }
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
           dot(face_of(smoothing, a), face_of(smoothing, b)) >= crease_cosine;
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
// that no pairs are compared. This is the common case.
static bool are_even(const struct smoothing *smoothing, struct faces faces)
{
    double axis[3];
    for (uint32_t i = 0; i < faces.count && smoothing->folded != NULL; i++) {
        if (smoothing->folded[faces.corners[i] / 3]) {
            return false;
        }
    }
    sum_faces(smoothing, faces, NULL, axis);
    unit(axis);
    return all_within(smoothing, faces, axis, 0.8660254037844387);
}

// Give a group its normals. It has one, so that a ridge is not torn where it is a little sharper, unless its faces look
// away from each other, as around the tip of a cone. Each of these faces goes with the faces that are near it.
static void smooth_group(struct smoothing *smoothing, struct faces group, uint32_t first, uint32_t *place)
{
    double all[3], axis[3];
    float normal[3];
    sum_faces(smoothing, group, NULL, all);
    memcpy(axis, all, sizeof axis);
    unit(axis);
    to_normal(all, normal);
    const bool one = group.count > MOST_FACES || all_within(smoothing, group, axis, crease_cosine);
    for (uint32_t i = 0; i < group.count; i++) {
        const uint32_t corner = group.corners[i];
        if (!one) {
            double sum[3];
            sum_faces(smoothing, group, face_of(smoothing, corner), sum);
            to_normal(sum, normal);
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

// Sort corners by the point they stand at, by counting.
static void sort_corners(struct scene_import *import, struct smoothing *smoothing)
{
    const struct scene_mesh *mesh = smoothing->mesh;
    const uint32_t *const group = smoothing->point = scene_import_weld_positions(import, mesh);
    smoothing->start =
        scene_import_allocate(import, (size_t)mesh->vertex_count + 2, sizeof *smoothing->start);
    smoothing->corners = scene_import_allocate(import, mesh->index_count, sizeof *smoothing->corners);
    uint32_t *next = smoothing->start + 1;
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        next[group[mesh->indices[i]] + 1]++;
    }
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        next[i + 1] += next[i];
    }
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        smoothing->corners[next[group[mesh->indices[i]]]++] = i;
    }
}

static void make_smooth(struct scene_import *import, struct scene_mesh *mesh, const uint32_t *polygons)
{
    struct smoothing smoothing = {.mesh = mesh};
    smoothing.faces = scene_import_allocate(import, mesh->index_count / 3, sizeof *smoothing.faces);
    smoothing.weights = scene_import_allocate(import, mesh->index_count, sizeof *smoothing.weights);
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        weigh_face(&smoothing, i);
    }
    find_folds(import, &smoothing, polygons);
    sort_corners(import, &smoothing);
    smoothing.source = scene_import_allocate(import, mesh->index_count, sizeof *smoothing.source);
    smoothing.normals = scene_import_allocate(import, mesh->index_count, sizeof *smoothing.normals);
    uint32_t *place = scene_import_allocate(import, mesh->index_count, sizeof *place);
    for (uint32_t point = 0; point < mesh->vertex_count; point++) {
        const uint32_t first = smoothing.start[point], end = smoothing.start[point + 1];
        smooth_point(&smoothing, smoothing.corners + first, end - first, place);
    }
    scene_import_gather_vertices(import, mesh, smoothing.source, smoothing.count);
    mesh->normals = smoothing.normals;
    free(mesh->indices);
    mesh->indices = place;
    free(smoothing.faces);
    free(smoothing.weights);
    free(smoothing.folded);
    free(smoothing.start);
    free(smoothing.corners);
    free(smoothing.point);
    free(smoothing.source);
}

void scene_import_make_normals(struct scene_import *import, struct scene_mesh *mesh,
                               enum scene_import_normals kind, const uint32_t *polygons)
{
    if (kind == SCENE_IMPORT_FLAT) {
        make_flat(import, mesh);
    } else {
        make_smooth(import, mesh, polygons);
    }
}

// Return how many corners of a triangle have normals that point to where the corners run clockwise.
static int count_opposed(const struct scene_mesh *mesh, uint32_t first_corner)
{
    double facet[3];
    int opposed = 0;
    face_normal(mesh, first_corner, facet);
    for (uint32_t k = 0; k < 3; k++) {
        const float *const normal = mesh->normals[mesh->indices[first_corner + k]];
        const double given[3] = {(double)normal[0], (double)normal[1], (double)normal[2]};
        opposed += dot(facet, given) < 0;
    }
    return opposed;
}

// Set for each triangle whether its normals oppose its corners. Where its normals are not of one mind, as on an edge
// that is smoothed over, the majority of the other triangles decides. Return true if the normals of any triangle oppose
// its corners.
static bool find_opposed(const struct scene_mesh *mesh, uint8_t *opposes)
{
    const uint32_t triangles = mesh->index_count / 3;
    uint32_t of_count[4] = {0}; // triangles by their number of corners that oppose
    for (uint32_t t = 0; t < triangles; t++) {
        opposes[t] = (uint8_t)count_opposed(mesh, 3 * t);
        of_count[opposes[t]]++;
    }
    const int enough = of_count[3] > of_count[0] ? 1 : 3;
    for (uint32_t t = 0; t < triangles; t++) {
        opposes[t] = opposes[t] >= enough;
    }
    return of_count[3] > 0;
}

// Turn the normal and the tangent of a vertex. A surface that is seen from its back is shaded by the whole frame the
// other way, so that a normal map shows the relief that it has in the file's own frame. The bitangent is the product of
// both times the fourth number. It is the opposite of the file's already, because that number goes by the corners.
static void turn_normal(struct scene_mesh *mesh, uint32_t vertex)
{
    for (int c = 0; c < 3; c++) {
        mesh->normals[vertex][c] = -mesh->normals[vertex][c];
    }
    for (int c = 0; c < 3 && mesh->tangents; c++) {
        mesh->tangents[vertex][c] = -mesh->tangents[vertex][c];
    }
}

void scene_import_turn_normals(struct scene_import *import, struct scene_mesh *mesh)
{
    enum { KEPT = 1, TURNED = 2 }; // ways in which a vertex is used
    const uint32_t count = mesh->vertex_count;
    uint8_t *use = scene_import_allocate(import, count, sizeof *use);
    uint8_t *opposes = scene_import_allocate(import, mesh->index_count / 3, sizeof *opposes);
    const bool any = find_opposed(mesh, opposes);
    for (uint32_t i = 0; i < mesh->index_count && any; i++) {
        use[mesh->indices[i]] |= opposes[i / 3] ? TURNED : KEPT;
    }
    if (any) {
        uint32_t *source = scene_import_allocate(import, 2 * (size_t)count, sizeof *source);
        uint32_t *turned = scene_import_allocate(import, count, sizeof *turned), end = count;
        for (uint32_t v = 0; v < count; v++) {
            source[v] = v;
            turned[v] = use[v] == (KEPT | TURNED) ? end++ : v;
            source[turned[v]] = v;
        }
        scene_import_gather_vertices(import, mesh, source, end);
        for (uint32_t v = 0; v < count; v++) {
            if (use[v] & TURNED) {
                turn_normal(mesh, turned[v]);
            }
        }
        for (uint32_t i = 0; i < mesh->index_count; i++) {
            mesh->indices[i] = opposes[i / 3] ? turned[mesh->indices[i]] : mesh->indices[i];
        }
        free(source);
        free(turned);
    }
    free(use);
    free(opposes);
}

bool scene_import_has_area(const struct scene_mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        const uint32_t *corner = mesh->indices + i;
        double a[3], b[3], product[3];
        subtract(mesh->positions[corner[1]], mesh->positions[corner[0]], a);
        subtract(mesh->positions[corner[2]], mesh->positions[corner[0]], b);
        cross(a, b, product);
        if (product[0] != 0 || product[1] != 0 || product[2] != 0) {
            return true;
        }
    }
    return false;
}

// Tangents ------------------------------------------------------------------------------------------

// Find the direction of growing u on a triangle. Return on which side growing −v lies, which is 1 or −1. Return 0 if
// the texture coordinates span no area.
static int face_tangent(const struct scene_mesh *mesh, const struct scene_texture_slot *slot, uint32_t first,
                        double tangent[3])
{
    const uint32_t *corner = mesh->indices + first;
    double edges[2][3], u[3], v[3];
    subtract(mesh->positions[corner[1]], mesh->positions[corner[0]], edges[0]);
    subtract(mesh->positions[corner[2]], mesh->positions[corner[0]], edges[1]);
    for (int k = 0; k < 3; k++) {
        const float *uv = mesh->uvs[slot->uv_set][corner[k]];
        u[k] = (double)slot->transform[0] * (double)uv[0] + (double)slot->transform[1] * (double)uv[1];
        v[k] = -((double)slot->transform[3] * (double)uv[0] + (double)slot->transform[4] * (double)uv[1]);
    }
    const double du1 = u[1] - u[0], dv1 = v[1] - v[0], du2 = u[2] - u[0], dv2 = v[2] - v[0];
    const double area = du1 * dv2 - du2 * dv1;
    const int side = area > 0 ? 1 : area < 0 ? -1 : 0;
    for (int c = 0; c < 3; c++) {
        tangent[c] = (edges[0][c] * dv2 - edges[1][c] * dv1) * side;
    }
    unit(tangent);
    return side;
}

// Double the vertices where texture coordinates that run one way meet mirrored ones, so that each vertex has one
// tangent frame. Set tangents[v][3].
static void split_mirrored(struct scene_import *import, struct scene_mesh *mesh, const signed char *sides)
{
    uint32_t *mirrored = scene_import_allocate(import, mesh->vertex_count, sizeof *mirrored);
    unsigned char *seen = scene_import_allocate(import, mesh->vertex_count, 1);
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        seen[mesh->indices[i]] |= sides[i / 3] < 0 ? 2 : sides[i / 3] > 0 ? 1 : 0;
    }
    uint32_t count = mesh->vertex_count;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        mirrored[i] = seen[i] == 3 ? count++ : i;
    }
    uint32_t *source = scene_import_allocate(import, count, sizeof *source);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        source[i] = source[mirrored[i]] = i;
    }
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        if (sides[i / 3] < 0) {
            mesh->indices[i] = mirrored[mesh->indices[i]];
        }
    }
    const uint32_t before = mesh->vertex_count;
    scene_import_gather_vertices(import, mesh, source, count);
    mesh->tangents = scene_import_allocate(import, count, sizeof *mesh->tangents);
    for (uint32_t i = 0; i < count; i++) {
        mesh->tangents[i][3] = i >= before || seen[source[i]] == 2 ? -1.0f : 1.0f;
    }
    free(mirrored);
    free(seen);
    free(source);
}

static void set_tangent(const float normal[3], const double sum[3], float tangent[4])
{
    const double n[3] = {normal[0], normal[1], normal[2]};
    double t[3] = {sum[0], sum[1], sum[2]};
    const double along = dot(n, t);
    for (int c = 0; c < 3; c++) {
        t[c] -= along * n[c];
    }
    // A vector without a direction becomes any that is at right angles to the normal.
    if (!(dot(t, t) > 1e-12)) {
        const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0};
        cross(n, n[0] * n[0] < 0.5 ? x : y, t);
    }
    unit(t);
    for (int c = 0; c < 3; c++) {
        tangent[c] = (float)t[c];
    }
}

void scene_import_make_tangents(struct scene_import *import, struct scene_mesh *mesh,
                                const struct scene_texture_slot *slot)
{
    const uint32_t triangles = mesh->index_count / 3;
    double(*faces)[3] = scene_import_allocate(import, triangles, sizeof *faces);
    signed char *sides = scene_import_allocate(import, triangles, 1);
    for (uint32_t i = 0; i < triangles; i++) {
        sides[i] = (signed char)face_tangent(mesh, slot, 3 * i, faces[i]);
    }
    split_mirrored(import, mesh, sides);
    double(*sums)[3] = scene_import_allocate(import, mesh->vertex_count, sizeof *sums);
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        // MikkTSpace puts the face's tangent into the vertex's own plane and weights it by the corner's angle too.
        const float *normal = mesh->normals[mesh->indices[i]];
        const double n[3] = {normal[0], normal[1], normal[2]};
        const double along = dot(n, faces[i / 3]);
        double projected[3];
        for (int c = 0; c < 3; c++) {
            projected[c] = faces[i / 3][c] - along * n[c];
        }
        unit(projected);
        const double angle = corner_angle(mesh, i);
        for (int c = 0; c < 3; c++) {
            sums[mesh->indices[i]][c] += projected[c] * angle;
        }
    }
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        set_tangent(mesh->normals[i], sums[i], mesh->tangents[i]);
    }
    free(faces);
    free(sides);
    free(sums);
}
