// SPDX-License-Identifier: MIT
#include "bound_texels.h"

#include "context/context.h"
#include "context/lookup.h"
#include "format/format.h"
#include "shared_texels.h"
#include "srgb_texture.h"
#include "texture.h"

bool rhw_texture_pin(struct rhw_context *context, rhw_texture id, struct rhw_texture_data *texture)
{
    const bool is_pinned = texture->shared != NULL;
    if (!rhw_texture_share(&context->memory, texture)) {
        return false;
    }
    if (!is_pinned && rhw_context_records(context, &context->textures, id.index)) {
        texture->shared->sampled = context->recording.generation;
    }
    return true;
}

// Return true if the pass or dispatch of the last generation draws into the texture, which it then does not sample.
static bool is_attached(const struct rhw_context *context, const struct rhw_texture_data *texture)
{
    return texture->attached == context->recording.generation;
}

enum rhw_result rhw_texture_note_bound(struct rhw_context *context, struct rhw_texture_data *texture)
{
    struct rhw_shared_texels *const shared = texture->shared;
    if (texture->info->path != RHW_TEXELS_RGBA8_SRGB || !texture->is_plain || texture->samples > 1) {
        return RHW_OK;
    }
    if (!texture->is_bound) {
        texture->is_bound = true;
        texture->next_bound = shared->bound;
        shared->bound = texture;
        shared->bound_texels = &context->bound_texels;
    }
    rhw_shared_texels_note_stale(shared);
    const bool waits = rhw_recording_is_open(&context->recording) && is_attached(context, texture);
    return waits ? RHW_OK : rhw_texture_linearize(context, texture);
}

// Prepare the textures of a record. Where the pass writes some of the texels, the copies hold until it has run.
static enum rhw_result prepare(struct rhw_context *context, const struct rhw_shared_texels *shared,
                               bool is_written)
{
    for (struct rhw_texture_data *texture = shared->bound; texture; texture = texture->next_bound) {
        if (is_attached(context, texture)) {
            continue;
        }
        rhw_texture_note_sampled(texture, context->recording.generation);
        const enum rhw_result result = rhw_texture_linearize(context, texture);
        if (result != RHW_OK) {
            return result;
        }
        texture->linear_levels = is_written ? 0 : texture->linear_levels;
    }
    return RHW_OK;
}

enum rhw_result rhw_bound_texels_prepare(struct rhw_context *context)
{
    struct rhw_shared_texels **next = &context->bound_texels.stale;
    while (*next) {
        struct rhw_shared_texels *const shared = *next;
        const bool is_written = shared->attached == context->recording.generation;
        const enum rhw_result result = prepare(context, shared, is_written);
        if (result != RHW_OK) {
            return result;
        }
        if (is_written || rhw_shared_texels_are_unsaid(shared)) {
            next = &shared->next_stale;
        } else {
            shared->is_stale = false;
            *next = shared->next_stale;
        }
    }
    return RHW_OK;
}
