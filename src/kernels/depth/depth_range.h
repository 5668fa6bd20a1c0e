// SPDX-License-Identifier: MIT
// Some draws leave depth as it is and change stencil by whether fragments pass the depth test, as shadow volumes do.
// The tile knows the least and the largest depth of every block of 8×8 pixels. If all of a plane of depth passes in a
// block, or all of it fails, no pixel is tested. If the operation that follows is KEEP, nothing is done at all: this
// saves a fifth of the instructions of shadow_volumes.
#ifndef RHW_DEPTH_RANGE_H
#define RHW_DEPTH_RANGE_H

#include <math.h>

#include "base/simd_layout.h"
#include "stencil_test.h"
#include "kernels/raster/plane.h"

// Look at the tile's depth anew. A block with a NaN, which passes no ordering test, gets the range of every depth.
static __attribute__((noinline)) void ranges_refresh(struct tile_depth *depth)
{
    for (int y = 0; y < HIZ_BLOCKS; y++) {
        f32x8 least[HIZ_BLOCKS], most[HIZ_BLOCKS];
        for (int x = 0; x < HIZ_BLOCKS; x++) {
            const float *texels = depth_texels(depth, x * RHW_BLOCK, y * RHW_BLOCK);
            i32x8 ordered = i32x8_splat(-1);
            least[x] = f32x8_splat(INFINITY);
            most[x] = f32x8_splat(-INFINITY);
            for (int row = 0; row < RHW_BLOCK; row++) {
                const f32x8 stored = f32x8_load(texels + row * RHW_TILE);
                least[x] = f32x8_min(stored, least[x]);
                most[x] = f32x8_max(stored, most[x]);
                ordered &= rhw_equal(stored, stored);
            }
            least[x] = f32x8_select(ordered, least[x], f32x8_splat(-INFINITY));
            most[x] = f32x8_select(ordered, most[x], f32x8_splat(INFINITY));
        }
        f32x8_transpose(least);
        f32x8_transpose(most);
        for (int column = 1; column < RHW_BLOCK; column++) {
            least[0] = f32x8_min(least[column], least[0]);
            most[0] = f32x8_max(most[column], most[0]);
        }
        f32x8_store(&depth->range_least[y * HIZ_BLOCKS], least[0]);
        f32x8_store(&depth->range_most[y * HIZ_BLOCKS], most[0]);
    }
    depth->has_ranges = true;
}

// A bit for each of the tile's blocks, row by row: blocks whose fragments all pass the depth test, and blocks whose
// fragments all fail it.
struct decided_blocks {
    uint64_t passed, failed;
};

// Return the decided blocks of a plane of depth, in rows of which a block is `wanted`. (anchor_x, anchor_y) is the
// anchor in the tile. `clamps` says that depth is kept within the viewport's range.
RHW_INLINE struct decided_blocks decide_blocks(const struct tile_depth *depth, enum rhw_compare compare,
                                               struct plane z, int anchor_x, int anchor_y, bool clamps,
                                               uint64_t wanted)
{
    const bool is_less = compare == RHW_COMPARE_LESS || compare == RHW_COMPARE_LESS_EQUAL;
    // Rounding does not cross the margin. The margin is 0 if depth is a float.
    const float margin = 2 * depth->state->depth_margin;
    const int first_x = z.dx < 0 ? RHW_BLOCK - 1 : 0, first_y = z.dy < 0 ? RHW_BLOCK - 1 : 0;
    const i32x8 blocks = rhw_lane_index * RHW_BLOCK;
    const i32x8 column = blocks + (first_x - anchor_x), row = blocks + (first_y - anchor_y);
    const int across_x = RHW_BLOCK - 1 - 2 * first_x, across_y = RHW_BLOCK - 1 - 2 * first_y;
    struct block_plane nearest, farthest;
    block_plane_set(&nearest, z, &(struct anchor_offset){f64x8_from_i32x8(column), f64x8_from_i32x8(row)});
    block_plane_set(
        &farthest, z,
        &(struct anchor_offset){f64x8_from_i32x8(column + across_x), f64x8_from_i32x8(row + across_y)});
    uint64_t below = 0, above = 0;
    for (int y = 0; y < HIZ_BLOCKS; y++) {
        if (!(wanted >> (HIZ_BLOCKS * y) & 0xff)) {
            continue;
        }
        f32x8 least = f32x8_from_f64x8(block_plane_value(&nearest, y));
        f32x8 most = f32x8_from_f64x8(block_plane_value(&farthest, y));
        if (clamps) {
            least = viewport_clamp(depth, least);
            most = viewport_clamp(depth, most);
        }
        if (margin != 0) {
            least = rhw_saturate(least) - margin;
            most = rhw_saturate(most) + margin;
        }
        const i32x8 nearer = rhw_less(most, f32x8_load(&depth->range_least[y * HIZ_BLOCKS]));
        const i32x8 farther = rhw_less(f32x8_load(&depth->range_most[y * HIZ_BLOCKS]), least);
        below |= (uint64_t)i32x8_sign_bits(nearer) << (HIZ_BLOCKS * y);
        above |= (uint64_t)i32x8_sign_bits(farther) << (HIZ_BLOCKS * y);
    }
    return is_less ? (struct decided_blocks){below, above} : (struct decided_blocks){above, below};
}

#endif
