// SPDX-License-Identifier: MIT
// The truth about one triangle, in exact arithmetic: which samples it covers and what every value is there.
// Written from the formulas of docs/exactness.md with GMP integers and rationals; it shares no code and no
// intermediate result with the pipeline. Only the snapped positions are defined in floating point, because
// that is what the contract says (see oracle_snap).
//
// At a sample the triangle has three integers, its edge values e_0, e_1, e_2 (e_i is the doubled area
// opposite vertex i, up to one common factor). Every interpolated value is a ratio of two linear forms of
// them, (Σ e_i·over_i) / (Σ e_i·under_i), with integer coefficients that are fixed per triangle:
//
//                    snapped triangle            homogeneous triangle (a vertex cannot be snapped)
//     smooth         I_i/W_i     over 1/W_i      I_i        over 1
//     noperspective  I_i         over 1          I_i·W_i    over W_i
//     Z/W            Z_i/W_i     over 1          Z_i        over W_i
//     1/W            1/W_i       over 1          1          over W_i
//
// A ratio of integers is exact; a double beside every coefficient gives a fast value with a proven bound, and
// where that bound is not tiny the integers decide.
#ifndef EXACT_ORACLE_H
#define EXACT_ORACLE_H

#include <gmp.h>
#include <stdbool.h>
#include <stdint.h>

struct oracle_view {
    int target_width, target_height; // pixels
    float x, y, width, height;       // viewport, pixels from the top left of the target
    float depth_min, depth_max;
    bool minus_one_to_one; // OpenGL's depth convention in clip space
};

// 3 corners and one more for each of 6 planes.
enum { ORACLE_CORNERS = 9 };

// Σ e_i·over_i / Σ e_i·under_i · 2^exponent.
struct oracle_form {
    mpz_t over[3], under[3];
    long exponent;
    double over_d[3], under_d[3]; // correct to one rounding; over_d includes 2^exponent
    double vertex_max;            // largest magnitude among the vertex values the form interpolates
    bool screen;                  // of a homogeneous triangle, and linear on the screen
};

struct oracle_triangle {
    float position[3][4];
    struct oracle_view view;
    bool empty;     // not finite, outside, or of no area and not cut: covers nothing
    bool clipped;   // coverage is that of the clipped polygon
    bool snapped;   // values come from the snapped positions
    bool ambiguous; // a cut corner is too near a rounding tie for any implementation to be held to it
    int turn;       // +1: the vertices turn clockwise as seen on the screen, −1: the other way
    int corner_count;
    int32_t corner_24_8[ORACLE_CORNERS][2];
    int32_t vertex_24_8[3][2]; // of snapped vertices
    // Edge value i at the centre of pixel (x, y) is edge[i][0]·x + edge[i][1]·y + edge[i][2].
    mpz_t edge[3][3];
    // Integer forms of the coordinates: W_i = w[i]·2^w_exponent, and z alike.
    mpz_t w[3], z[3];
    long w_exponent, z_exponent;
    mpz_t temporary[4];
};

// Edge values at one sample, exact and as doubles that are correct to one rounding.
struct oracle_sample {
    mpz_t line[3]; // of the lines through the edges
    mpz_t e[3];    // the same, or 0 where a cut triangle's sample is off the triangle
    mpz_t sum;
    double line_d[3], e_d[3];
    bool inside; // no line is below 0
    bool linear; // forms that are linear on the screen take `line` instead of `e`
};

void oracle_triangle_init(struct oracle_triangle *t);
void oracle_triangle_clear(struct oracle_triangle *t);
void oracle_form_init(struct oracle_form *f);
void oracle_form_clear(struct oracle_form *f);
void oracle_sample_init(struct oracle_sample *s);
void oracle_sample_clear(struct oracle_sample *s);

// Where a vertex lands, in 1/256 pixel: computed in double from the float inputs and rounded once, ties to
// even. False when the vertex cannot be snapped: W <= 0, or beyond the guard band.
bool oracle_snap(const struct oracle_view *view, const float position[4], int32_t xy_24_8[2]);

// Takes the clip-space positions of a triangle and works out everything that does not depend on the sample.
void oracle_triangle_set(struct oracle_triangle *t, const struct oracle_view *view,
                         const float position[3][4]);

// The same for a triangle that a renderer places on the screen itself, with W and Z of these positions; W > 0. Its corners
// turn round an area. Nothing is cut.
void oracle_triangle_set_snapped(struct oracle_triangle *t, const struct oracle_view *view,
                                 const int32_t corner_24_8[3][2], const float position[3][4]);

void oracle_form_smooth(struct oracle_form *f, const struct oracle_triangle *t, const float value[3]);
void oracle_form_noperspective(struct oracle_form *f, const struct oracle_triangle *t, const float value[3]);
// After the viewport's depth range, before it is clamped to it.
void oracle_form_depth(struct oracle_form *f, struct oracle_triangle *t);
void oracle_form_inverse_w(struct oracle_form *f, const struct oracle_triangle *t);

// The covered pixels of row `y`: [x[0], x[1]), [x[2], x[3]), ... Returns how many numbers it wrote (even).
// A sample on an edge is decided by the top-left rule, which is the same as moving every sample right by an
// infinitesimal amount and down by a much smaller one.
int oracle_cover_row(const struct oracle_triangle *t, int y, int x[ORACLE_CORNERS]);
// Rows that may be covered: [*y0, *y1).
void oracle_rows(const struct oracle_triangle *t, int *y0, int *y1);

// Edge values at the centre of pixel (x, y), and one pixel further right.
void oracle_sample_at(struct oracle_sample *s, const struct oracle_triangle *t, int x, int y);
void oracle_sample_right(struct oracle_sample *s, const struct oracle_triangle *t);
// At `by`/256 pixel from the centre of pixel (x, y). All edge values are 256 times those of the centre, which is one common
// factor.
void oracle_sample_beside(struct oracle_sample *s, const struct oracle_triangle *t, int x, int y,
                          const int by_24_8[2]);

// The least 1/W that the triangle's points in front of the eye have; the linear 1/W does not go below it.
double oracle_least_inverse_w(const struct oracle_triangle *t);

// The value at a sample, correctly computed to within 2^-40 of the form's largest vertex value.
double oracle_value(const struct oracle_form *f, const struct oracle_sample *s);
// |got − truth| / unit, from the integers alone; unit is a power of two. NaN where the value is undefined.
double oracle_error(const struct oracle_form *f, const struct oracle_sample *s, double got, double unit);
// The same, through doubles; *slack receives a proven bound on how far the result may be off.
double oracle_error_fast(const struct oracle_form *f, const struct oracle_sample *s, double got, double unit,
                         double *slack);
// The largest |weight|: 1 or less inside a triangle whose vertices all have W > 0. Behind a vertex with W <= 0
// the weights on the screen are no means but any numbers whose sum is 1.
double oracle_largest_weight(const struct oracle_form *f, const struct oracle_sample *s);

// d(value)/dx (axis 0) or /dy (axis 1), per pixel, and the size its error is measured against: the largest
// d(weight) times the largest vertex value.
double oracle_derivative(const struct oracle_form *f, const struct oracle_triangle *t,
                         const struct oracle_sample *s, int axis, double *size);

// Unit in the last place of a float of this magnitude; of the smallest one below the normal range.
double oracle_ulp(double magnitude);

#endif
