// SPDX-License-Identifier: MIT
// What the animations of all formats need.
#ifndef SCENE_POSE_H
#define SCENE_POSE_H

#include "import.h"

/// Return the number of the model's animation that is wanted, by its name, or by its number where none has that name.
/// Return −1 if there is none.
int64_t scene_import_find_animation(const struct scene_import *import);
/// Interpolate on the sphere, linearly and the short way (glTF 2.0 §C.4). The result is not made unit.
void scene_import_slerp(const float from[4], const float to[4], double part, float result[4]);
/// Make the matrix that scales, turns by a quaternion of any length, and moves, in this order.
void scene_import_compose(const float translation[3], const float rotation[4], const float scale[3],
                          float matrix[16]);
void scene_import_compose_exact(const double translation[3], const double rotation[4], const double scale[3],
                                double matrix[16]);

#endif
