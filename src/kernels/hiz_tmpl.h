// SPDX-License-Identifier: MIT
// Hierarchical depth (Greene, Kass and Miller 1993, Hierarchical Z-Buffer Visibility): of every block of 8×8 pixels
// the tile knows a depth that none of its pixels lies behind, so that what does need not be tested pixel by pixel.
// Template: compiled once per instruction set.
//
// With LESS and LESS_EQUAL depth only falls, and what was a bound stays one: `direction` 1. With GREATER it is −1 and
// everything is mirrored: bounds are of direction · depth. What may move depth the other way ends them. A triangle that
// covers a block moves its bound; small triangles do so together, when the tile's depth is looked at anew.

#include "pack_tmpl.h"

#include <math.h>

enum { HIZ_BLOCKS = RHW_TILE / RHW_BLOCK }; // of a tile, each way

_Static_assert(RHW_TILE == 64 && RHW_BLOCK == 8, "the bounds of 8 blocks side by side are a vector");

// Before a draw: whether bounds go on to hold, and whether its fragments can be tested against them.
static void hiz_follow(struct tile_work *work, const struct rhw_pipeline_def *def)
{
    const enum rhw_compare compare = def->depth_compare;
    work->hiz_tests = false;
    if (!def->depth_test) {
        return;
    }
    const int direction = compare == RHW_COMPARE_LESS || compare == RHW_COMPARE_LESS_EQUAL         ? 1
                          : compare == RHW_COMPARE_GREATER || compare == RHW_COMPARE_GREATER_EQUAL ? -1
                                                                                                   : 0;
    if (direction == 0 && def->depth_write && compare != RHW_COMPARE_EQUAL && compare != RHW_COMPARE_NEVER) {
        work->hiz_direction = 0;
    } else if (direction != 0 && direction != work->hiz_direction &&
               (def->depth_write || work->hiz_direction == 0)) {
        work->hiz_direction = direction;
        for (int i = 0; i < HIZ_BLOCKS * HIZ_BLOCKS; i++) {
            work->scratch->hiz[i] = INFINITY;
        }
    }
    work->hiz_tests = tests_early(work) && direction != 0 && direction == work->hiz_direction;
}

// Looks at the tile's depth anew. What lies outside of the target may make a bound worse, but not wrong; NaN passes no
// ordering test and bounds nothing.
static void hiz_refresh(struct tile_work *work)
{
    const f8 direction = f8_splat((float)work->hiz_direction);
    for (int y = 0; y < HIZ_BLOCKS; y++) {
        f8 most[HIZ_BLOCKS];
        for (int x = 0; x < HIZ_BLOCKS; x++) {
            const float *texels = stored_depth(work, x * RHW_BLOCK, y * RHW_BLOCK);
            most[x] = f8_splat(-INFINITY);
            for (int row = 0; row < RHW_BLOCK; row++) {
                most[x] = f8_max(f8_load(texels) * direction, most[x]); // the second where one is NaN
                texels += RHW_TILE;
            }
        }
        f8_transpose(most);
        for (int column = 1; column < RHW_BLOCK; column++) {
            most[0] = f8_max(most[column], most[0]);
        }
        f8_store(&work->scratch->hiz[y * HIZ_BLOCKS], most[0]);
    }
}

// The column or row of a block where direction · depth is least: the first or the last. `slope` is how depth changes.
RHW_INLINE int hiz_nearest(const struct tile_work *work, double slope)
{
    return slope * work->hiz_direction < 0 ? RHW_BLOCK - 1 : 0;
}

// Whether a block at row y of the tile has a bound.
RHW_INLINE bool hiz_bounds(const struct tile_work *work, int y)
{
    const f8 bounds = f8_load(&work->scratch->hiz[y / RHW_BLOCK * HIZ_BLOCKS]);
    return i8_sign_bits(rhw_less(bounds, f8_splat(INFINITY))) != 0;
}

// Which of the blocks side by side at row y of the tile a plane of depth lies behind, as a bit for each: the nearest
// depth it has there, made as depth_row makes it, is beyond the block's bound.
RHW_INLINE unsigned hiz_hidden(const struct tile_work *work, const struct planes *planes, int y)
{
    const struct plane z = linear_plane(&planes->linear, QUANTITY_Z);
    const double dy = work->y + y + hiz_nearest(work, z.dy) - planes->anchor_y;
    const i8 dx = i8_splat(work->x + hiz_nearest(work, z.dx) - planes->anchor_x) + rhw_lane_index * RHW_BLOCK;
    const d8 depth = d8_add(d8_mul(d8_splat(z.dx), d8_from_i8(dx)), d8_splat(z.at + z.dy * dy));
    const f8 nearest = viewport_clamp(work->state, f8_from_d8(depth)) * f8_splat((float)work->hiz_direction);
    return i8_sign_bits(rhw_less(f8_load(&work->scratch->hiz[y / RHW_BLOCK * HIZ_BLOCKS]), nearest));
}

// All pixels of the block at (x, y) were tested against a plane of depth, and what passed was written.
RHW_INLINE void hiz_cover(struct tile_work *work, const struct planes *planes, int x, int y)
{
    const struct plane z = linear_plane(&planes->linear, QUANTITY_Z);
    const double dx = work->x + x + (RHW_BLOCK - 1 - hiz_nearest(work, z.dx)) - planes->anchor_x;
    const double dy = work->y + y + (RHW_BLOCK - 1 - hiz_nearest(work, z.dy)) - planes->anchor_y;
    const f8 depth = viewport_clamp(work->state, f8_splat((float)(z.dx * dx + (z.at + z.dy * dy))));
    const float farthest = depth[0] * (float)work->hiz_direction;
    float *const bound = &work->scratch->hiz[y / RHW_BLOCK * HIZ_BLOCKS + x / RHW_BLOCK];
    if (farthest < *bound) {
        *bound = farthest;
    }
}
