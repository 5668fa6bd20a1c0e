// SPDX-License-Identifier: MIT
// Which mip levels a sample reads: the level of detail from gradients or as given, and the level it names.
#ifndef RHW_LOD_H
#define RHW_LOD_H

#include "resource/sampler.h"
#include "resource/texture.h"
#include "sample_constants.h"

// Return &texture->mip[level]. It is found by a loop where an index would do: the processor predicts when the loop ends
// and starts to load texels before it has worked out the level of detail, which saves a quarter of the time.
RHW_INLINE const struct rhw_mip *mip_at(const struct rhw_texture_data *texture, int level)
{
    const struct rhw_mip *mip = texture->mip;
    for (; level > 0; level--) {
        mip++;
        __asm__("" : "+r"(mip)); // keeps the compiler from seeing through the loop
    }
    return mip;
}

// Return the last level that may be used.
RHW_INLINE int last_level(const struct rhw_texture_data *texture, const struct rhw_sampler_data *sampler)
{
    return sampler->def.mip_filter == RHW_MIP_FILTER_NONE ? 0 : texture->levels - 1;
}

// Return log2(a) / 2 within 2^-17, exact at powers of four: the level of detail needs no more. The bits of a float,
// read as a number, are its logarithm except for the curve between powers of two. 0 gives −63.5, and infinity and NaN
// give 64: the bits of a NaN differ between processors.
RHW_INLINE f32x8 half_log2(f32x8 a)
{
    const struct sample_constants *const k = sample_constants();
    const i32x8 bits = (i32x8)rhw_min(a, k->largest);
    const f32x8 straight = rhw_float_from_int(bits) * k->log_scale + k->log_offset;
    const f32x8 t = (f32x8)((bits & k->fraction_bits) | k->one_bits) - k->one;
    const f32x8 square = t * t;
    const f32x8 curve = (k->curve1 * t + k->curve0) + square * (k->curve3 * t + k->curve2);
    return straight + (square - t) * curve;
}

// Return the level of detail after OpenGL ES 3.0 §3.8.10, biased but not yet limited. Half the logarithm of the squared
// length spares the square root.
RHW_INLINE f32x8 level_of_detail(const struct rhw_texture_data *texture,
                                 const struct rhw_sampler_data *sampler, const f32x8 *gradient,
                                 const f32x8 *lod)
{
    if (!gradient) {
        return (lod ? *lod : rhw_splat(0.0f)) + sampler->def.lod_bias;
    }
    const struct rhw_mip *const mip = &texture->mip[0];
    const f32x8 scale_x = f32x8_load(mip->scale_x), scale_y = f32x8_load(mip->scale_y);
    const f32x8 ux = gradient[0] * scale_x, vx = gradient[1] * scale_y;
    const f32x8 uy = gradient[2] * scale_x, vy = gradient[3] * scale_y;
    return half_log2(rhw_max(ux * ux + vx * vx, uy * uy + vy * vy)) + f32x8_load(sampler->gradient_bias);
}

#endif
