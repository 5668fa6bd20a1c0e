// SPDX-License-Identifier: MIT
// Where the rows of a small triangle begin and end: 8 rows at a time, a row in each lane. Template: compiled once per
// instruction set.
//
// An edge q + a·x + b·y >= 0 (coverage_tmpl.h), which is q_y + a·x in row y, covers x >= ceil(−q_y/a) where a > 0 and
// x <= floor(q_y/|a|) where a < 0. Both are made of v = (q_y + 1/2)·(−1/a), exactly though in float: the half moves no
// quotient of integers to another whole number, but keeps them 1/(2|a|) > 2^-15 from all. In the rows of a small
// triangle |q_y| < 2^22, and |a|, |b| < 2^14, so the sum is exact, and the reciprocal and the product are off by less
// than 2^-23·|v|: nothing within 128 pixels crosses a whole number, and what is further away ends at the tile's border.
// Where a is 0, a factor of 2^30 puts v beyond one border or the other by the sign of q_y.

#include "batch_tmpl.h"

#include <math.h>

// The edges of a triangle.
struct span_edges {
    float q[3], step[3]; // in row y0 of the batch, and a half; change per row
    float scale[3];      // −1/a
    float side[3];       // infinite, and above 0 for an edge where spans begin
};

// Of triangle i of the batch.
static void span_edges(struct span_edges *edges, const struct batch *batch, int i)
{
    for (int e = 0; e < 3; e++) {
        const int32_t a = batch->a[e][i];
        edges->q[e] = (float)batch->q[e][i] + 0.5f;
        edges->step[e] = (float)batch->b[e][i];
        edges->scale[e] = a == 0 ? 0x1p30f : -1 / (float)a;
        edges->side[e] = a > 0 ? INFINITY : -INFINITY;
    }
}

// Columns of the tile; `end` is exclusive, and not above `begin` where nothing is covered.
struct row_spans {
    i8 begin, end;
};

// Of rows y to y + 7 of the tile that lie in y0 .. y1 − 1.
RHW_INLINE struct row_spans row_spans(const struct span_edges *edges, const struct batch *batch, int i, int y,
                                      int y0, int y1)
{
    const i8 rows = i8_splat(y) + rhw_lane_index;
    const f8 from_q = rhw_to_float(rows - i8_splat(batch->y0[i]));
    f8 begin = f8_splat(0);                                     // span_mask starts where the triangle does
    f8 end = f8_splat((float)(batch->x1[i] - batch->x[i] - 1)); // the last one
    for (int e = 0; e < 3; e++) {
        const f8 side = f8_splat(edges->side[e]);
        const f8 q = f8_splat(edges->q[e]) + f8_splat(edges->step[e]) * from_q;
        const f8 v = q * f8_splat(edges->scale[e]);
        begin = f8_max(begin, f8_min(v, side));
        end = f8_min(end, f8_max(v, side));
    }
    begin = rhw_ceil(begin);
    end = f8_max(end, f8_splat(-1)) + f8_splat(1); // −1 is before the first column
    const i8 x = i8_splat(batch->x[i]);
    const i8 drawn = ~rhw_less_int(rows, i8_splat(y0)) & rhw_less_int(rows, i8_splat(y1));
    return (struct row_spans){rhw_to_int_unchecked(begin) + x, (rhw_to_int_unchecked(end) + x) & drawn};
}

// The pixels of the block at x, in the rows of the spans, that they cover from column x0 on; bit 8·row + column.
RHW_INLINE uint64_t span_mask(const struct row_spans *spans, int x, int x0)
{
    const i8 zero = i8_splat(0), width = i8_splat(RHW_BLOCK), first = i8_splat(x);
    const i8 end = i8_max(i8_min(spans->end - first, width), zero);
    const i8 begin = i8_min(i8_max(spans->begin, i8_splat(x0)) - first, end);
    return i8_to_bytes(i8_power2(end) - i8_power2(begin));
}
