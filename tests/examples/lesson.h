// SPDX-License-Identifier: MIT
// What the tests of the lessons share. A test includes the lesson's source, whose functions are static, with
// its main renamed; it draws into float targets and holds every pixel against the formulas, which reference.h
// evaluates in double on the snapped positions.
#ifndef LESSON_H
#define LESSON_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <rhw/rhw.h>

#include "reference.h"

/// The renamed main of the lesson.
int lesson_main(int argc, char **argv);

/// Clip coordinates to the screen, as the viewport and the snapping to 1/256 pixel say.
struct ref_triangle lesson_triangle(const float clip[3][4], const struct rhw_viewport *viewport);

/// Fails unless value is within 8 ULP of `largest`, the largest vertex value, of the truth.
void lesson_near(const char *what, int column, int row, float value, double truth, double largest);

/// Fails unless the two are no further apart than `tolerance`.
void lesson_close(double value, double truth, double tolerance);

/// Fails unless pixel and triangle agree on coverage. Returns whether it is covered.
bool lesson_covered(const struct ref_triangle *triangle, int column, int row, bool drawn);

/// The weights at a pixel's centre.
struct ref_weights lesson_weights(const struct ref_triangle *triangle, int column, int row);

double lesson_dot(const double a[3], const double b[3]);

/// The direction, of length 1, from `eye` through a place of a picture of size × size pixels, as solid_camera of the
/// same arguments has it.
void lesson_ray(const float eye[3], const float target[3], float zoom, int size, double column, double row,
                double direction[3]);

/// Runs the lesson itself in the test's folder; it must end with 0.
void lesson_run(void **state);

#endif
