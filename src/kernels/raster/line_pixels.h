// SPDX-License-Identifier: MIT
// The pixels of a Bresenham line (geometry/line_bresenham.h). In each column of its rectangle, the line has the pixel
// whose centre it passes nearest to. A steep line has one pixel in each row instead.
#ifndef RHW_LINE_PIXELS_H
#define RHW_LINE_PIXELS_H

#include "base/constants.h"
#include "base/simd.h"
#include "draw/triangle.h"

// In column c the line has the pixel ⌊(n + step·c) / scale⌋ across, counted from the target's edge: this is where the
// line passes the centre of c, in whole pixels. All numbers are integers, or halves of them, below 2^50.
struct line_pixels {
    bool is_y_major;
    double n, step, scale;
    int width; // number of pixels across, from the computed one on
};

static struct line_pixels line_pixels_of(const struct rhw_triangle *t, int width)
{
    const double dx = t->x_24_8[2] - t->x_24_8[0], dy = t->y_24_8[2] - t->y_24_8[0];
    const bool is_y_major = (dy < 0 ? -dy : dy) > (dx < 0 ? -dx : dx);
    const double along = is_y_major ? dy : dx, across = is_y_major ? dx : dy, sign = along < 0 ? -1 : 1;
    const double major = is_y_major ? t->y_24_8[0] : t->x_24_8[0],
                 minor = (is_y_major ? t->x_24_8[0] : t->y_24_8[0]) - (width - 1) * (RHW_SUBPIXEL / 2);
    // Moved by (−ε, −ε²), a line that rises to the right comes to lie higher. Any other line comes to lie lower, and a
    // steep one to the left.
    const bool goes_up = !is_y_major && across * sign > 0;
    const double n = sign * (minor * along + across * (RHW_SUBPIXEL / 2 - major));
    return (struct line_pixels){is_y_major, n + (goes_up ? 0.5 : -0.5), sign * across * RHW_SUBPIXEL,
                                sign * along * RHW_SUBPIXEL, width};
}

// Return where the line is in the 8 columns, or rows, from `first` on. The dividend is never a multiple of `scale`, nor
// nearer to one than the quotient's rounding.
RHW_INLINE i32x8 line_places(const struct line_pixels *line, int first)
{
    const f64x8 columns = f64x8_from_i32x8(i32x8_splat(first) + rhw_lane_index);
    const f64x8 at = f64x8_div(f64x8_add(f64x8_splat(line->n), f64x8_mul(f64x8_splat(line->step), columns)),
                               f64x8_splat(line->scale));
    return i32x8_round_f64x8(f64x8_sub(at, f64x8_splat(0.5)));
}

// Return the line's pixels in the block at (x, y) of the target, a byte for each row.
static uint64_t line_mask(const struct line_pixels *line, int x, int y)
{
    const i32x8 at = line_places(line, line->is_y_major ? y : x) - i32x8_splat(line->is_y_major ? x : y);
    uint64_t mask = 0;
    for (int row = 0; row < RHW_BLOCK; row++) {
        const i32x8 from = line->is_y_major ? i32x8_splat(at[row]) : at;
        const i32x8 place = line->is_y_major ? rhw_lane_index : i32x8_splat(row);
        const i32x8 is_drawn =
            ~rhw_less_int(place, from) & rhw_less_int(place, from + i32x8_splat(line->width));
        mask |= (uint64_t)i32x8_sign_bits(is_drawn) << (8 * row);
    }
    return mask;
}

#endif
