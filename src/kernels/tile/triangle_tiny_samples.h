// SPDX-License-Identifier: MIT
// The smallest triangles, where pixels have 4 samples, have few columns, as in meshes that are finer than the picture.
// What they cover is known by cells of 4×4 pixels (sample_cells.h). The samples of a pixel are the lanes of a vector of
// four, in the early depth test too, so that nothing is done for pixels that are not covered.
#ifndef RHW_TRIANGLE_TINY_SAMPLES_H
#define RHW_TRIANGLE_TINY_SAMPLES_H

#include "kernels/fragment/collect.h"
#include "sample_cells.h"
#include "triangle_planes.h"

_Static_assert(MOST_CELLS / BATCH * CELL * CELL <= RHW_COLLECTED_FRAGMENTS,
               "the fragments of a triangle are listed without a look at their number");

// The texels of a cell's pixels, counted from its first.
#define CELL_ROW(y) (y) * RHW_TILE, (y)*RHW_TILE + 1, (y)*RHW_TILE + 2, (y)*RHW_TILE + 3
static const uint8_t texel_of_pixel[CELL * CELL] = {CELL_ROW(0), CELL_ROW(1), CELL_ROW(2), CELL_ROW(3)};
#undef CELL_ROW

// Return the pixels of a cell that have a sample in `covered`: the lowest bit of the four that a pixel has.
RHW_INLINE uint64_t covered_pixels(uint64_t covered)
{
    const uint64_t pairs = covered | covered >> 2;
    return (pairs | pairs >> 1) & 0x1111111111111111u;
}

// Return the depth of the samples of a pixel.
RHW_INLINE f32x4 depth_of_pixel(struct rhw_tile_scratch *scratch, int texel)
{
    return (f32x4){depth_of_sample(scratch, 0)->texels[texel], depth_of_sample(scratch, 1)->texels[texel],
                   depth_of_sample(scratch, 2)->texels[texel], depth_of_sample(scratch, 3)->texels[texel]};
}

RHW_INLINE void store_depth_of_pixel(struct rhw_tile_scratch *scratch, int texel, f32x4 depth)
{
    for (int s = 0; s < CELL_SAMPLES; s++) {
        depth_of_sample(scratch, s)->texels[texel] = depth[s];
    }
}

// Return the open samples of a pixel, a bit each.
static inline unsigned open_of_pixel(struct rhw_tile_scratch *scratch, int texel)
{
    const int x = texel_column(texel), y = texel_row(texel);
    unsigned open = 0;
    for (int s = 0; s < CELL_SAMPLES; s++) {
        open |= (unsigned)(depth_of_sample(scratch, s)->open[y] >> x & 1) << s;
    }
    return open;
}

// Change the open bits of a pixel whose samples `passed` have passed a test, as settle_block does for pixels of a
// block. Return the samples that go on to be shaded.
RHW_INLINE unsigned settle_pixel(struct rhw_tile_scratch *scratch, int texel, unsigned passed,
                                 const struct rhw_depth_rule rule)
{
    const int x = texel_column(texel), y = texel_row(texel);
    if (rule.open != RHW_OPEN_CLAIM && rule.open != RHW_OPEN_MARK) {
        return passed;
    }
    if (rule.open == RHW_OPEN_CLAIM) {
        passed &= open_of_pixel(scratch, texel);
    } else {
        scratch->depth.marked = true;
    }
    for (int s = 0; s < CELL_SAMPLES; s++) {
        uint64_t *const row = &depth_of_sample(scratch, s)->open[y];
        const uint64_t pixel = (uint64_t)(passed >> s & 1) << x;
        *row = rule.open == RHW_OPEN_CLAIM ? *row & ~pixel : *row | pixel;
    }
    return passed;
}

// Test the samples of a cell by a depth rule, and list its fragments.
RHW_INLINE void draw_cell(const struct tile_work *work, const struct triangle_setup8 *setup, int i,
                          const struct sample_cell *cell, const struct rhw_depth_rule rule)
{
    struct rhw_tile_scratch *const scratch = work->scratch;
    struct collected_fragments *const collected = &scratch->collected;
    const struct plane z = plane_of(&setup->quantities[i], QUANTITY_Z);
    const f64x4 right = f64x4_splat(work->x + cell->x - setup->anchor_x[i]),
                down = f64x4_splat(work->y + cell->y - setup->anchor_y[i]);
    const bool tests = work->plan.tests_early, lists = work->plan.shading != RHW_SHADING_NONE;
    const int first = cell->y * RHW_TILE + cell->x;
    int count = collected->count;
    for (uint64_t left = covered_pixels(cell->covered); left != 0; left &= left - 1) {
        const unsigned bit = (unsigned)__builtin_ctzll(left), n = bit / CELL_SAMPLES;
        const int texel = first + texel_of_pixel[n];
        const unsigned covered = (unsigned)(cell->covered >> bit) & 0xf;
        unsigned samples = covered;
        if (tests) {
            const struct cell_pixel *const pixel = &work->cell_pixels[n];
            const f32x4 stored = depth_of_pixel(scratch, texel);
            const f32x4 depth = f32x4_from_f64x4(plane_value4(z, pixel->dx + right, pixel->dy + down));
            samples &= i32x4_sign_bits(compare_lanes4(rule.compare, depth, stored));
            if (rule.open >= RHW_OPEN_TRY) {
                samples |= covered & open_of_pixel(scratch, texel) &
                           i32x4_sign_bits(compare_lanes4(RHW_COMPARE_EQUAL, depth, stored));
            }
            if (samples == 0) {
                continue;
            }
            if (rule.write) {
                store_depth_of_pixel(scratch, texel, f32x4_select(i32x4_from_bits(samples), depth, stored));
            }
            samples = settle_pixel(scratch, texel, samples, rule);
        }
        collected->texel[count] = texel;
        collected->samples[count] = (int32_t)samples;
        count += lists && samples != 0;
    }
    collected->count = count;
}

// Make groups of the fragments of triangle i, or pack them.
static __attribute__((noinline)) void finish_cells(const struct triangle_run *run, int i)
{
    struct tile_work *const work = run->work;
    struct collected_fragments *const collected = &work->scratch->collected;
    struct triangle_work triangle;
    begin_tiny(&triangle, run, i);
    work->counters->fragments += (uint64_t)collected->count;
    // Nobody asks where the fragments lie if they may share a group and are too few for one of their own.
    collected->overtakes =
        (!work->orders_lanes || collected->count >= least_of_group(work)) && collected_wait(work);
    RHW_ISA_NAME(rhw_release_collected)(work, &triangle);
}

// Pack the fragments of triangle i, which are few. The draw wants no more than smooth varyings of them. This saves 5 %
// of the instructions of msaa4_sphere_1m.
RHW_INLINE void pack_cells(const struct triangle_run *run, int i)
{
    struct tile_work *const work = run->work;
    const struct triangle_setup8 *const setup = run->setup;
    struct collected_fragments *const collected = &work->scratch->collected;
    struct partial_group *const partial = &work->scratch->partial;
    const struct packed_triangle *const packed =
        next_packed(work, setup->read->vertex[i], setup->anchor_x[i], setup->anchor_y[i]);
    work->counters->fragments += (uint64_t)collected->count;
    for (int k = 0; k < collected->count; k++) {
        const int texel = collected->texel[k];
        const double dx = texel_column(texel) - packed->anchor_x, dy = texel_row(texel) - packed->anchor_y;
        const int n = pack_values(partial, packed, texel, quantity_values(&setup->quantities[i], dx, dy));
        partial->samples[n] = collected->samples[k];
        if (n + 1 == RHW_LANES) {
            RHW_ISA_NAME(rhw_pack_group)(work);
        }
    }
    collected->count = 0;
}

// Draw the cells of triangle i by a depth rule.
RHW_INLINE void draw_cells(const struct triangle_run *run, int i, const struct rhw_depth_rule rule)
{
    const struct tile_work *const work = run->work;
    const struct triangle_setup8 *const setup = run->setup;
    const struct sample_cells *const cells = &setup->cells;
    for (int n = cells->first[i]; n < cells->first[i + 1]; n++) {
        struct sample_cell cell = cell_at(cells, n);
        cell.covered &= work->drawn_cell;
        if (cell.covered != 0) {
            draw_cell(work, setup, i, &cell, rule);
        }
    }
    const int count = work->scratch->collected.count;
    // Packing 6 or 7 fragments plainly costs less than a group of their own.
    if (count != 0 && count < RHW_LANES && work->packs_plainly) {
        pack_cells(run, i);
    } else if (count != 0) {
        finish_cells(run, i);
    }
    if (rule.open == RHW_OPEN_MARK && work->scratch->depth.marked) {
        work->scratch->depth.marked = false;
        see_triangle(work, setup->read->number[i]);
    }
}

// Draw a run by a depth rule.
RHW_INLINE void draw_tiny_samples_by(const struct triangle_run *run, const struct rhw_depth_rule rule)
{
    const struct triangle_setup8 *const setup = run->setup;
    for (int i = run->first; i < run->end; i++) {
        const struct hiz_rect rect = {setup->x0[i], setup->y0[i], setup->x1[i], setup->y1[i]};
        if (setup->cells.covers >> i & 1 && !hides_small(run->work, setup, i, rect)) {
            draw_cells(run, i, rule);
        }
    }
}

// Draw a run of tiny triangles. The loop is compiled for each rule that has a name.
void RHW_ISA_NAME(rhw_draw_tiny_samples)(const struct triangle_run *run)
{
    const struct rhw_draw_plan *const plan = &run->work->plan;
    run->work->scratch->depth.marked = false;
    switch (plan->early_name) {
    case RHW_RULE_LESS: draw_tiny_samples_by(run, rhw_named_rules[RHW_RULE_LESS]); break;
    case RHW_RULE_GREATER: draw_tiny_samples_by(run, rhw_named_rules[RHW_RULE_GREATER]); break;
    case RHW_RULE_MARK_LESS: draw_tiny_samples_by(run, rhw_named_rules[RHW_RULE_MARK_LESS]); break;
    case RHW_RULE_MARK_GREATER: draw_tiny_samples_by(run, rhw_named_rules[RHW_RULE_MARK_GREATER]); break;
    case RHW_RULE_CLAIM: draw_tiny_samples_by(run, rhw_named_rules[RHW_RULE_CLAIM]); break;
    case RHW_RULE_ANY: draw_tiny_samples_by(run, plan->early); break;
    }
}

#endif
