// SPDX-License-Identifier: MIT
// Any triangle can be drawn in a tile block by block of 8×8 pixels: coverage and depth are tested, and what survives is
// collected for shading. This is the general path. Small triangles have a path of their own (triangle_small.h), and so
// have triangles that cover the tile all over where no depth is tested before shading: 17 % fewer instructions in
// fill_color. Small slivers, and small triangles of one colour, come here as well, by spans instead of coverage.
#ifndef RHW_TRIANGLE_LARGE_H
#define RHW_TRIANGLE_LARGE_H

#include "kernels/fragment/explained_fragment.h"
#include "kernels/fragment/collect.h"
#include "kernels/fragment/constant_color.h"
#include "kernels/depth/stencil_block.h"
#include "kernels/depth/depth_range.h"
#include "span_blocks.h"
#include "triangle_planes.h"
#include "triangle_whole.h"

// Blocks -----------------------------------------------------------------------------------------------

// Return 0 if the triangle faces the front. Return 1 if not.
RHW_INLINE int face_of(const struct triangle_work *triangle)
{
    return triangle->t->flags & RHW_TRIANGLE_BACK ? 1 : 0;
}

// Test a block's pixels set in `mask` before shading. Return the pixels that pass.
RHW_INLINE uint64_t test_depth(struct tile_work *work, const struct triangle_work *triangle,
                               const struct block *block, uint64_t mask)
{
    struct tile_depth *const depth = &work->scratch->depth;
    const struct planes *const planes = &triangle->planes;
    const bool is_whole = mask == ~(uint64_t)0;
    if (work->plan.test != RHW_TEST_DEPTH) {
        const struct block_pixels pixels = {depth, block->z, block->x, block->y, mask};
        return test_block_early_stencil(&pixels, &work->plan, face_of(triangle));
    }
    mask = test_block_early(depth, block->z, block->x, block->y, mask, &work->plan);
    // Blocks of spans start anywhere; only blocks at multiples of 8 have a bound.
    if (is_whole && work->tests_bounds && work->plan.early.write && !block->leaves_triangle &&
        planes->kind == PLANES_LINEAR && ((block->x | block->y) & (RHW_BLOCK - 1)) == 0) {
        hiz_cover(depth, plane_of(&planes->quantities, QUANTITY_Z), planes->anchor_x - work->x,
                  planes->anchor_y - work->y, block->x, block->y, 0);
    }
    return mask;
}

// Draw a block of which `mask` is covered and open: depth is tested first, then what survives is collected for shading.
RHW_INLINE void shade_block(struct tile_work *work, struct triangle_work *triangle, int x, int y,
                            uint64_t mask, bool is_explained)
{
    const struct rhw_draw_plan *const plan = &work->plan;
    if (!triangle->has_planes) {
        set_planes(work, triangle);
    }
    f32x8 z[RHW_BLOCK];
    // The block is set member by member: before an initializer gcc clears all of it, by a slow `rep stos`.
    struct block block;
    block.x = x;
    block.y = y;
    block.at = block_offset(work, &triangle->planes, x, y);
    block.z = z;
    block.leaves_triangle = leaves_triangle(triangle, &block.at);
    block.samples = NULL;
    if (plan->needs_depth || is_explained) {
        depth_rows(work, triangle, &block, mask, z);
        if (is_explained) {
            explain_covered(work, x, y, 0, mask, z);
        }
        if (plan->tests_early) {
            mask = test_depth(work, triangle, &block, mask);
        }
        if (is_explained) {
            explain_passed(work, x, y, 0, mask);
        }
        if (mask == 0) {
            return;
        }
    }
    if (plan->shading == RHW_SHADING_NONE) {
        return;
    }
    work->counters->fragments += (uint64_t)__builtin_popcountll(mask);
    if (plan->shading == RHW_SHADING_CONSTANT) {
        blend_constant(work, x, y, mask);
    } else {
        collect_block(work, triangle, &block, mask);
    }
}

static __attribute__((noinline)) void shade_plain_block(struct tile_work *work,
                                                        struct triangle_work *triangle, int x, int y,
                                                        uint64_t mask)
{
    shade_block(work, triangle, x, y, mask, false);
}

static __attribute__((noinline)) void shade_explained_block(struct tile_work *work,
                                                            struct triangle_work *triangle, int x, int y,
                                                            uint64_t mask)
{
    shade_block(work, triangle, x, y, mask, true);
}

// Draw a block. Work that asks for no number of the triangle is done here, and needs few registers.
RHW_INLINE void draw_block(struct tile_work *work, struct triangle_work *triangle, int x, int y,
                           uint64_t mask)
{
    const struct rhw_draw_plan *const plan = &work->plan;
    struct tile_depth *const depth = &work->scratch->depth;
    if (work->phase == RHW_PHASE_BACKWARDS) {
        mask = claim_backwards(depth, x, y, mask);
    } else if (plan->early_name == RHW_RULE_CLAIM) {
        mask &= block_bits(&depth->open[y], x);
    }
    if (mask == 0) {
        return;
    }
    // No number of the triangle is wanted.
    if (plan->shading == RHW_SHADING_CONSTANT && !plan->needs_depth) {
        work->counters->fragments += (uint64_t)__builtin_popcountll(mask);
        blend_constant(work, x, y, mask);
        return;
    }
    if (work->explained) {
        shade_explained_block(work, triangle, x, y, mask);
    } else {
        shade_plain_block(work, triangle, x, y, mask);
    }
}

// All ---------------------------------------------------------------------------------------------------

// Return true if what is known of blocks of the triangle's plane holds for the one at (x, y): its bit is set, and depth
// in it is the plane's depth.
static bool holds_for_block(const struct tile_work *work, const struct triangle_work *triangle,
                            unsigned known, int x, int y)
{
    if (!(known >> (x / RHW_BLOCK) & 1)) {
        return false;
    }
    const struct anchor_offset at = block_offset(work, &triangle->planes, x, y);
    return !leaves_triangle(triangle, &at);
}

static void draw_blocks(struct tile_work *work, struct triangle_work *triangle,
                        const struct coverage *coverage)
{
    const struct tile_rect rect = rect_of(work, triangle->t);
    const bool is_cut = work->is_scissored || triangle->t->flags & RHW_TRIANGLE_RECTANGLE;
    const unsigned columns = 0xffu << (rect.x0 / RHW_BLOCK) & 0xffu >> ((RHW_TILE - rect.x1) / RHW_BLOCK);
    for (int y = rect.y0 & -RHW_BLOCK; y < rect.y1; y += RHW_BLOCK) {
        const unsigned hidden = hidden_blocks(work, triangle, y);
        struct block_row row = {0, ~0u};
        if (coverage->count == 1) {
            row = block_row_of(&coverage->triangles[0], y);
        }
        for (unsigned left = columns & ~row.outside; left != 0; left &= left - 1) {
            const int column = __builtin_ctz(left), x = column * RHW_BLOCK;
            if (holds_for_block(work, triangle, hidden, x, y)) {
                continue;
            }
            uint64_t mask = row.crossed >> column & 1 ? coverage_mask(coverage, x, y) : ~(uint64_t)0;
            if (is_cut) {
                mask &= rect_mask(x, y, rect.x0, rect.y0, rect.x1, rect.y1);
            }
            if (mask != 0) {
                draw_block(work, triangle, x, y, mask);
            }
        }
    }
    finish_collected(work, triangle);
}

// Settled blocks ----------------------------------------------------------------------------------------

// Return true if the tile knows enough of its depth to draw a triangle by draw_whole_blocks, if the triangle's draw may
// be drawn by it.
static bool knows_ranges(const struct tile_work *work)
{
    // A draw tests this many triangles before a look at all of the tile's depth pays.
    enum { TRIANGLES_UNRANGED = 2 };
    struct tile_depth *const depth = &work->scratch->depth;
    if (work->plan.test != RHW_TEST_WHOLE_BLOCKS ||
        (!depth->has_ranges && depth->unranged++ < TRIANGLES_UNRANGED)) {
        return false;
    }
    if (!depth->has_ranges) {
        ranges_refresh(depth);
    }
    return true;
}

// Return the blocks among `wanted` in which stencil can be changed without a test.
static struct decided_blocks decided_blocks(struct tile_work *work, struct triangle_work *triangle,
                                            uint64_t wanted)
{
    const struct planes *const planes = &triangle->planes;
    if (!triangle->has_planes) {
        set_planes(work, triangle);
    }
    if (planes->kind != PLANES_LINEAR) {
        return (struct decided_blocks){0, 0};
    }
    if (triangle->clipped) {
        for (uint64_t left = wanted; left != 0; left &= left - 1) {
            const int n = __builtin_ctzll(left);
            const struct anchor_offset at =
                block_offset(work, planes, n % HIZ_BLOCKS * RHW_BLOCK, n / HIZ_BLOCKS * RHW_BLOCK);
            wanted &= ~((uint64_t)leaves_triangle(triangle, &at) << n);
        }
    }
    const struct decided_blocks decided = decide_blocks(
        &work->scratch->depth, work->plan.early.compare, plane_of(&planes->quantities, QUANTITY_Z),
        planes->anchor_x - work->x, planes->anchor_y - work->y, triangle->clamps_depth, wanted);
    return (struct decided_blocks){decided.passed & wanted, decided.failed & wanted};
}

// Return the covered pixels of a block, which is among the triangle's.
static uint64_t mask_of_block(const struct tile_work *work, const struct triangle_work *triangle,
                              const struct coverage *coverage, bool is_crossed, int x, int y)
{
    uint64_t mask = !is_crossed            ? ~(uint64_t)0
                    : coverage->count == 1 ? crossed_mask(&coverage->triangles[0], x, y)
                                           : coverage_mask(coverage, x, y);
    if (work->is_scissored || triangle->t->flags & RHW_TRIANGLE_RECTANGLE) {
        const struct tile_rect rect = rect_of(work, triangle->t);
        mask &= rect_mask(x, y, rect.x0, rect.y0, rect.x1, rect.y1);
    }
    return mask;
}

// Draw a triangle that leaves depth as it is and changes stencil by whether it passes the depth test. Nothing shades
// it, so there is nothing collected to end with.
static __attribute__((noinline)) void draw_whole_blocks(struct tile_work *work,
                                                        struct triangle_work *triangle,
                                                        const struct coverage *coverage)
{
    struct tile_depth *const depth = &work->scratch->depth;
    const struct rhw_stencil_rule *const face = &work->state->depth_stencil.face[face_of(triangle)];
    struct block_bits blocks = {~(uint64_t)0, ~(uint64_t)0};
    if (coverage->count == 1) {
        blocks = blocks_of(&coverage->triangles[0]);
    }
    const struct tile_rect rect = rect_of(work, triangle->t);
    blocks.inside &= blocks_of_rect(rect.x0, rect.y0, rect.x1, rect.y1);
    const struct decided_blocks decided = decided_blocks(work, triangle, blocks.inside);
    const uint64_t kept = (face->pass == RHW_STENCIL_KEEP ? decided.passed : 0) |
                          (face->depth_fail == RHW_STENCIL_KEEP ? decided.failed : 0);
    for (uint64_t left = blocks.inside & ~kept; left != 0; left &= left - 1) {
        const int n = __builtin_ctzll(left);
        const int x = n % HIZ_BLOCKS * RHW_BLOCK, y = n / HIZ_BLOCKS * RHW_BLOCK;
        const uint64_t mask = mask_of_block(work, triangle, coverage, blocks.crossed >> n & 1, x, y);
        if ((decided.passed | decided.failed) >> n & 1) {
            change_stencil_block(depth, x, y, mask, face,
                                 decided.passed >> n & 1 ? face->pass : face->depth_fail);
        } else if (mask != 0) {
            // Nothing is drawn backwards or claimed here, and the general path never comes here.
            shade_plain_block(work, triangle, x, y, mask);
        }
    }
}

// Draw a small triangle whose groups must be rows, or that is a sliver: 6 % fewer instructions for lines drawn as
// quads.
static void draw_by_spans(struct tile_work *work, struct triangle_work *triangle)
{
    begin_any(work, triangle, NULL);
    draw_span_blocks(work, triangle, draw_block);
    finish_collected(work, triangle);
}

static void draw_any(struct tile_work *work, struct triangle_work *triangle)
{
    struct coverage coverage;
    struct clipped_planes clipped;
    begin_any(work, triangle, &clipped);
    coverage_setup(&coverage, triangle->chunk, triangle->t, center_of_pixel(work->x, work->y));
    if (coverage.count == 0) {
        return;
    }
    if (covers_tile(&coverage) && !(triangle->t->flags & RHW_TRIANGLE_RECTANGLE)) {
        if (takes_whole_tile(work)) {
            set_planes(work, triangle);
            if (draw_whole_tile(work, triangle)) {
                return;
            }
        }
        if (takes_constant_tile(work)) {
            blend_constant_tile(work);
            end_whole_tile(work);
            return;
        }
    }
    if (knows_ranges(work)) {
        draw_whole_blocks(work, triangle, &coverage);
    } else {
        draw_blocks(work, triangle, &coverage);
    }
}

#endif
