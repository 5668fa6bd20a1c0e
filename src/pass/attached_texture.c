// SPDX-License-Identifier: MIT
// A texture is checked and taken as an attachment of a pass.
#include "attached_texture.h"

#include <stdio.h>

#include "context/context.h"
#include "format/format.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "feedback_loop.h"
#include "encoder.h"
#include "resource/shared_texels.h"

static const char *const where = "rhw_pass_begin";

static struct rhw_name name_of(const rhw_context *context, rhw_texture id)
{
    return rhw_name_of(&context->textures, id.index);
}

const struct rhw_mip *rhw_stencil_aspect_of(const struct rhw_mip *mip, struct rhw_mip *aspect)
{
    if (!mip) {
        return NULL;
    }
    *aspect = *mip;
    rhw_mip_take_stencil(aspect);
    return aspect;
}

// Return true if an earlier attachment draws into the level's texels, or into their stencil.
static bool is_attached(const struct rhw_encoder *encoder, const struct rhw_mip *mip, int layer)
{
    const struct rhw_target *const target = &encoder->pass->target;
    struct rhw_mip aspect;
    return rhw_pass_attaches(encoder, rhw_texel_range_of(mip, layer, target->layers)) ||
           (mip->stencil && rhw_pass_attaches(encoder, rhw_texel_range_of(rhw_stencil_aspect_of(mip, &aspect),
                                                                          layer, target->layers)));
}

// Check the size of a level that is attached. A pass that names its size draws into a part of larger levels (Vulkan
// 1.3, VkFramebufferCreateInfo). A pass that takes its size from the first attachment has only attachments of that
// size, because any other size is likely a mistake.
static bool check_size(const struct rhw_encoder *encoder, rhw_texture id, const char *name,
                       struct rhw_attached_part part, const struct rhw_mip *mip)
{
    const struct rhw_target *const target = &encoder->pass->target;
    const bool fits = encoder->names_size ? mip->width >= target->width && mip->height >= target->height
                                          : mip->width == target->width && mip->height == target->height;
    return rhw_check(encoder->context, fits, "%s: %s is %s, whose level %d is %dx%d; the pass is %dx%d%s",
                     where, name, name_of(encoder->context, id).text, part.level, mip->width, mip->height,
                     target->width, target->height,
                     encoder->names_size
                         ? ", and each is at least as large"
                         : " as its first attachment; set width and height for a part of larger ones");
}

// Check the texture of an attachment against the pass and the earlier attachments. The first attachment gives the pass
// its size, where it has none.
static bool check_texture(struct rhw_encoder *encoder, rhw_texture id, const struct rhw_texture_data *texture,
                          const char *name, struct rhw_attached_part part)
{
    struct rhw_target *const target = &encoder->pass->target;
    rhw_context *const context = encoder->context;
    if (!rhw_check(context, part.level >= 0 && part.level < texture->levels,
                   "%s: %s.level is %d; %s has levels 0..%d", where, name, part.level,
                   name_of(context, id).text, texture->levels - 1)) {
        return false;
    }
    const struct rhw_mip *const mip = &texture->mip[part.level];
    const int layer = part.layer;
    if (target->width == 0) {
        target->width = mip->width;
        target->height = mip->height;
    }
    return rhw_check(context, part.layer_count == target->layers,
                     "%s: %s.layer_count is %d; the first attachment has %d", where, name, part.layer_count,
                     target->layers) &&
           rhw_check(context, layer >= 0 && layer < mip->slices,
                     "%s: %s.layer is %d; level %d of %s has 0..%d", where, name, layer, part.level,
                     name_of(context, id).text, mip->slices - 1) &&
           rhw_check(context, target->layers <= mip->slices - layer,
                     "%s: %s has %d layers from %d on; level %d of %s has 0..%d", where, name, target->layers,
                     layer, part.level, name_of(context, id).text, mip->slices - 1) &&
           rhw_check(context, !texture->swizzles,
                     "%s: %s is %s, a view with a swizzle; attachments have none", where, name,
                     name_of(context, id).text) &&
           rhw_check(context, !is_attached(encoder, mip, layer),
                     "%s: %s is %s, as another attachment is; each needs its own texture or layer", where,
                     name, name_of(context, id).text) &&
           check_size(encoder, id, name, part, mip);
}

// Check that a texture has as many samples as the pass, or one sample, into which the pass can be resolved.
static bool check_attached_samples(const struct rhw_encoder *encoder, rhw_texture id,
                                   const struct rhw_texture_data *texture, const char *name)
{
    const int samples = encoder->pass->target.pattern->count;
    return rhw_check(encoder->context, texture->samples == samples || texture->samples == 1,
                     "%s: %s is %s, which has %d samples; the pass has %d", where, name,
                     name_of(encoder->context, id).text, texture->samples, samples);
}

bool rhw_attached_part_take(struct rhw_context *context, const struct rhw_target *target,
                            struct rhw_texture_data *texture, struct rhw_attached_part part,
                            struct rhw_clean_tiles **clean)
{
    const struct rhw_mip *const mip = &texture->mip[part.level];
    rhw_texture_note_attached(texture, context->recording.generation);
    texture->written |= 1u << part.level;
    *clean = NULL;
    if (target->layers > 1 || mip->width != target->width || mip->height != target->height) {
        rhw_clean_tiles_forget(texture->clean);
        return true;
    }
    *clean = rhw_clean_tiles_of_part(&context->memory, &texture->clean, part.layer, part.level, mip->width,
                                     mip->height);
    return *clean != NULL;
}

// Make a recording take a part of a texture whenever it runs. Return false when out of memory.
static bool take_when_run(struct rhw_encoder *encoder, rhw_texture id, struct rhw_attached_part part,
                          struct rhw_clean_tiles **clean)
{
    struct rhw_clean_part *const taken =
        rhw_arena_alloc(&encoder->pass->arena, sizeof *taken, _Alignof(struct rhw_clean_part));
    if (taken) {
        *taken = (struct rhw_clean_part){encoder->clean_parts,
                                         rhw_pool_item(&encoder->context->textures, id.index), part, clean};
        encoder->clean_parts = taken;
    }
    return taken != NULL;
}

// Take a part of a texture, whose record of clean tiles is given in `clean`. Return false when out of memory.
static bool take(struct rhw_encoder *encoder, rhw_texture id, struct rhw_texture_data *texture,
                 struct rhw_attached_part part, struct rhw_clean_tiles **clean)
{
    struct rhw_context *const context = encoder->context;
    rhw_encoder_note_use(encoder, &context->textures, id.index, texture->moves);
    return context->uses ? take_when_run(encoder, id, part, clean)
                         : rhw_attached_part_take(context, &encoder->pass->target, texture, part, clean);
}

// Return the texture of the attachment `name`. Report misuse and return NULL when there is none.
static struct rhw_texture_data *find_texture(const rhw_context *context, rhw_texture id, const char *name)
{
    char whose[64];
    snprintf(whose, sizeof whose, "%s: %s.texture", where, name);
    return rhw_context_texture(context, id, whose);
}

enum rhw_result rhw_pass_attach_texture(struct rhw_encoder *encoder, rhw_texture id,
                                        struct rhw_attached_part part, const char *name,
                                        struct rhw_attachment *attachment)
{
    struct rhw_context *const context = encoder->context;
    struct rhw_texture_data *const texture = find_texture(context, id, name);
    if (!texture) {
        return RHW_ERROR_MISUSE;
    }
    if (!check_texture(encoder, id, texture, name, part) ||
        !check_attached_samples(encoder, id, texture, name)) {
        return RHW_ERROR_MISUSE;
    }
    attachment->layer = part.layer;
    attachment->level = part.level;
    attachment->format = texture->format;
    attachment->texel_size = rhw_format_size(texture->format);
    attachment->loads_resolved = texture->samples != encoder->pass->target.pattern->count;
    if (attachment->loads_resolved) {
        attachment->resolve = &texture->mip[part.level];
        attachment->resolve_format = texture->format;
    } else {
        attachment->target = &texture->mip[part.level];
        attachment->sample_stride = texture->samples > 1 ? texture->sample_stride : 0;
    }
    struct rhw_clean_tiles **const clean =
        attachment->loads_resolved ? &attachment->resolve_clean : &attachment->clean;
    return take(encoder, id, texture, part, clean) ? RHW_OK : RHW_ERROR_OUT_OF_MEMORY;
}

// Return true if samples of one format are resolved into another: into the same one, or into that of one aspect.
static bool resolves_into(const struct rhw_format_info *from, const struct rhw_format_info *to)
{
    const int depth = RHW_ROLE_DEPTH_TARGET, stencil = RHW_ROLE_STENCIL_TARGET;
    const bool is_depth = rhw_format_has_role(to, depth) && to->codec == from->codec;
    const bool is_stencil = rhw_format_has_role(to, stencil) && !rhw_format_has_role(to, depth);
    const bool has_both = rhw_format_has_role(from, depth) && rhw_format_has_role(from, stencil);
    return from == to || (has_both && (is_depth || is_stencil));
}

enum rhw_result rhw_pass_attach_resolve(struct rhw_encoder *encoder, rhw_texture id, const char *name,
                                        struct rhw_attachment *attachment)
{
    const struct rhw_target *const target = &encoder->pass->target;
    struct rhw_context *const context = encoder->context;
    char member[32];
    snprintf(member, sizeof member, "%s.resolve", name);
    const struct rhw_attached_part part = {attachment->layer, attachment->level, target->layers};
    struct rhw_texture_data *const texture = rhw_context_texture(context, id, where);
    if (!texture || !check_texture(encoder, id, texture, member, part) ||
        !rhw_check(context, !attachment->loads_resolved && target->pattern->count > 1,
                   "%s: %s is set and %s.texture has one sample; it must be null then", where, member,
                   name) ||
        !rhw_check(context,
                   texture->samples == 1 &&
                       resolves_into(rhw_format_info(attachment->format), rhw_format_info(texture->format)),
                   "%s: %s is %s, which is %s with %d samples; it must be %s with one", where, member,
                   name_of(context, id).text, rhw_format_info(texture->format)->name, texture->samples,
                   rhw_format_info(attachment->format)->name)) {
        return RHW_ERROR_MISUSE;
    }
    attachment->resolve = &texture->mip[part.level];
    attachment->resolve_format = texture->format;
    return take(encoder, id, texture, part, &attachment->resolve_clean) ? RHW_OK : RHW_ERROR_OUT_OF_MEMORY;
}
