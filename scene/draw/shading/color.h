// SPDX-License-Identifier: MIT
// The sRGB transfer function (IEC 61966-2-1) for the few values that no texture decodes.
#ifndef SCENE_COLOR_H
#define SCENE_COLOR_H

#include "rhw/shader.h"

static inline rhw_float scene_color_decode8(rhw_float encoded)
{
    const rhw_float curve = rhw_pow((encoded + 0.055f) / 1.055f, 2.4f);
    return rhw_select(rhw_less_equal(encoded, 0.04045f), encoded / 12.92f, curve);
}

/// Return the light of one 8-bit code.
static inline float scene_color_decode(uint8_t code)
{
    return scene_color_decode8(rhw_splat((float)code / 255.0f))[0];
}

#endif
