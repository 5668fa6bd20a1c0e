// SPDX-License-Identifier: MIT
// Which of the kernels' functions samples a texture: chosen once, when it is bound.
#include "binding.h"

#include "format.h"
#include "kernels/kernels.h"
#include "sampler.h"
#include "texture.h"

static rhw_sample_function *sample_function(const struct rhw_kernels *kernels,
                                            const struct rhw_texture_data *texture,
                                            const struct rhw_sampler_data *sampler)
{
    if (texture && sampler->filters_fixed && texture->info->path == RHW_TEXELS_RGBA8_UNORM) {
        return kernels->sample_unorm8;
    }
    if (texture && sampler->filters_fixed && texture->info->path == RHW_TEXELS_RGBA8_SRGB) {
        return kernels->sample_srgb8;
    }
    return kernels->sample_float;
}

struct rhw_binding rhw_binding_of(const struct rhw_kernels *kernels, const struct rhw_texture_data *texture,
                                  const struct rhw_sampler_data *sampler)
{
    return (struct rhw_binding){.sample = sample_function(kernels, texture, sampler),
                                .texture = texture,
                                .sampler = sampler,
                                .sample_groups = kernels->sample_groups};
}
