// SPDX-License-Identifier: MIT
// Triangles that are small beside a tile: what meshes are made of. Their edges fit into 32 bits, and their blocks of
// 8×8 pixels start where the triangle does instead of at multiples of 8, so that few of them are mostly empty.
// Coverage and the early depth test of a row are one step: what is covered stays a mask of lanes.
// Template: compiled once per instruction set.

#include "batch_tmpl.h"

// A block in the tile, and the pixels of it that may be drawn; x1 and y1 exclusive. q: the edges at its first column, x,
// in the first row that is drawn, y0.
struct small_block {
    int x, y, x0, y0, x1, y1;
    int q[3];
};

// Edges at 8 pixels in a row, and what they change by to the next row.
struct small_edges {
    i8 q[3], step[3];
};

// Of triangle i of the batch at the block's first column, row y0.
RHW_INLINE void small_edges(struct small_edges *edges, const struct batch *batch, int i,
                            const struct small_block *block)
{
    for (int e = 0; e < 3; e++) {
        edges->q[e] = i8_splat(block->q[e]) + i8_splat(batch->a[e][i]) * rhw_lane_index;
        edges->step[e] = i8_splat(batch->b[e][i]);
    }
}

// The pixels of the block that triangle i covers and that pass the depth test, which writes their depth; bit
// 8·row + column. `tests`: there is an early test; `rule` is how, a constant where a call names it.
RHW_INLINE uint64_t small_test(struct tile_work *work, const struct batch *batch, int i,
                               const struct small_block *block, bool tests, const struct depth_rule rule)
{
    struct small_edges edges;
    small_edges(&edges, batch, i, block);
    struct block_plane depth;
    if (tests) {
        const struct plane z = linear_plane(&batch->linear[i], QUANTITY_Z);
        const i8 dx = i8_splat(work->x + block->x - batch->anchor_x[i]) + rhw_lane_index;
        const i8 dy = i8_splat(work->y + block->y0 - batch->anchor_y[i]) + rhw_lane_index;
        const struct block_place at = {d8_from_i8(dx), d8_from_i8(dy)};
        plane_over(&depth, &z, &at);
    }
    // Negative where a column is not to be drawn.
    const i8 sides = (rhw_lane_index - i8_splat(block->x0 - block->x)) |
                     (i8_splat(block->x1 - block->x - 1) - rhw_lane_index);
    float *texels = stored_depth(work, block->x, block->y0);
    uint64_t passed = 0;
    for (int row = 0; row < block->y1 - block->y0; row++) {
        i8 inside = ~((edges.q[0] | edges.q[1] | edges.q[2] | sides) >> 31);
        if (tests) {
            const unsigned open = open_row(work, block->x, block->y0 + row, rule);
            inside = test_lanes(texels, f8_from_d8(plane_row(&depth, row)), inside, open, rule);
        }
        passed |= (uint64_t)i8_sign_bits(inside) << (8 * row);
        for (int e = 0; e < 3; e++) {
            edges.q[e] += edges.step[e];
        }
        texels += RHW_TILE;
    }
    passed <<= 8 * (block->y0 - block->y);
    return tests ? settle_block(work, block->x, block->y, passed, rule) : passed;
}

// The same, tested by the rule of the draw.
RHW_INLINE uint64_t small_pixels(struct tile_work *work, const struct batch *batch, int i,
                                 const struct small_block *block)
{
    if (!tests_early(work)) {
        return small_test(work, batch, i, block, false, work->early);
    }
    switch (work->common) {
    case RULE_LESS: return small_test(work, batch, i, block, true, common_rules[RULE_LESS]);
    case RULE_GREATER: return small_test(work, batch, i, block, true, common_rules[RULE_GREATER]);
    case RULE_MARK_LESS: return small_test(work, batch, i, block, true, common_rules[RULE_MARK_LESS]);
    case RULE_MARK_GREATER: return small_test(work, batch, i, block, true, common_rules[RULE_MARK_GREATER]);
    case RULE_TAKE: return small_test(work, batch, i, block, true, common_rules[RULE_TAKE]);
    default: return small_test(work, batch, i, block, true, work->early);
    }
}

// Takes what packing needs of the planes from the batch.
RHW_INLINE void take_planes(struct triangle_work *triangle, const struct batch *batch, int i)
{
    struct planes *const planes = &triangle->planes;
    planes->exact = planes->wide = planes->homogeneous = false;
    planes->anchor_x = batch->anchor_x[i];
    planes->anchor_y = batch->anchor_y[i];
    planes->linear = batch->linear[i];
    planes->factors.inverse_area = batch->inverse_area[i]; // for planes_slopes
    memcpy(triangle->v, batch->vertex[i], sizeof triangle->v);
    triangle->planes_ready = true;
}

// The pixels of triangle i in the block, of which the batch has all there is to know. `only`: it has no others.
RHW_INLINE void draw_small_block(struct tile_work *work, struct triangle_work *triangle,
                                 const struct batch *batch, int i, const struct small_block *block, bool only)
{
    uint64_t mask = small_pixels(work, batch, i, block);
    if (work->phase == PHASE_BACKWARDS) {
        mask = take_backwards(work, block->x, block->y, mask);
    }
    if (mask == 0 || !work->shades) {
        return;
    }
    work->counters->fragments += (uint64_t)__builtin_popcountll(mask);
    if (!triangle->planes_ready) {
        take_planes(triangle, batch, i);
    }
    if (only) {
        collect_loose(work, triangle, block->x, block->y, block->y1 - block->y, mask);
        return;
    }
    const struct block_place at = block_place(work, &triangle->planes, block->x, block->y);
    collect_block(work, triangle, &at, block->x, block->y, mask, NULL, false);
}

// A triangle that needs more than the batch has.
RHW_INLINE void draw_other_block(struct tile_work *work, struct triangle_work *triangle,
                                 const struct batch *batch, int i, const struct small_block *block)
{
    const uint64_t mask = small_test(work, batch, i, block, false, work->early);
    if (mask != 0) {
        draw_block(work, triangle, block->x, block->y, mask);
    }
}

// The block of triangle i from (x, y) on, moved where it would reach over the tile's end. `only`: it has no others.
RHW_INLINE struct small_block small_block(const struct batch *batch, int i, int x, int y, bool only)
{
    struct small_block block = {min_int(x, RHW_TILE - RHW_BLOCK),
                                min_int(y, RHW_TILE - RHW_BLOCK),
                                x,
                                y,
                                min_int(x + RHW_BLOCK, batch->x1[i]),
                                min_int(y + RHW_BLOCK, batch->y1[i]),
                                {batch->q[0][i], batch->q[1][i], batch->q[2][i]}};
    for (int e = 0; e < 3 && !only; e++) {
        block.q[e] += batch->a[e][i] * (block.x - batch->x[i]) + batch->b[e][i] * (y - batch->y0[i]);
    }
    return block;
}

static __attribute__((noinline)) void draw_small_blocks(struct tile_work *work,
                                                        struct triangle_work *triangle,
                                                        const struct batch *batch, int i, bool taken)
{
    int rise[3]; // of the edges in a block, at most
    for (int e = 0; e < 3; e++) {
        rise[e] = (RHW_BLOCK - 1) * (max_int(batch->a[e][i], 0) + max_int(batch->b[e][i], 0));
    }
    for (int y = batch->y0[i]; y < batch->y1[i]; y += RHW_BLOCK) {
        for (int x = batch->x0[i]; x < batch->x1[i]; x += RHW_BLOCK) {
            const struct small_block block = small_block(batch, i, x, y, false);
            if (((block.q[0] + rise[0]) | (block.q[1] + rise[1]) | (block.q[2] + rise[2])) < 0) {
                continue; // an edge leaves it outside
            }
            if (taken) {
                draw_small_block(work, triangle, batch, i, &block, false);
            } else {
                draw_other_block(work, triangle, batch, i, &block);
            }
        }
    }
}

static void draw_small(struct tile_work *work, struct triangle_work *triangle, const struct batch *batch,
                       int i)
{
    // Where no screen weights are wanted the batch has all there is to know; groups that keep the depth of a row take
    // it from draw_block.
    const bool taken = (work->packs || !work->shades) && !(batch->inexact >> i & 1);
    if (taken && batch->x1[i] - batch->x0[i] <= RHW_BLOCK && batch->y1[i] - batch->y0[i] <= RHW_BLOCK) {
        const struct small_block block = small_block(batch, i, batch->x0[i], batch->y0[i], true);
        draw_small_block(work, triangle, batch, i, &block, true);
    } else {
        draw_small_blocks(work, triangle, batch, i, taken && !work->keeps_depth);
    }
    finish_loose(work, triangle);
}
