// SPDX-License-Identifier: MIT
// 8 lines side by side, and the points straight beside their ends.
#ifndef RHW_LINES8_H
#define RHW_LINES8_H

#include "base/constants.h"
#include "base/simd.h"

struct lines8 {
    i32x8 x[2], y[2]; // 24.8
    i32x8 flags;      // flags of the lines' triangles
    i32x8 vertex[2], primitive, segment;
    // The place in the stipple's pattern where lines with a stipple begin (raster/stipple_mask.h).
    i32x8 phase;
};

// The corners beside the ends, 24.8. They are half_width_24_8 away from the ends.
struct line_sides8 {
    i32x8 x, y;       // vector n across the lines
    unsigned nonzero; // bits of lines that are not points
};

static struct line_sides8 line_sides8(const struct lines8 *l, double half_width_24_8)
{
    const f64x8 dx = f64x8_from_i32x8(l->x[1] - l->x[0]), dy = f64x8_from_i32x8(l->y[1] - l->y[0]);
    const f64x8 squared = f64x8_add(f64x8_mul(dx, dx), f64x8_mul(dy, dy)); // below 2^49: exact
    const f64x8 scale = f64x8_div(f64x8_splat(half_width_24_8), f64x8_sqrt(squared));
    const double most = RHW_MAX_LINE_WIDTH * RHW_SUBPIXEL;
    const i32x8 x = i32x8_round_f64x8(f64x8_clamp(f64x8_mul(dy, scale), -most, most));
    const i32x8 y = i32x8_round_f64x8(f64x8_clamp(f64x8_mul(dx, scale), -most, most));
    const i32x8 zero = rhw_equal_int(l->x[0], l->x[1]) & rhw_equal_int(l->y[0], l->y[1]);
    return (struct line_sides8){-x, y, ~i32x8_sign_bits(zero)};
}

#endif
