// SPDX-License-Identifier: MIT
// Texels that a shader reads by itself.
#ifndef SHADER_TEXEL_PLANE_H
#define SHADER_TEXEL_PLANE_H

#include "rhw/shader_binding.h"
#include "rhw/shader_memory.h"

// Return the first component of what rhw_binding_sample_fetch gives of a plane. Numbers outside of it pick no texel.
static inline rhw_float shader_fetch_texel(const struct rhw_texel_plane *plane, rhw_int x, rhw_int y)
{
    const rhw_int zero = rhw_splat_int(0);
    const rhw_int outside =
        rhw_less_int(x, zero) | ~rhw_less_int(x, rhw_splat_int(plane->width)) | rhw_less_int(y, zero);
    const rhw_int row = rhw_max_int(rhw_min_int(y, rhw_splat_int(plane->height)), zero);
    const rhw_int number = (rhw_int)((rhw_uint)(row * plane->pitch) + (rhw_uint)x); // x may be any number
    return rhw_gather(plane->texels, plane->pitch * plane->height, number | outside);
}

#endif
