// SPDX-License-Identifier: MIT
// See pass_feedback_loop.h. What is set is in two lists, each texture once, so that setting it again costs nothing.
#include "pass_feedback_loop.h"

#include "context.h"
#include "pass_state.h"
#include "texture_access.h"

struct rhw_sampled_texture {
    const struct rhw_sampled_texture *next;
    struct rhw_texture_data *const *item;
};

struct rhw_stored_level {
    const struct rhw_stored_level *next;
    struct rhw_texel_range texels;
};

static bool is_in(struct rhw_texel_range texels, const struct rhw_mip *mip, int layer, int layers)
{
    return mip && rhw_texel_ranges_overlap(texels, rhw_texel_range_of(mip, layer, layers));
}

static bool is_in_attachment(const struct rhw_pass_state *pass, const struct rhw_attachment *attachment,
                             struct rhw_texel_range texels)
{
    return is_in(texels, attachment->target, attachment->layer, pass->layers) ||
           is_in(texels, attachment->resolve, attachment->layer, pass->layers);
}

static bool is_in_color(const struct rhw_pass_state *pass, struct rhw_texel_range texels)
{
    for (int i = 0; i < pass->color_count; i++) {
        if (is_in_attachment(pass, &pass->colors[i], texels)) {
            return true;
        }
    }
    return false;
}

bool rhw_pass_attaches(const struct rhw_pass_state *pass, struct rhw_texel_range texels)
{
    return is_in_color(pass, texels) || is_in_attachment(pass, &pass->depth, texels) ||
           is_in_attachment(pass, &pass->stencil, texels);
}

// Whether depth, or stencil, writes some of the texels: what is read-only only where it is resolved.
static bool writes(const struct rhw_pass_state *pass, const struct rhw_attachment *attachment,
                   struct rhw_texel_range texels)
{
    return attachment->is_read_only
               ? attachment->resolves && is_in(texels, attachment->resolve, attachment->layer, pass->layers)
               : is_in_attachment(pass, attachment, texels);
}

// Stencil alone is in both, depth and stencil.
static bool draws_into(const struct rhw_pass_state *pass, struct rhw_texel_range texels)
{
    return is_in_color(pass, texels) || (pass->has_depth && writes(pass, &pass->depth, texels)) ||
           (pass->has_stencil && writes(pass, &pass->stencil, texels));
}

static struct rhw_texel_range range_of_level(const struct rhw_texture_data *texture, int level)
{
    const struct rhw_mip *const mip = &texture->mip[level];
    return rhw_texel_range_of(mip, 0, mip->slices);
}

// Most textures that are set are nobody's attachment, by any name.
bool rhw_pass_draws_into(const struct rhw_pass_state *pass, const struct rhw_texture_data *texture)
{
    bool draws = false;
    if (rhw_texture_is_attached(pass->context, texture)) {
        for (int i = 0; i < texture->levels && !draws; i++) {
            draws = draws_into(pass, range_of_level(texture, i));
        }
    }
    return draws;
}

bool rhw_pass_stores_texture(const struct rhw_pass_state *pass, const struct rhw_texture_data *texture)
{
    if (!rhw_texture_is_attached(pass->context, texture)) {
        return false;
    }
    for (const struct rhw_stored_level *stored = pass->stored; stored; stored = stored->next) {
        for (int i = 0; i < texture->levels; i++) {
            if (rhw_texel_ranges_overlap(stored->texels, range_of_level(texture, i))) {
                return true;
            }
        }
    }
    return false;
}

bool rhw_pass_samples(const struct rhw_pass_state *pass, struct rhw_texel_range texels)
{
    for (const struct rhw_sampled_texture *sampled = pass->sampled; sampled; sampled = sampled->next) {
        const struct rhw_texture_data *const texture = *sampled->item;
        for (int i = 0; i < texture->levels; i++) {
            if (rhw_texel_ranges_overlap(texels, range_of_level(texture, i))) {
                return true;
            }
        }
    }
    return false;
}

bool rhw_pass_note_sampled(struct rhw_pass_state *pass, struct rhw_texture_data *const *item)
{
    struct rhw_texture_data *const texture = *item;
    const uint32_t generation = pass->context->recording.generation;
    if (texture->sampled_pass == generation) {
        return true;
    }
    struct rhw_sampled_texture *const sampled =
        rhw_arena_alloc(&pass->arena, sizeof *sampled, sizeof(void *));
    if (sampled) {
        *sampled = (struct rhw_sampled_texture){pass->sampled, item};
        pass->sampled = sampled;
        texture->sampled_pass = generation;
    }
    return sampled != NULL;
}

bool rhw_pass_note_stored(struct rhw_pass_state *pass, struct rhw_texture_data *texture, int level)
{
    const uint32_t generation = pass->context->recording.generation;
    texture->stored_levels = texture->stored_pass == generation ? texture->stored_levels : 0;
    struct rhw_stored_level *const stored = rhw_arena_alloc(&pass->arena, sizeof *stored, sizeof(void *));
    if (stored) {
        *stored = (struct rhw_stored_level){pass->stored, range_of_level(texture, level)};
        pass->stored = stored;
        texture->stored_pass = generation;
        texture->stored_levels |= 1u << level;
    }
    return stored != NULL;
}
