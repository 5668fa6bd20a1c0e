// SPDX-License-Identifier: MIT
// What the animations of all formats need.
#ifndef SCENE_POSE_H
#define SCENE_POSE_H

#include "place.h"

/// Return the number of the model's animation that is wanted, by its name, or by its number where none has that name.
/// Return −1 if there is none.
int64_t scene_import_find_animation(const struct scene_import *import);
/// Interpolate on the sphere, linearly and the short way (glTF 2.0 §C.4). The result is not made unit.
void scene_import_slerp(const float from[4], const float to[4], double part, double result[4]);
/// Make the place that scales, turns by a quaternion of any length, and moves, in this order. Its floats are made of
/// floats.
struct scene_import_place scene_import_compose(const double translation[3], const double rotation[4],
                                               const double scale[3]);

#endif
