// SPDX-License-Identifier: MIT
// 8 lines side by side, and what lies straight beside their ends.
#ifndef RHW_LINES8_H
#define RHW_LINES8_H

#include "base/constants.h"
#include "base/simd.h"

struct lines8 {
    i8 x[2], y[2]; // 24.8
    i8 flags;      // of their triangles
    i8 vertex[2], primitive, segment;
    i8 phase; // of lines with a stipple: its place where they begin (raster/stipple_mask.h)
};

// The corners beside the ends, 24.8; half_width_24_8 away from them.
struct line_sides8 {
    i8 x, y;          // of n
    unsigned nonzero; // bits of lines that are not points
};

static struct line_sides8 line_sides8(const struct lines8 *l, double half_width_24_8)
{
    const d8 dx = d8_from_i8(l->x[1] - l->x[0]), dy = d8_from_i8(l->y[1] - l->y[0]);
    const d8 squared = d8_add(d8_mul(dx, dx), d8_mul(dy, dy)); // below 2^49: exact
    const d8 scale = d8_div(d8_splat(half_width_24_8), d8_sqrt(squared));
    const double most = RHW_MAX_LINE_WIDTH * RHW_SUBPIXEL;
    const i8 x = i8_round_d8(d8_clamp(d8_mul(dy, scale), -most, most));
    const i8 y = i8_round_d8(d8_clamp(d8_mul(dx, scale), -most, most));
    const i8 zero = rhw_equal_int(l->x[0], l->x[1]) & rhw_equal_int(l->y[0], l->y[1]);
    return (struct line_sides8){-x, y, ~i8_sign_bits(zero)};
}

#endif
