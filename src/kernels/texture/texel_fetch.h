// SPDX-License-Identifier: MIT
// The way from coordinates to texels: address modes, texel numbers and loads. filter_float.h and filter_fixed.h have
// what is done with the texels of a footprint.
#ifndef RHW_TEXEL_FETCH_H
#define RHW_TEXEL_FETCH_H

#include "base/simd_layout.h"
#include "resource/srgb_texture.h"
#include "resource/texture.h"
#include "kernels/texel/texel_codec.h"
#include "sample_constants.h"

// Addresses -----------------------------------------------------------------------------------------

// Return the coordinate folded into 0..1, or into −1..2 with a border, where only what lies outside the texture
// matters. What is not finite lands on a bound.
static inline f32x8 fold_coordinate(enum rhw_address address, f32x8 u)
{
    const f32x8 zero = rhw_splat(0.0f), one = rhw_splat(1.0f);
    if (__builtin_expect(address == RHW_ADDRESS_REPEAT, 1)) {
        // This is never negative, and 1 where it is NaN.
        return rhw_min(u - rhw_floor(u), sample_constants()->one);
    }
    switch (address) {
    case RHW_ADDRESS_MIRROR: {
        const f32x8 period = u - 2.0f * rhw_floor(0.5f * u); // 0..2
        return rhw_clamp(1.0f - rhw_abs(period - 1.0f), zero, one);
    }
    case RHW_ADDRESS_BORDER: return rhw_clamp(u, rhw_splat(-1.0f), rhw_splat(2.0f));
    default: return rhw_clamp(u, zero, one);
    }
}

// Return of a folded coordinate what says which texel it lies in. Where MIRROR runs backwards a texel begins at its
// other edge (Vulkan 1.3, "Wrapping Operation": −1 − i), so that the coordinate counts as just below itself.
static inline f32x8 nearest_coordinate(enum rhw_address address, f32x8 u, f32x8 folded)
{
    const f32x8 zero = rhw_splat(0.0f);
    if (address != RHW_ADDRESS_MIRROR) {
        return folded;
    }
    const i32x8 is_backward = rhw_less(rhw_splat(1.0f), u - 2.0f * rhw_floor(0.5f * u));
    // This is the float's neighbour towards 0.
    return (f32x8)((i32x8)folded + (is_backward & rhw_less(zero, folded)));
}

// Move texel coordinates that may lie one outside a level into it. A repeated or mirrored edge is already exact:
// folding leaves −1 and `size` only for the neighbour across the edge. Border texels are clamped as well, and replaced
// after the fetch.
static inline i32x8 wrap_coordinate(enum rhw_address address, i32x8 i, int size)
{
    if (address == RHW_ADDRESS_REPEAT) {
        const i32x8 n = i32x8_splat(size);
        return i + (n & (i >> 31)) - (n & ~rhw_less_int(i, n));
    }
    return rhw_max_int(rhw_min_int(i, i32x8_splat(size - 1)), i32x8_splat(0));
}

static inline i32x8 is_outside(i32x8 i, int size)
{
    return (i >> 31) | ~rhw_less_int(i, i32x8_splat(size));
}

// Return y · texels per row + x, of x and y inside the level: all three fit 16 bits.
RHW_INLINE i32x8 texel_number(i32x8 xy, const struct rhw_mip *mip)
{
    return i32x8_dot_halves(xy, i32x8_load(mip->step));
}

// Return a channel of the border. What the format lacks stays 0, 0, 0, 1 (Vulkan 1.3 §16.3.3 "Texel Replacement"), and
// integer formats have a colour of their own.
RHW_INLINE f32x8 border_channel(const struct rhw_format_info *format, const struct rhw_sampler_def *def,
                                int channel)
{
    const bool lacks = channel >= format->channels;
    const int lacking = channel < 3 ? 0 : 1;
    return rhw_format_is_integer(format)
               ? (f32x8)rhw_splat_int(lacks ? lacking : def->border_integer[channel])
               : rhw_splat(lacks ? (float)lacking : def->border[channel]);
}

// Loads ---------------------------------------------------------------------------------------------

// Put 8 numbers into memory. One store and 8 loads cost less than taking the lanes out of a register, which gcc does
// unless kept from it.
RHW_INLINE void spill_lanes(i32x8 lanes, uint32_t numbers[RHW_LANES])
{
    memcpy(numbers, &lanes, sizeof lanes);
    __asm__("" : "+m"(*(uint32_t(*)[RHW_LANES])numbers));
}

// Load texels by their numbers, counted from `texels`, of `size` bytes each. Where a pass reads what another has drawn,
// those of a group mostly stand side by side, as a row that is loaded at once.
RHW_INLINE void fetch_numbered_texels(size_t size, const unsigned char *texels, i32x8 number,
                                      struct raw_texels *raw)
{
    if (!i32x8_any_bit(number ^ (i32x8_splat_first(number) + rhw_lane_index))) {
        load_texel_row(size, texels + (size_t)(uint32_t)number[0] * size, raw);
        return;
    }
    if (size == 4) {
        raw->word[0] = i32x8_gather(texels, number);
        return;
    }
    uint32_t at[RHW_LANES];
    if (size == 8) {
        spill_lanes(2 * number, at);
        i32x8_load_pairs(texels, at, &raw->word[0], &raw->word[1]);
        return;
    }
    spill_lanes(number, at);
    const void *place[RHW_LANES];
    for (int i = 0; i < RHW_LANES; i++) {
        place[i] = texels + at[i] * size;
    }
    if (size == 16) {
        load_texels16(place, raw);
    } else {
        load_small_texels(place, size, raw);
    }
}

// Load texels (x, y) of a level.
RHW_INLINE void fetch_raw_texels(size_t size, const struct rhw_mip *mip, i32x8 x, i32x8 y,
                                 struct raw_texels *raw)
{
    const i32x8 number = size == 4 ? texel_number((x << 16) | y, mip)
                                   : y * (int32_t)(mip->row_pitch >> __builtin_ctzll(size)) + x;
    fetch_numbered_texels(size, mip->texels, number, raw);
}

#endif
