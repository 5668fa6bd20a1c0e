// SPDX-License-Identifier: MIT
// Triangles that are small beside a tile are what meshes are made of. Their edges fit into 32 bits, and their blocks of
// 8×8 pixels start where the triangle does instead of at multiples of 8, so that few of them are mostly empty. If a
// triangle has at most 8 columns, it is a strip: coverage and the early depth test of a row are one step, and what is
// covered stays a mask of lanes. The rows of other triangles are spans (span.h), so that no row is looked at where it
// is empty. Strips of more than 8 rows take 6 to 12 % fewer instructions for the bunny than spans would.
#ifndef RHW_TRIANGLE_SMALL_H
#define RHW_TRIANGLE_SMALL_H

#include "kernels/fragment/collect.h"
#include "kernels/integer.h"
#include "span_blocks.h"
#include "triangle_planes.h"

// Return the pixels of the block at (x, y) to be shaded, among the pixels `mask` that passed the early test. They are
// counted, and the triangle is made ready for shading.
RHW_INLINE uint64_t ready_pixels(struct tile_work *work, struct triangle_work *triangle, int x, int y,
                                 uint64_t mask)
{
    if (work->phase == RHW_PHASE_BACKWARDS) {
        mask = claim_backwards(&work->scratch->depth, x, y, mask);
    }
    if (mask == 0 || work->plan.shading == RHW_SHADING_NONE) {
        return 0;
    }
    work->counters->fragments += (uint64_t)__builtin_popcountll(mask);
    if (!triangle->has_planes) {
        copy_planes(work, triangle);
    }
    return mask;
}

// small_depth_columns sets the depth of a triangle over the columns from x on, and small_depth_rows over the rows from
// y on.
RHW_INLINE void small_depth_columns(struct block_plane *depth, const struct tile_work *work,
                                    const struct triangle_work *triangle, int x)
{
    const struct triangle_setup8 *const setup = triangle->setup;
    const int i = triangle->lane;
    block_plane_column(depth, plane_of(&setup->quantities[i], QUANTITY_Z),
                       f64x8_from_i32x8(i32x8_splat(work->x + x - setup->anchor_x[i]) + rhw_lane_index));
}

RHW_INLINE void small_depth_rows(struct block_plane *depth, const struct tile_work *work,
                                 const struct triangle_work *triangle, int y)
{
    const struct triangle_setup8 *const setup = triangle->setup;
    const int i = triangle->lane;
    block_plane_rows(depth, plane_of(&setup->quantities[i], QUANTITY_Z),
                     f64x8_from_i32x8(i32x8_splat(work->y + y - setup->anchor_y[i]) + rhw_lane_index));
}

// Strips -----------------------------------------------------------------------------------------------

// A triangle at 8 pixels in a row: the edges and what they change by to the next row, the columns that may be drawn
// (`sides` is negative in the others), and the part of depth that depends on the column.
struct strip {
    int x; // first column, in the tile
    i32x8 q[3], step[3], sides;
    struct block_plane depth;
};

// Set a strip at its first row.
RHW_INLINE void strip_set(struct strip *strip, const struct tile_work *work,
                          const struct triangle_work *triangle)
{
    const struct triangle_setup8 *const setup = triangle->setup;
    const int i = triangle->lane;
    strip->x = setup->x[i];
    for (int e = 0; e < 3; e++) {
        strip->q[e] = i32x8_splat(setup->q[e][i]) + i32x8_splat(setup->a[e][i]) * rhw_lane_index;
        strip->step[e] = i32x8_splat(setup->b[e][i]);
    }
    strip->sides = (rhw_lane_index - i32x8_splat(setup->x0[i] - strip->x)) |
                   (i32x8_splat(setup->x1[i] - strip->x - 1) - rhw_lane_index);
    if (work->plan.tests_early) {
        small_depth_columns(&strip->depth, work, triangle, strip->x);
    }
}

// Rows y .. y1 − 1 of a strip, 8 at most. Their mask is the mask of the block whose first row is `top`.
struct strip_rows {
    int y, y1, top;
};

// Return the pixels of the rows that are covered, and move the strip on to row y1.
RHW_INLINE uint64_t cover_strip(struct strip *strip, struct strip_rows rows)
{
    uint64_t covered = 0;
    for (int row = 0; row < rows.y1 - rows.y; row++) {
        const i32x8 outside = strip->q[0] | strip->q[1] | strip->q[2] | strip->sides;
        covered |= (uint64_t)(i32x8_sign_bits(outside) ^ 0xff) << (8 * row);
        for (int e = 0; e < 3; e++) {
            strip->q[e] += strip->step[e];
        }
    }
    return covered << (8 * (rows.y - rows.top));
}

// Rows of a strip to be tested.
struct strip_test {
    struct tile_work *work;
    const struct triangle_work *triangle;
    struct strip *strip;
    struct strip_rows rows;
};

// Cover rows of a strip and test their depth, which the test writes. Return the pixels that are covered and pass.
RHW_INLINE uint64_t test_strip(const void *pixels, const struct rhw_depth_rule rule)
{
    const struct strip_test *const test = pixels;
    const struct strip_rows rows = test->rows;
    struct strip *const strip = test->strip;
    struct tile_depth *const depth = &test->work->scratch->depth;
    float *texels = depth_texels(depth, strip->x, rows.y);
    uint64_t passed = 0;
    small_depth_rows(&strip->depth, test->work, test->triangle, rows.y);
    for (int row = 0; row < rows.y1 - rows.y; row++) {
        const i32x8 inside = ~((strip->q[0] | strip->q[1] | strip->q[2] | strip->sides) >> 31);
        const f32x8 z = f32x8_from_f64x8(block_plane_value(&strip->depth, row));
        const i32x8 pass = test_lanes(texels, z, inside, open_row(depth, strip->x, rows.y + row, rule), rule);
        passed |= (uint64_t)i32x8_sign_bits(pass) << (8 * row);
        texels += RHW_TILE;
        for (int e = 0; e < 3; e++) {
            strip->q[e] += strip->step[e];
        }
    }
    return settle_block(depth, strip->x, rows.top, passed << (8 * (rows.y - rows.top)), rule);
}

// Return the pixels that are to be shaded, if nothing hides them later.
RHW_INLINE uint64_t strip_pixels(struct tile_work *work, const struct triangle_work *triangle,
                                 struct strip *strip, struct strip_rows rows)
{
    const struct strip_test test = {work, triangle, strip, rows};
    return work->plan.tests_early ? test_early(&work->plan, test_strip, &test) : cover_strip(strip, rows);
}

RHW_INLINE void draw_strip_rows(struct tile_work *work, struct triangle_work *triangle, struct strip *strip,
                                int y, int y1)
{
    const struct strip_rows rows = {y, y1, min_int(y, RHW_TILE - RHW_BLOCK)};
    const uint64_t passed = strip_pixels(work, triangle, strip, rows);
    const uint64_t mask = ready_pixels(work, triangle, strip->x, rows.top, passed);
    if (mask != 0) {
        collect_fragments(work, triangle, strip->x, rows.top, y1 - rows.top, mask);
    }
}

// Draw a triangle that fits into a block.
RHW_INLINE void draw_short_strip(struct tile_work *work, struct triangle_work *triangle)
{
    const struct triangle_setup8 *const setup = triangle->setup;
    struct strip strip;
    strip_set(&strip, work, triangle);
    draw_strip_rows(work, triangle, &strip, setup->y0[triangle->lane], setup->y1[triangle->lane]);
}

// Draw a triangle that fits into 8 columns and has more than 8 rows.
static __attribute__((noinline)) void draw_tall_strip(struct tile_work *work, struct triangle_work *triangle)
{
    const struct triangle_setup8 *const setup = triangle->setup;
    const int y1 = setup->y1[triangle->lane];
    struct strip strip;
    strip_set(&strip, work, triangle);
    for (int y = setup->y0[triangle->lane]; y < y1; y += RHW_BLOCK) {
        draw_strip_rows(work, triangle, &strip, y, min_int(y + RHW_BLOCK, y1));
    }
}

// Blocks -----------------------------------------------------------------------------------------------

// The pixels of the block at (x, y) to be tested: those set in `mask`, which is not 0.
struct span_test {
    struct tile_work *work;
    const struct triangle_work *triangle;
    int x, y;
    uint64_t mask;
};

// Test the pixels of a block. Return the pixels that pass the depth test, which writes their depth.
RHW_INLINE uint64_t test_spans(const void *pixels, const struct rhw_depth_rule rule)
{
    const struct span_test *const test = pixels;
    const int x = test->x, y = test->y;
    const uint64_t mask = test->mask;
    struct tile_depth *const depth = &test->work->scratch->depth;
    struct block_plane over;
    small_depth_columns(&over, test->work, test->triangle, x);
    small_depth_rows(&over, test->work, test->triangle, y);
    const int first = __builtin_ctzll(mask) / 8, last = 7 - __builtin_clzll(mask) / 8;
    float *texels = depth_texels(depth, x, y + first);
    uint64_t passed = 0;
    for (int row = first; row <= last; row++) {
        const i32x8 live = i32x8_from_bits((unsigned)(mask >> (8 * row)) & 0xff);
        const f32x8 z = f32x8_from_f64x8(block_plane_value(&over, row));
        const i32x8 pass = test_lanes(texels, z, live, open_row(depth, x, y + row, rule), rule);
        passed |= (uint64_t)i32x8_sign_bits(pass) << (8 * row);
        texels += RHW_TILE;
    }
    return settle_block(depth, x, y, passed, rule);
}

RHW_INLINE uint64_t span_pixels(struct tile_work *work, const struct triangle_work *triangle, int x, int y,
                                uint64_t mask)
{
    const struct span_test test = {work, triangle, x, y, mask};
    return work->plan.tests_early ? test_early(&work->plan, test_spans, &test) : mask;
}

// Draw one block of several.
static inline void draw_small_block(struct tile_work *work, struct triangle_work *triangle, int x, int y,
                                    uint64_t mask)
{
    mask = ready_pixels(work, triangle, x, y, span_pixels(work, triangle, x, y, mask));
    if (mask == 0) {
        return;
    }
    f32x8 z[RHW_BLOCK];
    const struct block block = {x, y, block_offset(work, &triangle->planes, x, y), z, false, NULL};
    if (work->plan.keeps_depth) {
        struct block_planes over;
        block_depth(&over, &triangle->planes, &block.at);
        for (int row = 0; row < RHW_BLOCK; row++) {
            z[row] = depth_of_row(&triangle->planes, &over, row);
        }
    }
    collect_block(work, triangle, &block, mask);
}

static __attribute__((noinline)) void draw_small_blocks(struct tile_work *work,
                                                        struct triangle_work *triangle)
{
    draw_span_blocks(work, triangle, draw_small_block);
}

// Draw a small triangle whose planes are not exact ones.
RHW_INLINE void draw_small_triangle(struct tile_work *work, struct triangle_work *triangle)
{
    const struct triangle_setup8 *const setup = triangle->setup;
    const int i = triangle->lane;
    if (setup->x1[i] - setup->x0[i] > RHW_BLOCK) {
        draw_small_blocks(work, triangle);
    } else if (setup->y1[i] - setup->y0[i] > RHW_BLOCK) {
        draw_tall_strip(work, triangle);
    } else {
        draw_short_strip(work, triangle);
    }
    finish_collected(work, triangle);
}

#endif
