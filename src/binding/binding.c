// SPDX-License-Identifier: MIT
// This chooses which of the kernels' functions samples a texture, once, when the texture is bound. The sampling
// functions that shaders call stand here too, and call what was chosen.
#include "binding.h"

#include "format/format.h"
#include "resource/sampler.h"
#include "resource/texture.h"
#include "binding/validation/validation.h"

#include <string.h>

// Return what a constant channel has. Integer formats have the bits of 0 and 1.
static rhw_float constant_channel(const struct rhw_texture_data *texture, enum rhw_swizzle swizzle)
{
    if (swizzle == RHW_SWIZZLE_ZERO) {
        return rhw_splat(0);
    }
    return rhw_format_is_integer(texture->info) ? rhw_float_from_bits(rhw_splat_int(1)) : rhw_splat(1);
}

static bool is_constant(enum rhw_swizzle swizzle)
{
    return swizzle == RHW_SWIZZLE_ZERO || swizzle == RHW_SWIZZLE_ONE;
}

// Return the channel that a view reads as channel `c`.
static int swizzled_channel(const struct rhw_texture_data *texture, int c)
{
    const enum rhw_swizzle swizzle = texture->swizzle[c];
    return swizzle == RHW_SWIZZLE_IDENTITY ? c : (int)swizzle - (int)RHW_SWIZZLE_RED;
}

// Put the channels of a view in its order (Vulkan 1.3, "Component Swizzle"). Filters mix each channel by itself, so
// that the order does not matter to them.
static void swizzle(const struct rhw_texture_data *texture, rhw_float texel[4])
{
    const rhw_float own[4] = {texel[0], texel[1], texel[2], texel[3]};
    for (int c = 0; texture->swizzles && c < 4; c++) {
        texel[c] = is_constant(texture->swizzle[c]) ? constant_channel(texture, texture->swizzle[c])
                                                    : own[swizzled_channel(texture, c)];
    }
}

static void sample_swizzled(const struct rhw_binding *binding, const struct rhw_sample_request *request,
                            rhw_float texel[4])
{
    (request->offset ? binding->own_offset : binding->own)(binding, request, texel);
    swizzle(binding->texture, texel);
}

// Return true for a texture of one float a texel, of which no level but the first is read.
static bool is_shadow_map(const struct rhw_texture_data *texture, const struct rhw_sampler_data *sampler)
{
    return texture->info->codec == RHW_CODEC_FLOAT32 && texture->info->channels == 1 &&
           texture->info->size == 4 &&
           (texture->levels == 1 || sampler->def.mip_filter == RHW_MIP_FILTER_NONE);
}

static bool has_four_halves(const struct rhw_texture_data *texture)
{
    return texture->info->codec == RHW_CODEC_FLOAT16 && texture->info->channels == 4;
}

struct rhw_binding rhw_binding_of(const struct rhw_kernels *kernels, enum rhw_paths paths,
                                  const struct rhw_texture_data *texture,
                                  const struct rhw_sampler_data *sampler)
{
    const struct rhw_texture_data *const multisampled = texture && texture->samples > 1 ? texture : NULL;
    texture = multisampled ? NULL : texture;
    const bool special = paths != RHW_PATHS_GENERAL;
    const bool fixed =
        texture && texture->is_plain && sampler->filters_fixed && texture->info->path != RHW_TEXELS_GENERAL;
    const bool anisotropic = texture && sampler->def.max_anisotropy > 1;
    struct rhw_binding binding = {.sample = kernels->sample_float,
                                  .sample_offset = kernels->sample_general,
                                  .general = kernels->sample_general,
                                  .texture = texture,
                                  .sampler = sampler,
                                  .multisampled = multisampled};
    if (texture && (!texture->is_plain || sampler->is_general)) {
        binding.sample = kernels->sample_general;
    } else if (fixed && texture->info->path == RHW_TEXELS_RGBA8_UNORM) {
        binding.sample = special ? kernels->sample_unorm8 : kernels->sample_unorm8_general;
    } else if (fixed) {
        binding.sample = special ? kernels->sample_srgb8 : kernels->sample_srgb8_general;
    } else if (texture && special && sampler->filters_compared && is_shadow_map(texture, sampler)) {
        binding.sample = kernels->sample_compared;
        binding.compare_window = anisotropic ? NULL : kernels->compare_window;
    } else if (texture && special && sampler->filters_plainly && has_four_halves(texture)) {
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
        binding.own_offset = binding.sample_offset;
        binding.sample = binding.sample_offset = sample_swizzled;
        binding.shares_footprints = false;
        binding.compare_window = NULL;
    }
    return binding;
}

void rhw_bindings_init(struct rhw_bindings *bindings, const struct rhw_kernels *kernels)
{
    *bindings = (struct rhw_bindings){.kernels = kernels, .storage = &rhw_no_storage};
    const struct rhw_binding none = rhw_binding_of(kernels, RHW_PATHS_ALL, NULL, NULL);
    for (int i = 0; i < RHW_MAX_TEXTURES; i++) {
        bindings->slot[i] = none;
    }
}

static void no_texel(rhw_float texel[4])
{
    texel[0] = texel[1] = texel[2] = rhw_splat(0);
    texel[3] = rhw_splat(1);
}

void rhw_sample(const struct rhw_bindings *bindings, int slot, const struct rhw_sample_request *request,
                rhw_float texel[4])
{
    if (bindings->site.validation) {
        rhw_validate_sample(bindings, slot, request);
    }
    // No slot has this number: it reads as a slot that nothing is bound to.
    if ((unsigned)slot >= RHW_MAX_TEXTURES) {
        no_texel(texel);
        return;
    }
    const struct rhw_binding *const binding = &bindings->slot[slot];
    if (((uintptr_t)request->bias | (uintptr_t)request->offset) == 0) {
        binding->sample(binding, request, texel);
    } else if (request->bias && binding->texture) {
        bindings->kernels->sample_biased(binding, request, texel);
    } else if (request->offset) {
        binding->sample_offset(binding, request, texel);
    } else {
        binding->sample(binding, request, texel);
    }
}

// Compare the columns of a window's footprints one by one.
static void compare_columns(const struct rhw_bindings *bindings, const struct rhw_binding *binding,
                            const struct rhw_sample_request *request, int column, int columns, int rows,
                            int stride, rhw_float *parts)
{
    struct rhw_sample_request shifted = *request;
    rhw_int offset[3] = {rhw_splat_int(0), rhw_splat_int(0), rhw_splat_int(0)}, first[3];
    const int axes = rhw_texture_components(binding->texture->shape.kind);
    for (int i = 0; request->offset && i < axes; i++) {
        offset[i] = request->offset[i];
    }
    memcpy(first, offset, sizeof first);
    shifted.offset = offset;
    for (int row = 0; row < rows; row++) {
        offset[1] = first[1] + row;
        for (int i = 0; i < columns; i++) {
            rhw_float texel[4];
            offset[0] = first[0] + (column + i);
            if (request->bias) {
                bindings->kernels->sample_biased(binding, &shifted, texel);
            } else {
                binding->sample_offset(binding, &shifted, texel);
            }
            parts[row * stride + i] = texel[0];
        }
    }
}

void rhw_sample_compare_window(const struct rhw_bindings *bindings, int slot,
                               const struct rhw_sample_request *request, int columns, int rows,
                               rhw_float *parts)
{
    if (bindings->site.validation) {
        rhw_validate_sample(bindings, slot, request);
    }
    const bool is_bound = (unsigned)slot < RHW_MAX_TEXTURES && bindings->slot[slot].texture;
    const struct rhw_binding *const binding = is_bound ? &bindings->slot[slot] : NULL;
    for (int i = 0; !binding && i < columns * rows; i++) {
        parts[i] = rhw_splat(0);
    }
    for (int column = 0; binding && column < columns; column += RHW_WINDOW_COLUMNS) {
        const int count = columns - column < RHW_WINDOW_COLUMNS ? columns - column : RHW_WINDOW_COLUMNS;
        if (request->bias || !binding->compare_window ||
            !binding->compare_window(binding, request, column, count, rows, columns, parts + column)) {
            compare_columns(bindings, binding, request, column, count, rows, columns, parts + column);
        }
    }
}

// Return the slot. Return NULL where it has no texture or does not exist.
static const struct rhw_binding *bound_slot(const struct rhw_bindings *bindings, int slot)
{
    if (bindings->site.validation) {
        rhw_validate_slot(bindings, slot);
    }
    return (unsigned)slot < RHW_MAX_TEXTURES && bindings->slot[slot].texture ? &bindings->slot[slot] : NULL;
}

void rhw_sample_gather(const struct rhw_bindings *bindings, int slot,
                       const struct rhw_sample_request *request, int channel, rhw_float texel[4])
{
    const struct rhw_binding *const binding = bound_slot(bindings, slot);
    if (binding && bindings->site.validation) {
        rhw_validate_reference(bindings, slot, request);
    }
    if (binding && channel >= 0 && channel < 4 && is_constant(binding->texture->swizzle[channel])) {
        texel[0] = constant_channel(binding->texture, binding->texture->swizzle[channel]);
        texel[1] = texel[2] = texel[3] = texel[0];
    } else if (binding && channel >= 0 && channel < 4) {
        bindings->kernels->gather(binding, request, swizzled_channel(binding->texture, channel), texel);
    } else {
        texel[0] = texel[1] = texel[2] = texel[3] = rhw_splat(channel == 3 ? 1.0f : 0.0f);
    }
}

void rhw_sample_fetch(const struct rhw_bindings *bindings, int slot, const rhw_int *at, const rhw_int *level,
                      rhw_float texel[4])
{
    const struct rhw_binding *const binding = bound_slot(bindings, slot);
    if (binding) {
        bindings->kernels->fetch(binding, at, level, texel);
        swizzle(binding->texture, texel);
    } else {
        no_texel(texel);
    }
}

void rhw_sample_fetch_sample(const struct rhw_bindings *bindings, int slot, const rhw_int *at,
                             const rhw_int *sample, rhw_float texel[4])
{
    if (bindings->site.validation) {
        rhw_validate_samples(bindings, slot);
    }
    if ((unsigned)slot < RHW_MAX_TEXTURES && bindings->slot[slot].multisampled) {
        bindings->kernels->fetch_sample(bindings->slot[slot].multisampled, at, sample, texel);
        swizzle(bindings->slot[slot].multisampled, texel);
    } else {
        no_texel(texel);
    }
}

void rhw_sample_query_lod(const struct rhw_bindings *bindings, int slot,
                          const struct rhw_sample_request *request, rhw_float lod[2])
{
    const struct rhw_binding *const binding = bound_slot(bindings, slot);
    lod[0] = lod[1] = rhw_splat(0);
    if (binding) {
        bindings->kernels->query_level(binding, request, lod);
    }
}

// Return the texture of a slot, of one sample or more. Return NULL where the slot has none or does not exist.
static const struct rhw_texture_data *any_texture(const struct rhw_bindings *bindings, int slot)
{
    if ((unsigned)slot < RHW_MAX_TEXTURES && bindings->slot[slot].multisampled) {
        return bindings->slot[slot].multisampled;
    }
    const struct rhw_binding *const binding = bound_slot(bindings, slot);
    return binding ? binding->texture : NULL;
}

void rhw_sample_size(const struct rhw_bindings *bindings, int slot, const rhw_int *level, rhw_int size[3])
{
    const struct rhw_binding any = {.texture = any_texture(bindings, slot)};
    size[0] = size[1] = size[2] = rhw_splat_int(0);
    if (any.texture) {
        bindings->kernels->query_size(&any, level, size);
    }
}

int rhw_sample_levels(const struct rhw_bindings *bindings, int slot)
{
    const struct rhw_texture_data *const texture = any_texture(bindings, slot);
    return texture ? texture->levels : 0;
}

int rhw_sample_samples(const struct rhw_bindings *bindings, int slot)
{
    const struct rhw_texture_data *const texture = any_texture(bindings, slot);
    return texture ? texture->samples : 0;
}

_Static_assert(RHW_MAX_TEXTURES == 32, "a bit of `slots` for each");

void rhw_sample_groups(const struct rhw_fragment *groups, int count, uint32_t slots, int at,
                       rhw_float (*texels)[4], int stride)
{
    if (groups->bindings->site.validation && !rhw_validate_sample_groups(groups, count, slots, at, stride)) {
        return;
    }
    if (slots != 0) {
        groups->bindings->kernels->sample_groups(groups, count, slots, at, texels, stride);
    }
}
