// SPDX-License-Identifier: MIT
// The smallest triangles, where pixels have one sample, have 4 columns and 8 rows at most: lines of a pixel, and meshes
// finer than the picture. What they cover is found 8 triangles at a time, one in each lane; then the pixels that are
// covered, which are fewer than there are rows, are looked at one by one. A fragment that passes the depth test is
// packed with the numbers that the test needed.
//
// This path saves instructions of a frame: lines_1m 22 %, sphere_1m 16 %, bunny_lit 14 %, sphere_1m_tex 3 %. If nothing
// is shaded, strips take less time, as they have fewer branches that cannot be foreseen, though in sphere_1m_depth 5 %
// more instructions.
#ifndef RHW_TRIANGLE_TINY_H
#define RHW_TRIANGLE_TINY_H

#include "kernels/fragment/collect.h"
#include "triangle_planes.h"

// The mask of a tiny triangle has bit TINY_COLUMNS·row + column from its first pixel on.
enum { TINY_COLUMNS = 4, TINY_ROWS = 8 };

_Static_assert(TINY_COLUMNS *TINY_ROWS == 32, "masks are words");

// Return the triangles of a batch that are tiny, by a bit each. Return 0 if they are so few that covering all 8 lanes
// would cost more than it saves.
RHW_INLINE unsigned tiny_of(const struct triangle_setup8 *setup)
{
    enum { FEW = 2 };
    const i32x8 width = i32x8_load(setup->x1) - i32x8_load(setup->x0),
                height = i32x8_load(setup->y1) - i32x8_load(setup->y0);
    const i32x8 beyond =
        rhw_less_int(i32x8_splat(TINY_COLUMNS), width) | rhw_less_int(i32x8_splat(TINY_ROWS), height);
    const unsigned tiny = setup->small & ~i32x8_sign_bits(beyond);
    return __builtin_popcount(tiny) > FEW ? tiny : 0;
}

// Set the masks of the batch. Masks of triangles that are not tiny are rubbish. Triangles of a bin reach into its tile,
// so that all others have a column and a row at least.
static void cover_tiny(struct triangle_setup8 *setup)
{
    const i32x8 x0 = i32x8_load(setup->x0), y0 = i32x8_load(setup->y0);
    const i32x8 columns = i32x8_min(i32x8_load(setup->x1) - x0, i32x8_splat(TINY_COLUMNS)),
                rows = i32x8_min(i32x8_load(setup->y1) - y0, i32x8_splat(TINY_ROWS));
    const u32x8 dx = (u32x8)(x0 - i32x8_load(setup->x));
    u32x8 q[3], right[3], down[3]; // unsigned: see edge_lanes
    for (int e = 0; e < 3; e++) {
        right[e] = (u32x8)i32x8_load(setup->a[e]);
        down[e] = (u32x8)i32x8_load(setup->b[e]);
        q[e] = (u32x8)i32x8_load(setup->q[e]) + right[e] * dx;
    }
    u32x8 covered = (u32x8)i32x8_splat(0);
    for (int row = 0; row < TINY_ROWS && rhw_any(rhw_less_int(i32x8_splat(row), rows)); row++) {
        u32x8 at[3] = {q[0], q[1], q[2]}, outside = (u32x8)i32x8_splat(0);
        for (int column = 0; column < TINY_COLUMNS; column++) {
            outside |= (at[0] | at[1] | at[2]) >> 31 << column;
            for (int e = 0; e < 3; e++) {
                at[e] += right[e];
            }
        }
        covered |= (outside ^ (u32x8)i32x8_splat(0xf)) << (TINY_COLUMNS * row);
        for (int e = 0; e < 3; e++) {
            q[e] += down[e];
        }
    }
    const i32x8 within_columns = {0, 0x11111111, 0x33333333, 0x77777777, -1};
    // The index is the number of rows, less one.
    const i32x8 within_rows = {0xf, 0xff, 0xfff, 0xffff, 0xfffff, 0xffffff, 0xfffffff, -1};
    i32x8_store(setup->tiny_mask, (i32x8)covered & i32x8_permute(within_columns, columns) &
                                      i32x8_permute(within_rows, rows - i32x8_splat(1)));
}

// Find the tiny triangles of a batch and cover them.
void RHW_ISA_NAME(rhw_find_tiny)(struct triangle_setup8 *setup)
{
    setup->tiny = tiny_of(setup);
    if (setup->tiny != 0) {
        cover_tiny(setup);
    }
}

// The places of the pixels of a tiny triangle, seen from its first one.
struct tiny_place {
    int texel;       // texel of the first pixel
    int right, down; // pixels from the triangle's anchor to the first
};

RHW_INLINE struct tiny_place place_of_tiny(const struct tile_work *work, const struct triangle_setup8 *setup,
                                           int i)
{
    return (struct tiny_place){setup->y0[i] * RHW_TILE + setup->x0[i],
                               work->x + setup->x0[i] - setup->anchor_x[i],
                               work->y + setup->y0[i] - setup->anchor_y[i]};
}

// Test triangle i by a depth rule and pack its fragments. The draw wants no more than smooth varyings of them.
RHW_INLINE void pack_tiny(const struct triangle_run *run, int i, const struct rhw_depth_rule rule)
{
    struct tile_work *const work = run->work;
    const struct triangle_setup8 *const setup = run->setup;
    const struct quantity_planes *const planes = &setup->quantities[i];
    const struct tiny_place place = place_of_tiny(work, setup, i);
    const struct packed_triangle *packed = NULL;
    unsigned fragments = 0;
    for (uint32_t left = setup->tiny_mask[i]; left != 0; left &= left - 1) {
        const int pixel = __builtin_ctz(left), column = pixel % TINY_COLUMNS, row = pixel / TINY_COLUMNS;
        const int texel = place.texel + row * RHW_TILE + column;
        const f64x4 quantities = quantity_values(planes, place.right + column, place.down + row);
        if (work->plan.tests_early &&
            !test_texel_early(&work->scratch->depth, texel, (float)quantities[QUANTITY_Z], rule)) {
            continue;
        }
        if (!packed) {
            packed = next_packed(work, setup->read->vertex[i], setup->anchor_x[i], setup->anchor_y[i]);
        }
        fragments++;
        if (pack_values(&work->scratch->partial, packed, texel, quantities) + 1 == RHW_LANES) {
            RHW_ISA_NAME(rhw_pack_group)(work);
        }
    }
    work->counters->fragments += fragments;
}

// Pack the collected fragments of triangle i, or make groups of them.
static __attribute__((noinline)) void finish_tiny(const struct triangle_run *run, int i)
{
    struct tile_work *const work = run->work;
    struct triangle_work triangle;
    begin_tiny(&triangle, run, i);
    work->counters->fragments += (uint64_t)work->scratch->collected.count;
    if (collected_wait(work)) {
        overtake(work);
    }
    RHW_ISA_NAME(rhw_release_collected)(work, &triangle);
}

// Test triangle i by a depth rule, and collect its fragments.
RHW_INLINE void collect_tiny(const struct triangle_run *run, int i, const struct rhw_depth_rule rule)
{
    struct tile_work *const work = run->work;
    const struct triangle_setup8 *const setup = run->setup;
    const struct plane z = plane_of(&setup->quantities[i], QUANTITY_Z);
    const struct tiny_place place = place_of_tiny(work, setup, i);
    int32_t *const texels = work->scratch->collected.texel;
    int count = 0;
    for (uint32_t left = setup->tiny_mask[i]; left != 0; left &= left - 1) {
        const int pixel = __builtin_ctz(left), column = pixel % TINY_COLUMNS, row = pixel / TINY_COLUMNS;
        const int texel = place.texel + row * RHW_TILE + column;
        texels[count] = texel;
        count += !work->plan.tests_early ||
                 test_texel_early(&work->scratch->depth, texel,
                                  (float)plane_value(z, place.right + column, place.down + row), rule);
    }
    if (count != 0) {
        work->scratch->collected.count = count;
        finish_tiny(run, i);
    }
}

// Draw a run by a depth rule.
RHW_INLINE void draw_tiny_by(const struct triangle_run *run, const struct rhw_depth_rule rule)
{
    const struct tile_work *const work = run->work;
    for (int i = run->first; i < run->end; i++) {
        if (work->packs_plainly) {
            pack_tiny(run, i, rule);
        } else {
            collect_tiny(run, i, rule);
        }
    }
}

// Draw a run of tiny triangles. The loop is compiled for each rule of a phase that shades.
void RHW_ISA_NAME(rhw_draw_tiny)(const struct triangle_run *run)
{
    const struct rhw_draw_plan *const plan = &run->work->plan;
    switch (plan->early_name) {
    case RHW_RULE_LESS: draw_tiny_by(run, rhw_named_rules[RHW_RULE_LESS]); break;
    case RHW_RULE_GREATER: draw_tiny_by(run, rhw_named_rules[RHW_RULE_GREATER]); break;
    case RHW_RULE_CLAIM: draw_tiny_by(run, rhw_named_rules[RHW_RULE_CLAIM]); break;
    case RHW_RULE_MARK_LESS:
    case RHW_RULE_MARK_GREATER:
    case RHW_RULE_ANY: draw_tiny_by(run, plan->early); break;
    }
}

#endif
