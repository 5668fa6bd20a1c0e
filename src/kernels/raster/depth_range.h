// SPDX-License-Identifier: MIT
// Draws that leave depth as it is and change stencil by whether fragments pass the depth test, as shadow volumes do: of
// every block of 8×8 pixels the tile knows the least and the largest depth, and where all of a plane in it passes, or all
// of it fails, no pixel is tested. Where KEEP is what follows nothing is done at all: a fifth of the instructions of
// shadow_volumes.
#ifndef RHW_DEPTH_RANGE_H
#define RHW_DEPTH_RANGE_H

#include <math.h>

#include "../../simd_layout.h"
#include "full_test.h"
#include "plane.h"

// Looks at the tile's depth. A block with a NaN, which passes no ordering test, has every depth.
static __attribute__((noinline)) void ranges_refresh(struct tile_depth *depth)
{
    for (int y = 0; y < HIZ_BLOCKS; y++) {
        f8 least[HIZ_BLOCKS], most[HIZ_BLOCKS];
        for (int x = 0; x < HIZ_BLOCKS; x++) {
            const float *texels = depth_texels(depth, x * RHW_BLOCK, y * RHW_BLOCK);
            i8 ordered = i8_splat(-1);
            least[x] = f8_splat(INFINITY);
            most[x] = f8_splat(-INFINITY);
            for (int row = 0; row < RHW_BLOCK; row++) {
                const f8 stored = f8_load(texels + row * RHW_TILE);
                least[x] = f8_min(stored, least[x]);
                most[x] = f8_max(stored, most[x]);
                ordered &= rhw_equal(stored, stored);
            }
            least[x] = f8_select(ordered, least[x], f8_splat(-INFINITY));
            most[x] = f8_select(ordered, most[x], f8_splat(INFINITY));
        }
        f8_transpose(least);
        f8_transpose(most);
        for (int column = 1; column < RHW_BLOCK; column++) {
            least[0] = f8_min(least[column], least[0]);
            most[0] = f8_max(most[column], most[0]);
        }
        f8_store(&depth->range_least[y * HIZ_BLOCKS], least[0]);
        f8_store(&depth->range_most[y * HIZ_BLOCKS], most[0]);
    }
    depth->has_ranges = true;
}

// Of the blocks side by side, a bit for each whose fragments all pass the depth test, and all fail it.
struct settled_blocks {
    unsigned passed, failed;
};

// Those at row y of the tile, of a plane of depth; (anchor_x, anchor_y): the anchor in the tile. `clamps`: depth is kept
// within the viewport's range.
RHW_INLINE struct settled_blocks settle_blocks(const struct tile_depth *depth, enum rhw_compare compare,
                                               struct plane z, int anchor_x, int anchor_y, int y, bool clamps)
{
    const bool is_less = compare == RHW_COMPARE_LESS || compare == RHW_COMPARE_LESS_EQUAL;
    const int first_x = z.dx < 0 ? RHW_BLOCK - 1 : 0, first_y = z.dy < 0 ? RHW_BLOCK - 1 : 0;
    const i8 column = rhw_lane_index * RHW_BLOCK - anchor_x;
    const double row = y - anchor_y;
    f8 least = f8_from_d8(plane_value8(z, d8_from_i8(column + first_x), d8_splat(row + first_y)));
    f8 most = f8_from_d8(plane_value8(z, d8_from_i8(column + (RHW_BLOCK - 1 - first_x)),
                                      d8_splat(row + RHW_BLOCK - 1 - first_y)));
    if (clamps) {
        least = viewport_clamp(depth, least);
        most = viewport_clamp(depth, most);
    }
    if (depth->state->depth_steps != 0) { // which rounding does not cross
        least = rhw_saturate(least) - 2 * depth->state->depth_margin;
        most = rhw_saturate(most) + 2 * depth->state->depth_margin;
    }
    const unsigned nearer =
        i8_sign_bits(rhw_less(most, f8_load(&depth->range_least[y / RHW_BLOCK * HIZ_BLOCKS])));
    const unsigned farther =
        i8_sign_bits(rhw_less(f8_load(&depth->range_most[y / RHW_BLOCK * HIZ_BLOCKS]), least));
    return is_less ? (struct settled_blocks){nearer, farther} : (struct settled_blocks){farther, nearer};
}

// 8 bytes: 1 where a bit of `bits` is set, else 0.
RHW_INLINE uint64_t bytes_of_bits(unsigned bits)
{
    const uint64_t apart = bits * (uint64_t)0x0101010101010101 & 0x8040201008040201; // byte i has bit i alone
    return (apart + 0x7f7f7f7f7f7f7f7f) >> 7 & 0x0101010101010101;
}

// Counts up or down by one, wrapping, 8 bytes at a time and without carries between them: what shadow volumes do, in half
// of the instructions.
RHW_INLINE void count_stencil_block(uint8_t *stencil, uint64_t mask, bool up)
{
    const uint64_t high = 0x8080808080808080;
    for (int row = 0; row < RHW_BLOCK; row++) {
        const uint64_t ones = bytes_of_bits((unsigned)(mask >> (8 * row)) & 0xff);
        uint64_t bytes;
        memcpy(&bytes, stencil, sizeof bytes);
        bytes = up ? ((bytes & ~high) + ones) ^ (bytes & high) : ((bytes | high) - ones) ^ (~bytes & high);
        memcpy(stencil, &bytes, sizeof bytes);
        stencil += RHW_TILE;
    }
}

// Does an operation to the stencil of the pixels of the block at (x, y) that are set in `mask`.
static __attribute__((noinline)) void change_stencil_block(struct tile_depth *depth, int x, int y,
                                                           uint64_t mask, const struct rhw_stencil_rule *face,
                                                           enum rhw_stencil_operation operation)
{
    const bool up = operation == RHW_STENCIL_INCREMENT_WRAP, down = operation == RHW_STENCIL_DECREMENT_WRAP;
    if (face->write_mask == 0xff && (up || down)) {
        count_stencil_block(&depth->stencil[y * RHW_TILE + x], mask, up);
        return;
    }
    for (int row = 0; row < RHW_BLOCK; row++) {
        const unsigned bits = (unsigned)(mask >> (8 * row)) & 0xff;
        uint8_t *const stencil = &depth->stencil[(y + row) * RHW_TILE + x];
        if (bits != 0) {
            struct tested_pixels pixels = {.stencil = i8_load_bytes(stencil)};
            change_stencil(&pixels, face, operation, i8_from_bits(bits));
            const uint64_t bytes = i8_to_bytes(pixels.stencil);
            memcpy(stencil, &bytes, sizeof bytes);
        }
    }
}

#endif
