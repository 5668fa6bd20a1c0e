// SPDX-License-Identifier: MIT
// Normals and tangents for meshes that lack them. Only + − × ÷ and square roots are used, so the result is equal
// everywhere. Sums are made in double.
#include "normals.h"

#include <stdlib.h>
#include <string.h>

#include "smooth.h"
#include "vector.h"
#include "vertices.h"

void scene_import_move_normal(const float matrix[16], float normal[3])
{
    // The cofactors are the inverse transposed times the determinant.
    double axes[3][3], cofactors[3], sum[3] = {0, 0, 0};
    for (int i = 0; i < 9; i++) {
        axes[i / 3][i % 3] = (double)matrix[i / 3 * 4 + i % 3];
    }
    for (int i = 0; i < 3; i++) {
        scene_cross(axes[(i + 1) % 3], axes[(i + 2) % 3], cofactors);
        for (int c = 0; c < 3; c++) {
            sum[c] += (double)normal[i] * cofactors[c];
        }
    }
    scene_vector_to_normal(sum, normal);
}

static void face_normal(const struct scene_mesh *mesh, uint32_t first_corner, double normal[3])
{
    const uint32_t *corner = mesh->indices + first_corner;
    double a[3], b[3];
    scene_vector_between(mesh->positions[corner[0]], mesh->positions[corner[1]], a);
    scene_vector_between(mesh->positions[corner[0]], mesh->positions[corner[2]], b);
    // The product of two long edges of a large mesh could leave the range.
    scene_vector_unit(a);
    scene_vector_unit(b);
    scene_cross(a, b, normal);
    scene_vector_unit(normal);
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
        scene_vector_to_normal(normal, mesh->normals[i]);
        memcpy(mesh->normals[i + 1], mesh->normals[i], sizeof mesh->normals[i]);
        memcpy(mesh->normals[i + 2], mesh->normals[i], sizeof mesh->normals[i]);
    }
}

void scene_import_make_normals(struct scene_import *import, struct scene_mesh *mesh,
                               enum scene_import_normals kind, const uint32_t *polygons, bool are_distinct)
{
    if (kind == SCENE_IMPORT_FLAT) {
        make_flat(import, mesh);
    } else {
        scene_import_make_smooth(import, mesh, polygons, are_distinct);
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
        opposed += scene_dot(facet, given) < 0;
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
        scene_vector_between(mesh->positions[corner[0]], mesh->positions[corner[1]], a);
        scene_vector_between(mesh->positions[corner[0]], mesh->positions[corner[2]], b);
        scene_cross(a, b, product);
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
    scene_vector_between(mesh->positions[corner[0]], mesh->positions[corner[1]], edges[0]);
    scene_vector_between(mesh->positions[corner[0]], mesh->positions[corner[2]], edges[1]);
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
    scene_vector_unit(tangent);
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
    const double along = scene_dot(n, t);
    for (int c = 0; c < 3; c++) {
        t[c] -= along * n[c];
    }
    // A vector without a direction becomes any that is at right angles to the normal.
    if (!(scene_dot(t, t) > 1e-12)) {
        const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0};
        scene_cross(n, n[0] * n[0] < 0.5 ? x : y, t);
    }
    scene_vector_unit(t);
    for (int c = 0; c < 3; c++) {
        tangent[c] = (float)t[c];
    }
}

static double corner_angle(const struct scene_mesh *mesh, uint32_t corner)
{
    const uint32_t first = corner / 3 * 3;
    const float *here = mesh->positions[mesh->indices[corner]];
    double a[3], b[3];
    scene_vector_between(here, mesh->positions[mesh->indices[first + (corner + 1) % 3]], a);
    scene_vector_between(here, mesh->positions[mesh->indices[first + (corner + 2) % 3]], b);
    scene_vector_unit(a);
    scene_vector_unit(b);
    return scene_vector_angle(scene_dot(a, b));
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
        const double along = scene_dot(n, faces[i / 3]);
        double projected[3];
        for (int c = 0; c < 3; c++) {
            projected[c] = faces[i / 3][c] - along * n[c];
        }
        scene_vector_unit(projected);
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
