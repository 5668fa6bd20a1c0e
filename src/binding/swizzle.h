// SPDX-License-Identifier: MIT
// The channels of a view in its own order (Vulkan 1.3, "Component Swizzle").
#ifndef RHW_SWIZZLE_H
#define RHW_SWIZZLE_H

#include "format/format.h"
#include "resource/texture.h"
#include "rhw/shader.h"

// Return what a constant channel has. Integer formats have the bits of 0 and 1.
static inline rhw_float rhw_constant_channel(const struct rhw_texture_data *texture, enum rhw_swizzle swizzle)
{
    if (swizzle == RHW_SWIZZLE_ZERO) {
        return rhw_splat(0);
    }
    return rhw_format_is_integer(texture->info) ? rhw_float_from_bits(rhw_splat_int(1)) : rhw_splat(1);
}

static inline bool rhw_swizzle_is_constant(enum rhw_swizzle swizzle)
{
    return swizzle == RHW_SWIZZLE_ZERO || swizzle == RHW_SWIZZLE_ONE;
}

// Return the channel that a view reads as channel `c`.
static inline int rhw_swizzled_channel(const struct rhw_texture_data *texture, int c)
{
    const enum rhw_swizzle swizzle = texture->swizzle[c];
    return swizzle == RHW_SWIZZLE_IDENTITY ? c : (int)swizzle - (int)RHW_SWIZZLE_RED;
}

// Put the channels of a view in its order (Vulkan 1.3, "Component Swizzle"). Filters mix each channel by itself, so
// that the order does not matter to them.
static inline void rhw_swizzle_texel(const struct rhw_texture_data *texture, rhw_float texel[4])
{
    const rhw_float own[4] = {texel[0], texel[1], texel[2], texel[3]};
    for (int c = 0; texture->swizzles && c < 4; c++) {
        texel[c] = rhw_swizzle_is_constant(texture->swizzle[c])
                       ? rhw_constant_channel(texture, texture->swizzle[c])
                       : own[rhw_swizzled_channel(texture, c)];
    }
}

#endif
