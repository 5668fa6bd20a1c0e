// SPDX-License-Identifier: MIT
// Textures and images that are set stand in two lists, each level once, so that setting a level again costs nothing.
#include "feedback_loop.h"

#include "context/context.h"
#include "encoder.h"
#include "resource/texture_access.h"

struct rhw_read_texture {
    const struct rhw_read_texture *next;
    struct rhw_texture_data *const *item;
    uint32_t levels; // a bit for each level
};

struct rhw_stored_level {
    const struct rhw_stored_level *next;
    struct rhw_texel_range texels;
};

static bool is_in(struct rhw_texel_range texels, const struct rhw_mip *mip, int layer, int layers)
{
    return mip && rhw_texel_ranges_overlap(texels, rhw_texel_range_of(mip, layer, layers));
}

static bool is_in_attachment(const struct rhw_encoder *encoder, const struct rhw_attachment *attachment,
                             struct rhw_texel_range texels)
{
    const struct rhw_target *const target = &encoder->pass->target;
    return is_in(texels, attachment->target, attachment->layer, target->layers) ||
           is_in(texels, attachment->resolve, attachment->layer, target->layers);
}

static bool is_in_color(const struct rhw_encoder *encoder, struct rhw_texel_range texels)
{
    const struct rhw_target *const target = &encoder->pass->target;
    for (int i = 0; i < target->color_count; i++) {
        if (is_in_attachment(encoder, &target->colors[i], texels)) {
            return true;
        }
    }
    return false;
}

bool rhw_pass_attaches(const struct rhw_encoder *encoder, struct rhw_texel_range texels)
{
    struct rhw_target *const target = &encoder->pass->target;
    return is_in_color(encoder, texels) || is_in_attachment(encoder, &target->depth, texels) ||
           is_in_attachment(encoder, &target->stencil, texels);
}

// Return true if the depth attachment, or the stencil attachment, writes some of the texels. A read-only attachment
// writes texels only where it is resolved.
static bool writes(const struct rhw_encoder *encoder, const struct rhw_attachment *attachment,
                   struct rhw_texel_range texels)
{
    return attachment->is_read_only
               ? attachment->resolves &&
                     is_in(texels, attachment->resolve, attachment->layer, encoder->pass->target.layers)
               : is_in_attachment(encoder, attachment, texels);
}

// Return true if the pass draws into some of the texels. A texture of stencil alone is the target of both attachments,
// depth and stencil.
static bool draws_into(const struct rhw_encoder *encoder, struct rhw_texel_range texels)
{
    const struct rhw_target *const target = &encoder->pass->target;
    return is_in_color(encoder, texels) || (target->has_depth && writes(encoder, &target->depth, texels)) ||
           (target->has_stencil && writes(encoder, &target->stencil, texels));
}

static struct rhw_texel_range range_of_level(const struct rhw_texture_data *texture, int level)
{
    const struct rhw_mip *const mip = &texture->mip[level];
    return rhw_texel_range_of(mip, 0, mip->slices);
}

// Return true if the pass may draw into the texture, or into texels that it shares. A recording does not note it in the
// texture.
static bool may_be_attached(const struct rhw_encoder *encoder, const struct rhw_texture_data *texture)
{
    return encoder->context->uses || rhw_texture_is_attached(encoder->context, texture);
}

// Most textures that are set are attached in no pass, neither themselves nor by a view: their levels are not looked at.
bool rhw_pass_draws_into(const struct rhw_encoder *encoder, const struct rhw_texture_data *texture,
                         uint32_t levels)
{
    levels = may_be_attached(encoder, texture) ? levels : 0;
    for (; levels != 0; levels &= levels - 1) {
        if (draws_into(encoder, range_of_level(texture, __builtin_ctz(levels)))) {
            return true;
        }
    }
    return false;
}

// Return true if one of a texture's levels has some of the texels.
static bool levels_have(const struct rhw_texture_data *texture, uint32_t levels,
                        struct rhw_texel_range texels)
{
    for (; levels != 0; levels &= levels - 1) {
        if (rhw_texel_ranges_overlap(texels, range_of_level(texture, __builtin_ctz(levels)))) {
            return true;
        }
    }
    return false;
}

bool rhw_pass_stores_texture(const struct rhw_encoder *encoder, const struct rhw_texture_data *texture,
                             uint32_t levels)
{
    if (!may_be_attached(encoder, texture)) {
        return false;
    }
    for (const struct rhw_stored_level *stored = encoder->stored; stored; stored = stored->next) {
        if (levels_have(texture, levels, stored->texels)) {
            return true;
        }
    }
    return false;
}

bool rhw_pass_reads(const struct rhw_encoder *encoder, struct rhw_texel_range texels)
{
    for (const struct rhw_read_texture *read = encoder->read; read; read = read->next) {
        if (levels_have(*read->item, read->levels, texels)) {
            return true;
        }
    }
    return false;
}

// The levels of a texture that the pass reads, and those that it stores, as far as is noted.
struct noted_levels {
    uint32_t *read, *stored;
};

// Return where it is noted which levels the pass reads and stores. Return NULLs where a recording has no memory for it.
static struct noted_levels noted_levels(const struct rhw_encoder *encoder,
                                        struct rhw_texture_data *const *item)
{
    if (encoder->context->uses) {
        struct rhw_use *const use = rhw_use_table_find(encoder->context->uses, item);
        return use ? (struct noted_levels){&use->read_levels, &use->stored_levels}
                   : (struct noted_levels){NULL, NULL};
    }
    struct rhw_texture_data *const texture = *item;
    const uint32_t generation = encoder->context->recording.generation;
    texture->read_levels = texture->read_pass == generation ? texture->read_levels : 0;
    texture->stored_levels = texture->stored_pass == generation ? texture->stored_levels : 0;
    texture->read_pass = texture->stored_pass = generation;
    return (struct noted_levels){&texture->read_levels, &texture->stored_levels};
}

bool rhw_pass_note_read(struct rhw_encoder *encoder, struct rhw_texture_data *const *item, uint32_t levels)
{
    uint32_t *const read_levels = noted_levels(encoder, item).read;
    const uint32_t added = read_levels ? levels & ~*read_levels : 0;
    if (added == 0) {
        return read_levels != NULL;
    }
    struct rhw_read_texture *const read =
        rhw_arena_alloc(&encoder->pass->arena, sizeof *read, _Alignof(struct rhw_read_texture));
    if (read) {
        *read = (struct rhw_read_texture){encoder->read, item, added};
        encoder->read = read;
        *read_levels |= added;
    }
    return read != NULL;
}

bool rhw_pass_note_stored(struct rhw_encoder *encoder, struct rhw_texture_data *const *item, int level)
{
    uint32_t *const stored_levels = noted_levels(encoder, item).stored;
    struct rhw_stored_level *const stored =
        rhw_arena_alloc(&encoder->pass->arena, sizeof *stored, _Alignof(struct rhw_stored_level));
    if (!stored || !stored_levels) {
        return false;
    }
    *stored = (struct rhw_stored_level){encoder->stored, range_of_level(*item, level)};
    encoder->stored = stored;
    *stored_levels |= 1u << level;
    return true;
}

bool rhw_pass_stores_level(const struct rhw_encoder *encoder, struct rhw_texture_data *const *item, int level)
{
    const uint32_t *const stored_levels = noted_levels(encoder, item).stored;
    return stored_levels && (*stored_levels >> level & 1) != 0;
}
