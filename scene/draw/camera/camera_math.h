// SPDX-License-Identifier: MIT
// Vectors for cameras, in double.
#ifndef SCENE_CAMERA_MATH_H
#define SCENE_CAMERA_MATH_H

#include <stdbool.h>

#include "elementary.h"

static inline double scene_tangent_of_half(double angle)
{
    double s, c;
    scene_sin_cos_degrees(angle * (90.0 / 3.14159265358979323846), &s, &c);
    return s / c;
}

static inline double scene_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void scene_cross(const double a[3], const double b[3], double result[3])
{
    result[0] = a[1] * b[2] - a[2] * b[1];
    result[1] = a[2] * b[0] - a[0] * b[2];
    result[2] = a[0] * b[1] - a[1] * b[0];
}

static inline bool scene_finite3(const double a[3])
{
    return a[0] - a[0] == 0.0 && a[1] - a[1] == 0.0 && a[2] - a[2] == 0.0;
}

/// Return the power of two that brings a length to 1..2, so that its square is a float, or as near to it as floats go.
/// Products with it are exact.
static inline float scene_unit_for(double length)
{
    double unit = 1.0;
    while (length > 0.0 && length * unit < 1.0 && unit < 0x1p120) {
        unit *= 2.0;
    }
    while (length * unit >= 2.0 && unit > 0x1p-120) {
        unit *= 0.5;
    }
    return (float)unit;
}

/// The line that something turns around. `axis` has length 1.
struct scene_turn {
    double center[3], axis[3];
};

/// Find the values that a linear function, `along`·p, has on the circle that a point turns on. They run from `middle` −
/// `reach` to `middle` + `reach`. The reach is the radius times the part of `along` that lies across the axis.
static inline void scene_turn_range(const struct scene_turn *turn, const double point[3],
                                    const double along[3], double *middle, double *reach)
{
    double from[3], radius2 = 0.0;
    for (int c = 0; c < 3; c++) {
        from[c] = point[c] - turn->center[c];
    }
    const double height = scene_dot(from, turn->axis), slope = scene_dot(along, turn->axis);
    for (int c = 0; c < 3; c++) {
        const double across = from[c] - height * turn->axis[c];
        radius2 += across * across;
    }
    const double across2 = scene_dot(along, along) - slope * slope;
    *middle = scene_dot(along, turn->center) + height * slope;
    *reach = across2 > 0.0 ? __builtin_sqrt(radius2 * across2) : 0.0;
}

static inline void scene_place_point(const float m[16], const float p[3], double result[3])
{
    for (int i = 0; i < 3; i++) {
        result[i] = (double)m[i] * (double)p[0] + (double)m[4 + i] * (double)p[1] +
                    (double)m[8 + i] * (double)p[2] + (double)m[12 + i];
    }
}

#endif
