// SPDX-License-Identifier: MIT
// The rows of a small triangle begin and end in spans. 8 rows are found at a time, a row in each lane.
//
// An edge q + a·x + b·y >= 0 (coverage.h), which is q_y + a·x in row y, covers x >= ceil(−q_y/a) where a > 0 and x <=
// floor(q_y/|a|) where a < 0. Both are made of v = (q_y + 1/2)·(−1/a), exactly though in float: the half moves no
// quotient of integers to another whole number, but keeps them 1/(2|a|) > 2^-15 from all. In the rows of a small
// triangle |q_y| < 2^22, and |a|, |b| < 2^14, so the sum is exact, and the reciprocal and the product are off by less
// than 2^-23·|v|: nothing within 128 pixels crosses a whole number, and what is further away ends at the tile's border.
// Where a is 0, a factor of 2^30 puts v beyond one border or the other by the sign of q_y.
#ifndef RHW_SPAN_H
#define RHW_SPAN_H

#include <math.h>

#include "base/constants.h"
#include "base/simd.h"

// The edges of a triangle.
struct span_edges {
    float q[3], step[3]; // value in the triangle's first row, and a half; change per row
    float scale[3];      // −1/a
    float side[3];       // infinite; above 0 for an edge where spans begin
};

static inline void span_edge_set(struct span_edges *edges, int e, int32_t q, int32_t a, int32_t b)
{
    edges->q[e] = (float)q + 0.5f;
    edges->step[e] = (float)b;
    edges->scale[e] = a == 0 ? 0x1p30f : -1 / (float)a;
    edges->side[e] = a > 0 ? INFINITY : -INFINITY;
}

// The rows of the tile to be found: 8 from `y` on. Those within y0 .. y1 − 1 are drawn.
struct span_rows {
    int y, y0, y1;
};

// Columns of the tile. `end` is exclusive, and not above `begin` where nothing is covered.
struct row_spans {
    i32x8 begin, end;
};

// Return the spans of a triangle. Its edges start at column `x` and row `top` of the tile, and it has `width` columns.
RHW_INLINE struct row_spans spans_of_rows(const struct span_edges *edges, int x, int top, int width,
                                          struct span_rows which)
{
    const i32x8 rows = i32x8_splat(which.y) + rhw_lane_index;
    const f32x8 from_top = rhw_float_from_int(rows - i32x8_splat(top));
    f32x8 begin = f32x8_splat(0);                // span_mask starts where the triangle does
    f32x8 end = f32x8_splat((float)(width - 1)); // last column of the triangle
    for (int e = 0; e < 3; e++) {
        const f32x8 side = f32x8_splat(edges->side[e]);
        const f32x8 q = f32x8_splat(edges->q[e]) + f32x8_splat(edges->step[e]) * from_top;
        const f32x8 v = q * f32x8_splat(edges->scale[e]);
        begin = f32x8_max(begin, f32x8_min(v, side));
        end = f32x8_min(end, f32x8_max(v, side));
    }
    begin = rhw_ceil(begin);
    end = f32x8_max(end, f32x8_splat(-1)) + f32x8_splat(1); // −1 is before the first column
    const i32x8 drawn =
        ~rhw_less_int(rows, i32x8_splat(which.y0)) & rhw_less_int(rows, i32x8_splat(which.y1));
    return (struct row_spans){rhw_int_from_float_unchecked(begin) + i32x8_splat(x),
                              (rhw_int_from_float_unchecked(end) + i32x8_splat(x)) & drawn};
}

// Return the pixels of the block at x, in the rows of the spans, that the spans cover from column x0 on: bit 8·row +
// column.
RHW_INLINE uint64_t span_mask(const struct row_spans *spans, int x, int x0)
{
    const i32x8 zero = i32x8_splat(0), width = i32x8_splat(RHW_BLOCK), first = i32x8_splat(x);
    const i32x8 end = i32x8_max(i32x8_min(spans->end - first, width), zero);
    const i32x8 begin = i32x8_min(i32x8_max(spans->begin, i32x8_splat(x0)) - first, end);
    return i32x8_to_bytes(i32x8_power2(end) - i32x8_power2(begin));
}

#endif
