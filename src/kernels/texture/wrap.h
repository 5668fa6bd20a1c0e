// SPDX-License-Identifier: MIT
// Address modes of the general sampler: texel coordinates may lie anywhere, as offsets bring them about. The special
// paths fold coordinates into 0..1 instead (texel_fetch.h), after which only neighbours lie outside.
#ifndef RHW_WRAP_H
#define RHW_WRAP_H

#include "base/simd_layout.h"
#include "rhw/types.h"

// Return coordinates that repeat in one period: 0..1 or 0..2, and the upper bound where they are not finite. Return
// others as they are.
static inline f32x8 fold_period(enum rhw_address address, f32x8 u)
{
    switch (address) {
    case RHW_ADDRESS_REPEAT: return rhw_min(u - rhw_floor(u), rhw_splat(1.0f));
    case RHW_ADDRESS_MIRROR: return rhw_min(u - 2.0f * rhw_floor(0.5f * u), rhw_splat(2.0f));
    default: return u;
    }
}

// Return folded coordinates in texels, within ±2^20, where every whole number and its halves are floats.
static inline f32x8 unfolded_texels(f32x8 folded, f32x8 size)
{
    return rhw_clamp(folded * size, rhw_splat(-0x1p20f), rhw_splat(0x1p20f));
}

// Return i modulo n, never negative. |i| is below 2^22, where the quotient is a whole number only if it is exactly one.
static inline i32x8 modulo(i32x8 i, i32x8 n)
{
    return i - n * rhw_int_from_float_unchecked(rhw_floor(rhw_float_from_int(i) / rhw_float_from_int(n)));
}

// Move texel coordinates into 0 .. size − 1. What a border replaces is clamped as well.
static inline i32x8 wrap_texel(enum rhw_address address, i32x8 i, i32x8 size)
{
    const i32x8 outside = (i >> 31) | ~rhw_less_int(i, size);
    if (!rhw_any(outside)) {
        return i;
    }
    if (address == RHW_ADDRESS_REPEAT) {
        return modulo(i, size);
    }
    if (address == RHW_ADDRESS_MIRROR) {
        const i32x8 period = modulo(i, size + size);
        return rhw_min_int(period, size + size - 1 - period);
    }
    // Numbers below 0 become −1 − i.
    const i32x8 mirrored = address == RHW_ADDRESS_MIRROR_ONCE ? i ^ (i >> 31) : i;
    return rhw_max_int(rhw_min_int(mirrored, size - 1), i32x8_splat(0));
}

#endif
