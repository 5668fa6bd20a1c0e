// SPDX-License-Identifier: MIT
// The smallest triangles where pixels have one sample, those of 4 columns and 8 rows at most: lines of a pixel, and meshes
// finer than the picture. What they cover is found 8 triangles at a time, one in each lane; then the pixels that are
// covered are looked at one by one, which are fewer than there are rows. A fragment that passes the depth test is packed
// with the numbers that the test needed.
//
// Fewer instructions of a frame: lines_1m 22 %, sphere_1m 16 %, bunny_lit 14 %, sphere_1m_tex 3 %. Where nothing is shaded
// strips take less time, as fewer branches of theirs cannot be foreseen, though in sphere_1m_depth 5 % more instructions.
#ifndef RHW_TRIANGLE_SPECKS_H
#define RHW_TRIANGLE_SPECKS_H

#include "kernels/fragment/gather.h"
#include "draw_state.h"
#include "triangle_planes.h"

// A speck's mask has bit SPECK_COLUMNS·row + column from its first pixel on.
enum { SPECK_COLUMNS = 4, SPECK_ROWS = 8 };

_Static_assert(SPECK_COLUMNS *SPECK_ROWS == 32, "masks are words");

// Bit i: triangle i of the batch is no larger, and its planes are those that its setup has. 0 where these are so few that
// to cover 8 lanes of them costs more than it saves.
RHW_INLINE unsigned find_specks(const struct triangle_setup8 *setup)
{
    enum { FEW = 2 };
    const i32x8 width = i32x8_load(setup->x1) - i32x8_load(setup->x0),
                height = i32x8_load(setup->y1) - i32x8_load(setup->y0);
    const i32x8 beyond =
        rhw_less_int(i32x8_splat(SPECK_COLUMNS), width) | rhw_less_int(i32x8_splat(SPECK_ROWS), height);
    const unsigned specks = ~(i32x8_sign_bits(beyond) | setup->exact) & 0xff;
    return __builtin_popcount(specks) > FEW ? specks : 0;
}

// Sets the masks of the batch; those of triangles that are no specks are rubbish. Triangles of a bin reach into its tile, so
// that all others have a column and a row at least.
static __attribute__((noinline)) void cover_specks(struct triangle_setup8 *setup)
{
    const i32x8 x0 = i32x8_load(setup->x0), y0 = i32x8_load(setup->y0);
    const i32x8 columns = i32x8_min(i32x8_load(setup->x1) - x0, i32x8_splat(SPECK_COLUMNS)),
                rows = i32x8_min(i32x8_load(setup->y1) - y0, i32x8_splat(SPECK_ROWS));
    const u32x8 dx = (u32x8)(x0 - i32x8_load(setup->x));
    u32x8 q[3], right[3], down[3]; // unsigned: see edge_lanes
    for (int e = 0; e < 3; e++) {
        right[e] = (u32x8)i32x8_load(setup->a[e]);
        down[e] = (u32x8)i32x8_load(setup->b[e]);
        q[e] = (u32x8)i32x8_load(setup->q[e]) + right[e] * dx;
    }
    u32x8 covered = (u32x8)i32x8_splat(0);
    for (int row = 0; row < SPECK_ROWS && rhw_any(rhw_less_int(i32x8_splat(row), rows)); row++) {
        u32x8 at[3] = {q[0], q[1], q[2]}, outside = (u32x8)i32x8_splat(0);
        for (int column = 0; column < SPECK_COLUMNS; column++) {
            outside |= (at[0] | at[1] | at[2]) >> 31 << column;
            for (int e = 0; e < 3; e++) {
                at[e] += right[e];
            }
        }
        covered |= (outside ^ (u32x8)i32x8_splat(0xf)) << (SPECK_COLUMNS * row);
        for (int e = 0; e < 3; e++) {
            q[e] += down[e];
        }
    }
    const i32x8 within_columns = {0, 0x11111111, 0x33333333, 0x77777777, -1};
    const i32x8 within_rows = {0xf, 0xff, 0xfff, 0xffff, 0xfffff, 0xffffff, 0xfffffff, -1}; // but one
    i32x8_store(setup->speck, (i32x8)covered & i32x8_permute(within_columns, columns) &
                                  i32x8_permute(within_rows, rows - i32x8_splat(1)));
}

// Begins the draw of a batch's first triangle, and sets the specks of a batch where that draw wants them.
RHW_INLINE unsigned set_specks(struct tile_work *work, const struct rhw_chunk *chunk,
                               struct triangle_setup8 *setup)
{
    const struct rhw_draw *const draw = chunk->segments[setup->read->triangle[0]->segment].draw;
    if (draw != work->draw) {
        set_draw(work, draw);
    }
    setup->specks = work->plan.speck_flag != 0 ? find_specks(setup) : 0;
    if (setup->specks != 0) {
        cover_specks(setup);
    }
    return setup->specks;
}

// Where the pixels of a speck lie, seen from its first.
struct speck_place {
    int texel;       // of the first
    int right, down; // pixels from the triangle's anchor to the first
};

RHW_INLINE struct speck_place place_of_speck(const struct tile_work *work,
                                             const struct triangle_setup8 *setup, int i)
{
    return (struct speck_place){setup->y0[i] * RHW_TILE + setup->x0[i],
                                work->x + setup->x0[i] - setup->anchor_x[i],
                                work->y + setup->y0[i] - setup->anchor_y[i]};
}

// Tests triangle i by a depth rule and packs its fragments, which want no more than smooth varyings.
RHW_INLINE void pack_speck(const struct tiny_run *run, int i, const struct rhw_depth_rule rule)
{
    struct tile_work *const work = run->work;
    const struct triangle_setup8 *const setup = run->setup;
    const struct quantity_planes *const planes = &setup->quantities[i];
    const struct speck_place place = place_of_speck(work, setup, i);
    const struct packed_triangle *packed = NULL;
    unsigned fragments = 0;
    for (uint32_t left = setup->speck[i]; left != 0; left &= left - 1) {
        const int pixel = __builtin_ctz(left), column = pixel % SPECK_COLUMNS, row = pixel / SPECK_COLUMNS;
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
            pack_group(work, 0xff);
        }
    }
    work->counters->fragments += fragments;
}

// Packs the gathered fragments of triangle i, or makes groups of them.
static __attribute__((noinline)) void finish_speck(const struct tiny_run *run, int i)
{
    struct tile_work *const work = run->work;
    struct triangle_work triangle;
    begin_tiny(work, &triangle, run, i);
    work->counters->fragments += (uint64_t)work->scratch->gathered.count;
    if (gathered_wait(work)) {
        overtake(work);
    }
    release_gathered(work, &triangle);
}

// Tests triangle i by a depth rule, and gathers its fragments.
RHW_INLINE void gather_speck(const struct tiny_run *run, int i, const struct rhw_depth_rule rule)
{
    struct tile_work *const work = run->work;
    const struct triangle_setup8 *const setup = run->setup;
    const struct plane z = plane_of(&setup->quantities[i], QUANTITY_Z);
    const struct speck_place place = place_of_speck(work, setup, i);
    int32_t *const texels = work->scratch->gathered.texel;
    int count = 0;
    for (uint32_t left = setup->speck[i]; left != 0; left &= left - 1) {
        const int pixel = __builtin_ctz(left), column = pixel % SPECK_COLUMNS, row = pixel / SPECK_COLUMNS;
        const int texel = place.texel + row * RHW_TILE + column;
        texels[count] = texel;
        count += !work->plan.tests_early ||
                 test_texel_early(&work->scratch->depth, texel,
                                  (float)plane_value(z, place.right + column, place.down + row), rule);
    }
    if (count != 0) {
        work->scratch->gathered.count = count;
        finish_speck(run, i);
    }
}

// Draws specks as long as they take this path; gives the first triangle that does not, or the end of the batch.
RHW_INLINE uint64_t draw_specks_by(const void *what, const struct rhw_depth_rule rule)
{
    const struct tiny_run *const run = what;
    const struct tile_work *const work = run->work;
    const struct triangle_setup8 *const setup = run->setup;
    int i = run->first;
    for (; i < setup->read->count; i++) {
        const struct rhw_triangle *const t = setup->read->triangle[i];
        if (!(setup->specks >> i & 1) || !(t->flags & work->plan.speck_flag) ||
            run->chunk->segments[t->segment].draw != work->draw) {
            break;
        }
        if (work->packs_plainly) {
            pack_speck(run, i, rule);
        } else {
            gather_speck(run, i, rule);
        }
        if (rule.open == RHW_OPEN_MARK && work->scratch->depth.marked) {
            work->scratch->depth.marked = false;
            see_triangle(work, setup->read->number[i]);
        }
    }
    return (uint64_t)i;
}

// Does so from triangle `first` of a batch on, which is one.
static __attribute__((noinline)) int draw_specks(struct tile_work *work, const struct rhw_chunk *chunk,
                                                 struct triangle_setup8 *setup, int first)
{
    const struct tiny_run run = {work, chunk, setup, first};
    return (int)test_early(&work->plan, draw_specks_by, &run);
}

#endif
