// SPDX-License-Identifier: MIT
// Sine, logarithm and their kin in double, with equal bits on every machine: a C library may answer differently on the
// next one. They are additions, multiplications and divisions in a fixed order. The stated errors were measured by
// tests/unit/scene/test_elementary.c.
#ifndef SCENE_ELEMENTARY_H
#define SCENE_ELEMENTARY_H

// Degrees, so that the quarter turns come out exactly. Both results are NaN where `degrees` is not finite.
void scene_sin_cos_degrees(double degrees, double *sine, double *cosine);

// Angles are radians, and errors are within 2^-52. Beyond a million radians an angle is taken modulo the double next to
// 2π. An angle that is not finite gives NaN.
double scene_sin(double angle);
double scene_cos(double angle);
double scene_tan(double angle); // within 2^-51 of the result, away from its poles
double scene_atan(double a);    // within 2^-50 of the result

double scene_exp(double a); // within 2^-51 of the result
double scene_log(double a); // within 2^-51, or within 2^-51 of the result where that is more than 1
// Return a^b for a >= 0. The power is 1 where b is 0. Its error is within 2^-44 of the result where the result is an
// ordinary float.
double scene_pow(double a, double b);

#endif
