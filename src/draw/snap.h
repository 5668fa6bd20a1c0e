// SPDX-License-Identifier: MIT
// A position on the screen is snapped to the nearest 1/256 pixel, ties to even, and into the guard band. Every position
// on the screen is snapped here: the front end snaps whole vertices 8 at a time, and the clipper snaps cut
// positions one by one. Equal positions therefore stay equal.
#ifndef RHW_SNAP_H
#define RHW_SNAP_H

#include "base/constants.h"
#include "base/simd.h"

// Return 8 positions in pixels, snapped. A position that is no number is snapped to the band's end.
RHW_INLINE i32x8 snap8(f64x8 pixels)
{
    const double limit = RHW_GUARD_BAND;
    return i32x8_round_f64x8(f64x8_mul(f64x8_clamp(pixels, -limit, limit), f64x8_splat(RHW_SUBPIXEL)));
}

// Return one position in pixels, snapped. Adding 1.5·2^52, where a double's last bit is worth 1, rounds as IEEE
// addition does; i32x8_round_f64x8 rounds by the same addition. nearbyint would go through libm.
static inline int32_t snap(double pixels)
{
    const double limit = RHW_GUARD_BAND;
    const double inside = pixels > limit ? limit : pixels >= -limit ? pixels : -limit;
    return (int32_t)((inside * RHW_SUBPIXEL + 0x1.8p52) - 0x1.8p52);
}

#endif
