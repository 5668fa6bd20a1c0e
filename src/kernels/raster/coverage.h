// SPDX-License-Identifier: MIT
// Coverage is exact: it is the sign of integer edge functions at pixel centres, or at one of several samples of each
// pixel, 8×8 pixels at a time.
//
// Edge i runs from vertex i + 1 to vertex i + 2. Its sign is turned so that the inside is where
//
//     e(P) = a·(Px − x) + b·(Py − y)  > 0,     (x, y) the edge's first vertex, all in 1/256 pixel,
//
// and, on a top or left edge, where e(P) = 0 too (top-left rule; Direct3D 11.3 §3.4.2.1). Samples of a kind are whole
// pixels apart, so e = 256·q + r there with one r for all of them, and e >= 0 exactly when q >= 0: the loops below work
// on q. |a|, |b| <= 2^24 and |e| < 2^49 (constants.h). In a block that an edge crosses |q| < 2^28.

#ifndef RHW_COVERAGE_H
#define RHW_COVERAGE_H

#include "draw/draw_list.h"
#include "base/simd.h"
#include "kernels/integer.h"
#include "sample_position.h"

_Static_assert((RHW_TILE - 1) % (RHW_BLOCK - 1) == 0, "coverage_add scales a block's extremes to the tile's");

struct edge {
    int32_t a, b;      // change of q per pixel to the right, and down
    int64_t q;         // q at the sample of the tile's first pixel
    int64_t low, high; // least and largest q of a block's pixels, less the q of its first pixel
};

// The sample of the tile's first pixel that is looked at, in 1/256 pixel from the target's origin.
struct sample_origin {
    int64_t x, y;
};

static inline struct sample_origin center_of_pixel(int x, int y)
{
    return (struct sample_origin){sample_of_pixel(x), sample_of_pixel(y)};
}

// Return e of the edge from (x0, y0) to (x1, y1) at a point. `sign` is −1 for a triangle whose vertices turn the
// negative way.
static inline int64_t edge_value(int32_t x0, int32_t y0, int32_t x1, int32_t y1, int32_t sign,
                                 struct sample_origin point)
{
    const int32_t a = sign * (y0 - y1), b = sign * (x1 - x0);
    return a * (point.x - x0) + b * (point.y - y0);
}

static inline struct edge make_edge(int32_t x0, int32_t y0, int32_t x1, int32_t y1, int32_t sign,
                                    struct sample_origin origin)
{
    const int32_t a = sign * (y0 - y1), b = sign * (x1 - x0);
    const bool top_left = a > 0 || (a == 0 && b > 0);
    const int64_t e = edge_value(x0, y0, x1, y1, sign, origin);
    return (struct edge){a, b, (e - (top_left ? 0 : 1)) >> RHW_SUBPIXEL_BITS,
                         (RHW_BLOCK - 1) * ((int64_t)min_int(a, 0) + min_int(b, 0)),
                         (RHW_BLOCK - 1) * ((int64_t)max_int(a, 0) + max_int(b, 0))};
}

// The edge of 8 triangles from vertex i to vertex i + 1, at x, y in 1/256 pixel. If vertices lie within 64 pixels of
// each other and within 72 of the pixels looked at, |a|, |b| < 2^14 and |e| < 2·2^14·72·256 < 2^30. In lanes of larger
// triangles, and of triangles far away, it is rubbish that may wrap: go on with it unsigned.
struct edge_lanes {
    i32x8 a, b; // change of e per 1/256 pixel to the right, and down
    i32x8 e;    // value less 1 where the edge is neither top nor left: inside is where e >= 0
};

// Return the edges from vertex i on. `turn` is −1 for triangles whose vertices turn the negative way, and 0 for others.
RHW_INLINE struct edge_lanes edge_lanes(const i32x8 vertex_x[3], const i32x8 vertex_y[3], int i, i32x8 turn,
                                        i32x8 x, i32x8 y)
{
    const int j = i == 2 ? 0 : i + 1;
    const i32x8 a = ((vertex_y[i] - vertex_y[j]) ^ turn) - turn,
                b = ((vertex_x[j] - vertex_x[i]) ^ turn) - turn;
    const i32x8 zero = i32x8_splat(0);
    const i32x8 top_left = rhw_less_int(zero, a) | (rhw_equal_int(a, zero) & rhw_less_int(zero, b));
    const u32x8 e =
        (u32x8)a * (u32x8)(x - vertex_x[i]) + (u32x8)b * (u32x8)(y - vertex_y[i]) + (u32x8)~top_left;
    return (struct edge_lanes){a, b, (i32x8)e};
}

// The edges of a triangle that cross the tile. If no edge does, the triangle covers all of the tile.
struct triangle_edges {
    int count;
    struct edge edges[3];
};

// Return the pixels of a block on the inner side of `count` edges. `q` is q of the block's first row, and `step` is its
// change from row to row. All rows are computed, because a loop whose end cannot be foreseen costs more than the rows
// that nobody asks for.
RHW_INLINE uint64_t mask_of_edges(i32x8 q[3], const i32x8 step[3], int count)
{
    i32x8 outside[RHW_BLOCK];
    for (int row = 0; row < RHW_BLOCK; row++) {
        outside[row] = q[0];
        q[0] += step[0];
        for (int i = 1; i < count; i++) {
            outside[row] |= q[i];
            q[i] += step[i];
        }
    }
    return ~i32x8_sign_bits_of_rows(outside);
}

// Return the pixels that the triangle covers of the block whose first pixel is (x, y) in the tile: bit 8·row + column.
static inline uint64_t triangle_mask(const struct triangle_edges *triangle, int x, int y)
{
    i32x8 q[3], step[3];
    int crossing = 0;
    for (int i = 0; i < triangle->count; i++) {
        const struct edge *const edge = &triangle->edges[i];
        const int64_t first = edge->q + (int64_t)edge->a * x + (int64_t)edge->b * y;
        if (first + edge->high < 0) {
            return 0;
        }
        if (first + edge->low >= 0) {
            continue;
        }
        // The edge crosses the block: `first` is within its extremes, so int32 holds it.
        q[crossing] = i32x8_splat((int32_t)first) + i32x8_splat(edge->a) * rhw_lane_index;
        step[crossing++] = i32x8_splat(edge->b);
    }
    switch (crossing) {
    case 0: return ~(uint64_t)0;
    case 1: return mask_of_edges(q, step, 1);
    case 2: return mask_of_edges(q, step, 2);
    default: return mask_of_edges(q, step, 3);
    }
}

// 8 blocks side by side in a tile, a bit for each: the blocks that the triangle leaves out, and the blocks that an edge
// crosses.
struct block_row {
    unsigned outside, crossed;
};

// Return the outside and crossed blocks at row y of the tile. An edge that crosses the tile is within 63·(|a| + |b|) <
// 2^31 in all of it.
static inline struct block_row block_row_of(const struct triangle_edges *triangle, int y)
{
    i32x8 outside = i32x8_splat(0), crossed = i32x8_splat(0);
    for (int i = 0; i < triangle->count; i++) {
        const struct edge *const edge = &triangle->edges[i];
        const i32x8 first = i32x8_splat((int32_t)(edge->q + (int64_t)edge->b * y)) +
                            i32x8_splat(RHW_BLOCK * edge->a) * rhw_lane_index;
        outside |= first + i32x8_splat((int32_t)edge->high);
        crossed |= first + i32x8_splat((int32_t)edge->low);
    }
    return (struct block_row){i32x8_sign_bits(outside), i32x8_sign_bits(crossed)};
}

// All blocks of the tile, row by row, a bit for each: the blocks of which the triangle may cover something, and the
// blocks that an edge crosses.
struct block_bits {
    uint64_t inside, crossed;
};

static inline struct block_bits blocks_of(const struct triangle_edges *triangle)
{
    i32x8 outside[RHW_BLOCK] = {{0}}, crossed[RHW_BLOCK] = {{0}};
    for (int i = 0; i < triangle->count; i++) {
        const struct edge *const edge = &triangle->edges[i];
        const i32x8 columns = i32x8_splat(RHW_BLOCK * edge->a) * rhw_lane_index;
        const i32x8 high = columns + i32x8_splat((int32_t)edge->high),
                    low = columns + i32x8_splat((int32_t)edge->low);
        for (int row = 0; row < RHW_BLOCK; row++) {
            const i32x8 first = i32x8_splat((int32_t)(edge->q + (int64_t)edge->b * (RHW_BLOCK * row)));
            outside[row] |= first + high;
            crossed[row] |= first + low;
        }
    }
    return (struct block_bits){~i32x8_sign_bits_of_rows(outside), i32x8_sign_bits_of_rows(crossed)};
}

// Return what triangle_mask returns, for a block that an edge crosses, by all edges: a processor cannot predict which
// edges cross the block.
static inline uint64_t crossed_mask(const struct triangle_edges *triangle, int x, int y)
{
    i32x8 q[3], step[3];
    for (int i = 0; i < triangle->count; i++) {
        const struct edge *const edge = &triangle->edges[i];
        q[i] = i32x8_splat((int32_t)(edge->q + (int64_t)edge->a * x + (int64_t)edge->b * y)) +
               i32x8_splat(edge->a) * rhw_lane_index;
        step[i] = i32x8_splat(edge->b);
    }
    switch (triangle->count) {
    case 1: return mask_of_edges(q, step, 1);
    case 2: return mask_of_edges(q, step, 2);
    default: return mask_of_edges(q, step, 3);
    }
}

// What a triangle, clipped or not, covers in one tile.
struct coverage {
    int count; // number of triangles that reach into the tile: a clipped polygon is a fan of them
    struct triangle_edges triangles[RHW_POLYGON_VERTICES - 2];
};

static inline void coverage_add(struct coverage *coverage, const int32_t x[3], const int32_t y[3],
                                int32_t sign, struct sample_origin origin)
{
    struct triangle_edges *const triangle = &coverage->triangles[coverage->count];
    triangle->count = 0;
    for (int i = 0; i < 3; i++) {
        const int j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
        const struct edge edge = make_edge(x[j], y[j], x[k], y[k], sign, origin);
        const int blocks = (RHW_TILE - 1) / (RHW_BLOCK - 1); // 63 pixels are 9 times 7
        if (edge.q + edge.high * blocks < 0) {
            return;
        }
        if (edge.q + edge.low * blocks < 0) {
            triangle->edges[triangle->count++] = edge;
        }
    }
    coverage->count++;
}

static inline void coverage_setup(struct coverage *coverage, const struct rhw_chunk *chunk,
                                  const struct rhw_triangle *t, struct sample_origin origin)
{
    coverage->count = 0;
    if (!(t->flags & RHW_TRIANGLE_POLYGON)) {
        coverage_add(coverage, t->x_24_8, t->y_24_8, t->flags & RHW_TRIANGLE_NEGATIVE ? -1 : 1, origin);
        return;
    }
    const struct rhw_polygon *const p = &chunk->polygons[t->polygon];
    for (int i = 1; i + 1 < p->count; i++) {
        const int32_t x[3] = {p->x_24_8[0], p->x_24_8[i], p->x_24_8[i + 1]};
        const int32_t y[3] = {p->y_24_8[0], p->y_24_8[i], p->y_24_8[i + 1]};
        const int64_t area = (int64_t)(x[1] - x[0]) * (y[2] - y[0]) - (int64_t)(x[2] - x[0]) * (y[1] - y[0]);
        if (area != 0) {
            coverage_add(coverage, x, y, area < 0 ? -1 : 1, origin);
        }
    }
}

static inline bool covers_tile(const struct coverage *coverage)
{
    return coverage->count == 1 && coverage->triangles[0].count == 0;
}

static inline uint64_t coverage_mask(const struct coverage *coverage, int x, int y)
{
    uint64_t mask = 0;
    for (int i = 0; i < coverage->count; i++) {
        mask ^= triangle_mask(&coverage->triangles[i], x, y);
    }
    return mask;
}

// Return the pixels of the block at (x, y) that are inside x0 .. x1 − 1, y0 .. y1 − 1 in tile coordinates. The block
// and the rectangle overlap.
static inline uint64_t rect_mask(int x, int y, int x0, int y0, int x1, int y1)
{
    const int left = x0 > x ? x0 - x : 0, right = x1 < x + RHW_BLOCK ? x1 - x : RHW_BLOCK;
    const int top = y0 > y ? y0 - y : 0, bottom = y1 < y + RHW_BLOCK ? y1 - y : RHW_BLOCK;
    const uint64_t row = (0xffu << left & 0xffu) & 0xffu >> (RHW_BLOCK - right);
    const uint64_t rows = (~(uint64_t)0 << (8 * top)) & (~(uint64_t)0 >> (8 * (RHW_BLOCK - bottom)));
    return row * 0x0101010101010101u & rows;
}

// Return the tile's blocks that the rectangle reaches into. The rectangle is not empty.
static inline uint64_t blocks_of_rect(int x0, int y0, int x1, int y1)
{
    return rect_mask(0, 0, x0 / RHW_BLOCK, y0 / RHW_BLOCK, (x1 - 1) / RHW_BLOCK + 1,
                     (y1 - 1) / RHW_BLOCK + 1);
}

#endif
