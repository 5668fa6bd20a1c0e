// SPDX-License-Identifier: MIT
#include "fbx_transform.h"

#include <string.h>

#include "assimp_exact.h"
#include "elementary.h"

static const struct {
    const char *name;
    enum { WAY, ANGLES, FACTORS } kind;
} vectors[SCENE_FBX_VECTORS] = {
    {"Lcl Translation", WAY},      {"RotationOffset", WAY},       {"RotationPivot", WAY},
    {"PreRotation", ANGLES},       {"Lcl Rotation", ANGLES},      {"PostRotation", ANGLES},
    {"ScalingOffset", WAY},        {"ScalingPivot", WAY},         {"Lcl Scaling", FACTORS},
    {"GeometricTranslation", WAY}, {"GeometricRotation", ANGLES}, {"GeometricScaling", FACTORS},
};

enum scene_fbx_vector scene_fbx_vector_of(const char *name, size_t length)
{
    enum scene_fbx_vector vector = SCENE_FBX_TRANSLATION;
    while (vector < SCENE_FBX_VECTORS &&
           (strlen(vectors[vector].name) != length || memcmp(vectors[vector].name, name, length) != 0)) {
        vector++;
    }
    return vector;
}

int scene_fbx_matrix_of(enum scene_fbx_vector vector)
{
    return vector >= SCENE_FBX_GEOMETRIC_TRANSLATION;
}

enum scene_fbx_vector scene_fbx_mover_of(int matrix)
{
    return matrix == 0 ? SCENE_FBX_TRANSLATION : SCENE_FBX_GEOMETRIC_TRANSLATION;
}

const char *scene_fbx_vector_name(enum scene_fbx_vector vector)
{
    return vectors[vector].name;
}

bool scene_fbx_is_way(enum scene_fbx_vector vector)
{
    return vector < SCENE_FBX_VECTORS && vectors[vector].kind == WAY;
}

struct scene_fbx_transform scene_fbx_transform_default(void)
{
    struct scene_fbx_transform transform = {.order = 0};
    for (int i = 0; i < SCENE_FBX_VECTORS; i++) {
        for (int c = 0; c < 3; c++) {
            transform.vectors[i][c] = vectors[i].kind == FACTORS ? 1 : 0;
        }
    }
    return transform;
}

static void move(double product[16], const double way[3], double sign)
{
    double m[16];
    scene_import_identity_exact(m);
    for (int c = 0; c < 3; c++) {
        m[12 + c] = sign * way[c];
    }
    scene_import_multiply_exact(product, m, product);
}

static void scale(double product[16], const double factors[3])
{
    double m[16];
    scene_import_identity_exact(m);
    for (int c = 0; c < 3; c++) {
        m[5 * c] = factors[c];
    }
    scene_import_multiply_exact(product, m, product);
}

// Turn by angles about the axes. The digits of an order are the axes, that which is applied first at their end.
static void turn(double product[16], const double angles[3], double order, bool is_backward)
{
    static const char orders[][4] = {"210", "120", "021", "201", "102", "012"};
    const int number = order >= 0 && order < 6 ? (int)order : -1;
    for (int i = 0; i < 3 && number >= 0; i++) {
        const int axis = orders[number][is_backward ? 2 - i : i] - '0';
        const int next = (axis + 1) % 3, last = (axis + 2) % 3;
        double m[16], sine, cosine;
        scene_import_identity_exact(m);
        scene_sin_cos_degrees(is_backward ? -angles[axis] : angles[axis], &sine, &cosine);
        m[5 * next] = m[5 * last] = cosine;
        m[4 * next + last] = sine;
        m[4 * last + next] = -sine;
        scene_import_multiply_exact(product, m, product);
    }
}

bool scene_fbx_find_matrix(const struct scene_fbx_transform *transform, int number, double matrix[16])
{
    const double(*const v)[3] = transform->vectors;
    bool is_wide = false, is_good = true;
    scene_import_identity_exact(matrix);
    if (number == 0) {
        move(matrix, v[SCENE_FBX_TRANSLATION], 1);
        move(matrix, v[SCENE_FBX_ROTATION_OFFSET], 1);
        move(matrix, v[SCENE_FBX_ROTATION_PIVOT], 1);
        turn(matrix, v[SCENE_FBX_PRE_ROTATION], 0, false);
        turn(matrix, v[SCENE_FBX_ROTATION], transform->order, false);
        turn(matrix, v[SCENE_FBX_POST_ROTATION], 0, true);
        move(matrix, v[SCENE_FBX_ROTATION_PIVOT], -1);
        move(matrix, v[SCENE_FBX_SCALING_OFFSET], 1);
        move(matrix, v[SCENE_FBX_SCALING_PIVOT], 1);
        scale(matrix, v[SCENE_FBX_SCALING]);
        move(matrix, v[SCENE_FBX_SCALING_PIVOT], -1);
    } else {
        move(matrix, v[SCENE_FBX_GEOMETRIC_TRANSLATION], 1);
        turn(matrix, v[SCENE_FBX_GEOMETRIC_ROTATION], transform->order, false);
        scale(matrix, v[SCENE_FBX_GEOMETRIC_SCALING]);
    }
    for (int i = 0; i < SCENE_FBX_VECTORS; i++) {
        const double *const vector = v[i];
        for (int c = 0; c < 3 && scene_fbx_matrix_of((enum scene_fbx_vector)i) == number; c++) {
            const bool is_turn = vectors[i].kind == ANGLES && (vector[c] < 0 || vector[c] > 0);
            const bool is_way = vectors[i].kind == WAY && (vector[c] < 0 || vector[c] > 0);
            is_wide = is_wide || is_turn || is_way || (double)(float)vector[c] != vector[c];
        }
    }
    for (int i = 0; i < 16; i++) {
        is_good = is_good && matrix[i] < 1e30 && matrix[i] > -1e30;
    }
    return is_wide && is_good;
}
