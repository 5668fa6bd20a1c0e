// SPDX-License-Identifier: MIT
// The formulas of the contract, one sample at a time in double: what the unit tests hold the pipeline's
// pixels against. Nothing here is shared with the library. (The exact tests do the same in rational
// numbers; here a double is far below the 8 ULP that are allowed.)
#ifndef TEST_REFERENCE_H
#define TEST_REFERENCE_H

#include <stdbool.h>
#include <stdint.h>

/// A triangle on the screen. Tests choose positions that are multiples of 1/256 pixel, so that snapping is
/// the identity and says nothing about how the implementation rounds.
struct ref_triangle {
    int64_t x_8[3], y_8[3]; ///< 1/256 pixel, y down
    double w[3], depth[3];  ///< W and Z/W
};

struct ref_weights {
    double space[3];  ///< a, b, c
    double screen[3]; ///< r, s, t
    double w;
};

/// Whether the pixel's centre is covered: exact, with the top-left rule.
bool ref_covers(const struct ref_triangle *triangle, int pixel_x, int pixel_y);
/// Weights at screen position x, y in pixels. W > 0 at every vertex.
struct ref_weights ref_weights_at(const struct ref_triangle *triangle, double x, double y);
/// Weights at x, y for homogeneous screen vertices (x·W, y·W, W in pixels), W of any sign: the truth for a
/// triangle that has no picture of its own on the screen.
struct ref_weights ref_weights_homogeneous(const double vertices[3][3], double x, double y);
double ref_mix(const double weights[3], const double values[3]);
/// d/dx (axis 0) or d/dy (axis 1) per pixel of a smooth value.
double ref_derivative(const struct ref_triangle *triangle, double x, double y, const double values[3],
                      int axis);

/// sRGB transfer functions, IEC 61966-2-1.
double ref_srgb_encode(double linear);
double ref_srgb_decode(double encoded);
/// The value of an IEEE binary16 pattern.
double ref_half(uint16_t bits);

#endif
