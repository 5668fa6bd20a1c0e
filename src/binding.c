// SPDX-License-Identifier: MIT
// Which of the kernels' functions samples a texture, chosen once, when it is bound; and the two functions by which
// shaders get there.
#include "binding.h"

#include "format.h"
#include "sampler.h"
#include "texture.h"
#include "watch.h"

struct rhw_binding rhw_binding_of(const struct rhw_kernels *kernels, enum rhw_paths paths,
                                  const struct rhw_texture_data *texture,
                                  const struct rhw_sampler_data *sampler)
{
    const bool special = paths != RHW_PATHS_GENERAL;
    const bool fixed = texture && sampler->filters_fixed && texture->info->path != RHW_TEXELS_GENERAL;
    struct rhw_binding binding = {.sample = kernels->sample_float, .texture = texture, .sampler = sampler};
    if (fixed && texture->info->path == RHW_TEXELS_RGBA8_UNORM) {
        binding.sample = special ? kernels->sample_unorm8 : kernels->sample_unorm8_general;
    } else if (fixed) {
        binding.sample = special ? kernels->sample_srgb8 : kernels->sample_srgb8_general;
    }
    binding.shares_footprints = fixed && special;
    return binding;
}

void rhw_bindings_init(struct rhw_bindings *bindings, const struct rhw_kernels *kernels)
{
    *bindings = (struct rhw_bindings){.sample_groups = kernels->sample_groups};
    for (int i = 0; i < RHW_MAX_TEXTURES; i++) {
        bindings->slot[i] = rhw_binding_of(kernels, RHW_PATHS_ALL, NULL, NULL);
    }
}

void rhw_sample(const struct rhw_bindings *textures, int slot, const struct rhw_sample_request *request,
                rhw_float texel[4])
{
    if (textures->site.findings) {
        rhw_watch_sample(textures, slot, request);
    }
    if ((unsigned)slot >= RHW_MAX_TEXTURES) { // as a slot that nothing is bound to
        texel[0] = texel[1] = texel[2] = rhw_splat(0);
        texel[3] = rhw_splat(1);
        return;
    }
    const struct rhw_binding *const binding = &textures->slot[slot];
    binding->sample(binding, request, texel);
}

void rhw_sample_groups(const struct rhw_fragment *groups, int count, uint32_t slots, int at,
                       rhw_float (*texels)[4], int stride)
{
    const uint32_t known = slots & ((1u << RHW_MAX_TEXTURES) - 1);
    if (groups->textures->site.findings) {
        rhw_watch_sample_groups(groups, count, slots, at);
    }
    if (known != 0) {
        groups->textures->sample_groups(groups, count, known, at, texels, stride);
    }
}
