// SPDX-License-Identifier: MIT
// The linear copy of an RGBA8_SRGB texture: what the sampler filters.
#ifndef RHW_SRGB_TEXTURE_H
#define RHW_SRGB_TEXTURE_H

#include "rhw/base.h"

struct rhw_context;
struct rhw_texture_data;

enum {
    // The number for 1. A code c of 255 becomes 128·c where nothing is decoded, so that alpha and RGBA8_UNORM texels,
    // which the sampler widens by the factor 128 too, stay exact.
    RHW_LINEAR_ONE = 255 * 128,
    RHW_LINEAR_TEXEL = 8 // bytes: red, blue, green, alpha, 16 bits each
};

// Make the copy, or renew levels whose texels have changed, on all threads of the context. Nothing is made for other
// formats. Return RHW_OK, RHW_ERROR_OUT_OF_MEMORY or RHW_ERROR_GIVEN_UP.
enum rhw_result rhw_texture_linearize(struct rhw_context *context, struct rhw_texture_data *texture);

#endif
