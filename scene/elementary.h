// SPDX-License-Identifier: MIT
// Sine, logarithm and the like in double, the same bits on every machine: a C library may answer differently on the next
// one. Additions, multiplications and divisions in a fixed order. Errors stated were measured by
// tests/unit/scene/test_elementary.c.
#ifndef SCENE_ELEMENTARY_H
#define SCENE_ELEMENTARY_H

// Degrees, so that the quarter turns come out exactly; NaN where degrees is not finite.
void scene_sin_cos_degrees(double degrees, double *sine, double *cosine);

// Radians; within 2^-52. Beyond a million radians the angle is taken modulo the double next to 2π; one that is not finite
// gives NaN.
double scene_sin(double angle);
double scene_cos(double angle);
double scene_tan(double angle); // within 2^-51 of the result, away from its poles
double scene_atan(double a);    // within 2^-50 of the result

double scene_exp(double a); // within 2^-51 of the result
double scene_log(double a); // within 2^-51, or of the result where that is more than 1
// a^b for a >= 0; 1 where b is 0. Where the result is an ordinary float: within 2^-44 of it.
double scene_pow(double a, double b);

#endif
