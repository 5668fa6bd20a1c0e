// SPDX-License-Identifier: MIT
// A square root or a division waits for the one before it, and a face takes 13 of them. So each step is taken for all
// faces of a batch, by loops over arrays that compilers make vectors of.
#include "face_weights.h"

#include <string.h>

#include "rhw/shader.h"
#include "vector.h"

enum { BATCH = SCENE_FACE_BATCH };

// The edges of faces, by axis: from the first corner to the second and the third, and from the second to the third.
struct edges {
    double ab[3][BATCH], ac[3][BATCH], bc[3][BATCH];
};

static const uint32_t *corners_of(const struct scene_mesh *mesh, const struct scene_face_batch *batch,
                                  uint32_t i)
{
    return mesh->indices + 3 * (size_t)batch->faces[i < batch->count ? i : 0];
}

// Find the edges from the first corner, which normals are made of.
static void find_edges(const struct scene_mesh *mesh, const struct scene_face_batch *batch,
                       struct edges *edges)
{
    for (uint32_t i = 0; i < BATCH; i++) {
        const uint32_t *const corner = corners_of(mesh, batch, i);
        const float *const p = mesh->positions[corner[0]], *const q = mesh->positions[corner[1]],
                           *const r = mesh->positions[corner[2]];
        for (int c = 0; c < 3; c++) {
            edges->ab[c][i] = (double)q[c] - (double)p[c];
            edges->ac[c][i] = (double)r[c] - (double)p[c];
        }
    }
}

static void find_last_edges(const struct scene_mesh *mesh, const struct scene_face_batch *batch,
                            struct edges *edges)
{
    for (uint32_t i = 0; i < BATCH; i++) {
        const uint32_t *const corner = corners_of(mesh, batch, i);
        const float *const q = mesh->positions[corner[1]], *const r = mesh->positions[corner[2]];
        for (int c = 0; c < 3; c++) {
            edges->bc[c][i] = (double)r[c] - (double)q[c];
        }
    }
}

// Find the unit normals of faces, and twice their areas.
static void find_normals(const struct edges *restrict edges, double (*restrict normals)[BATCH],
                         double *restrict areas)
{
    for (uint32_t i = 0; i < BATCH; i++) {
        const double a[3] = {edges->ab[0][i], edges->ab[1][i], edges->ab[2][i]};
        const double b[3] = {edges->ac[0][i], edges->ac[1][i], edges->ac[2][i]};
        double normal[3];
        scene_cross(a, b, normal);
        const double length = __builtin_sqrt(scene_dot(normal, normal));
        const double divisor = length > 0 ? length : 1;
        for (int c = 0; c < 3; c++) {
            normals[c][i] = length > 0 ? normal[c] / divisor : 0;
        }
        areas[i] = length;
    }
}

static void make_unit(double (*edges)[BATCH])
{
    for (uint32_t i = 0; i < BATCH; i++) {
        double edge[3] = {edges[0][i], edges[1][i], edges[2][i]};
        scene_vector_unit(edge);
        edges[0][i] = edge[0];
        edges[1][i] = edge[1];
        edges[2][i] = edge[2];
    }
}

// Weigh the corners between two edges, which are unit vectors. `sign` is −1 where one of them points to the corner. Gcc
// would take each way through the conditions for all faces if this was one loop.
static void weigh(double (*restrict a)[BATCH], double (*restrict b)[BATCH], double sign,
                  const double *restrict areas, double *restrict weights)
{
    double cosines[BATCH], sizes[BATCH];
    for (uint32_t i = 0; i < BATCH; i++) {
        cosines[i] = sign * (a[0][i] * b[0][i] + a[1][i] * b[1][i] + a[2][i] * b[2][i]);
        const double size = __builtin_fabs(cosines[i]);
        sizes[i] = size > 1 ? 1 : size;
    }
    for (uint32_t i = 0; i < BATCH; i++) {
        sizes[i] = scene_vector_acute_angle(sizes[i]);
    }
    for (uint32_t i = 0; i < BATCH; i++) {
        weights[i] = areas[i] * scene_vector_whole_angle(cosines[i], sizes[i]);
    }
}

static void find_batch_normals(const struct scene_mesh *mesh, struct scene_face_batch *batch)
{
    struct edges edges;
    double areas[BATCH];
    find_edges(mesh, batch, &edges);
    find_normals(&edges, batch->normals, areas);
}

static void weigh_batch(const struct scene_mesh *mesh, struct scene_face_batch *batch)
{
    struct edges edges;
    double areas[BATCH];
    find_edges(mesh, batch, &edges);
    find_last_edges(mesh, batch, &edges);
    find_normals(&edges, batch->normals, areas);
    // An edge has the same unit vector from both ends, but for its sign.
    make_unit(edges.ab);
    make_unit(edges.ac);
    make_unit(edges.bc);
    weigh(edges.ab, edges.ac, 1, areas, batch->weights[0]);
    weigh(edges.ab, edges.bc, -1, areas, batch->weights[1]);
    weigh(edges.ac, edges.bc, 1, areas, batch->weights[2]);
}

static void add(const struct scene_face_batch *batch, struct scene_face_point *points)
{
    for (uint32_t i = 0; i < batch->count; i++) {
        const rhw_double4 normal = {batch->normals[0][i], batch->normals[1][i], batch->normals[2][i], 1};
        for (uint32_t k = 0; k < 3; k++) {
            const double weight = batch->weights[k][i];
            double *const sum = points[batch->points[i][k]].sum;
            rhw_double4 sums;
            memcpy(&sums, sum, sizeof sums);
            sums += normal * (rhw_double4){weight, weight, weight, 1};
            memcpy(sum, &sums, sizeof sums);
        }
    }
}

static void make_directions(struct scene_face_point *points, uint32_t count)
{
    double axes[3][BATCH] = {{0}};
    for (uint32_t first = 0; first < count; first += BATCH) {
        const uint32_t some = count - first < BATCH ? count - first : BATCH;
        for (uint32_t i = 0; i < some; i++) {
            axes[0][i] = points[first + i].sum[0];
            axes[1][i] = points[first + i].sum[1];
            axes[2][i] = points[first + i].sum[2];
        }
        make_unit(axes);
        for (uint32_t i = 0; i < some; i++) {
            points[first + i].sum[0] = axes[0][i];
            points[first + i].sum[1] = axes[1][i];
            points[first + i].sum[2] = axes[2][i];
        }
    }
}

extern const struct scene_face_functions RHW_ISA_NAME(scene_face_functions);

const struct scene_face_functions RHW_ISA_NAME(scene_face_functions) = {
    .find_normals = find_batch_normals, .weigh = weigh_batch, .add = add, .make_directions = make_directions};
