// SPDX-License-Identifier: MIT
// The sampler's general half, one of the translation units of an instruction set: textures of every kind, anisotropy,
// and what shaders ask beside samples. binding.c chooses which function samples a texture.
#include "kernel_entries.h"

#include "kernels/texture/anisotropy.h"
#include "kernels/texture/anisotropy_fixed.h"
#include "kernels/texture/filter_general.h"
#include "kernels/texture/storage_image.h"
#include "kernels/texture/texel_query.h"

void RHW_ISA_NAME(rhw_sample_general)(const struct rhw_binding_data *binding,
                                      const struct rhw_sample_request *request, rhw_float texel[4])
{
    sample_general(binding, request, texel);
}

void RHW_ISA_NAME(rhw_sample_anisotropic)(const struct rhw_binding_data *binding,
                                          const struct rhw_sample_request *request, rhw_float texel[4])
{
    sample_anisotropic(binding, request, texel);
}

void RHW_ISA_NAME(rhw_sample_fixed_anisotropic)(const struct rhw_binding_data *binding,
                                                const struct rhw_sample_request *request, rhw_float texel[4])
{
    sample_fixed_anisotropic(binding, request, FOOTPRINTS_INTERIOR, texel);
}

void RHW_ISA_NAME(rhw_sample_fixed_anisotropic_general)(const struct rhw_binding_data *binding,
                                                        const struct rhw_sample_request *request,
                                                        rhw_float texel[4])
{
    sample_fixed_anisotropic(binding, request, FOOTPRINTS_WRAPPED, texel);
}

void RHW_ISA_NAME(rhw_sample_axis_groups)(const struct rhw_binding_data *binding,
                                          const struct rhw_fragment *groups, int count, int at,
                                          rhw_float (*texels)[4], int stride)
{
    if (binding->texture->info->codec == RHW_CODEC_SRGB8) {
        sample_axis_groups(binding, groups, count, at, RHW_CODEC_SRGB8, texels, stride);
    } else {
        sample_axis_groups(binding, groups, count, at, RHW_CODEC_UNORM8, texels, stride);
    }
}

void RHW_ISA_NAME(rhw_sample_biased)(const struct rhw_binding_data *binding,
                                     const struct rhw_sample_request *request, rhw_float texel[4])
{
    sample_biased(binding, request, texel);
}

void RHW_ISA_NAME(rhw_gather_texels)(const struct rhw_binding_data *binding,
                                     const struct rhw_sample_request *request, int channel,
                                     rhw_float texel[4])
{
    gather(binding, request, channel, texel);
}

void RHW_ISA_NAME(rhw_fetch_texels)(const struct rhw_binding_data *binding, const rhw_int *at,
                                    const rhw_int *level, rhw_float texel[4])
{
    if (!level && binding->texture->is_plain) {
        fetch_plain(binding->texture, at, texel);
    } else {
        fetch(binding->texture, at, level ? *level : rhw_splat_int(0), texel);
    }
}

void RHW_ISA_NAME(rhw_query_level)(const struct rhw_binding_data *binding,
                                   const struct rhw_sample_request *request, rhw_float lod[2])
{
    query_level(binding, request, lod);
}

void RHW_ISA_NAME(rhw_query_size)(const struct rhw_binding_data *binding, const rhw_int *level,
                                  rhw_int size[3])
{
    query_size(binding->texture, level ? *level : rhw_splat_int(0), size);
}

void RHW_ISA_NAME(rhw_load_image)(const struct rhw_storage_image *image, const rhw_int *at,
                                  rhw_float texel[4])
{
    image_load(image, at, texel);
}

void RHW_ISA_NAME(rhw_store_image)(const struct rhw_storage_image *image, const rhw_int *at,
                                   const rhw_int *mask, const rhw_float texel[4])
{
    image_store(image, at, *mask, texel);
}

void RHW_ISA_NAME(rhw_fetch_sample_texels)(const struct rhw_texture_data *texture, const rhw_int *at,
                                           const rhw_int *sample, rhw_float texel[4])
{
    fetch_sample(texture, at, *sample, texel);
}
