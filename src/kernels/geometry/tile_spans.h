// SPDX-License-Identifier: MIT
// The tiles that a long triangle reaches into, row by row. They are few of the rectangle around a thin diagonal
// triangle, and a tile that looks at a triangle in vain pays for reading it and setting it up.
//
// What lies inside of a closed outline lies, at every height, between two points of the outline. So the tiles of a row
// are those from the least to the greatest x that the outline has in the row, both made a little wider by what rounding
// may have cost, and never narrower. This holds for the polygon of a clipped triangle as well, even where snapping made
// it cross itself, and for samples anywhere in their pixels.
#ifndef RHW_TILE_SPANS_H
#define RHW_TILE_SPANS_H

#include "kernels/integer.h"
#include "kernels/raster/sample_position.h"
#include "geometry_scratch.h"

enum {
    ROWS_MOST = RHW_MAX_TARGET_SIZE / RHW_TILE, // rows of tiles
    ROW_STEPS_LOG2 = RHW_TILE_LOG2 + RHW_SUBPIXEL_BITS
};

// The tiles of each row of a triangle's range, counted from its first ones. Both ends are inclusive, and first > last
// where a row has none.
struct tile_spans {
    uint8_t first[ROWS_MOST], last[ROWS_MOST];
};

// The least and the greatest x of an outline, 24.8, in the rows of tiles y0 .. y1.
struct row_extents {
    int y0, y1;
    int32_t least[ROWS_MOST], most[ROWS_MOST];
};

// Return true if a triangle may leave out so many tiles of its range that looking for them pays. A range of a single
// row or column leaves out none.
static inline bool is_long(const struct rhw_triangle_list *list, int t)
{
    enum { LONG = 4 }; // a range of 3×3 tiles, or 5×2
    const struct rhw_tile_range *const range = &list->ranges[t];
    // These draw other pixels than those inside of their corners.
    const unsigned others =
        RHW_TRIANGLE_RECTANGLE | RHW_TRIANGLE_LINE | RHW_TRIANGLE_SMOOTH | RHW_TRIANGLE_CONSERVATIVE;
    return (range->x1 - range->x0) * (range->y1 - range->y0) >= LONG && !(list->triangles[t].flags & others);
}

static void add_extent(struct row_extents *rows, int row, int32_t x0, int32_t x1)
{
    int32_t *const least = &rows->least[row - rows->y0], *const most = &rows->most[row - rows->y0];
    *least = min_int(*least, min_int(x0, x1));
    *most = max_int(*most, max_int(x0, x1));
}

// Add an edge, downwards: y0 <= y1. Between its ends x is off by less than 2 steps. One is the slope's error, below
// 2^-24, times a height of less than 2^24, as rows lie in the target; the other is what the shift drops. The product of
// slope and height has 64 bits, and |x1 − x0| is about 2^24 at most: lines reach beyond the guard band by half their
// width.
static void add_edge_extents(struct row_extents *rows, int32_t x0, int32_t y0, int32_t x1, int32_t y1)
{
    enum { SLOPE_BITS = 24 };
    const int first = y0 >> ROW_STEPS_LOG2, last = y1 >> ROW_STEPS_LOG2;
    if (last < rows->y0) {
        return;
    }
    const int64_t slope = first != last ? (int64_t)(x1 - x0) * ((int64_t)1 << SLOPE_BITS) / (y1 - y0) : 0;
    const int from = max_int(first, rows->y0), to = min_int(last, rows->y1);
    int32_t x = x0;
    if (first < from) {
        x += (int32_t)(((from << ROW_STEPS_LOG2) - y0) * slope >> SLOPE_BITS);
    }
    for (int row = from; row <= to; row++) {
        const int32_t height = ((row + 1) << ROW_STEPS_LOG2) - y0;
        const int32_t next = row < last ? x0 + (int32_t)(height * slope >> SLOPE_BITS) : x1;
        add_extent(rows, row, x, next);
        x = next;
    }
}

static void add_outline(struct row_extents *rows, const int32_t *x, const int32_t *y, int count)
{
    for (int i = 0; i < count; i++) {
        const int j = i + 1 < count ? i + 1 : 0;
        if (y[i] <= y[j]) {
            add_edge_extents(rows, x[i], y[i], x[j], y[j]);
        } else {
            add_edge_extents(rows, x[j], y[j], x[i], y[i]);
        }
    }
}

// Set the tiles of a long triangle. Return how many there are.
static __attribute__((noinline)) uint32_t set_long_spans(struct tile_spans *spans,
                                                         const struct rhw_triangle_list *list, int t)
{
    // ERROR is proved in add_edge_extents. FAR is beyond all positions.
    enum { ERROR = 2, FAR = 1 << 30 };
    const struct rhw_triangle *const triangle = &list->triangles[t];
    const struct rhw_draw_state *const state = list->segments[triangle->segment].draw->state;
    const struct rhw_tile_range range = list->ranges[t];
    const int height = range.y1 - range.y0 + 1;
    struct row_extents rows;
    rows.y0 = range.y0;
    rows.y1 = range.y1;
    for (int row = 0; row < height; row++) {
        rows.least[row] = FAR;
        rows.most[row] = -FAR;
    }
    if (triangle->flags & RHW_TRIANGLE_POLYGON) {
        const struct rhw_polygon *const polygon = &list->polygons[triangle->polygon];
        add_outline(&rows, polygon->x_24_8, polygon->y_24_8, polygon->count);
    } else {
        add_outline(&rows, triangle->x_24_8, triangle->y_24_8, 3);
    }
    uint32_t count = 0;
    for (int row = 0; row < height; row++) {
        const int x0 = pixel_of_step(rows.least[row] - ERROR, state->first_step) >> RHW_TILE_LOG2;
        const int x1 = (pixel_of_step(rows.most[row] + ERROR, state->past_step) - 1) >> RHW_TILE_LOG2;
        const int first = max_int(x0, range.x0) - range.x0, last = min_int(x1, range.x1) - range.x0;
        const bool is_empty = first > last;
        spans->first[row] = is_empty ? 1 : (uint8_t)first;
        spans->last[row] = is_empty ? 0 : (uint8_t)last;
        count += is_empty ? 0 : (uint32_t)(last - first + 1);
    }
    return count;
}

// Set the tiles of any triangle. Return how many there are.
static inline uint32_t set_tile_spans(struct tile_spans *spans, const struct rhw_triangle_list *list, int t)
{
    const struct rhw_tile_range *const range = &list->ranges[t];
    const int width = range->x1 - range->x0 + 1, height = range->y1 - range->y0 + 1;
    if (is_long(list, t)) {
        return set_long_spans(spans, list, t);
    }
    for (int row = 0; row < height; row++) {
        spans->first[row] = 0;
        spans->last[row] = (uint8_t)(width - 1);
    }
    return (uint32_t)(width * height);
}

#endif
