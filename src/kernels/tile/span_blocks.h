// SPDX-License-Identifier: MIT
// A small triangle is drawn in blocks of 8×8 pixels, by its spans: the blocks start where the triangle does, and no
// block is looked at where a row is empty.
#ifndef RHW_SPAN_BLOCKS_H
#define RHW_SPAN_BLOCKS_H

#include "kernels/integer.h"
#include "kernels/triangle_work.h"
#include "span.h"
#include "triangle_setup8.h"

// A function that draws the pixels set in `mask`, which is not 0, of the block at (x, y).
typedef void draw_block_function(struct tile_work *work, struct triangle_work *triangle, int x, int y,
                                 uint64_t mask);

// Call `draw` for the blocks of a triangle. Blocks that would reach over the tile's end are moved.
RHW_INLINE void draw_span_blocks(struct tile_work *work, struct triangle_work *triangle,
                                 draw_block_function *draw)
{
    const struct triangle_setup8 *const setup = triangle->setup;
    const int i = triangle->lane;
    struct span_edges edges;
    for (int e = 0; e < 3; e++) {
        span_edge_set(&edges, e, setup->q[e][i], setup->a[e][i], setup->b[e][i]);
    }
    for (int y0 = setup->y0[i]; y0 < setup->y1[i]; y0 += RHW_BLOCK) {
        const int y = min_int(y0, RHW_TILE - RHW_BLOCK);
        const struct row_spans spans =
            spans_of_rows(&edges, setup->x[i], setup->y0[i], setup->x1[i] - setup->x[i],
                          (struct span_rows){y, y0, setup->y1[i]});
        for (int x0 = setup->x0[i]; x0 < setup->x1[i]; x0 += RHW_BLOCK) {
            const int x = min_int(x0, RHW_TILE - RHW_BLOCK);
            const uint64_t mask = span_mask(&spans, x, x0);
            if (mask != 0) {
                draw(work, triangle, x, y, mask);
            }
        }
    }
}

#endif
