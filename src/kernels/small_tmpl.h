// SPDX-License-Identifier: MIT
// Triangles that are small beside a tile: what meshes are made of. Their edges fit into 32 bits, and their blocks of
// 8×8 pixels start where the triangle does instead of at multiples of 8, so that few of them are mostly empty. In one
// of at most 8 columns, coverage and the early depth test of a row are one step: what is covered stays a mask of lanes.
// The rows of others are spans, so that no row is looked at where it is empty.
// Template: compiled once per instruction set.

#include "span_tmpl.h"

// The part of depth that depends on the column, of a block at x; and on the row, of one at y.
RHW_INLINE void small_columns(struct block_plane *depth, const struct tile_work *work,
                              const struct batch *batch, int i, int x)
{
    const struct plane z = linear_plane(&batch->linear[i], QUANTITY_Z);
    plane_columns(depth, &z, d8_from_i8(i8_splat(work->x + x - batch->anchor_x[i]) + rhw_lane_index));
}

RHW_INLINE void small_rows(struct block_plane *depth, const struct tile_work *work, const struct batch *batch,
                           int i, int y)
{
    const struct plane z = linear_plane(&batch->linear[i], QUANTITY_Z);
    plane_rows(depth, &z, d8_from_i8(i8_splat(work->y + y - batch->anchor_y[i]) + rhw_lane_index));
}

// Of a triangle at 8 pixels in a row: the edges and what they change by to the next row, the columns that may be drawn
// (negative where not), and the part of depth that depends on the column.
struct strip {
    i8 q[3], step[3], sides;
    struct block_plane depth;
};

// Of triangle i of the batch at column x of the tile, its first, row y0.
RHW_INLINE void strip_setup(struct strip *strip, const struct tile_work *work, const struct batch *batch,
                            int i, int x, bool tests)
{
    for (int e = 0; e < 3; e++) {
        strip->q[e] = i8_splat(batch->q[e][i]) + i8_splat(batch->a[e][i]) * rhw_lane_index;
        strip->step[e] = i8_splat(batch->b[e][i]);
    }
    strip->sides =
        (rhw_lane_index - i8_splat(batch->x0[i] - x)) | (i8_splat(batch->x1[i] - x - 1) - rhw_lane_index);
    if (tests) {
        small_columns(&strip->depth, work, batch, i, x);
    }
}

// The pixels that triangle i covers in rows y .. y1 − 1, 8 at most, and that pass the depth test, which writes their
// depth, as a mask of the block that starts at row `top`. The strip goes on to row y1. `tests`: there is an early test;
// `rule` is how, a constant where a call names it.
RHW_INLINE uint64_t test_strip(struct tile_work *work, const struct batch *batch, int i, struct strip *strip,
                               int x, int y, int y1, int top, bool tests, const struct depth_rule rule)
{
    if (tests) {
        small_rows(&strip->depth, work, batch, i, y);
    }
    float *texels = stored_depth(work, x, y);
    uint64_t passed = 0;
    for (int row = 0; row < y1 - y; row++) {
        i8 inside = ~((strip->q[0] | strip->q[1] | strip->q[2] | strip->sides) >> 31);
        if (tests) {
            const unsigned open = open_row(work, x, y + row, rule);
            inside = test_lanes(texels, f8_from_d8(plane_row(&strip->depth, row)), inside, open, rule);
        }
        passed |= (uint64_t)i8_sign_bits(inside) << (8 * row);
        for (int e = 0; e < 3; e++) {
            strip->q[e] += strip->step[e];
        }
        texels += RHW_TILE;
    }
    passed <<= 8 * (y - top);
    return tests ? settle_block(work, x, top, passed, rule) : passed;
}

// Of the pixels of a block set in `mask`, which is not 0, those that pass the depth test, which writes their depth.
RHW_INLINE uint64_t test_covered(struct tile_work *work, const struct batch *batch, int i, int x, int y,
                                 uint64_t mask, const struct depth_rule rule)
{
    struct block_plane depth;
    small_columns(&depth, work, batch, i, x);
    small_rows(&depth, work, batch, i, y);
    const int first = __builtin_ctzll(mask) / 8, last = 7 - __builtin_clzll(mask) / 8;
    float *texels = stored_depth(work, x, y + first);
    uint64_t passed = 0;
    for (int row = first; row <= last; row++) {
        const i8 live = i8_from_bits((unsigned)(mask >> (8 * row)) & 0xff);
        const i8 pass = test_lanes(texels, f8_from_d8(plane_row(&depth, row)), live,
                                   open_row(work, x, y + row, rule), rule);
        passed |= (uint64_t)i8_sign_bits(pass) << (8 * row);
        texels += RHW_TILE;
    }
    return settle_block(work, x, y, passed, rule);
}

// What test_strip finds, or test_covered where there is no strip; `rule` as there.
RHW_INLINE uint64_t test_small(struct tile_work *work, const struct batch *batch, int i, struct strip *strip,
                               int x, int y, int y1, int top, uint64_t mask, const struct depth_rule rule)
{
    return strip ? test_strip(work, batch, i, strip, x, y, y1, top, true, rule)
                 : test_covered(work, batch, i, x, top, mask, rule);
}

// By the rule of the draw.
RHW_INLINE uint64_t small_pixels(struct tile_work *work, const struct batch *batch, int i,
                                 struct strip *strip, int x, int y, int y1, int top, uint64_t mask)
{
    if (!tests_early(work)) {
        return strip ? test_strip(work, batch, i, strip, x, y, y1, top, false, work->early) : mask;
    }
    switch (work->common) {
    case RULE_LESS: return test_small(work, batch, i, strip, x, y, y1, top, mask, common_rules[RULE_LESS]);
    case RULE_GREATER:
        return test_small(work, batch, i, strip, x, y, y1, top, mask, common_rules[RULE_GREATER]);
    case RULE_MARK_LESS:
        return test_small(work, batch, i, strip, x, y, y1, top, mask, common_rules[RULE_MARK_LESS]);
    case RULE_MARK_GREATER:
        return test_small(work, batch, i, strip, x, y, y1, top, mask, common_rules[RULE_MARK_GREATER]);
    case RULE_TAKE: return test_small(work, batch, i, strip, x, y, y1, top, mask, common_rules[RULE_TAKE]);
    default: return test_small(work, batch, i, strip, x, y, y1, top, mask, work->early);
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
    memcpy(triangle->v, batch->read->vertex[i], sizeof triangle->v);
    triangle->planes_ready = true;
}

// Those of the pixels of triangle i in a block that passed the early test, `mask`, that are to be collected: they are
// counted, and the triangle is made ready for it.
RHW_INLINE uint64_t ready_pixels(struct tile_work *work, struct triangle_work *triangle,
                                 const struct batch *batch, int i, int x, int y, uint64_t mask)
{
    if (work->phase == PHASE_BACKWARDS) {
        mask = take_backwards(work, x, y, mask);
    }
    if (mask == 0 || !work->shades) {
        return 0;
    }
    work->counters->fragments += (uint64_t)__builtin_popcountll(mask);
    if (!triangle->planes_ready) {
        take_planes(triangle, batch, i);
    }
    return mask;
}

// Rows y to y1 − 1 of a strip, 8 at most.
RHW_INLINE void draw_strip_rows(struct tile_work *work, struct triangle_work *triangle,
                                const struct batch *batch, int i, struct strip *strip, int y, int y1)
{
    const int x = batch->x[i], top = min_int(y, RHW_TILE - RHW_BLOCK);
    const uint64_t passed = small_pixels(work, batch, i, strip, x, y, y1, top, 0);
    const uint64_t mask = ready_pixels(work, triangle, batch, i, x, top, passed);
    if (mask != 0) {
        collect_loose(work, triangle, x, top, y1 - top, mask);
    }
}

// A triangle that fits into 8 columns and more than 8 rows, of which the batch has all there is to know.
static __attribute__((noinline)) void draw_tall_strip(struct tile_work *work, struct triangle_work *triangle,
                                                      const struct batch *batch, int i)
{
    struct strip strip;
    strip_setup(&strip, work, batch, i, batch->x[i], tests_early(work));
    for (int y = batch->y0[i]; y < batch->y1[i]; y += RHW_BLOCK) {
        draw_strip_rows(work, triangle, batch, i, &strip, y, min_int(y + RHW_BLOCK, batch->y1[i]));
    }
}

// One that fits into a block.
RHW_INLINE void draw_short_strip(struct tile_work *work, struct triangle_work *triangle,
                                 const struct batch *batch, int i)
{
    struct strip strip;
    strip_setup(&strip, work, batch, i, batch->x[i], tests_early(work));
    draw_strip_rows(work, triangle, batch, i, &strip, batch->y0[i], batch->y1[i]);
}

// One block of several. `taken`: the batch has all there is to know of the triangle.
RHW_INLINE void draw_small_block(struct tile_work *work, struct triangle_work *triangle,
                                 const struct batch *batch, int i, int x, int y, uint64_t mask, bool taken)
{
    if (!taken) {
        draw_block(work, triangle, x, y, mask);
        return;
    }
    mask = small_pixels(work, batch, i, NULL, x, y, y + RHW_BLOCK, y, mask);
    mask = ready_pixels(work, triangle, batch, i, x, y, mask);
    if (mask != 0) {
        const struct block_place at = block_place(work, &triangle->planes, x, y);
        collect_block(work, triangle, &at, x, y, mask, NULL, false);
    }
}

// Blocks that would reach over the tile's end are moved.
static __attribute__((noinline)) void draw_small_blocks(struct tile_work *work,
                                                        struct triangle_work *triangle,
                                                        const struct batch *batch, int i, bool taken)
{
    struct span_edges edges;
    span_edges(&edges, batch, i);
    for (int y0 = batch->y0[i]; y0 < batch->y1[i]; y0 += RHW_BLOCK) {
        const int y = min_int(y0, RHW_TILE - RHW_BLOCK);
        const struct row_spans spans = row_spans(&edges, batch, i, y, y0, batch->y1[i]);
        for (int x0 = batch->x0[i]; x0 < batch->x1[i]; x0 += RHW_BLOCK) {
            const int x = min_int(x0, RHW_TILE - RHW_BLOCK);
            const uint64_t mask = span_mask(&spans, x, x0);
            if (mask != 0) {
                draw_small_block(work, triangle, batch, i, x, y, mask, taken);
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
    if (taken && batch->x1[i] - batch->x0[i] <= RHW_BLOCK) {
        if (batch->y1[i] - batch->y0[i] <= RHW_BLOCK) {
            draw_short_strip(work, triangle, batch, i);
        } else {
            draw_tall_strip(work, triangle, batch, i);
        }
    } else {
        draw_small_blocks(work, triangle, batch, i, taken && !work->keeps_depth);
    }
    finish_loose(work, triangle);
}
