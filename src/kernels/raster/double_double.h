// SPDX-License-Identifier: MIT
// Edge functions in double-double, for the triangles with a vertex that cannot be snapped. Their vertices are floats of
// any magnitude, and a sliver of them may be a millionth of a pixel wide where a pixel centre lies in it: every weight
// is then next to nothing divided by next to nothing, and double does not survive this. A pair of doubles carries 106
// bits (Dekker 1971, A Floating-Point Technique for Extending the Available Precision). Products of two floats are
// exact in one double already.

#ifndef RHW_DOUBLE_DOUBLE_H
#define RHW_DOUBLE_DOUBLE_H

#include "base/simd.h"

struct dd {
    double hi, lo; // hi + lo is the number; |lo| is at most half an ULP of hi
};

// Return a + b, where |a| >= |b|.
static struct dd dd_sum_ordered(double a, double b)
{
    const double s = a + b;
    return (struct dd){s, b - (s - a)};
}

static struct dd dd_sum(double a, double b)
{
    const double s = a + b, t = s - a;
    return (struct dd){s, (a - (s - t)) + (b - t)};
}

// Return the upper 26 bits of a double. The bits that are left are 26 too.
static double dd_upper(double a)
{
    const double t = 134217729.0 * a; // 2^27 + 1
    return t - (t - a);
}

static struct dd dd_product(double a, double b)
{
    const double p = a * b, a1 = dd_upper(a), b1 = dd_upper(b), a2 = a - a1, b2 = b - b1;
    return (struct dd){p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2};
}

static struct dd dd_add(struct dd a, struct dd b)
{
    struct dd s = dd_sum(a.hi, b.hi);
    const struct dd t = dd_sum(a.lo, b.lo);
    s = dd_sum_ordered(s.hi, s.lo + t.hi);
    return dd_sum_ordered(s.hi, s.lo + t.lo);
}

static struct dd dd_scale(struct dd a, double b)
{
    const struct dd p = dd_product(a.hi, b);
    return dd_sum_ordered(p.hi, p.lo + a.lo * b);
}

// A plane like struct plane: its value at the anchor's centre, and its change per pixel.
struct dd_plane {
    struct dd at, dx, dy;
};

// Return the edge from vertex j to vertex k of a homogeneous triangle, whose vertices are given as X, Y, W. The map M
// leads from there to pixels times W. The edge is (M·V_j × M·V_k)·P, taken apart so that the cross product is a cross
// product of floats, which is exact. `cx` and `cy` are the viewport's centre, in pixels from the anchor's centre.
static struct dd_plane dd_edge(const double j[3], const double k[3], double half_width, double half_height,
                               double cx, double cy)
{
    struct dd cross[3];
    for (int i = 0; i < 3; i++) {
        const int m = i == 2 ? 0 : i + 1, n = i == 0 ? 2 : i - 1;
        cross[i] = dd_sum(j[m] * k[n], -(j[n] * k[m]));
    }
    struct dd_plane e;
    e.dx = dd_scale(cross[0], -half_height);
    e.dy = dd_scale(cross[1], half_width);
    e.at = dd_add(dd_scale(cross[2], -(half_width * half_height)),
                  dd_add(dd_scale(e.dx, -cx), dd_scale(e.dy, -cy)));
    return e;
}

// Return the determinant of three rows of floats. It is zero exactly if the true determinant is zero: as long as the
// exponents of the floats lie within 2^24 of each other, a nonzero determinant stays above the rounding errors.
static struct dd dd_determinant(double v[3][3])
{
    struct dd det = {0, 0};
    double size = 0;
    for (int i = 0; i < 3; i++) {
        const int m = i == 2 ? 0 : i + 1, n = i == 0 ? 2 : i - 1;
        const double plus = v[1][m] * v[2][n], minus = v[1][n] * v[2][m];
        det = dd_add(det, dd_scale(dd_sum(plus, -minus), v[0][i]));
        size += __builtin_fabs(plus * v[0][i]) + __builtin_fabs(minus * v[0][i]);
    }
    return __builtin_fabs(det.hi) <= 0x1p-98 * size ? (struct dd){0, 0} : det;
}

// Return the values at half a row of 8 pixels. `dx` are integers below 2^16, pixels from the anchor.
static f64x4 dd_row_half(const struct dd_plane *e, f64x4 dx, struct dd row)
{
    const double upper = dd_upper(e->dx.hi);
    const f64x4 p = dx * f64x4_splat(e->dx.hi);
    const f64x4 p_lo =
        (dx * f64x4_splat(upper) - p) + dx * f64x4_splat(e->dx.hi - upper) + dx * f64x4_splat(e->dx.lo);
    const f64x4 hi = f64x4_splat(row.hi), s = hi + p, t = s - hi;
    const f64x4 s_lo = (hi - (s - t)) + (p - t);
    return s + (s_lo + (p_lo + f64x4_splat(row.lo)));
}

static f64x8 dd_row(const struct dd_plane *e, f64x8 dx, double dy)
{
    const struct dd row = dd_add(e->at, dd_scale(e->dy, dy));
    return (f64x8){dd_row_half(e, dx.lo, row), dd_row_half(e, dx.hi, row)};
}

#endif
