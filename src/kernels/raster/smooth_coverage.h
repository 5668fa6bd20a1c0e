// SPDX-License-Identifier: MIT
// A smooth line's rectangle covers a part of each pixel's square. The coverage is the area of this part, but for
// roundings below 2^−16.
//
// The area is a sum over the four sides, each taken from left to right or back. A side adds what lies above it in the
// square:
//
//     ∫ clamp(h(x), 0, 1) dx,    h: the side's height in the square, x: where the side passes through its columns.
//
// The integral is (G(h1) − G(h0)) / slope, where G(h) is 0 below 0, h²/2 up to h = 1 and h − 1/2 from there. A side
// that hardly changes within a pixel is taken at its middle there.
#ifndef RHW_SMOOTH_COVERAGE_H
#define RHW_SMOOTH_COVERAGE_H

#include "base/constants.h"
#include "base/simd.h"
#include "draw/triangle.h"

// A side of the rectangle, in pixels of the tile.
struct smooth_side {
    double x, y, slope;
    double left, right;
    double sign; // direction in which the side leads; 0: straight up or down
};

struct smooth_line {
    struct smooth_side sides[4];
};

// Set a smooth line. `x` and `y` are the tile's first pixel.
static void smooth_line_set(struct smooth_line *line, const struct rhw_triangle *t, int x, int y)
{
    const int32_t *const tx = t->x_24_8, *const ty = t->y_24_8;
    const int32_t corner_x[4] = {tx[0], tx[1], tx[1] + tx[2] - tx[0], tx[2]};
    const int32_t corner_y[4] = {ty[0], ty[1], ty[1] + ty[2] - ty[0], ty[2]};
    const double turn = (double)(tx[1] - tx[0]) * (ty[2] - ty[0]) - (double)(tx[2] - tx[0]) * (ty[1] - ty[0]);
    for (int i = 0; i < 4; i++) {
        const int j = (i + 1) % 4;
        const double dx = corner_x[j] - corner_x[i], dy = corner_y[j] - corner_y[i];
        const double x0 = (double)corner_x[i] / RHW_SUBPIXEL - x, x1 = (double)corner_x[j] / RHW_SUBPIXEL - x;
        line->sides[i] = (struct smooth_side){.x = x0,
                                              .y = (double)corner_y[i] / RHW_SUBPIXEL - y,
                                              .slope = dx == 0 ? 0 : dy / dx,
                                              .left = x0 < x1 ? x0 : x1,
                                              .right = x0 < x1 ? x1 : x0,
                                              .sign = dx == 0                  ? 0
                                                      : (dx < 0) == (turn < 0) ? -1
                                                                               : 1};
    }
}

// Return the G of the comment at the head of this file.
RHW_INLINE f64x8 area_below(f64x8 h)
{
    const f64x8 inside = f64x8_clamp(h, 0, 1), above = f64x8_clamp(f64x8_sub(h, f64x8_splat(1)), 0, 0x1p40);
    return f64x8_add(f64x8_mul(f64x8_mul(inside, inside), f64x8_splat(0.5)), above);
}

// Return what a side adds to the area of 8 pixels, from column x on, in row y.
RHW_INLINE f64x8 side_area(const struct smooth_side *side, f64x8 x, double y)
{
    const double least_slope = 0x1p-14;
    const f64x8 from = f64x8_clamp(x, side->left, side->right);
    const f64x8 to = f64x8_clamp(f64x8_add(x, f64x8_splat(1)), side->left, side->right);
    const f64x8 slope = f64x8_splat(side->slope), start = f64x8_splat(side->x),
                height = f64x8_splat(side->y - y);
    const f64x8 h0 = f64x8_add(height, f64x8_mul(slope, f64x8_sub(from, start)));
    const f64x8 h1 = f64x8_add(height, f64x8_mul(slope, f64x8_sub(to, start)));
    if (side->slope < least_slope && side->slope > -least_slope) {
        const f64x8 middle = f64x8_clamp(f64x8_mul(f64x8_add(h0, h1), f64x8_splat(0.5)), 0, 1);
        return f64x8_mul(f64x8_sub(to, from), middle);
    }
    return f64x8_div(f64x8_sub(area_below(h1), area_below(h0)), slope);
}

// Return the pixels of the block at (x, y) of the tile of which the line covers 2^−16 at least, and set how much it
// covers, by row.
static uint64_t smooth_mask(const struct smooth_line *line, int x, int y, f32x8 coverage[RHW_BLOCK])
{
    const f64x8 columns = f64x8_from_i32x8(i32x8_splat(x) + rhw_lane_index);
    uint64_t mask = 0;
    for (int row = 0; row < RHW_BLOCK; row++) {
        f64x8 area = f64x8_splat(0);
        for (int i = 0; i < 4; i++) {
            const struct smooth_side *const side = &line->sides[i];
            if (side->sign != 0) {
                area = f64x8_add(area, f64x8_mul(f64x8_splat(side->sign), side_area(side, columns, y + row)));
            }
        }
        coverage[row] = f32x8_from_f64x8(f64x8_clamp(area, 0, 1));
        const unsigned drawn = i32x8_sign_bits(rhw_less_equal(f32x8_splat(0x1p-16f), coverage[row]));
        mask |= (uint64_t)drawn << (8 * row);
    }
    return mask;
}

#endif
