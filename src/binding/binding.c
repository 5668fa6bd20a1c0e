// SPDX-License-Identifier: MIT
// This chooses which of the kernels' functions samples a texture, once, when the texture is bound.
#include "binding.h"

#include "format/format.h"
#include "resource/sampler.h"
#include "resource/texture.h"
#include "swizzle.h"

// Return true if samples lie along the axis of anisotropy. Texels of formats that are not filtered have no mean.
static bool is_anisotropic(const struct rhw_texture_data *texture, const struct rhw_sampler_data *sampler)
{
    return sampler->def.max_anisotropy > 1 && rhw_format_has_role(texture->info, RHW_ROLE_FILTERED);
}

static void sample_swizzled(const struct rhw_binding_data *binding, const struct rhw_sample_request *request,
                            rhw_float texel[4])
{
    const struct rhw_kernels *const kernels = binding->kernels;
    rhw_sample_function *const own_offset = is_anisotropic(binding->texture, binding->sampler)
                                                ? kernels->sample_anisotropic
                                                : kernels->sample_general;
    (request->offset ? own_offset : binding->own)(binding, request, texel);
    rhw_swizzle_texel(binding->texture, texel);
}

// Return true for a texture of one float a texel, of which no level but the first is read.
static bool is_shadow_map(const struct rhw_texture_data *texture, const struct rhw_sampler_data *sampler)
{
    return texture->info->codec == RHW_CODEC_FLOAT32 && texture->info->channels == 1 &&
           texture->info->size == 4 &&
           (texture->levels == 1 || sampler->def.mip_filter == RHW_MIP_FILTER_NONE);
}

static bool has_halves(const struct rhw_texture_data *texture)
{
    return texture->info->codec == RHW_CODEC_FLOAT16 && texture->info->channels != 1;
}

struct rhw_binding_data rhw_binding_of(const struct rhw_kernels *kernels, enum rhw_paths paths,
                                       const struct rhw_texture_data *texture,
                                       const struct rhw_sampler_data *sampler)
{
    if (texture && texture->samples > 1) {
        return (struct rhw_binding_data){.sample = kernels->sample_float,
                                         .sample_offset = kernels->sample_float,
                                         .multisampled = texture,
                                         .kernels = kernels,
                                         .kind = RHW_BINDING_MULTISAMPLED,
                                         .paths = (uint8_t)paths};
    }
    const bool special = paths != RHW_PATHS_GENERAL;
    const bool fixed =
        texture && texture->is_plain && sampler->filters_fixed && texture->info->path != RHW_TEXELS_GENERAL;
    const bool anisotropic = texture && is_anisotropic(texture, sampler);
    struct rhw_binding_data binding = {.sample = kernels->sample_float,
                                       .sample_offset = kernels->sample_general,
                                       .texture = texture,
                                       .sampler = sampler,
                                       .kernels = kernels,
                                       .kind = RHW_BINDING_SAMPLED,
                                       .paths = (uint8_t)paths};
    if (texture && (!texture->is_plain || sampler->is_general)) {
        binding.sample = kernels->sample_general;
    } else if (fixed && texture->info->path == RHW_TEXELS_RGBA8_UNORM) {
        binding.sample = special ? kernels->sample_unorm8 : kernels->sample_unorm8_general;
    } else if (fixed) {
        binding.sample = special ? kernels->sample_srgb8 : kernels->sample_srgb8_general;
    } else if (texture && special && sampler->filters_compared && is_shadow_map(texture, sampler)) {
        binding.sample = kernels->sample_compared;
        binding.compares_windows = !anisotropic;
    } else if (texture && special && sampler->filters_plainly && has_halves(texture)) {
        binding.sample = kernels->sample_halves;
    }
    if (!texture) {
        binding.sample_offset = kernels->sample_float;
    } else if (anisotropic) {
        binding.isotropic = binding.sample;
        binding.sample = binding.sample_offset = kernels->sample_anisotropic;
        if (fixed) {
            binding.sample =
                special ? kernels->sample_fixed_anisotropic : kernels->sample_fixed_anisotropic_general;
        }
    }
    binding.shares_footprints = fixed && special && !anisotropic;
    if (texture && texture->swizzles) {
        binding.own = binding.sample;
        binding.sample = binding.sample_offset = sample_swizzled;
        binding.shares_footprints = false;
        binding.compares_windows = false;
    }
    return binding;
}

void rhw_bindings_init(struct rhw_bindings *bindings, const struct rhw_kernels *kernels)
{
    *bindings =
        (struct rhw_bindings){.kernels = kernels, .storage = &rhw_no_storage, .slot_count = RHW_MAX_TEXTURES};
    const struct rhw_binding_data none = rhw_binding_of(kernels, RHW_PATHS_ALL, NULL, NULL);
    for (int i = 0; i < RHW_MAX_TEXTURES; i++) {
        bindings->slot[i] = none;
    }
}
