// SPDX-License-Identifier: MIT
// From clip coordinates to the screen: the one projection, snapped, and what it says about a vertex.
#ifndef RHW_PROJECTION_H
#define RHW_PROJECTION_H

#include "draw/draw_list.h"
#include "pipeline/pipeline.h"
#include "kernels/raster/snap.h"

// Gives the flags of 8 vertices; `snapped` tells which can be snapped.
RHW_INLINE i8 vertex_flags(const f8 position[4], f8 near, i8 snapped)
{
    const f8 x = position[0], y = position[1], z = position[2], w = position[3], zero = f8_splat(0);
    const i8 finite =
        rhw_equal(x - x, zero) & rhw_equal(y - y, zero) & rhw_equal(z - z, zero) & rhw_equal(w - w, zero);
    i8 flags = rhw_less(x, -w) & i8_splat(RHW_VERTEX_LEFT);
    flags |= rhw_less(w, x) & i8_splat(RHW_VERTEX_RIGHT);
    flags |= rhw_less(y, -w) & i8_splat(RHW_VERTEX_BOTTOM);
    flags |= rhw_less(w, y) & i8_splat(RHW_VERTEX_TOP);
    flags |= rhw_less(z, near) & i8_splat(RHW_VERTEX_NEAR);
    flags |= rhw_less(w, z) & i8_splat(RHW_VERTEX_FAR);
    flags |= ~snapped & i8_splat(RHW_VERTEX_UNSNAPPED);
    flags |= ~finite & i8_splat(RHW_VERTEX_NOT_FINITE);
    return flags;
}

// Makes the header of the vertex records from clip coordinates.
RHW_INLINE void project(const struct rhw_draw_state *state, const f8 position[4], f8 header[8])
{
    const f8 x = position[0], y = position[1], z = position[2], w = position[3];
    const bool symmetric = state->pipeline->def.depth_range == RHW_DEPTH_MINUS_ONE_TO_ONE;
    const d8 wd = d8_from_f8(w);
    const d8 sx =
        d8_add(d8_mul(d8_div(d8_from_f8(x), wd), d8_splat(state->half_width)), d8_splat(state->center_x));
    const d8 sy =
        d8_sub(d8_splat(state->center_y), d8_mul(d8_div(d8_from_f8(y), wd), d8_splat(state->half_height)));
    const f8 d = f8_from_d8(
        d8_add(d8_splat(state->depth_low), d8_mul(d8_splat(state->depth_span), d8_div(d8_from_f8(z), wd))));
    // In float the comparisons err by a rounding at 32768, a power of two: there the float is below or equal
    // exactly when the double rounds to it or below.
    const f8 fx = f8_from_d8(sx), fy = f8_from_d8(sy);
    const f8 band = f8_splat((float)RHW_GUARD_BAND), far_depth = f8_splat(1e30f);
    const i8 snapped = rhw_less(f8_splat(0), w) & rhw_less_equal(fx, band) & rhw_less_equal(-band, fx) &
                       rhw_less_equal(fy, band) & rhw_less_equal(-band, fy) & rhw_less(d, far_depth) &
                       rhw_less(-far_depth, d);
    header[0] = (f8)snap8(sx);
    header[1] = (f8)snap8(sy);
    header[2] = d;
    i8 flags = vertex_flags(position, symmetric ? -w : f8_splat(0), snapped);
    if (state->pipeline->def.depth_clip_disabled) {
        flags &= i8_splat(~(RHW_VERTEX_NEAR | RHW_VERTEX_FAR));
    }
    header[3] = (f8)flags;
    header[4] = x;
    header[5] = y;
    header[6] = z;
    header[7] = w;
}

#endif
