// SPDX-License-Identifier: MIT
// The stencil test of a fragment: depth bounds, stencil and depth, in this order (Vulkan 1.3 §27.11 to §27.14), and
// depth in steps of a UNORM format. Draws that need none of these take depth_test.h alone.
#ifndef RHW_STENCIL_TEST_H
#define RHW_STENCIL_TEST_H

#include "pipeline/depth_stencil.h"
#include "kernels/texel/texel_codec.h"
#include "depth_test.h"

RHW_INLINE i32x8 stencil_result(enum rhw_stencil_operation operation, i32x8 stencil, int32_t reference)
{
    const i32x8 one = i32x8_splat(1), byte = i32x8_splat(0xff);
    switch (operation) {
    case RHW_STENCIL_KEEP: return stencil;
    case RHW_STENCIL_ZERO: return i32x8_splat(0);
    case RHW_STENCIL_REPLACE: return i32x8_splat(reference);
    case RHW_STENCIL_INCREMENT_CLAMP: return i32x8_min(stencil + one, byte);
    case RHW_STENCIL_DECREMENT_CLAMP: return i32x8_max(stencil - one, i32x8_splat(0));
    case RHW_STENCIL_INVERT: return ~stencil & byte;
    case RHW_STENCIL_INCREMENT_WRAP: return (stencil + one) & byte;
    case RHW_STENCIL_DECREMENT_WRAP: return (stencil - one) & byte;
    }
    return stencil;
}

// Return the lanes whose stencil passes. `compare` is the comparison of the face; it may be a constant.
RHW_INLINE i32x8 stencil_passes(const struct rhw_stencil_rule *face, enum rhw_compare compare, i32x8 stencil)
{
    const i32x8 read = i32x8_splat(face->read_mask);
    return compare_lanes(compare, rhw_float_from_int(i32x8_splat(face->reference) & read),
                         rhw_float_from_int(stencil & read));
}

// Stencil and depth of 8 pixels, and what the test knows of the fragments over them.
struct tested_pixels {
    f32x8 depth;
    i32x8 stencil;
    bool changes_stencil;
};

RHW_INLINE void change_stencil(struct tested_pixels *pixels, const struct rhw_stencil_rule *face,
                               enum rhw_stencil_operation operation, i32x8 lanes)
{
    if (operation != RHW_STENCIL_KEEP && rhw_any(lanes)) {
        const i32x8 written = lanes & i32x8_splat(face->write_mask);
        const i32x8 result = stencil_result(operation, pixels->stencil, face->reference);
        pixels->stencil = (pixels->stencil & ~written) | (result & written);
        pixels->changes_stencil = true;
    }
}

RHW_INLINE f32x8 round_depth(f32x8 z, double steps)
{
    return depth_from_steps(steps_of_depth(z, steps), steps);
}

// Test the fragments of depth z in the lanes of `live`, and change their pixels. Return the lanes that pass. Depth is
// rounded to its steps, by a division in double, only if rounding decides: if depth is near what the pixel has, or is
// written. What is further away than the margin lies on the same side without rounding.
RHW_INLINE i32x8 test_pixels(struct tested_pixels *pixels, const struct rhw_depth_stencil_state *state,
                             const struct rhw_stencil_rule *face, const struct rhw_depth_rule rule, f32x8 z,
                             i32x8 live, unsigned open)
{
    bool is_rounded = state->depth_steps == 0;
    if (!is_rounded) {
        z = rhw_saturate(z);
        const i32x8 near = rhw_less_equal(rhw_abs(z - pixels->depth), f32x8_splat(state->depth_margin));
        if (rhw_any(live & near)) {
            z = round_depth(z, state->depth_steps);
            is_rounded = true;
        }
    }
    if (state->tests_bounds) {
        live &= rhw_less_equal(f32x8_splat(state->bounds_least), pixels->depth) &
                rhw_less_equal(pixels->depth, f32x8_splat(state->bounds_most));
    }
    i32x8 unfailed = live;
    if (face->compare != RHW_COMPARE_ALWAYS) {
        unfailed &= stencil_passes(face, face->compare, pixels->stencil);
    }
    const i32x8 pass = unfailed & rule_passes(rule, z, pixels->depth, open);
    // The three operations change disjoint lanes.
    if (state->tests_stencil) {
        change_stencil(pixels, face, face->fail, live & ~unfailed);
        change_stencil(pixels, face, face->depth_fail, unfailed & ~pass);
        change_stencil(pixels, face, face->pass, pass);
    }
    if (rule.write && rhw_any(pass)) {
        pixels->depth =
            f32x8_select(pass, is_rounded ? z : round_depth(z, state->depth_steps), pixels->depth);
    }
    return pass;
}

// Count the pixels that passed, if a query asks for it here.
RHW_INLINE void count_passed(struct tile_depth *depth, uint64_t passed)
{
    if (depth->state->counts_by_test) {
        depth->passed += (uint64_t)__builtin_popcountll(passed);
    }
}

// Test the fragments of a row from (x, y) on. Return the lanes that pass.
RHW_INLINE i32x8 test_row_stencil(struct tile_depth *depth, int x, int y,
                                  const struct rhw_depth_stencil_state *state,
                                  const struct rhw_stencil_rule *face, const struct rhw_depth_rule rule,
                                  f32x8 z, i32x8 live)
{
    float *const texels = depth_texels(depth, x, y);
    uint8_t *const stencil = &depth->stencil[y * RHW_TILE + x];
    struct tested_pixels pixels = {f32x8_load(texels), i32x8_load_bytes(stencil), false};
    const i32x8 pass = test_pixels(&pixels, state, face, rule, z, live, open_row(depth, x, y, rule));
    if (rule.write) {
        f32x8_store(texels, pixels.depth);
    }
    if (pixels.changes_stencil) {
        const uint64_t bytes = i32x8_to_bytes(pixels.stencil);
        memcpy(stencil, &bytes, sizeof bytes);
    }
    return pass;
}

// Test the pixels of a block before shading. `face` is 0 for the front.
RHW_INLINE uint64_t test_rows_stencil(const struct block_pixels *block, const struct rhw_depth_rule rule,
                                      int face)
{
    struct tile_depth *const depth = block->depth;
    // These are copies, which stay in registers: the compiler cannot know that the stores of rows leave the originals
    // as they are.
    const struct rhw_depth_stencil_state state = *depth->state;
    const struct rhw_stencil_rule rules = depth->state->face[face];
    uint64_t passed = 0;
    for (int row = 0; row < RHW_BLOCK; row++) {
        const unsigned bits = (unsigned)(block->mask >> (8 * row)) & 0xff;
        if (bits != 0) {
            const i32x8 pass = test_row_stencil(depth, block->x, block->y + row, &state, &rules, rule,
                                                block->z[row], i32x8_from_bits(bits));
            passed |= (uint64_t)i32x8_sign_bits(pass) << (8 * row);
        }
    }
    count_passed(depth, passed);
    return settle_block(depth, block->x, block->y, passed, rule);
}

// Test the pixels of a block before shading by a loop in which the usual comparisons are constants.
static __attribute__((noinline)) uint64_t test_block_stencil(const struct block_pixels *block,
                                                             const struct rhw_depth_rule rule, int face)
{
    struct rhw_depth_rule named = rule;
    switch (rule.compare) {
    case RHW_COMPARE_LESS: named.compare = RHW_COMPARE_LESS; return test_rows_stencil(block, named, face);
    case RHW_COMPARE_EQUAL: named.compare = RHW_COMPARE_EQUAL; return test_rows_stencil(block, named, face);
    case RHW_COMPARE_LESS_EQUAL:
        named.compare = RHW_COMPARE_LESS_EQUAL;
        return test_rows_stencil(block, named, face);
    default: return test_rows_stencil(block, rule, face);
    }
}

// Test the fragments of a row that are set in `bits` after shading. Fragments in `back` face away.
static __attribute__((noinline)) unsigned test_row_late_stencil(struct tile_depth *depth, int x, int y,
                                                                f32x8 z, unsigned bits, unsigned back,
                                                                const struct rhw_depth_rule rule)
{
    i32x8 pass = i32x8_splat(0);
    for (int face = 0; face < 2; face++) {
        const unsigned facing = bits & (face == 0 ? ~back : back);
        if (facing != 0) {
            pass |= test_row_stencil(depth, x, y, depth->state, &depth->state->face[face], rule, z,
                                     i32x8_from_bits(facing));
        }
    }
    const unsigned passed = i32x8_sign_bits(pass);
    count_passed(depth, passed);
    if (rule.open == RHW_OPEN_CLOSE) {
        depth->open[y] &= ~((uint64_t)passed << x);
    }
    return passed;
}

// Test fragments of 8 texels after shading. They lie anywhere in the tile, and no two of them lie on one texel.
static __attribute__((noinline)) unsigned test_texels_late_stencil(struct tile_depth *depth,
                                                                   const int32_t texel[8], f32x8 z,
                                                                   unsigned bits, unsigned back,
                                                                   const struct rhw_depth_rule rule)
{
    float depths[8];
    int32_t stencils[8];
    unsigned open = 0;
    for (int i = 0; i < 8; i++) {
        depths[i] = depth->texels[texel[i]];
        stencils[i] = depth->stencil[texel[i]];
        open |= (unsigned)(depth->open[texel[i] / RHW_TILE] >> texel[i] % RHW_TILE & 1) << i;
    }
    struct tested_pixels pixels = {f32x8_load(depths), i32x8_load(stencils), false};
    const i32x8 front = test_pixels(&pixels, depth->state, &depth->state->face[0], rule, z,
                                    i32x8_from_bits(bits & ~back), open);
    const i32x8 other = test_pixels(&pixels, depth->state, &depth->state->face[1], rule, z,
                                    i32x8_from_bits(bits & back), open);
    const unsigned passed = i32x8_sign_bits(front | other);
    count_passed(depth, passed);
    f32x8_store(depths, pixels.depth);
    i32x8_store(stencils, pixels.stencil);
    for (unsigned left = bits; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        depth->texels[texel[lane]] = depths[lane];
        depth->stencil[texel[lane]] = (uint8_t)stencils[lane];
        if (rule.open == RHW_OPEN_CLOSE && passed >> lane & 1) {
            depth->open[texel[lane] / RHW_TILE] &= ~((uint64_t)1 << texel[lane] % RHW_TILE);
        }
    }
    return passed;
}

#endif
