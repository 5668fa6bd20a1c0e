// SPDX-License-Identifier: MIT
// What recorded draws read is kept: a texture that is written between them gets new memory.
#include "texture_access.h"

#include <string.h>

#include "context/context.h"
#include "context/lookup.h"
#include "base/memory.h"
#include "context/misuse.h"
#include "shared_texels.h"
#include "texture.h"

bool rhw_texture_is_attached(const struct rhw_context *context, const struct rhw_texture_data *texture)
{
    const struct rhw_recording_place *const recording = &context->recording;
    const uint32_t attached = texture->shared ? texture->shared->attached : texture->attached;
    return rhw_recording_is_open(recording) && attached == recording->generation;
}

bool rhw_texture_check_unread(const struct rhw_context *context, rhw_texture id,
                              const struct rhw_texture_data *texture, const char *where)
{
    const struct rhw_recording_place *const recording = &context->recording;
    return rhw_check(
        context, !texture->shared || !recording->active || texture->shared->sampled != recording->generation,
        "%s: %s shares its texels with views or stands on memory of the program, and the pass "
        "being recorded samples them; end that first",
        where, rhw_name_of(&context->textures, id.index).text);
}

bool rhw_texture_check_unattached(const struct rhw_context *context, rhw_texture id,
                                  const struct rhw_texture_data *texture, const char *where)
{
    return rhw_check(context, !rhw_texture_is_attached(context, texture),
                     "%s: %s is an attachment of the pass being recorded; end that first", where,
                     rhw_name_of(&context->textures, id.index).text);
}

// Give the texture new memory with equal texels. Draws that were recorded keep the old memory. Return NULL when out of
// memory.
static struct rhw_texture_data *renew(struct rhw_context *context, rhw_texture id)
{
    struct rhw_texture_data **const item = rhw_pool_get(&context->textures, id.index, id.generation);
    const struct rhw_texture_data *const old = *item;
    struct rhw_texture_data *const data = rhw_texture_data_create(&context->memory, old->format, &old->shape);
    if (!data) {
        return NULL;
    }
    if (!rhw_pool_retire_copy(&context->memory, &context->textures, id.index)) {
        rhw_texture_data_destroy(&context->memory, data);
        return NULL;
    }
    memcpy(data->memory, old->memory, old->memory_size);
    data->written = old->written;
    data->moves = old->moves + 1;
    data->renewed_pass = context->recording.generation;
    data->renewed_draws = context->recording.draw;
    *item = data;
    return data;
}

struct rhw_texture_data *rhw_texture_to_write(struct rhw_context *context, rhw_texture id,
                                              struct rhw_texture_data *texture)
{
    const bool read =
        !texture->shared && rhw_context_draws_read(context, &context->textures, id.index,
                                                   texture->renewed_pass, texture->renewed_draws);
    struct rhw_texture_data *const written = read ? renew(context, id) : texture;
    if (written) {
        context->recording.rewrites += rhw_context_records(context, &context->textures, id.index);
        rhw_texture_note_written(written);
    }
    return written;
}
