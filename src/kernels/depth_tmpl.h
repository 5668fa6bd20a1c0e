// SPDX-License-Identifier: MIT
// What of 8 fragments is seen: depth tests against a tile's depth, and pixels that are still open. Template: compiled
// once per instruction set.
//
// Draws that any order would draw alike (hidden_surface.h) can be drawn in two phases, so that only what is seen is shaded:
// the first leaves the least depth of all their triangles (with LESS; GREATER is its mirror image), the second shades
// the fragments that have it. Of fragments with equal depth the first in submission order wins with LESS, the last with
// LESS_EQUAL. The last needs no care: each is shaded and overwrites the one before. For the first, a pixel is `open`
// from when the first phase writes it until its fragment is shaded; depth that was there before, or that a fragment
// function which discards wrote, is nobody's to match.
//
// Without a depth test the last fragment wins: the triangles are drawn backwards, and a pixel is open until it is
// taken.

#include "work_tmpl.h"

// Lanes for which `z compare old` holds.
RHW_INLINE i8 depth_passes(enum rhw_compare compare, f8 z, f8 old)
{
    switch (compare) {
    case RHW_COMPARE_NEVER: return i8_splat(0);
    case RHW_COMPARE_LESS: return rhw_less(z, old);
    case RHW_COMPARE_EQUAL: return rhw_equal(z, old);
    case RHW_COMPARE_LESS_EQUAL: return rhw_less_equal(z, old);
    case RHW_COMPARE_GREATER: return rhw_less(old, z);
    case RHW_COMPARE_NOT_EQUAL: return ~rhw_equal(z, old);
    case RHW_COMPARE_GREATER_EQUAL: return rhw_less_equal(old, z);
    default: return i8_splat(-1);
    }
}

static f8 viewport_clamp(const struct rhw_draw_state *state, f8 z)
{
    return f8_min(f8_max(z, f8_splat(state->depth_least)), f8_splat(state->depth_most));
}

static float *stored_depth(const struct tile_work *work, int x, int y)
{
    return &work->scratch->depth[y * RHW_TILE + x];
}

static bool tests_early(const struct tile_work *work)
{
    return work->depth_mode == DEPTH_EARLY || work->depth_mode == DEPTH_EARLY_REJECT;
}

// What enum common_rule names.
static const struct depth_rule common_rules[RULE_OTHER] = {
    [RULE_LESS] = {RHW_COMPARE_LESS, true, OPEN_IGNORED},
    [RULE_GREATER] = {RHW_COMPARE_GREATER, true, OPEN_IGNORED},
    [RULE_MARK_LESS] = {RHW_COMPARE_LESS, true, OPEN_MARK},
    [RULE_MARK_GREATER] = {RHW_COMPARE_GREATER, true, OPEN_MARK},
    [RULE_TAKE] = {RHW_COMPARE_EQUAL, false, OPEN_TAKE},
};

static enum common_rule common_rule(const struct depth_rule rule)
{
    for (int i = 0; i < RULE_OTHER; i++) {
        const struct depth_rule common = common_rules[i];
        if (rule.compare == common.compare && rule.write == common.write && rule.open == common.open) {
            return (enum common_rule)i;
        }
    }
    return RULE_OTHER;
}

RHW_INLINE i8 passes(const struct depth_rule rule, f8 z, f8 stored, unsigned open)
{
    i8 pass = depth_passes(rule.compare, z, stored);
    if (rule.open >= OPEN_TRY) {
        pass |= depth_passes(RHW_COMPARE_EQUAL, z, stored) & i8_from_bits(open & 0xff);
    }
    return pass;
}

// Of a bit per pixel by row, those of the block at x in 8 rows: bit 8·row + column.
RHW_INLINE uint64_t block_bits(const uint64_t rows[RHW_BLOCK], int x)
{
    const ul4 byte = {0xff, 0xff, 0xff, 0xff}, upper = {0, 8, 16, 24}, lower = {32, 40, 48, 56};
    const ul4 bits = (ul4_load(rows) >> x & byte) << upper | (ul4_load(rows + 4) >> x & byte) << lower;
    return bits[0] | bits[1] | bits[2] | bits[3];
}

// The other way round: sets or clears them.
RHW_INLINE void change_block(uint64_t rows[RHW_BLOCK], int x, uint64_t bits, bool set)
{
    const ul4 byte = {0xff, 0xff, 0xff, 0xff}, upper = {0, 8, 16, 24}, lower = {32, 40, 48, 56};
    const ul4 all = {bits, bits, bits, bits};
    const ul4 first = (all >> upper & byte) << x, second = (all >> lower & byte) << x;
    const ul4 old_first = ul4_load(rows), old_second = ul4_load(rows + 4);
    ul4_store(rows, set ? old_first | first : old_first & ~first);
    ul4_store(rows + 4, set ? old_second | second : old_second & ~second);
}

// Of the pixels of a block set in `mask`, those that are open; they are not open any more.
static uint64_t take_block(struct tile_work *work, int x, int y, uint64_t mask)
{
    uint64_t *const open = &work->scratch->open[y];
    const uint64_t taken = mask & block_bits(open, x);
    change_block(open, x, taken, false);
    return taken;
}

// Tests the fragments of 8 texels in a row in the lanes of `live`, and writes their depth; returns those that pass.
// Bit i of `open`: texel i is open. `rule` is a constant where a call names it. Before shading settle_block has to
// follow.
RHW_INLINE i8 test_lanes(float *texels, f8 z, i8 live, unsigned open, const struct depth_rule rule)
{
    const f8 stored = f8_load(texels);
    const i8 pass = live & passes(rule, z, stored, open);
    if (rule.write) {
        f8_store(texels, f8_select(pass, z, stored));
    }
    return pass;
}

// The open pixels of a row from x on, where a test has to know them.
RHW_INLINE unsigned open_row(const struct tile_work *work, int x, int y, const struct depth_rule rule)
{
    return rule.open >= OPEN_TRY ? (unsigned)(work->scratch->open[y] >> x) : 0;
}

// What a test does to the open pixels of a block whose pixels `passed` passed it; returns those that go on.
RHW_INLINE uint64_t settle_block(struct tile_work *work, int x, int y, uint64_t passed,
                                 const struct depth_rule rule)
{
    if (rule.open == OPEN_TAKE) {
        return passed ? take_block(work, x, y, passed) : 0;
    }
    if (rule.open == OPEN_MARK && passed) {
        change_block(&work->scratch->open[y], x, passed, true);
        work->hit = true;
    }
    return passed;
}

// Tests the fragments of a row that are set in `bits` after shading.
static unsigned test_row(struct tile_work *work, int x, int y, f8 z, unsigned bits,
                         const struct depth_rule rule)
{
    const unsigned passed = i8_sign_bits(
        test_lanes(stored_depth(work, x, y), z, i8_from_bits(bits), open_row(work, x, y, rule), rule));
    if (rule.open == OPEN_CLOSE) {
        work->scratch->open[y] &= ~((uint64_t)passed << x);
    }
    return passed;
}

// The same with 8 texels of the tile that lie anywhere.
static unsigned test_texels(struct tile_work *work, const int32_t at[8], f8 z, unsigned bits,
                            const struct depth_rule rule)
{
    struct rhw_tile_scratch *const scratch = work->scratch;
    float stored[8];
    unsigned open = 0;
    for (int i = 0; i < 8; i++) {
        stored[i] = scratch->depth[at[i]];
        open |= (unsigned)(scratch->open[at[i] / RHW_TILE] >> at[i] % RHW_TILE & 1) << i;
    }
    const unsigned passed = i8_sign_bits(i8_from_bits(bits) & passes(rule, z, f8_load(stored), open));
    float depth[8];
    f8_store(depth, z);
    for (unsigned left = passed; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        if (rule.write) {
            scratch->depth[at[lane]] = depth[lane];
        }
        if (rule.open == OPEN_CLOSE) {
            scratch->open[at[lane] / RHW_TILE] &= ~((uint64_t)1 << at[lane] % RHW_TILE);
        }
    }
    return passed;
}
