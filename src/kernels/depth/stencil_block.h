// SPDX-License-Identifier: MIT
// The stencil test of a block of 8×8 pixels works by masks, a bit for each pixel: stencil and depth are compared row by
// row, and what follows is done to all of the block at once. It serves where no depth has to be rounded to its steps.
// This is so if depth is a float. With 24 bits it is so for depths above 1/2: the farther half, into which perspective
// puts nearly everything if depth is not reversed. The masks save a fifth of the instructions of shadow_volumes.
#ifndef RHW_STENCIL_BLOCK_H
#define RHW_STENCIL_BLOCK_H

#include "stencil_test.h"

// Stencil ----------------------------------------------------------------------------------------------

// Apply an operation to the stencil of the pixels of the block at (x, y) that are set in `mask`.
static __attribute__((noinline)) void change_stencil_block(struct tile_depth *depth, int x, int y,
                                                           uint64_t mask, const struct rhw_stencil_rule *face,
                                                           enum rhw_stencil_operation operation)
{
    if (mask == 0 || operation == RHW_STENCIL_KEEP) {
        return;
    }
    const bool up = operation == RHW_STENCIL_INCREMENT_WRAP, down = operation == RHW_STENCIL_DECREMENT_WRAP;
    if (face->write_mask == 0xff && (up || down)) {
        // Shadow volumes take this path.
        count_bytes_of_rows(&depth->stencil[y * RHW_TILE + x], RHW_TILE, mask, up);
        return;
    }
    for (int row = 0; row < RHW_BLOCK; row++) {
        const unsigned bits = (unsigned)(mask >> (8 * row)) & 0xff;
        uint8_t *const stencil = &depth->stencil[(y + row) * RHW_TILE + x];
        if (bits != 0) {
            struct tested_pixels pixels = {.stencil = i32x8_load_bytes(stencil)};
            change_stencil(&pixels, face, operation, i32x8_from_bits(bits));
            const uint64_t bytes = i32x8_to_bytes(pixels.stencil);
            memcpy(stencil, &bytes, sizeof bytes);
        }
    }
}

RHW_INLINE uint64_t compare_stencil_rows(const uint8_t *stencil, const struct rhw_stencil_rule *face,
                                         enum rhw_compare compare)
{
    i32x8 pass[RHW_BLOCK];
    for (int row = 0; row < RHW_BLOCK; row++) {
        pass[row] = stencil_passes(face, compare, i32x8_load_bytes(stencil + row * RHW_TILE));
    }
    return i32x8_sign_bits_of_rows(pass);
}

// Return the pixels of the block at (x, y) whose stencil passes, whatever is drawn there.
static __attribute__((noinline)) uint64_t compare_stencil_block(const struct tile_depth *depth, int x, int y,
                                                                const struct rhw_stencil_rule *face)
{
    const uint8_t *const stencil = &depth->stencil[y * RHW_TILE + x];
    return face->compare == RHW_COMPARE_EQUAL ? compare_stencil_rows(stencil, face, RHW_COMPARE_EQUAL)
                                              : compare_stencil_rows(stencil, face, face->compare);
}

// All --------------------------------------------------------------------------------------------------

// Return true if rounding leaves all depths of a block as they are.
RHW_INLINE bool keeps_depths(const struct rhw_depth_stencil_state *state, const f32x8 z[RHW_BLOCK])
{
    i32x8 kept = i32x8_splat(-1);
    for (int row = 0; row < RHW_BLOCK; row++) {
        kept &= rhw_less(f32x8_splat(state->kept_above), z[row]);
    }
    return i32x8_sign_bits(kept) == 0xff;
}

RHW_INLINE uint64_t compare_depth_rows(const float *texels, const f32x8 z[RHW_BLOCK],
                                       enum rhw_compare compare)
{
    i32x8 pass[RHW_BLOCK];
    for (int row = 0; row < RHW_BLOCK; row++) {
        pass[row] = compare_lanes(compare, z[row], f32x8_load(texels + row * RHW_TILE));
    }
    return i32x8_sign_bits_of_rows(pass);
}

// Return the pixels that pass the depth test. Their depth becomes that of the fragments if the rule writes it. The
// usual rules are constants of loops of their own.
RHW_INLINE uint64_t test_depth_rows(const struct block_pixels *block, const struct rhw_depth_rule rule)
{
    const float *const texels = depth_texels(block->depth, block->x, block->y);
    if (rule.write) {
        return rule.compare == RHW_COMPARE_LESS ? test_block(block, rhw_named_rules[RHW_RULE_LESS])
                                                : test_block(block, rule);
    }
    switch (rule.compare) {
    case RHW_COMPARE_LESS: return block->mask & compare_depth_rows(texels, block->z, RHW_COMPARE_LESS);
    case RHW_COMPARE_EQUAL: return block->mask & compare_depth_rows(texels, block->z, RHW_COMPARE_EQUAL);
    default: return block->mask & compare_depth_rows(texels, block->z, rule.compare);
    }
}

// Test the pixels of a block before shading. Rounding keeps the block's depths, and nothing but stencil and depth is
// tested. `face` is 0 for the front. No depth has to be held to 1: depths of a triangle that may leave the viewport's
// range have been held to it (depth_rows).
static __attribute__((noinline)) uint64_t test_block_masks(const struct block_pixels *block,
                                                           const struct rhw_depth_rule rule, int face)
{
    struct tile_depth *const depth = block->depth;
    const struct rhw_depth_stencil_state *const state = depth->state;
    const struct rhw_stencil_rule *const rules = &state->face[face];
    const int x = block->x, y = block->y;
    uint64_t unfailed = block->mask;
    if (rules->compare != RHW_COMPARE_ALWAYS) {
        unfailed &= compare_stencil_block(depth, x, y, rules);
        change_stencil_block(depth, x, y, block->mask & ~unfailed, rules, rules->fail);
    }
    const struct block_pixels pixels = {depth, block->z, x, y, unfailed};
    const uint64_t passed = test_depth_rows(&pixels, rule);
    if (state->tests_stencil && rules->depth_fail != RHW_STENCIL_KEEP) {
        change_stencil_block(depth, x, y, unfailed & ~passed, rules, rules->depth_fail);
    }
    if (state->tests_stencil && rules->pass != RHW_STENCIL_KEEP) {
        change_stencil_block(depth, x, y, passed, rules, rules->pass);
    }
    count_passed(depth, passed);
    return passed;
}

// Test the pixels of a block before shading, by the fastest path that is open to them.
RHW_INLINE uint64_t test_block_early_stencil(const struct block_pixels *block,
                                             const struct rhw_draw_plan *plan, int face)
{
    return rhw_test_has_masks(plan->test) && keeps_depths(block->depth->state, block->z)
               ? test_block_masks(block, plan->early, face)
               : test_block_stencil(block, plan->early, face);
}

#endif
