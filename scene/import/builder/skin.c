// SPDX-License-Identifier: MIT
#include "skin.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "normals.h"
#include "numbers.h"
#include "origin.h"
#include "pieces.h"

// Find the middle and the sides of the box around the positions of a mesh.
static void find_box(const struct scene_mesh *mesh, double middle[3], double sides[3])
{
    float low[3] = {FLT_MAX, FLT_MAX, FLT_MAX}, high[3] = {-FLT_MAX, -FLT_MAX, -FLT_MAX};
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        for (int c = 0; c < 3; c++) {
            low[c] = fminf(low[c], mesh->positions[v][c]);
            high[c] = fmaxf(high[c], mesh->positions[v][c]);
        }
    }
    for (int c = 0; c < 3; c++) {
        middle[c] = low[c] > high[c] ? 0 : (double)low[c] / 2 + (double)high[c] / 2;
        sides[c] = low[c] > high[c] ? 0 : (double)high[c] - (double)low[c];
    }
}

// Return true if floats lose what can be seen of a box that a joint moves: it stands far away, or was far on the way.
static bool loses(const struct scene_import_place *joint, const double middle[3], const double sides[3])
{
    double floats[16], exact[3], narrow[3], distance = 0, lost = 0, size = 0;
    for (int i = 0; i < 16; i++) {
        floats[i] = (double)joint->world[i];
    }
    scene_import_transform_exact(joint->exact, middle, exact);
    scene_import_transform_exact(floats, middle, narrow);
    for (int row = 0; row < 3; row++) {
        double along = 0;
        for (int k = 0; k < 3; k++) {
            along += fabs(joint->exact[4 * k + row]) * sides[k];
        }
        size = fmax(size, along);
        distance = fmax(distance, fabs(exact[row]));
        lost = fmax(lost, fabs(exact[row] - narrow[row]));
    }
    const double most = ldexp(SCENE_IMPORT_FAR, -24) * size; // floats have 24 bits
    return distance > SCENE_IMPORT_FAR * size || lost > most;
}

struct scene_import_skin scene_import_skin_open(struct scene_import *import, struct scene_mesh *mesh,
                                                const struct scene_import_place *joints, size_t count)
{
    const uint32_t vertices = mesh->vertex_count;
    struct scene_import_skin skin = {
        .import = import,
        .mesh = mesh,
        .matrices = scene_import_allocate(import, vertices, sizeof *skin.matrices),
        .weights = scene_import_allocate(import, vertices, sizeof *skin.weights),
    };
    double middle[3], sides[3];
    bool is_lossy = false;
    find_box(mesh, middle, sides);
    for (size_t i = 0; i < count && !is_lossy; i++) {
        is_lossy = loses(&joints[i], middle, sides);
    }
    if (is_lossy) {
        skin.points = scene_import_allocate(import, vertices, sizeof *skin.points);
        skin.sums = scene_import_allocate(import, vertices, sizeof *skin.sums);
    }
    return skin;
}

void scene_import_skin_add(struct scene_import_skin *skin, uint32_t vertex,
                           const struct scene_import_place *joint, float weight)
{
    skin->weights[vertex] += weight;
    for (int m = 0; m < 16; m++) {
        skin->matrices[vertex][m] += weight * joint->world[m];
    }
    if (skin->points != NULL) {
        double place[3];
        scene_import_transform_floats(joint->exact, skin->mesh->positions[vertex], place);
        skin->sums[vertex] += (double)weight;
        for (int c = 0; c < 3; c++) {
            skin->points[vertex][c] += (double)weight * place[c];
        }
    }
}

static void turn_tangent(const float matrix[16], float tangent[3])
{
    float turned[3];
    for (int row = 0; row < 3; row++) {
        turned[row] = matrix[row] * tangent[0] + matrix[4 + row] * tangent[1] + matrix[8 + row] * tangent[2];
    }
    memcpy(tangent, turned, sizeof turned);
}

static void move_directions(const struct scene_import_skin *skin)
{
    const struct scene_mesh *const mesh = skin->mesh;
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        if (mesh->normals != NULL) {
            scene_import_move_normal(skin->matrices[v], mesh->normals[v]);
        }
        if (mesh->tangents != NULL) {
            turn_tangent(skin->matrices[v], mesh->tangents[v]);
        }
    }
}

static void move_floats(const struct scene_import_skin *skin, bool divides)
{
    for (uint32_t v = 0; v < skin->mesh->vertex_count; v++) {
        const float share = divides && skin->weights[v] > 0 ? 1 / skin->weights[v] : 1; // exporters round
        float point[3];
        scene_import_transform(skin->matrices[v], skin->mesh->positions[v], point);
        for (int c = 0; c < 3; c++) {
            skin->mesh->positions[v][c] = point[c] * share;
        }
    }
}

// Make positions of the sums in double. There the sum of the weights must be exactly 1: what a float of it is off by
// would move each vertex another way.
static void move_exactly(struct scene_import_skin *skin, double origin[3])
{
    for (uint32_t v = 0; v < skin->mesh->vertex_count; v++) {
        for (int c = 0; c < 3 && skin->sums[v] > 0; c++) {
            skin->points[v][c] /= skin->sums[v];
        }
    }
    free(skin->mesh->positions);
    free(skin->sums);
    scene_import_settle_mesh(skin->import, skin->mesh, skin->points, origin);
}

void scene_import_skin_close(struct scene_import_skin *skin, bool divides, double origin[3])
{
    memset(origin, 0, 3 * sizeof *origin);
    move_directions(skin);
    if (skin->points == NULL) {
        move_floats(skin, divides);
    } else {
        move_exactly(skin, origin);
    }
    free(skin->matrices);
    free(skin->weights);
}
