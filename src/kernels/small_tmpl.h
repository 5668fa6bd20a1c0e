// SPDX-License-Identifier: MIT
// Triangles that are small beside a tile: what meshes are made of. Their edges fit into 32 bits, and their blocks of
// 8×8 pixels start where the triangle does instead of at multiples of 8, so that few of them are mostly empty.
// Template: compiled once per instruction set.

#include "batch_tmpl.h"

// A row of 8 pixels, edge by edge.
struct small_row {
    i8 q[3], step[3];
};

// Of triangle i of the batch, at (x, y) of its edges.
RHW_INLINE struct small_row small_row_first(const struct batch *batch, int i)
{
    struct small_row row;
    for (int e = 0; e < 3; e++) {
        row.q[e] = i8_splat(batch->q[e][i]) + i8_splat(batch->a[e][i]) * rhw_lane_index;
        row.step[e] = i8_splat(batch->b[e][i]);
    }
    return row;
}

// The lanes that are covered; goes on to the next row.
RHW_INLINE unsigned small_row_next(struct small_row *row)
{
    const unsigned outside = i8_sign_bits(row->q[0] | row->q[1] | row->q[2]);
    for (int i = 0; i < 3; i++) {
        row->q[i] += row->step[i];
    }
    return ~outside;
}

// Bit 8·row + column of the block whose first pixel is (x, y) in the tile.
RHW_INLINE uint64_t small_mask(const struct batch *batch, int i, int x, int y)
{
    struct small_row row;
    for (int e = 0; e < 3; e++) {
        const int a = batch->a[e][i], b = batch->b[e][i];
        const int q = batch->q[e][i] + a * (x - batch->x[i]) + b * (y - batch->y0[i]);
        if (q + (RHW_BLOCK - 1) * (max_int(a, 0) + max_int(b, 0)) < 0) {
            return 0;
        }
        row.q[e] = i8_splat(q) + i8_splat(a) * rhw_lane_index;
        row.step[e] = i8_splat(b);
    }
    uint64_t mask = 0;
    for (int y_row = 0; y_row < RHW_BLOCK; y_row++) {
        mask |= (uint64_t)(small_row_next(&row) & 0xff) << (8 * y_row);
    }
    return mask;
}

static void small_collect(struct tile_work *work, struct triangle_work *triangle, int x, int y, unsigned bits)
{
    work->counters->fragments += (unsigned)__builtin_popcount(bits);
    if (row_is_pending(work, x, y, bits)) {
        flush(work);
    }
    if (triangle->packed < 0) {
        pack_triangle(work, triangle);
    }
    pack_row(work, triangle, x, y, bits);
}

// Takes what packing needs of the planes from the batch.
RHW_INLINE void take_planes(struct triangle_work *triangle, const struct batch *batch, int i)
{
    struct planes *const planes = &triangle->planes;
    planes->exact = planes->wide = planes->homogeneous = false;
    planes->anchor_x = triangle->t->x_24_8[0] >> RHW_SUBPIXEL_BITS;
    planes->anchor_y = triangle->t->y_24_8[0] >> RHW_SUBPIXEL_BITS;
    planes->linear = batch->linear[i];
    planes->factors.inverse_area = batch->inverse_area[i]; // for planes_slopes
    memcpy(triangle->v, batch->vertex[i], sizeof triangle->v);
    triangle->planes_ready = true;
}

// Draws triangle i of the batch, which is neither wider nor higher than a block, row by row: coverage, depth, packing.
// `tests`: depth is tested before shading; `rule` is how, a constant where a call names it.
RHW_INLINE void small_rows(struct tile_work *work, struct triangle_work *triangle, const struct batch *batch,
                           int i, bool tests, const struct depth_rule rule)
{
    const int x0 = batch->x0[i], x = batch->x[i], end = batch->y1[i];
    const unsigned columns = (0xffu << (x0 - x)) & (0xffu >> (RHW_BLOCK - (batch->x1[i] - x)));
    const struct planes *const planes = &triangle->planes;
    struct small_row edges = small_row_first(batch, i);
    const d8 z_column = d8_mul(d8_splat(planes->linear.dx[QUANTITY_Z]),
                               d8_from_i8(i8_splat(work->x + x - planes->anchor_x) + rhw_lane_index));
    for (int y = batch->y0[i]; y < end; y++) {
        unsigned bits = small_row_next(&edges) & columns;
        if (bits == 0) {
            continue;
        }
        if (tests) {
            const double row = planes->linear.at[QUANTITY_Z] +
                               planes->linear.dy[QUANTITY_Z] * (double)(work->y + y - planes->anchor_y);
            const f8 z = f8_from_d8(d8_add(z_column, d8_splat(row)));
            bits = test_row(work, x, y, z, bits, rule);
        } else if (work->phase == PHASE_BACKWARDS) {
            bits = take_row(work, x, y, bits);
        }
        if (bits != 0 && work->shades) {
            small_collect(work, triangle, x, y, bits);
        }
    }
}

static void draw_small_rows(struct tile_work *work, struct triangle_work *triangle, const struct batch *batch,
                            int i)
{
    if (!tests_early(work)) {
        small_rows(work, triangle, batch, i, false, work->early);
    } else if (is_plain_less(work->early)) {
        small_rows(work, triangle, batch, i, true, plain_less);
    } else {
        small_rows(work, triangle, batch, i, true, work->early);
    }
}

static void draw_small_blocks(struct tile_work *work, struct triangle_work *triangle,
                              const struct batch *batch, int i)
{
    const int x1 = batch->x1[i], y1 = batch->y1[i];
    for (int y0 = batch->y0[i]; y0 < y1; y0 += RHW_BLOCK) {
        const int y = min_int(y0, RHW_TILE - RHW_BLOCK); // so that the block stays in the tile
        for (int x0 = batch->x0[i]; x0 < x1; x0 += RHW_BLOCK) {
            const int x = min_int(x0, RHW_TILE - RHW_BLOCK);
            uint64_t mask = small_mask(batch, i, x, y);
            if (work->scissored || x != x0 || y != y0) {
                mask &= rect_mask(x, y, x0, y0, x1, y1);
            }
            if (mask != 0) {
                draw_block(work, triangle, x, y, mask);
            }
        }
    }
}

static void draw_small(struct tile_work *work, struct triangle_work *triangle, const struct batch *batch,
                       int i)
{
    // Where no screen weights are wanted, the batch has all there is to know.
    const bool taken = (work->packs || !work->shades) && !(batch->inexact >> i & 1);
    if (taken) {
        take_planes(triangle, batch, i);
    }
    if (taken && batch->x1[i] - batch->x0[i] <= RHW_BLOCK && batch->y1[i] - batch->y0[i] <= RHW_BLOCK) {
        draw_small_rows(work, triangle, batch, i);
    } else {
        draw_small_blocks(work, triangle, batch, i);
    }
}
