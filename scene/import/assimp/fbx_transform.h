// SPDX-License-Identifier: MIT
// The transform of a model in an FBX, in double. Twelve vectors make it, and assimp makes matrices of floats of them.
#ifndef SCENE_IMPORT_FBX_TRANSFORM_H
#define SCENE_IMPORT_FBX_TRANSFORM_H

#include <stdbool.h>
#include <stddef.h>

enum scene_fbx_vector {
    SCENE_FBX_TRANSLATION,
    SCENE_FBX_ROTATION_OFFSET,
    SCENE_FBX_ROTATION_PIVOT,
    SCENE_FBX_PRE_ROTATION,
    SCENE_FBX_ROTATION,
    SCENE_FBX_POST_ROTATION,
    SCENE_FBX_SCALING_OFFSET,
    SCENE_FBX_SCALING_PIVOT,
    SCENE_FBX_SCALING,
    SCENE_FBX_GEOMETRIC_TRANSLATION, // this and the next two move the geometry alone, not models below
    SCENE_FBX_GEOMETRIC_ROTATION,
    SCENE_FBX_GEOMETRIC_SCALING,
    SCENE_FBX_VECTORS,
};

/// Two matrices: that of the model, and that of its geometry within it.
enum { SCENE_FBX_MATRICES = 2 };

struct scene_fbx_transform {
    double vectors[SCENE_FBX_VECTORS][3];
    bool is_given[SCENE_FBX_VECTORS];
    double order; ///< in which a rotation's angles are applied
};

struct scene_fbx_transform scene_fbx_transform_default(void);
/// Return the vector that a property is, by its name. Return SCENE_FBX_VECTORS if it is none.
enum scene_fbx_vector scene_fbx_vector_of(const char *name, size_t length);
/// Return the number of the matrix that a vector belongs to.
int scene_fbx_matrix_of(enum scene_fbx_vector vector);
/// Return the vector that moves things by one of the two matrices.
enum scene_fbx_vector scene_fbx_mover_of(int matrix);
/// Return the name of a vector.
const char *scene_fbx_vector_name(enum scene_fbx_vector vector);
/// Return true for a vector that is places or ways, not angles or factors.
bool scene_fbx_is_way(enum scene_fbx_vector vector);
/// Find one of the two matrices. Return false if assimp's floats may have all of it.
bool scene_fbx_find_matrix(const struct scene_fbx_transform *transform, int number, double matrix[16]);

#endif
