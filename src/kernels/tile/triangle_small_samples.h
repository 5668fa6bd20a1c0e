// SPDX-License-Identifier: MIT
// Small triangles have edges that fit into 32 bits, and this file draws them where pixels have several samples. The
// edges of all samples stand side by side, and coverage and the early depth test of a row are one step. Parts of 8
// columns and rows start where the triangle does. It is the special path of triangle_large_samples.h for draws that are
// shaded at pixel centres.
#ifndef RHW_TRIANGLE_SMALL_SAMPLES_H
#define RHW_TRIANGLE_SMALL_SAMPLES_H

#include "kernels/fragment/collect.h"
#include "triangle_planes.h"

// A part of a triangle's rectangle: rows y .. y1 − 1, and the columns of the 8 from x on whose lanes are not negative
// in `sides`. Its masks are masks of the block whose first row is `top`; all of the block lies in the tile.
struct small_part {
    int x, y, y1, top;
    i32x8 sides;
    int32_t q[3][RHW_MAX_SAMPLES]; // q of coverage.h of each edge, at each sample of the pixel (x, y)
};

// The numbers that all parts of a triangle share.
struct small_edges {
    i32x8 along[3], step[3]; // change of the edges to the lanes of a row, and to the next row
};

// Leave out rows of a part, at its ends, that have no sample within the triangle. Return true if a row is left.
static inline bool trim_rows(struct small_part *part, const struct triangle_work *triangle)
{
    const struct triangle_setup8 *const setup = triangle->setup;
    const int i = triangle->lane, right = part->x - setup->x[i], down = part->y - setup->y0[i];
    i32x8 outside = i32x8_splat(0);
    // The edge is looked at where it is largest in the row: at one end, beyond all of the row's samples.
    for (int e = 0; e < 3; e++) {
        const int32_t a = setup->a[e][i], b = setup->b[e][i];
        const int32_t first = (setup->q[e][i] >> RHW_SUBPIXEL_BITS) + a * right + b * down;
        const int32_t most = first + RHW_BLOCK * max_int(a, 0) + max_int(b, 0) + 1;
        outside |= i32x8_splat(most) + i32x8_splat(b) * rhw_lane_index;
    }
    const unsigned rows = ~i32x8_sign_bits(outside) & ((1u << (part->y1 - part->y)) - 1);
    if (rows == 0) {
        return false;
    }
    part->y1 = part->y + 32 - __builtin_clz(rows);
    part->y += __builtin_ctz(rows);
    return true;
}

// Set the edges of a part.
static inline void part_edges_set(struct small_part *part, const struct tile_work *work,
                                  const struct triangle_work *triangle)
{
    const struct triangle_setup8 *const setup = triangle->setup;
    const struct rhw_sample_pattern *const pattern = work->target->pattern;
    const int i = triangle->lane, right = part->x - setup->x[i], down = part->y - setup->y0[i];
    for (int e = 0; e < 3; e++) {
        const int32_t a = setup->a[e][i], b = setup->b[e][i];
        const int32_t first = setup->q[e][i] + (a * right + b * down) * RHW_SUBPIXEL;
        for (int s = 0; s < work->samples; s += RHW_LANES) {
            const i32x8 at = i32x8_splat(first) + i32x8_splat(a) * i32x8_load(&pattern->x_0_8[s]) +
                             i32x8_splat(b) * i32x8_load(&pattern->y_0_8[s]);
            i32x8_store(&part->q[e][s], at >> RHW_SUBPIXEL_BITS);
        }
    }
}

// A part to be drawn.
struct part_test {
    struct tile_work *work;
    const struct triangle_work *triangle;
    const struct small_edges *edges;
    const struct small_part *part;
    uint64_t *mask; // pixels of each sample that are covered and pass
};

// Return the pixels whose sample s the triangle covers, and which pass the depth test. The test writes depth.
RHW_INLINE uint64_t test_part_sample(const struct part_test *test, int s, const struct rhw_depth_rule rule)
{
    struct tile_work *const work = test->work;
    const struct triangle_setup8 *const setup = test->triangle->setup;
    const struct small_edges *const edges = test->edges;
    const struct small_part *const part = test->part;
    const struct rhw_sample_pattern *const pattern = work->target->pattern;
    struct tile_depth *const depth = depth_of_sample(work->scratch, s);
    const int i = test->triangle->lane;
    const struct plane z = plane_of(&setup->quantities[i], QUANTITY_Z);
    const f64x8 dx = f64x8_from_i32x8(i32x8_splat(work->x + part->x - setup->anchor_x[i]) + rhw_lane_index);
    const f64x8 column = plane_column(z, f64x8_add(dx, f64x8_splat(from_center(pattern->x_0_8[s]))));
    const double dy = work->y - setup->anchor_y[i] + from_center(pattern->y_0_8[s]);
    const bool tests = work->plan.tests_early;
    i32x8 q[3];
    for (int e = 0; e < 3; e++) {
        q[e] = i32x8_splat(part->q[e][s]) + edges->along[e];
    }
    uint64_t passed = 0;
    for (int y = part->y; y < part->y1; y++) {
        const i32x8 inside = ~((q[0] | q[1] | q[2] | part->sides) >> 31);
        unsigned bits = i32x8_sign_bits(inside);
        for (int e = 0; e < 3; e++) {
            q[e] += edges->step[e];
        }
        if (bits != 0 && tests) {
            const f32x8 value = f32x8_from_f64x8(f64x8_add(column, f64x8_splat(z.at + z.dy * (dy + y))));
            const unsigned open = open_row(depth, part->x, y, rule);
            bits = i32x8_sign_bits(test_lanes(depth_texels(depth, part->x, y), value, inside, open, rule));
        }
        passed |= (uint64_t)bits << (8 * (y - part->top));
    }
    return tests ? settle_block(depth, part->x, part->top, passed, rule) : passed;
}

// Cover and test a part in all samples. Return the pixels of which a sample is left.
RHW_INLINE uint64_t test_part(const void *what, const struct rhw_depth_rule rule)
{
    const struct part_test *const test = what;
    const uint32_t drawn = test->work->pipeline->def.sample_mask;
    uint64_t any = 0;
    for (int s = 0; s < test->work->samples; s++) {
        test->mask[s] = drawn >> s & 1 ? test_part_sample(test, s, rule) : 0;
        any |= test->mask[s];
    }
    return any;
}

static void draw_small_part(struct tile_work *work, struct triangle_work *triangle,
                            const struct small_edges *edges, const struct small_part *part)
{
    uint64_t mask[RHW_MAX_SAMPLES];
    const struct part_test test = {work, triangle, edges, part, mask};
    const uint64_t any = test_early(&work->plan, test_part, &test);
    if (any == 0 || work->plan.shading == RHW_SHADING_NONE) {
        return;
    }
    work->counters->fragments += (uint64_t)__builtin_popcountll(any);
    if (!triangle->has_planes) {
        copy_planes(work, triangle);
    }
    collect_samples(work, triangle, part->x, part->top, mask, any);
}

// Return true if all of the triangle in a part lies behind what the tile shows there.
static inline bool hides_part(const struct tile_work *work, const struct triangle_work *triangle,
                              const struct small_part *part)
{
    const struct triangle_setup8 *const setup = triangle->setup;
    const int i = triangle->lane;
    return hides_small(work, setup, i,
                       (struct hiz_rect){max_int(part->x, setup->x0[i]), part->y,
                                         min_int(part->x + RHW_BLOCK, setup->x1[i]), part->y1});
}

static void draw_small_triangle_samples(struct tile_work *work, struct triangle_work *triangle)
{
    const struct triangle_setup8 *const setup = triangle->setup;
    const int i = triangle->lane;
    const int x0 = setup->x0[i], y0 = setup->y0[i], x1 = setup->x1[i], y1 = setup->y1[i];
    struct small_edges edges;
    for (int e = 0; e < 3; e++) {
        edges.along[e] = i32x8_splat(setup->a[e][i]) * rhw_lane_index;
        edges.step[e] = i32x8_splat(setup->b[e][i]);
    }
    begin_plain(triangle);
    for (int s = 0; s < work->samples; s++) {
        depth_of_sample(work->scratch, s)->marked = false;
    }
    for (int y = y0; y < y1; y += RHW_BLOCK) {
        for (int x = x0; x < x1; x += RHW_BLOCK) {
            // An initializer would clear the edges too; they are set later.
            struct small_part part;
            part.x = min_int(x, RHW_TILE - RHW_BLOCK);
            part.y = y;
            part.y1 = min_int(y + RHW_BLOCK, y1);
            part.top = min_int(y, RHW_TILE - RHW_BLOCK);
            const i32x8 column = i32x8_splat(part.x) + rhw_lane_index;
            part.sides = (column - i32x8_splat(x)) | (i32x8_splat(x1 - 1) - column);
            if (trim_rows(&part, triangle) && !hides_part(work, triangle, &part)) {
                part_edges_set(&part, work, triangle);
                draw_small_part(work, triangle, &edges, &part);
            }
        }
    }
    finish_collected(work, triangle);
    for (int s = 1; s < work->samples; s++) {
        work->scratch->depth.marked |= depth_of_sample(work->scratch, s)->marked;
    }
}

#endif
