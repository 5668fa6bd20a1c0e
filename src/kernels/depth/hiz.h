// SPDX-License-Identifier: MIT
// Hierarchical depth (Greene, Kass and Miller 1993, Hierarchical Z-Buffer Visibility): for every block of 8×8 pixels
// the tile knows a depth that none of its pixels lies behind. What lies behind that depth need not be tested pixel by
// pixel: 5 % fewer instructions in Sponza, where half of the blocks of the depth phase are hidden.
//
// With LESS and LESS_EQUAL depth only falls, and what was a bound stays one: `direction` is 1. With GREATER it is −1
// and everything is mirrored: bounds are of direction · depth. A draw that may move depth the other way ends the
// bounds. A triangle that covers a block moves the bound of the block. Small triangles move bounds together, when the
// tile's depth is looked at anew.
#ifndef RHW_HIZ_H
#define RHW_HIZ_H

#include <math.h>

#include "base/simd_layout.h"
#include "depth_test.h"
#include "kernels/raster/plane.h"

// A rectangle of pixels of the tile; x1 and y1 are exclusive.
struct hiz_rect {
    int x0, y0, x1, y1;
};

_Static_assert(RHW_TILE == 64 && RHW_BLOCK == 8, "the bounds of 8 blocks side by side are a vector");

// Before a draw, decide whether bounds go on to hold. Return true if the draw's fragments can be tested against them.
static bool hiz_follow(struct tile_depth *depth, const struct rhw_draw_plan *plan)
{
    const int direction = plan->depth_direction;
    if (plan->ends_bounds) {
        depth->direction = 0;
    } else if (direction != 0 && direction != depth->direction &&
               (plan->moves_depth || depth->direction == 0)) {
        depth->direction = direction;
        for (int i = 0; i < HIZ_BLOCKS * HIZ_BLOCKS; i++) {
            depth->bounds[i] = INFINITY;
        }
    }
    return plan->tests_early && direction != 0 && direction == depth->direction;
}

// Return the farthest depth, times `direction`, in each of the 8 blocks side by side at row y of a sample. What lies
// outside of the target may make a bound worse, but not wrong; NaN passes no ordering test and bounds nothing.
RHW_INLINE f32x8 hiz_farthest(struct tile_depth *depth, f32x8 direction, int y)
{
    f32x8 most[HIZ_BLOCKS];
    for (int x = 0; x < HIZ_BLOCKS; x++) {
        const float *texels = depth_texels(depth, x * RHW_BLOCK, y);
        most[x] = f32x8_splat(-INFINITY);
        for (int row = 0; row < RHW_BLOCK; row++) {
            // The second operand wins if one is NaN.
            most[x] = f32x8_max(f32x8_load(texels) * direction, most[x]);
            texels += RHW_TILE;
        }
    }
    f32x8_transpose(most);
    for (int column = 1; column < RHW_BLOCK; column++) {
        most[0] = f32x8_max(most[column], most[0]);
    }
    return most[0];
}

// Look anew at the tile's depth in the first `count` samples of its pixels. The bounds are kept with the first sample.
static void hiz_refresh(struct tile_depth *const *sample, int count)
{
    struct tile_depth *const first = sample[0];
    const f32x8 direction = f32x8_splat((float)first->direction);
    for (int y = 0; y < RHW_TILE; y += RHW_BLOCK) {
        f32x8 most = hiz_farthest(first, direction, y);
        for (int s = 1; s < count; s++) {
            most = f32x8_max(hiz_farthest(sample[s], direction, y), most);
        }
        f32x8_store(&first->bounds[y / RHW_BLOCK * HIZ_BLOCKS], most);
    }
}

// Return where direction · depth is least between two columns or rows: at one of them, and `reach` pixels before or
// behind it, because samples lie this far from the centres of their pixels. `change` is the change of depth to the next
// column or row. Planes are evaluated in steps that keep an order (plane.h), so that no rounding passes the value
// there.
RHW_INLINE double hiz_nearest(const struct tile_depth *depth, double change, int first, int last,
                              double reach)
{
    return change * depth->direction < 0 ? last + reach : first - reach;
}

RHW_INLINE double hiz_farthest_place(const struct tile_depth *depth, double change, int first, int last,
                                     double reach)
{
    return change * depth->direction < 0 ? first - reach : last + reach;
}

// Return true if some block at row y of the tile has a bound.
RHW_INLINE bool hiz_has_bounds(const struct tile_depth *depth, int y)
{
    const f32x8 bounds = f32x8_load(&depth->bounds[y / RHW_BLOCK * HIZ_BLOCKS]);
    return i32x8_sign_bits(rhw_less(bounds, f32x8_splat(INFINITY))) != 0;
}

// Return a bit for each of the blocks side by side at row y of the tile that a plane of depth lies behind: the nearest
// depth it has there is beyond the block's bound. (anchor_x, anchor_y) is the anchor in the tile. `reach` is how far
// samples lie from the centres of their pixels.
RHW_INLINE unsigned hiz_hidden(const struct tile_depth *depth, struct plane z, int anchor_x, int anchor_y,
                               int y, double reach)
{
    const double dy = hiz_nearest(depth, z.dy, y, y + RHW_BLOCK - 1, reach) - anchor_y;
    const double first = hiz_nearest(depth, z.dx, 0, RHW_BLOCK - 1, reach) - anchor_x;
    const f64x8 dx = f64x8_add(f64x8_from_i32x8(rhw_lane_index * RHW_BLOCK), f64x8_splat(first));
    const f64x8 value = plane_value8(z, dx, f64x8_splat(dy));
    const f32x8 nearest =
        viewport_clamp(depth, f32x8_from_f64x8(value)) * f32x8_splat((float)depth->direction);
    return i32x8_sign_bits(rhw_less(f32x8_load(&depth->bounds[y / RHW_BLOCK * HIZ_BLOCKS]), nearest));
}

// Return true if a plane of depth lies behind what the tile shows in a rectangle of at most two columns of blocks.
RHW_INLINE bool hiz_hides(const struct tile_depth *depth, struct plane z, int anchor_x, int anchor_y,
                          const struct hiz_rect *rect, double reach)
{
    const int left = rect->x0 / RHW_BLOCK, right = (rect->x1 - 1) / RHW_BLOCK;
    const double dx = hiz_nearest(depth, z.dx, rect->x0, rect->x1 - 1, reach) - anchor_x;
    const double dy = hiz_nearest(depth, z.dy, rect->y0, rect->y1 - 1, reach) - anchor_y;
    const float nearest = (float)plane_value(z, dx, dy) * (float)depth->direction;
    bool hides = right - left <= 1;
    for (int y = rect->y0 / RHW_BLOCK; y <= (rect->y1 - 1) / RHW_BLOCK; y++) {
        const float *const bounds = &depth->bounds[y * HIZ_BLOCKS];
        hides = hides && bounds[left] < nearest && bounds[right] < nearest;
    }
    return hides;
}

// Move the bound of the block at (x, y), both multiples of 8. All samples of the block were tested against a plane of
// depth, and what passed was written.
RHW_INLINE void hiz_cover(struct tile_depth *depth, struct plane z, int anchor_x, int anchor_y, int x, int y,
                          double reach)
{
    const double dx = hiz_farthest_place(depth, z.dx, x, x + RHW_BLOCK - 1, reach) - anchor_x;
    const double dy = hiz_farthest_place(depth, z.dy, y, y + RHW_BLOCK - 1, reach) - anchor_y;
    const f32x8 value = viewport_clamp(depth, f32x8_splat((float)plane_value(z, dx, dy)));
    const float farthest = value[0] * (float)depth->direction;
    float *const bound = &depth->bounds[y / RHW_BLOCK * HIZ_BLOCKS + x / RHW_BLOCK];
    if (farthest < *bound) {
        *bound = farthest;
    }
}

#endif
