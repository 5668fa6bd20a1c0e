// SPDX-License-Identifier: MIT
// The one projection from clip coordinates to the screen: positions are snapped, and flags say what is known of a
// vertex.
#ifndef RHW_PROJECTION_H
#define RHW_PROJECTION_H

#include "draw/draw_list.h"
#include "pipeline/pipeline.h"
#include "draw/snap.h"

// Return the flags of 8 vertices. `snapped` tells which can be snapped.
RHW_INLINE i32x8 vertex_flags(const f32x8 position[4], f32x8 near, i32x8 snapped)
{
    const f32x8 x = position[0], y = position[1], z = position[2], w = position[3], zero = f32x8_splat(0);
    const i32x8 finite =
        rhw_equal(x - x, zero) & rhw_equal(y - y, zero) & rhw_equal(z - z, zero) & rhw_equal(w - w, zero);
    i32x8 flags = rhw_less(x, -w) & i32x8_splat(RHW_VERTEX_LEFT);
    flags |= rhw_less(w, x) & i32x8_splat(RHW_VERTEX_RIGHT);
    flags |= rhw_less(y, -w) & i32x8_splat(RHW_VERTEX_BOTTOM);
    flags |= rhw_less(w, y) & i32x8_splat(RHW_VERTEX_TOP);
    flags |= rhw_less(z, near) & i32x8_splat(RHW_VERTEX_NEAR);
    flags |= rhw_less(w, z) & i32x8_splat(RHW_VERTEX_FAR);
    flags |= ~snapped & i32x8_splat(RHW_VERTEX_UNSNAPPED);
    flags |= ~finite & i32x8_splat(RHW_VERTEX_NOT_FINITE);
    return flags;
}

// Make the header of the vertex records from clip coordinates.
RHW_INLINE void project(const struct rhw_draw_state *state, const f32x8 position[4], f32x8 header[8])
{
    const f32x8 x = position[0], y = position[1], z = position[2], w = position[3];
    const bool symmetric = state->pipeline->def.depth_range == RHW_DEPTH_MINUS_ONE_TO_ONE;
    const f64x8 wd = f64x8_from_f32x8(w);
    const f64x8 sx = f64x8_add(f64x8_mul(f64x8_div(f64x8_from_f32x8(x), wd), f64x8_splat(state->half_width)),
                               f64x8_splat(state->center_x));
    const f64x8 sy = f64x8_sub(f64x8_splat(state->center_y), f64x8_mul(f64x8_div(f64x8_from_f32x8(y), wd),
                                                                       f64x8_splat(state->half_height)));
    const f32x8 d = f32x8_from_f64x8(
        f64x8_add(f64x8_splat(state->depth_low),
                  f64x8_mul(f64x8_splat(state->depth_span), f64x8_div(f64x8_from_f32x8(z), wd))));
    // In float the comparisons err by a rounding at 32768, a power of two: there the float is below or equal exactly
    // when the double rounds to it or below.
    const f32x8 fx = f32x8_from_f64x8(sx), fy = f32x8_from_f64x8(sy);
    const f32x8 band = f32x8_splat((float)RHW_GUARD_BAND), far_depth = f32x8_splat(1e30f);
    const i32x8 snapped = rhw_less(f32x8_splat(0), w) & rhw_less_equal(fx, band) & rhw_less_equal(-band, fx) &
                          rhw_less_equal(fy, band) & rhw_less_equal(-band, fy) & rhw_less(d, far_depth) &
                          rhw_less(-far_depth, d);
    header[0] = (f32x8)snap8(sx);
    header[1] = (f32x8)snap8(sy);
    header[2] = d;
    i32x8 flags = vertex_flags(position, symmetric ? -w : f32x8_splat(0), snapped);
    if (state->pipeline->def.depth_clip_disabled) {
        flags &= i32x8_splat(~(RHW_VERTEX_NEAR | RHW_VERTEX_FAR));
    }
    header[3] = (f32x8)flags;
    header[4] = x;
    header[5] = y;
    header[6] = z;
    header[7] = w;
}

#endif
