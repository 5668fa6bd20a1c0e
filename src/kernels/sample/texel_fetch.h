// SPDX-License-Identifier: MIT
// From coordinates to texels: address modes, texel numbers, loads, and every format as floats. What is done with the
// texels of a footprint stands in filter_float.h and filter_fixed.h.
#ifndef RHW_TEXEL_FETCH_H
#define RHW_TEXEL_FETCH_H

#include "../../simd_layout.h"
#include "../../format.h"
#include "../../srgb.h"
#include "../../srgb_texture.h"
#include "../../texture.h"
#include "sample_constants.h"

// Addresses -----------------------------------------------------------------------------------------

// Folded into 0..1, or −1..2 with a border, where only what lies outside the texture matters. What is not
// finite lands on a bound.
static inline f8 fold_coordinate(enum rhw_address address, f8 u)
{
    const f8 zero = rhw_splat(0.0f), one = rhw_splat(1.0f);
    if (__builtin_expect(address == RHW_ADDRESS_REPEAT, 1)) {
        return rhw_min(u - rhw_floor(u), sample_constants()->one); // never negative; 1 where it is NaN
    }
    switch (address) {
    case RHW_ADDRESS_MIRROR: {
        const f8 period = u - 2.0f * rhw_floor(0.5f * u); // 0..2
        return rhw_clamp(1.0f - rhw_abs(period - 1.0f), zero, one);
    }
    case RHW_ADDRESS_BORDER: return rhw_clamp(u, rhw_splat(-1.0f), rhw_splat(2.0f));
    default: return rhw_clamp(u, zero, one);
    }
}

// Texel coordinates that may lie one outside a level, moved into it. A repeated or mirrored edge is already exact:
// folding leaves −1 and `size` only for the neighbour across the edge. Border texels are clamped as well,
// and replaced after the fetch.
static inline i8 wrap_coordinate(enum rhw_address address, i8 i, int size)
{
    if (address == RHW_ADDRESS_REPEAT) {
        const i8 n = i8_splat(size);
        return i + (n & (i >> 31)) - (n & ~rhw_less_int(i, n));
    }
    return rhw_max_int(rhw_min_int(i, i8_splat(size - 1)), i8_splat(0));
}

static inline i8 is_outside(i8 i, int size)
{
    return (i >> 31) | ~rhw_less_int(i, i8_splat(size));
}

// y · texels per row + x, of x and y inside the level: all three fit 16 bits.
RHW_INLINE i8 texel_number(i8 xy, const struct rhw_mip *mip)
{
    return i8_dot_halves(xy, i8_load(mip->step));
}

// Loads ---------------------------------------------------------------------------------------------

// Puts 8 numbers into memory: one store and 8 loads cost less than taking the lanes out of a register, which gcc
// does unless kept from it.
RHW_INLINE void spill_lanes(i8 lanes, uint32_t numbers[RHW_LANES])
{
    memcpy(numbers, &lanes, sizeof lanes);
    __asm__("" : "+m"(*(uint32_t(*)[RHW_LANES])numbers));
}

// Formats -------------------------------------------------------------------------------------------

// c / 255 correctly rounded for whole c of 0..255: 1/255 = 1/256 + 1/65280.
RHW_INLINE f8 unorm8_to_float(i8 code)
{
    const f8 c = rhw_to_float(code);
    return c * 0x1p-8f + c * 1.53186284e-05f;
}

// Linear value of the sRGB code at `shift`. A gather costs 12 cycles on a Zen 3; a polynomial as exact as the
// table costs more.
RHW_INLINE f8 srgb8_to_float(i8 texel, int shift)
{
    const i8 code = (texel >> shift) & 0xff;
    return (f8)i8_gather(rhw_srgb_decode_table, code);
}

// Texels (x, y) of a level as floats, colour linear.
static inline void fetch_texels(enum rhw_format format, const struct rhw_mip *mip, i8 x, i8 y, f8 texel[4])
{
    const size_t size = format == RHW_FORMAT_R8_UNORM       ? 1
                        : format == RHW_FORMAT_RG8_UNORM    ? 2
                        : format == RHW_FORMAT_RGBA16_FLOAT ? 8
                        : format == RHW_FORMAT_RGBA32_FLOAT ? 16
                                                            : 4;
    texel[1] = texel[2] = rhw_splat(0.0f);
    texel[3] = rhw_splat(1.0f);
    if (size == 4) {
        const i8 word = i8_gather(mip->texels, texel_number((x << 16) | y, mip));
        if (format != RHW_FORMAT_RGBA8_UNORM && format != RHW_FORMAT_RGBA8_SRGB) {
            texel[0] = (f8)word; // R32_FLOAT, D32_FLOAT
            return;
        }
        for (int c = 0; c < 3; c++) {
            texel[c] = format == RHW_FORMAT_RGBA8_SRGB ? srgb8_to_float(word, 8 * c)
                                                       : unorm8_to_float((word >> (8 * c)) & 0xff);
        }
        texel[3] = unorm8_to_float((word >> 24) & 0xff);
        return;
    }
    uint32_t at[RHW_LANES];
    spill_lanes(y * (int32_t)(mip->row_pitch / size) + x, at);
    if (size == 16) {
        f4 row[RHW_LANES];
        for (int i = 0; i < RHW_LANES; i++) {
            memcpy(&row[i], mip->texels + at[i] * size, sizeof row[i]);
        }
        f4_columns(row, texel);
    } else if (size == 8) {
        i8 red_green, blue_alpha;
        spill_lanes(2 * i8_load(at), at);
        i8_load_pairs(mip->texels, at, &red_green, &blue_alpha);
        texel[0] = f8_from_half(red_green & 0xffff);
        texel[1] = f8_from_half((i8)((u8)red_green >> 16));
        texel[2] = f8_from_half(blue_alpha & 0xffff);
        texel[3] = f8_from_half((i8)((u8)blue_alpha >> 16));
    } else {
        int32_t red[RHW_LANES], last[RHW_LANES];
        for (int i = 0; i < RHW_LANES; i++) {
            red[i] = mip->texels[at[i] * size];
            last[i] = mip->texels[at[i] * size + size - 1];
        }
        texel[0] = unorm8_to_float(i8_load(red));
        if (format == RHW_FORMAT_RG8_UNORM) {
            texel[1] = unorm8_to_float(i8_load(last));
        }
    }
}

#endif
