// SPDX-License-Identifier: MIT
// The sampler, one of the three translation units of an instruction set: sample/ has its parts.
#include "sample/filter_fixed.h"
#include "sample/filter_float.h"
#include "sample/multi_texture.h"
#include "sample_entry.h"

void RHW_ISA_NAME(rhw_sample_float)(const struct rhw_binding *binding, const rhw_float uv[2],
                                    const rhw_float grad[4], const rhw_float *lod, rhw_float texel[4])
{
    if (!binding->texture) {
        texel[0] = texel[1] = texel[2] = rhw_splat(0.0f);
        texel[3] = rhw_splat(1.0f);
    } else {
        sample_float(binding, uv, grad, lod, texel);
    }
}

void RHW_ISA_NAME(rhw_sample_unorm8)(const struct rhw_binding *binding, const rhw_float uv[2],
                                     const rhw_float grad[4], const rhw_float *lod, rhw_float texel[4])
{
    sample_fixed(binding->texture, binding->sampler, uv,
                 fixed_level_of_detail(binding->texture, binding->sampler, grad, lod), RHW_CODEC_UNORM8,
                 texel);
}

void RHW_ISA_NAME(rhw_sample_srgb8)(const struct rhw_binding *binding, const rhw_float uv[2],
                                    const rhw_float grad[4], const rhw_float *lod, rhw_float texel[4])
{
    sample_fixed(binding->texture, binding->sampler, uv,
                 fixed_level_of_detail(binding->texture, binding->sampler, grad, lod), RHW_CODEC_SRGB8,
                 texel);
}

void RHW_ISA_NAME(rhw_sample_groups)(const struct rhw_binding *bindings, uint32_t slots,
                                     const struct rhw_fragment *groups, int count, int at,
                                     rhw_float (*texels)[4], int stride)
{
    sample_groups(bindings, slots, groups, count, at, texels, stride);
}
