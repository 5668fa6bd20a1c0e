// SPDX-License-Identifier: MIT
// The sampler, one of the translation units of an instruction set; texture/ has its parts. binding.c chooses which of
// these functions samples a texture.
#include "kernel_entries.h"

#include "kernels/texture/filter_compare.h"
#include "kernels/texture/filter_fixed.h"
#include "kernels/texture/filter_float.h"
#include "kernels/texture/multi_texture.h"

void RHW_ISA_NAME(rhw_sample_float)(const struct rhw_binding_data *binding,
                                    const struct rhw_sample_request *request, rhw_float texel[4])
{
    if (!binding->texture) {
        texel[0] = texel[1] = texel[2] = rhw_splat(0.0f);
        texel[3] = rhw_splat(1.0f);
    } else {
        sample_float(binding, request, false, texel);
    }
}

void RHW_ISA_NAME(rhw_sample_halves)(const struct rhw_binding_data *binding,
                                     const struct rhw_sample_request *request, rhw_float texel[4])
{
    sample_halves(binding, request, texel);
}

void RHW_ISA_NAME(rhw_sample_compared)(const struct rhw_binding_data *binding,
                                       const struct rhw_sample_request *request, rhw_float texel[4])
{
    sample_compared(binding, request, texel);
}

bool RHW_ISA_NAME(rhw_compare_window)(const struct rhw_binding_data *binding,
                                      const struct rhw_sample_request *request, int column, int columns,
                                      int rows, int stride, rhw_float *parts)
{
    const struct compared_window window = {column, columns, rows, stride};
    return compare_window(binding, request, &window, parts);
}

void RHW_ISA_NAME(rhw_sample_unorm8)(const struct rhw_binding_data *binding,
                                     const struct rhw_sample_request *request, rhw_float texel[4])
{
    sample_fixed(binding, request->coordinates,
                 fixed_level_of_detail(binding, request->gradient, request->lod), RHW_CODEC_UNORM8, texel);
}

void RHW_ISA_NAME(rhw_sample_srgb8)(const struct rhw_binding_data *binding,
                                    const struct rhw_sample_request *request, rhw_float texel[4])
{
    sample_fixed(binding, request->coordinates,
                 fixed_level_of_detail(binding, request->gradient, request->lod), RHW_CODEC_SRGB8, texel);
}

void RHW_ISA_NAME(rhw_sample_unorm8_general)(const struct rhw_binding_data *binding,
                                             const struct rhw_sample_request *request, rhw_float texel[4])
{
    sample_fixed_general(binding, request, RHW_CODEC_UNORM8, texel);
}

void RHW_ISA_NAME(rhw_sample_srgb8_general)(const struct rhw_binding_data *binding,
                                            const struct rhw_sample_request *request, rhw_float texel[4])
{
    sample_fixed_general(binding, request, RHW_CODEC_SRGB8, texel);
}

void RHW_ISA_NAME(rhw_sample_groups)(const struct rhw_binding_data *bindings,
                                     const struct rhw_fragment *groups, int count, uint32_t slots, int at,
                                     rhw_float (*texels)[4], int stride)
{
    sample_groups(bindings, groups, count, slots, at, texels, stride);
}
