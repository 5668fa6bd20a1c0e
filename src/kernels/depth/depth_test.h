// SPDX-License-Identifier: MIT
// The depth test compares fragments with the tile's depth: fragments of a row, of a block of 8×8 pixels, or from
// anywhere in the tile. What a test has to do with open pixels is part of its rule. If `rule` is a constant, its
// branches are constants too: enum rhw_rule_name says which rules have loops of their own.
#ifndef RHW_DEPTH_TEST_H
#define RHW_DEPTH_TEST_H

#include "base/compare.h"
#include "draw/draw_plan.h"
#include "base/simd_layout.h"
#include "open_pixels.h"
#include "tile_depth.h"

// Return depth kept within the viewport's range.
RHW_INLINE f32x8 viewport_clamp(const struct tile_depth *depth, f32x8 z)
{
    return f32x8_min(f32x8_max(z, f32x8_splat(depth->least)), f32x8_splat(depth->most));
}

RHW_INLINE float *depth_texels(struct tile_depth *depth, int x, int y)
{
    return &depth->texels[y * RHW_TILE + x];
}

// Return the lanes that pass. Bit i of `open` says that the pixel of lane i is open.
RHW_INLINE i32x8 rule_passes(const struct rhw_depth_rule rule, f32x8 z, f32x8 stored, unsigned open)
{
    i32x8 pass = compare_lanes(rule.compare, z, stored);
    if (rule.open >= RHW_OPEN_TRY) {
        pass |= compare_lanes(RHW_COMPARE_EQUAL, z, stored) & i32x8_from_bits(open & 0xff);
    }
    return pass;
}

// Return the open pixels of a row from x on, if a test has to know them.
RHW_INLINE unsigned open_row(const struct tile_depth *depth, int x, int y, const struct rhw_depth_rule rule)
{
    return rule.open >= RHW_OPEN_TRY ? (unsigned)(depth->open[y] >> x) : 0;
}

// Test the fragments of 8 texels in a row in the lanes of `live`, and write their depth. Return the lanes that pass.
// `open` is what open_row returns. Before shading, settle_block has to follow.
RHW_INLINE i32x8 test_lanes(float *texels, f32x8 z, i32x8 live, unsigned open,
                            const struct rhw_depth_rule rule)
{
    const f32x8 stored = f32x8_load(texels);
    const i32x8 pass = live & rule_passes(rule, z, stored, open);
    if (rule.write) {
        f32x8_store(texels, f32x8_select(pass, z, stored));
    }
    return pass;
}

// Test a fragment before shading, and change the open bit of its pixel as settle_block changes those of a block. Return
// true if the fragment goes on to be shaded.
RHW_INLINE bool test_texel_early(struct tile_depth *depth, int texel, float z,
                                 const struct rhw_depth_rule rule)
{
    const float stored = depth->texels[texel];
    uint64_t *const row = &depth->open[texel / RHW_TILE];
    const uint64_t pixel = (uint64_t)1 << texel % RHW_TILE;
    const bool passes = compare_numbers(rule.compare, z, stored) ||
                        (rule.open >= RHW_OPEN_TRY && z == stored && *row & pixel);
    if (!passes || (rule.open == RHW_OPEN_CLAIM && !(*row & pixel))) {
        return false;
    }
    if (rule.write) {
        depth->texels[texel] = z;
    }
    if (rule.open == RHW_OPEN_CLAIM) {
        *row &= ~pixel;
    } else if (rule.open == RHW_OPEN_MARK) {
        *row |= pixel;
        depth->marked = true;
    }
    return true;
}

// Change the open pixels of the block at (x, y), of which the pixels `passed` have passed a test. Return the pixels
// that go on to be shaded.
RHW_INLINE uint64_t settle_block(struct tile_depth *depth, int x, int y, uint64_t passed,
                                 const struct rhw_depth_rule rule)
{
    if (rule.open == RHW_OPEN_CLAIM) {
        return passed ? claim_block(&depth->open[y], x, passed) : 0;
    }
    if (rule.open == RHW_OPEN_MARK && passed) {
        change_block(&depth->open[y], x, passed, BITS_SET);
        depth->marked = true;
    }
    return passed;
}

enum block_mask { MASK_PART, MASK_WHOLE }; // MASK_WHOLE: every pixel is set

// The pixels of the block at (x, y) that are set in `mask`, with depths `z`.
struct block_pixels {
    struct tile_depth *depth;
    const f32x8 *z; // depths of the rows
    int x, y;
    uint64_t mask;
};

// Test the pixels of a block. Return the pixels that pass.
RHW_INLINE uint64_t test_rows(const struct block_pixels *block, const struct rhw_depth_rule rule,
                              enum block_mask which)
{
    float *texels = depth_texels(block->depth, block->x, block->y);
    uint64_t passed = 0;
    for (int row = 0; row < RHW_BLOCK; row++) {
        const i32x8 live = which == MASK_WHOLE ? i32x8_splat(-1)
                                               : i32x8_from_bits((unsigned)(block->mask >> (8 * row)) & 0xff);
        const unsigned open = open_row(block->depth, block->x, block->y + row, rule);
        const i32x8 pass = test_lanes(texels, block->z[row], live, open, rule);
        passed |= (uint64_t)i32x8_sign_bits(pass) << (8 * row);
        texels += RHW_TILE;
    }
    return settle_block(block->depth, block->x, block->y, passed, rule);
}

RHW_INLINE uint64_t test_block(const void *pixels, const struct rhw_depth_rule rule)
{
    const struct block_pixels *const block = pixels;
    return block->mask == ~(uint64_t)0 ? test_rows(block, rule, MASK_WHOLE)
                                       : test_rows(block, rule, MASK_PART);
}

// A test of pixels before shading. The pixels are of a kind that the test knows; `rule` is a constant if it has a name.
typedef uint64_t early_test_function(const void *pixels, const struct rhw_depth_rule rule);

// Test pixels by the draw's rule before shading. Return the pixels that pass.
RHW_INLINE uint64_t test_early(const struct rhw_draw_plan *plan, early_test_function *test,
                               const void *pixels)
{
    switch (plan->early_name) {
    case RHW_RULE_LESS: return test(pixels, rhw_named_rules[RHW_RULE_LESS]);
    case RHW_RULE_GREATER: return test(pixels, rhw_named_rules[RHW_RULE_GREATER]);
    case RHW_RULE_MARK_LESS: return test(pixels, rhw_named_rules[RHW_RULE_MARK_LESS]);
    case RHW_RULE_MARK_GREATER: return test(pixels, rhw_named_rules[RHW_RULE_MARK_GREATER]);
    case RHW_RULE_CLAIM: return test(pixels, rhw_named_rules[RHW_RULE_CLAIM]);
    default: return test(pixels, plan->early);
    }
}

// Test the pixels of the block at (x, y) that are set in `mask`, with depths `z`, before shading.
RHW_INLINE uint64_t test_block_early(struct tile_depth *depth, const f32x8 z[RHW_BLOCK], int x, int y,
                                     uint64_t mask, const struct rhw_draw_plan *plan)
{
    const struct block_pixels block = {depth, z, x, y, mask};
    return test_early(plan, test_block, &block);
}

// Test the fragments of a row that are set in `bits` after shading.
RHW_INLINE unsigned test_row_late(struct tile_depth *depth, int x, int y, f32x8 z, unsigned bits,
                                  const struct rhw_depth_rule rule)
{
    const unsigned passed = i32x8_sign_bits(
        test_lanes(depth_texels(depth, x, y), z, i32x8_from_bits(bits), open_row(depth, x, y, rule), rule));
    if (rule.open == RHW_OPEN_CLOSE) {
        depth->open[y] &= ~((uint64_t)passed << x);
    }
    return passed;
}

// Test fragments of 8 texels that lie anywhere in the tile after shading.
static unsigned test_texels_late(struct tile_depth *depth, const int32_t texel[8], f32x8 z, unsigned bits,
                                 const struct rhw_depth_rule rule)
{
    unsigned open = 0;
    for (int i = 0; i < 8 && rule.open >= RHW_OPEN_TRY; i++) {
        open |= (unsigned)(depth->open[texel[i] / RHW_TILE] >> texel[i] % RHW_TILE & 1) << i;
    }
    // The vector is not read back from memory: see gather_texels.
    const f32x8 stored = (f32x8)i32x8_gather(depth->texels, i32x8_load(texel));
    const unsigned passed = i32x8_sign_bits(i32x8_from_bits(bits) & rule_passes(rule, z, stored, open));
    float lanes[8];
    f32x8_store(lanes, z);
    for (unsigned left = passed; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        if (rule.write) {
            depth->texels[texel[lane]] = lanes[lane];
        }
        if (rule.open == RHW_OPEN_CLOSE) {
            depth->open[texel[lane] / RHW_TILE] &= ~((uint64_t)1 << texel[lane] % RHW_TILE);
        }
    }
    return passed;
}

// Claim pixels of the block at (x, y) that are set in `mask`, when triangles are drawn backwards. Return the pixels
// that no triangle after this one covers.
static uint64_t claim_backwards(struct tile_depth *depth, int x, int y, uint64_t mask)
{
    const uint64_t claimed = claim_block(&depth->open[y], x, mask);
    depth->open_count -= __builtin_popcountll(claimed);
    return claimed;
}

#endif
