// SPDX-License-Identifier: MIT
// Vectors of normals, in double. Only + − × ÷ and square roots are used, so results are equal everywhere.
#ifndef SCENE_VECTOR_H
#define SCENE_VECTOR_H

#include <stdbool.h>

#include "draw/camera/camera_math.h"

static inline void scene_vector_between(const float from[3], const float to[3], double between[3])
{
    for (int c = 0; c < 3; c++) {
        between[c] = (double)to[c] - (double)from[c];
    }
}

/// Scale to length 1, or to 0 when there is no direction. Squares of doubles made of floats stay in range.
static inline void scene_vector_unit(double vector[3])
{
    const double length = __builtin_sqrt(scene_dot(vector, vector));
    const double scale = length > 0 ? 1 / length : 0;
    for (int c = 0; c < 3; c++) {
        vector[c] *= scale;
    }
}

/// Make a normal of a vector of length 1. It is (0, 0, 1) where the vector has no direction.
static inline void scene_vector_narrow(const double unit[3], float normal[3])
{
    const bool none = unit[0] == 0 && unit[1] == 0 && unit[2] == 0;
    for (int c = 0; c < 3; c++) {
        normal[c] = none ? (c == 2 ? 1.0f : 0.0f) : (float)unit[c];
    }
}

/// Make a normal of a vector of any length.
static inline void scene_vector_to_normal(const double vector[3], float normal[3])
{
    double direction[3] = {vector[0], vector[1], vector[2]};
    scene_vector_unit(direction);
    scene_vector_narrow(direction, normal);
}

/// Return the angle whose cosine is `cosine`, which is from 0 to 1, in radians. The error is below 7e-5 (Abramowitz and
/// Stegun 4.4.45), ample for a weight, and equal on every machine.
static inline double scene_vector_acute_angle(double cosine)
{
    const double polynomial = 1.5707288 + cosine * (-0.2121144 + cosine * (0.0742610 - 0.0187293 * cosine));
    return __builtin_sqrt(1 - cosine) * polynomial;
}

/// Return the angle whose cosine is `cosine`, where `acute` is that of its size.
static inline double scene_vector_whole_angle(double cosine, double acute)
{
    return cosine < 0 ? 3.14159265358979324 - acute : acute;
}

/// Return the angle whose cosine is `cosine`, held between −1 and 1.
static inline double scene_vector_angle(double cosine)
{
    const double x = cosine < 0 ? -cosine : cosine;
    return scene_vector_whole_angle(cosine, scene_vector_acute_angle(x > 1 ? 1 : x));
}

#endif
