// SPDX-License-Identifier: MIT
// The rules about what may be bound, to a slot or in a binding.
#include "binding_check.h"

#include "context/context.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "format/format.h"
#include "resource/sampler.h"
#include "resource/texture.h"

bool rhw_binding_check_texture(const struct rhw_context *context, rhw_texture id,
                               const struct rhw_texture_data *texture, const char *where)
{
    return rhw_check(context, rhw_format_has_role(texture->info, RHW_ROLE_SAMPLED),
                     "%s: %s is %s; it cannot be sampled", where,
                     rhw_name_of(&context->textures, id.index).text, texture->info->name);
}

// Return true if a sampler gives texels as they are. Anisotropy only weighs what is filtered.
static bool takes_texels(const struct rhw_texture_data *texture, const struct rhw_sampler_data *sampler)
{
    const struct rhw_sampler_def *const def = &sampler->def;
    return def->min_filter == RHW_FILTER_NEAREST && def->mag_filter == RHW_FILTER_NEAREST &&
           (def->mip_filter != RHW_MIP_FILTER_LINEAR || texture->levels == 1) && !def->compares &&
           def->reduction == RHW_REDUCTION_AVERAGE;
}

// Return true if the sampler does to the texels what their format allows. Formats that cannot be filtered need a
// sampler that gives texels as they are.
static bool filters_fit(const struct rhw_texture_data *texture, const struct rhw_sampler_data *sampler)
{
    return rhw_format_has_role(texture->info, RHW_ROLE_FILTERED) || takes_texels(texture, sampler);
}

// Return true if the texture has the sampler's coordinates. Coordinates in texels need a single 1D or 2D image
// (Vulkan 1.3, VkSamplerCreateInfo).
static bool coordinates_fit(const struct rhw_texture_data *texture, const struct rhw_sampler_data *sampler)
{
    const struct rhw_texture_shape *const shape = &texture->shape;
    const bool is_flat = shape->kind == RHW_TEXTURE_1D || shape->kind == RHW_TEXTURE_2D;
    return !sampler->def.unnormalized || (!shape->is_array && is_flat);
}

bool rhw_sampler_fits(const struct rhw_texture_data *texture, const struct rhw_sampler_data *sampler)
{
    return filters_fit(texture, sampler) && coordinates_fit(texture, sampler);
}

bool rhw_binding_check_sampler(const rhw_context *context, rhw_texture id, rhw_sampler sampler_id,
                               const struct rhw_sampler_data *sampler, const char *where)
{
    const struct rhw_texture_data *const texture = rhw_context_texture(context, id, where);
    const struct rhw_texture_shape *const shape = &texture->shape;
    return rhw_check(context, filters_fit(texture, sampler),
                     "%s: %s is %s, which is not filtered; %s must have nearest filters, and no comparison "
                     "or reduction",
                     where, rhw_name_of(&context->textures, id.index).text, texture->info->name,
                     rhw_name_of(&context->samplers, sampler_id.index).text) &&
           rhw_check(context, coordinates_fit(texture, sampler),
                     "%s: %s is unnormalized and %s has kind %d, layers %d; it must be 1D or 2D and no array",
                     where, rhw_name_of(&context->samplers, sampler_id.index).text,
                     rhw_name_of(&context->textures, id.index).text, (int)shape->kind, shape->layers);
}

bool rhw_binding_check_image(const struct rhw_context *context, rhw_texture id,
                             const struct rhw_texture_data *texture, int level, const char *where)
{
    return rhw_check(context, level >= 0 && level < texture->levels, "%s: level is %d; %s has levels 0..%d",
                     where, level, rhw_name_of(&context->textures, id.index).text, texture->levels - 1) &&
           rhw_check(context,
                     texture->info == rhw_format_info(texture->format) &&
                         rhw_format_has_role(texture->info, RHW_ROLE_COLOR_TARGET),
                     "%s: %s is %s; it must be a format that can be drawn into as colour", where,
                     rhw_name_of(&context->textures, id.index).text,
                     rhw_format_info(texture->format)->name) &&
           rhw_check(context, !texture->swizzles, "%s: %s is a view that swizzles; it must not", where,
                     rhw_name_of(&context->textures, id.index).text) &&
           rhw_check(context, texture->samples == 1, "%s: %s has %d samples; it must have one", where,
                     rhw_name_of(&context->textures, id.index).text, texture->samples);
}

bool rhw_format_has_texels(enum rhw_format format)
{
    const struct rhw_format_info *const info = rhw_format_info(format);
    return rhw_format_decoded(format) == format && info->codec != RHW_CODEC_NONE &&
           !rhw_format_has_role(info, RHW_ROLE_DEPTH_TARGET | RHW_ROLE_STENCIL_TARGET);
}

bool rhw_binding_check_texels(const struct rhw_context *context, enum rhw_format format, size_t offset,
                              const char *where)
{
    if (!rhw_check_format(context, where, "format", format)) {
        return false;
    }
    const struct rhw_format_info *const info = rhw_format_info(format);
    return rhw_check(context, rhw_format_has_texels(format),
                     "%s: format is %s; it must be of colour, and not compressed", where, info->name) &&
           rhw_check(context, offset % info->size == 0,
                     "%s: offset is %zu; it must be a multiple of the %d bytes of a texel of %s", where,
                     offset, info->size, info->name);
}
