// SPDX-License-Identifier: MIT
// Small triangles where pixels have several samples: their edges fit into 32 bits, those of all samples side by side, and
// coverage and the early depth test of a row are one step, in the rows and blocks that the triangle reaches alone. It is
// the special path of triangle_multisample.h for draws that are tested early and shaded at pixel centres.
#ifndef RHW_TRIANGLE_SMALL_SAMPLES_H
#define RHW_TRIANGLE_SMALL_SAMPLES_H

#include "../fragment/gather.h"
#include "triangle_planes.h"

// The edges at each sample of the first pixel of a block: as q in coverage.h.
struct sample_edges {
    int32_t q[3][RHW_MAX_SAMPLES], a[3], b[3];
};

static inline void sample_edges_set(struct sample_edges *edges, const struct tile_work *work,
                                    const struct triangle_work *triangle, int x, int y)
{
    const struct triangle_setup8 *const setup = triangle->setup;
    const struct rhw_sample_pattern *const pattern = work->pass->pattern;
    const struct rhw_triangle *const t = triangle->t;
    const int i = triangle->lane;
    const int32_t px = (work->x + x) * RHW_SUBPIXEL, py = (work->y + y) * RHW_SUBPIXEL;
    for (int e = 0; e < 3; e++) {
        const int32_t a = setup->a[e][i], b = setup->b[e][i];
        const bool top_left = a > 0 || (a == 0 && b > 0);
        const int32_t first = a * (px - t->x_24_8[e]) + b * (py - t->y_24_8[e]) - (top_left ? 0 : 1);
        for (int s = 0; s < work->samples; s += RHW_LANES) {
            const i8 at = i8_splat(first) + i8_splat(a) * i8_load(&pattern->x_0_8[s]) +
                          i8_splat(b) * i8_load(&pattern->y_0_8[s]);
            i8_store(&edges->q[e][s], at >> RHW_SUBPIXEL_BITS);
        }
        edges->a[e] = a;
        edges->b[e] = b;
    }
}

// The part of a block that a triangle may cover: rows, and columns as bits.
struct block_part {
    int x, y, row0, row1;
    unsigned columns;
};

// Pixels of the part whose sample s the triangle covers.
RHW_INLINE uint64_t cover_sample(const struct sample_edges *edges, const struct block_part *part, int s)
{
    i8 q[3];
    for (int e = 0; e < 3; e++) {
        const int32_t first = edges->q[e][s] + edges->b[e] * part->row0;
        q[e] = i8_splat(first) + i8_splat(edges->a[e]) * rhw_lane_index;
    }
    uint64_t covered = 0;
    for (int row = part->row0; row < part->row1; row++) {
        const unsigned bits = (i8_sign_bits(q[0] | q[1] | q[2]) ^ 0xff) & part->columns;
        covered |= (uint64_t)bits << (8 * row);
        for (int e = 0; e < 3; e++) {
            q[e] += i8_splat(edges->b[e]);
        }
    }
    return covered;
}

// Samples of a part to be tested: those set in `mask`.
struct part_test {
    struct tile_work *work;
    const struct triangle_work *triangle;
    const struct block_part *part;
    uint64_t *mask; // by sample; what passes stays
};

// Does so with the depth test, which writes depth. Gives the pixels of which a sample passes.
RHW_INLINE uint64_t test_part(const void *pixels, const struct rhw_depth_rule rule)
{
    const struct part_test *const test = pixels;
    struct tile_work *const work = test->work;
    const struct rhw_sample_pattern *const pattern = work->pass->pattern;
    const struct triangle_setup8 *const setup = test->triangle->setup;
    const struct block_part *const part = test->part;
    const int i = test->triangle->lane;
    const struct plane z = plane_of(&setup->quantities[i], QUANTITY_Z);
    const d8 dx = d8_from_i8(i8_splat(work->x + part->x - setup->anchor_x[i]) + rhw_lane_index);
    const double dy = work->y + part->y - setup->anchor_y[i];
    uint64_t any = 0;
    for (int s = 0; s < work->samples; s++) {
        const uint64_t mask = test->mask[s];
        if (mask == 0) {
            continue;
        }
        struct tile_depth *const depth = depth_plane(work->scratch, s);
        const d8 column = plane_column(z, d8_add(dx, d8_splat(from_center(pattern->x_0_8[s]))));
        const double at = dy + from_center(pattern->y_0_8[s]);
        const int first = __builtin_ctzll(mask) / 8, last = 7 - __builtin_clzll(mask) / 8;
        float *texels = depth_texels(depth, part->x, part->y + first);
        uint64_t passed = 0;
        for (int row = first; row <= last; row++) {
            const f8 value = f8_from_d8(d8_add(column, d8_splat(z.at + z.dy * (at + row))));
            const unsigned open = open_row(depth, part->x, part->y + row, rule);
            const i8 live = i8_from_bits((unsigned)(mask >> (8 * row)) & 0xff);
            passed |= (uint64_t)i8_sign_bits(test_lanes(texels, value, live, open, rule)) << (8 * row);
            texels += RHW_TILE;
        }
        test->mask[s] = settle_block(depth, part->x, part->y, passed, rule);
        any |= test->mask[s];
    }
    return any;
}

static void draw_small_part(struct tile_work *work, struct triangle_work *triangle,
                            const struct sample_edges *edges, const struct block_part *part)
{
    const uint32_t drawn = work->pipeline->def.sample_mask;
    uint64_t mask[RHW_MAX_SAMPLES], any = 0;
    for (int s = 0; s < work->samples; s++) {
        mask[s] = drawn >> s & 1 ? cover_sample(edges, part, s) : 0;
        any |= mask[s];
    }
    if (any != 0 && work->plan.tests_early) {
        const struct part_test test = {work, triangle, part, mask};
        any = test_early(&work->plan, test_part, &test);
    }
    if (any == 0 || work->plan.shading == RHW_SHADING_NONE) {
        return;
    }
    work->counters->fragments += (uint64_t)__builtin_popcountll(any);
    if (!triangle->has_planes) {
        copy_planes(work, triangle);
    }
    gather_samples(work, triangle, part->x, part->y, mask, any);
}

// Whether a triangle takes this path: a small one that is no point, and whose planes are not exact ones.
RHW_INLINE bool takes_small_samples(const struct tile_work *work, const struct triangle_work *triangle)
{
    return triangle->t->flags & work->plan.sampled_small_flag &&
           !(triangle->t->flags & RHW_TRIANGLE_RECTANGLE) &&
           !(triangle->setup->exact >> triangle->lane & 1) && !triangle->clamps_depth;
}

static __attribute__((noinline)) void draw_small_samples(struct tile_work *work,
                                                         struct triangle_work *triangle)
{
    const struct triangle_setup8 *const setup = triangle->setup;
    const int i = triangle->lane;
    const int x0 = setup->x0[i], y0 = setup->y0[i], x1 = setup->x1[i], y1 = setup->y1[i];
    const int left = x0 & -RHW_BLOCK, top = y0 & -RHW_BLOCK;
    struct sample_edges edges;
    for (int s = 0; s < work->samples; s++) {
        depth_plane(work->scratch, s)->marked = false;
    }
    for (int y = top; y < y1; y += RHW_BLOCK) {
        for (int x = left; x < x1; x += RHW_BLOCK) {
            const struct block_part part = {x, y, max_int(y0 - y, 0), min_int(y1 - y, RHW_BLOCK),
                                            0xffu << max_int(x0 - x, 0) &
                                                0xffu >> max_int(x + RHW_BLOCK - x1, 0) & 0xffu};
            sample_edges_set(&edges, work, triangle, x, y);
            draw_small_part(work, triangle, &edges, &part);
        }
    }
    finish_gathered(work, triangle);
    for (int s = 1; s < work->samples; s++) {
        work->scratch->depth.marked |= depth_plane(work->scratch, s)->marked;
    }
}

#endif
