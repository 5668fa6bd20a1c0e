// SPDX-License-Identifier: MIT
// Bindings of textures, samplers and images in memory of the program.
#include "binding.h"
#include "bind_entry.h"
#include "binding_check.h"
#include "context/context.h"
#include "context/entry.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "resource/bound_texels.h"
#include "resource/sampler.h"
#include "resource/shared_texels.h"
#include "resource/texture.h"

static enum rhw_result bind_texture(struct rhw_context *context, rhw_texture id, rhw_sampler sampler_id,
                                    struct rhw_binding *binding, const char *where)
{
    struct rhw_texture_data *const texture = rhw_context_texture(context, id, where);
    const struct rhw_sampler_data *sampler = NULL;
    if (!texture || !rhw_binding_check_texture(context, id, texture, where)) {
        return RHW_ERROR_MISUSE;
    }
    if (sampler_id.index != 0) {
        sampler = rhw_context_sampler(context, sampler_id, where);
        if (!sampler || !rhw_binding_check_sampler(context, id, sampler_id, sampler, where)) {
            return RHW_ERROR_MISUSE;
        }
    }
    const bool is_pinned = rhw_texture_pin(context, id, texture);
    const enum rhw_result result =
        is_pinned ? rhw_texture_note_bound(context, texture) : RHW_ERROR_OUT_OF_MEMORY;
    if (result != RHW_OK) {
        return result;
    }
    const bool is_alone = !sampler && texture->samples == 1;
    const struct rhw_binding_data data =
        is_alone ? (struct rhw_binding_data){.texture = texture,
                                             .kernels = context->kernels,
                                             .kind = RHW_BINDING_TEXTURE,
                                             .paths = (uint8_t)context->paths}
                 : rhw_binding_of(context->kernels, context->paths, texture, sampler);
    rhw_binding_put(&data, binding);
    return RHW_OK;
}

enum rhw_result rhw_binding_of_texture(rhw_context *context, rhw_texture texture, rhw_sampler sampler,
                                       struct rhw_binding *binding)
{
    static const char *const where = "rhw_binding_of_texture";
    if (!rhw_binding_enter(context, binding, where)) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = bind_texture(context, texture, sampler, binding, where);
    rhw_context_leave(context);
    return result;
}

enum rhw_result rhw_binding_of_sampler(rhw_context *context, rhw_sampler sampler, struct rhw_binding *binding)
{
    static const char *const where = "rhw_binding_of_sampler";
    if (!rhw_binding_enter(context, binding, where)) {
        return RHW_ERROR_MISUSE;
    }
    const struct rhw_binding_data data = {.sampler = rhw_context_sampler(context, sampler, where),
                                          .kind = RHW_BINDING_SAMPLER};
    if (data.sampler) {
        rhw_binding_put(&data, binding);
    }
    rhw_context_leave(context);
    return data.sampler ? RHW_OK : RHW_ERROR_MISUSE;
}

static enum rhw_result bind_image(struct rhw_context *context, rhw_texture id, int level, bool is_read_only,
                                  struct rhw_binding *binding, const char *where)
{
    struct rhw_texture_data *const texture = rhw_context_texture(context, id, where);
    if (!texture || !rhw_binding_check_image(context, id, texture, level, where)) {
        return RHW_ERROR_MISUSE;
    }
    if (!rhw_texture_pin(context, id, texture)) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    if (!is_read_only) {
        texture->shared->has_stores = true;
        texture->written |= 1u << level;
        rhw_texture_note_written(texture);
    }
    const struct rhw_binding_data data = {.image = rhw_storage_image_of_level(texture, level, is_read_only),
                                          .kernels = context->kernels,
                                          .kind = RHW_BINDING_IMAGE};
    rhw_binding_put(&data, binding);
    return RHW_OK;
}

enum rhw_result rhw_binding_of_image(rhw_context *context, rhw_texture texture, int level, bool read_only,
                                     struct rhw_binding *binding)
{
    static const char *const where = "rhw_binding_of_image";
    if (!rhw_binding_enter(context, binding, where)) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = bind_image(context, texture, level, read_only, binding, where);
    rhw_context_leave(context);
    return result;
}

bool rhw_binding_of_pair(const struct rhw_binding *texture, const struct rhw_binding *sampler,
                         struct rhw_binding *binding)
{
    const struct rhw_binding_data *const of = rhw_binding_look(texture), *const by =
                                                                             rhw_binding_look(sampler);
    const bool has_texture = of && (of->kind == RHW_BINDING_SAMPLED || of->kind == RHW_BINDING_TEXTURE);
    const bool has_sampler = by && (by->kind == RHW_BINDING_SAMPLED || by->kind == RHW_BINDING_SAMPLER);
    struct rhw_binding_data data = {.kind = RHW_BINDING_EMPTY};
    if (of && of->kind == RHW_BINDING_MULTISAMPLED && has_sampler) {
        data = rhw_sampler_fits(of->multisampled, by->sampler) ? *of : data;
    } else if (has_texture && has_sampler && rhw_sampler_fits(of->texture, by->sampler)) {
        data = rhw_binding_of(of->kernels, (enum rhw_paths)of->paths, of->texture, by->sampler);
    }
    rhw_binding_put(&data, binding);
    return data.kind != RHW_BINDING_EMPTY;
}
