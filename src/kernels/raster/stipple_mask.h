// SPDX-License-Identifier: MIT
// The stipple of a line decides which of its pixels are drawn (struct rhw_line_stipple). Places along a line are whole
// numbers: columns, or rows, of a Bresenham line, and 1/256 pixel of a rectangular one. `unit` places in a row have one
// bit of the pattern.
//
// The phase of a triangle is a place: for a Bresenham line it is the place of column 0, from which places rise to where
// the line leads; for a rectangular line it is the place of the line's beginning. Both are known to a whole pattern.
#ifndef RHW_STIPPLE_MASK_H
#define RHW_STIPPLE_MASK_H

#include "base/constants.h"
#include "base/simd.h"
#include "draw/triangle.h"

// Return a bit for each place that is drawn. Half a place behind a place is never a multiple of `unit`, so that no
// quotient lies where rounding decides.
static unsigned stippled8(i32x8 place, int unit, int pattern)
{
    const f64x8 units = f64x8_div(f64x8_add(f64x8_from_i32x8(place), f64x8_splat(0.5)), f64x8_splat(unit));
    const i32x8 number = i32x8_round_f64x8(f64x8_sub(units, f64x8_splat(0.5))) & i32x8_splat(15);
    const i32x8 bit = i32x8_power2(number) & i32x8_splat(pattern);
    return ~i32x8_sign_bits(rhw_equal_int(bit, i32x8_splat(0))) & 0xff;
}

// Return the pixels of the block at (x, y) of the target that the stipple of a Bresenham line draws.
static uint64_t stippled_columns(const struct rhw_triangle *t, const struct rhw_line_stipple *stipple,
                                 bool is_y_major, int x, int y)
{
    const int32_t along = is_y_major ? t->y_24_8[2] - t->y_24_8[0] : t->x_24_8[2] - t->x_24_8[0];
    const i32x8 column = i32x8_splat(is_y_major ? y : x) + rhw_lane_index;
    const i32x8 place = i32x8_splat(t->phase) + (along < 0 ? -column : column);
    const unsigned bits = stippled8(place, stipple->factor, stipple->pattern);
    uint64_t mask = 0;
    for (int row = 0; row < RHW_BLOCK; row++) {
        const unsigned of_row = !is_y_major ? bits : bits >> row & 1 ? 0xff : 0;
        mask |= (uint64_t)of_row << (8 * row);
    }
    return mask;
}

// A rectangular line. A point lies (dx·x + dy·y − begin) / length along it. All numbers but the length are integers
// below 2^50, 1/256 pixel or products of two.
struct stippled_rectangle {
    double dx, dy, begin, length;
    int32_t phase;
    int unit, pattern;
};

// Return the stippled line that a triangle is half of. The first half (geometry/line_rectangle.h) has corners a + n, a
// − n, b + n, and vertex a twice; the second has a − n, b − n, b + n.
static struct stippled_rectangle stippled_rectangle_of(const struct rhw_triangle *t,
                                                       const struct rhw_line_stipple *stipple)
{
    const bool is_first = t->vertex[0] == t->vertex[1];
    const int to = is_first ? 2 : 1;
    const double dx = t->x_24_8[to] - t->x_24_8[0], dy = t->y_24_8[to] - t->y_24_8[0];
    const double twice_a[2] = {
        is_first ? (double)t->x_24_8[0] + t->x_24_8[1] : 2.0 * t->x_24_8[0] + t->x_24_8[2] - t->x_24_8[1],
        is_first ? (double)t->y_24_8[0] + t->y_24_8[1] : 2.0 * t->y_24_8[0] + t->y_24_8[2] - t->y_24_8[1]};
    const f64x8 length = f64x8_sqrt(f64x8_splat(dx * dx + dy * dy));
    return (struct stippled_rectangle){.dx = dx,
                                       .dy = dy,
                                       .begin = (dx * twice_a[0] + dy * twice_a[1]) / 2,
                                       .length = length.lo[0],
                                       .phase = t->phase,
                                       .unit = stipple->factor * RHW_SUBPIXEL,
                                       .pattern = stipple->pattern};
}

// Return the pixels of a block whose samples the stipple draws. x and y are the position of the first pixel's sample,
// in 1/256 pixel of the target. What lies before the beginning by the rounding of the rectangle's corners counts as the
// beginning.
static uint64_t stippled_samples(const struct stippled_rectangle *line, int64_t x, int64_t y)
{
    const f64x8 columns = f64x8_mul(f64x8_from_i32x8(rhw_lane_index), f64x8_splat(RHW_SUBPIXEL));
    const f64x8 at_x = f64x8_mul(f64x8_add(columns, f64x8_splat((double)x)), f64x8_splat(line->dx));
    const double farthest = 1 << 29;
    uint64_t mask = 0;
    for (int row = 0; row < RHW_BLOCK; row++) {
        const double at_y = line->dy * (double)(y + row * RHW_SUBPIXEL) - line->begin;
        const f64x8 along = f64x8_div(f64x8_add(at_x, f64x8_splat(at_y)), f64x8_splat(line->length));
        const i32x8 place = i32x8_round_f64x8(f64x8_clamp(along, 0, farthest)) + i32x8_splat(line->phase);
        mask |= (uint64_t)stippled8(place, line->unit, line->pattern) << (8 * row);
    }
    return mask;
}

#endif
