// SPDX-License-Identifier: MIT
// Textures with their samplers are set here, and become the bindings of a draw.
#include "pass_texture.h"

#include "binding/binding.h"
#include "context/context.h"
#include "context/entry.h"
#include "format/format.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "feedback_loop.h"
#include "encoder.h"
#include "pass_storage.h"
#include "rhw/rhw.h"
#include "resource/sampler.h"
#include "resource/srgb_texture.h"
#include "resource/shared_texels.h"

static bool check_sampled(const struct rhw_encoder *encoder, rhw_texture id, int slot, const char *where)
{
    const rhw_context *const context = encoder->context;
    const struct rhw_texture_data *const texture = rhw_context_texture(context, id, where);
    return texture &&
           rhw_check(context, rhw_format_has_role(texture->info, RHW_ROLE_SAMPLED),
                     "%s: %s is %s; it cannot be sampled", where,
                     rhw_name_of(&context->textures, id.index).text, texture->info->name) &&
           rhw_check(context, !rhw_pass_draws_into(encoder, texture, rhw_all_levels(texture)),
                     "%s: %s, for slot %d, is an attachment of this pass, or has a level and layer of one; "
                     "sample a view of others",
                     where, rhw_name_of(&context->textures, id.index).text, slot) &&
           rhw_check(context, !rhw_pass_stores_texture(encoder, texture, rhw_all_levels(texture)),
                     "%s: %s, for slot %d, is a storage image of this pass, or has a level and layer of one; "
                     "sample a view of others",
                     where, rhw_name_of(&context->textures, id.index).text, slot);
}

// Return true if a sampler gives texels as they are.
static bool takes_texels(const struct rhw_texture_data *texture, const struct rhw_sampler_data *sampler)
{
    const struct rhw_sampler_def *const def = &sampler->def;
    return def->min_filter == RHW_FILTER_NEAREST && def->mag_filter == RHW_FILTER_NEAREST &&
           (def->mip_filter != RHW_MIP_FILTER_LINEAR || texture->levels == 1) && !def->compares &&
           def->max_anisotropy <= 1 && def->reduction == RHW_REDUCTION_AVERAGE;
}

// Check that a sampler fits a texture. Formats that cannot be filtered need a sampler that gives texels as they are.
// Coordinates in texels need a single 1D or 2D image (Vulkan 1.3, VkSamplerCreateInfo).
static bool check_sampler(const rhw_context *context, rhw_texture id, rhw_sampler sampler_id,
                          const struct rhw_sampler_data *sampler, const char *where)
{
    const struct rhw_texture_data *const texture = rhw_context_texture(context, id, where);
    const struct rhw_texture_shape *const shape = &texture->shape;
    return rhw_check(context,
                     rhw_format_has_role(texture->info, RHW_ROLE_FILTERED) || takes_texels(texture, sampler),
                     "%s: %s is %s, which is not filtered; %s must have nearest filters, and no comparison, "
                     "anisotropy or reduction",
                     where, rhw_name_of(&context->textures, id.index).text, texture->info->name,
                     rhw_name_of(&context->samplers, sampler_id.index).text) &&
           rhw_check(context,
                     !sampler->def.unnormalized || (!shape->is_array && (shape->kind == RHW_TEXTURE_1D ||
                                                                         shape->kind == RHW_TEXTURE_2D)),
                     "%s: %s is unnormalized and %s has kind %d, layers %d; it must be 1D or 2D and no array",
                     where, rhw_name_of(&context->samplers, sampler_id.index).text,
                     rhw_name_of(&context->textures, id.index).text, (int)shape->kind, shape->layers);
}

// Make the linear copy of an sRGB texture that is sampled. Textures with several samples need none, because they are
// not filtered. Return false when out of memory.
static bool linearize(struct rhw_context *context, struct rhw_texture_data *texture)
{
    return texture->samples > 1 || rhw_texture_linearize(context, texture);
}

static void set_texture(struct rhw_encoder *encoder, int slot, rhw_texture texture, rhw_sampler sampler)
{
    static const char *const where = "rhw_pass_set_texture";
    rhw_context *const context = encoder->context;
    struct rhw_bound_texture bound = {NULL, NULL};
    if (!rhw_check(context, slot >= 0 && slot < RHW_MAX_TEXTURES, "%s: slot is %d; it is in 0..%d", where,
                   slot, RHW_MAX_TEXTURES - 1)) {
        return;
    }
    if (texture.index != 0) {
        bound.sampler = check_sampled(encoder, texture, slot, where)
                            ? rhw_context_sampler(context, sampler, where)
                            : NULL;
        if (!bound.sampler || !check_sampler(context, texture, sampler, bound.sampler, where)) {
            return;
        }
        bound.texture = rhw_pool_get(&context->textures, texture.index, texture.generation);
        rhw_texture_note_sampled(*bound.texture, context->recording.generation);
        encoder->out_of_memory |=
            !rhw_pass_note_read(encoder, bound.texture, rhw_all_levels(*bound.texture)) ||
            !linearize(context, *bound.texture);
        rhw_pool_use(&context->textures, texture.index, context->recording.generation);
        rhw_pool_use(&context->samplers, sampler.index, context->recording.generation);
    }
    struct rhw_bound_texture *const current = &encoder->bound.textures[slot];
    encoder->textures_changed |= current->texture != bound.texture || current->sampler != bound.sampler;
    *current = bound;
}

void rhw_pass_set_texture(rhw_context *context, rhw_pass id, int slot, rhw_texture texture,
                          rhw_sampler sampler)
{
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, "rhw_pass_set_texture");
    if (encoder) {
        set_texture(encoder, slot, texture, sampler);
        rhw_context_leave(context);
    }
}

bool rhw_pass_resolve_textures(struct rhw_encoder *encoder)
{
    struct rhw_context *const context = encoder->context;
    struct rhw_bindings *const bindings =
        rhw_arena_alloc(&encoder->pass->arena, sizeof *bindings, RHW_CACHE_LINE);
    if (!bindings) {
        return false;
    }
    rhw_bindings_init(bindings, context->kernels);
    for (int i = 0; i < RHW_MAX_TEXTURES; i++) {
        const struct rhw_bound_texture *const bound = &encoder->bound.textures[i];
        if (bound->texture) {
            if (!linearize(context, *bound->texture)) {
                return false;
            }
            bindings->slot[i] =
                rhw_binding_of(context->kernels, context->paths, *bound->texture, bound->sampler);
        }
    }
    bindings->storage = rhw_pass_storage_of(encoder);
    encoder->pending.bindings = bindings;
    return bindings->storage != NULL;
}
