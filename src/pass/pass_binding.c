// SPDX-License-Identifier: MIT
// What the shader functions of the next draws reach by slot is set here: textures with their samplers, storage buffers,
// storage images and texel buffers. They become the bindings of a draw.
#include "pass_binding.h"

#include "binding/binding.h"
#include "binding/binding_check.h"
#include "context/context.h"
#include "context/entry.h"
#include "format/format.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "feedback_loop.h"
#include "encoder.h"
#include "memory_overlap.h"
#include "rhw/rhw.h"
#include "resource/sampler.h"
#include "resource/srgb_texture.h"
#include "resource/shared_texels.h"
#include "resource/buffer.h"
#include "resource/buffer_access.h"
#include "resource/texture.h"

// Textures ----------------------------------------------------------------------------------------------

static bool check_sampled(const struct rhw_encoder *encoder, rhw_texture id, int slot, const char *where)
{
    const rhw_context *const context = encoder->context;
    const struct rhw_texture_data *const texture = rhw_context_texture(context, id, where);
    return texture && rhw_binding_check_texture(context, id, texture, where) &&
           rhw_check(context, !rhw_pass_draws_into(encoder, texture, rhw_all_levels(texture)),
                     "%s: %s, for slot %d, is an attachment of this pass, or has a level and layer of one; "
                     "sample a view of others",
                     where, rhw_name_of(&context->textures, id.index).text, slot) &&
           rhw_check(context, !rhw_pass_stores_texture(encoder, texture, rhw_all_levels(texture)),
                     "%s: %s, for slot %d, is a storage image of this %s, or has a level and layer of one; "
                     "sample a view of others",
                     where, rhw_name_of(&context->textures, id.index).text, slot,
                     rhw_recording_noun(&context->recording));
}

// Make the linear copy of an sRGB texture that is sampled. Textures with several samples need none, because they are
// not filtered. A recording makes it when it runs. Return false when out of memory.
static bool linearize(struct rhw_encoder *encoder, struct rhw_texture_data *texture)
{
    if (encoder->context->uses || texture->samples > 1 || encoder->given_up) {
        return true;
    }
    const enum rhw_result result = rhw_texture_linearize(encoder->context, texture);
    encoder->given_up = result == RHW_ERROR_GIVEN_UP;
    return result != RHW_ERROR_OUT_OF_MEMORY;
}

// Bind what was set in a slot. Slots up to the last one that has something are there.
static void bind_texture(struct rhw_encoder *encoder, int slot, const struct rhw_bound_texture *bound)
{
    const struct rhw_context *const context = encoder->context;
    struct rhw_bindings *const slots = &encoder->slots;
    for (; slots->slot_count <= slot; slots->slot_count++) {
        slots->slot[slots->slot_count] = rhw_binding_of(context->kernels, context->paths, NULL, NULL);
    }
    slots->slot[slot] = rhw_binding_of(context->kernels, context->paths,
                                       bound->texture ? *bound->texture : NULL, bound->sampler);
    encoder->bindings_changed = true;
}

// Note in the texture that draws sample it. A recording does when it runs.
static void note_sampled(struct rhw_encoder *encoder, struct rhw_texture_data *const *texture)
{
    const rhw_context *const context = encoder->context;
    if (!context->uses) {
        rhw_texture_note_sampled(*texture, context->recording.generation);
        return;
    }
    struct rhw_use *const use = rhw_use_table_find(context->uses, texture);
    if (use) {
        use->is_sampled = true;
    }
}

bool rhw_encoder_set_texture(struct rhw_encoder *encoder, int slot, rhw_texture texture, rhw_sampler sampler,
                             const char *where)
{
    rhw_context *const context = encoder->context;
    struct rhw_bound_texture bound = {NULL, NULL};
    if (!rhw_check(context, slot >= 0 && slot < RHW_MAX_TEXTURES, "%s: slot is %d; it is in 0..%d", where,
                   slot, RHW_MAX_TEXTURES - 1)) {
        return false;
    }
    if (texture.index != 0) {
        bound.sampler = check_sampled(encoder, texture, slot, where)
                            ? rhw_context_sampler(context, sampler, where)
                            : NULL;
        if (!bound.sampler || !rhw_binding_check_sampler(context, texture, sampler, bound.sampler, where)) {
            return false;
        }
        bound.texture = rhw_pool_get(&context->textures, texture.index, texture.generation);
        rhw_encoder_note_use(encoder, &context->textures, texture.index, (*bound.texture)->moves);
        rhw_encoder_note_use(encoder, &context->samplers, sampler.index, 0);
        note_sampled(encoder, bound.texture);
        encoder->out_of_memory |=
            !rhw_pass_note_read(encoder, bound.texture, rhw_all_levels(*bound.texture)) ||
            !linearize(encoder, *bound.texture);
    }
    struct rhw_bound_texture *const current = &encoder->bound.textures[slot];
    if (current->texture != bound.texture || current->sampler != bound.sampler) {
        *current = bound;
        bind_texture(encoder, slot, &bound);
    }
    return true;
}

void rhw_pass_set_texture(rhw_context *context, rhw_pass id, int slot, rhw_texture texture,
                          rhw_sampler sampler)
{
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, "rhw_pass_set_texture");
    if (encoder) {
        (void)rhw_encoder_set_texture(encoder, slot, texture, sampler, "rhw_pass_set_texture");
        rhw_context_leave(context);
    }
}

// Storage buffers ---------------------------------------------------------------------------------------

// Note bytes that shader functions read, and write unless `is_read_only`. Return false where it is misuse.
static bool note_memory(struct rhw_encoder *encoder, const void *bytes, size_t size, bool is_read_only,
                        const char *where)
{
    return is_read_only ? rhw_memory_note_read(&encoder->memory, bytes, size, where)
                        : rhw_memory_note_stored(&encoder->memory, bytes, size, where);
}

// Bind bytes of a live buffer that shader functions read, and write unless `is_read_only`. Return false where it is
// misuse.
static bool bind_range(struct rhw_encoder *encoder, rhw_buffer id, size_t offset, size_t size,
                       bool is_read_only, const char *where, struct rhw_bound_range *range)
{
    struct rhw_context *const context = encoder->context;
    struct rhw_buffer_data *const data = rhw_context_buffer(context, id, where);
    if (!data || !rhw_buffer_check_range(context, id, data, offset, size, where)) {
        return false;
    }
    const size_t length = size == 0 ? data->size - offset : size;
    const struct rhw_buffer_part part = {id, data, is_read_only ? RHW_BUFFER_READ : RHW_BUFFER_STORED, offset,
                                         offset + length};
    if (!rhw_buffer_check_unmapped(context, &part, where) || !rhw_buffer_check_use(context, &part, where) ||
        !note_memory(encoder, data->bytes + offset, length, is_read_only, where)) {
        return false;
    }
    encoder->out_of_memory |= !rhw_buffer_note_use(context, &encoder->pass->arena, &part);
    if (is_read_only && !context->uses) {
        data->bound_pass = context->recording.generation;
    }
    *range = (struct rhw_bound_range){data, offset, length, is_read_only};
    return true;
}

bool rhw_encoder_set_storage_buffer(struct rhw_encoder *encoder, int slot, rhw_buffer id, size_t offset,
                                    size_t size, bool is_read_only, const char *where)
{
    struct rhw_context *const context = encoder->context;
    struct rhw_bound_range range = {.data = NULL};
    if (!rhw_check(context, slot >= 0 && slot < RHW_MAX_STORAGE_BUFFERS, "%s: slot is %d; it is in 0..%d",
                   where, slot, RHW_MAX_STORAGE_BUFFERS - 1) ||
        !rhw_check(context, offset % 4 == 0, "%s: offset is %zu; it must be a multiple of 4", where,
                   offset) ||
        (id.index != 0 && !bind_range(encoder, id, offset, size, is_read_only, where, &range))) {
        return false;
    }
    encoder->bound.storage[slot] = range;
    encoder->bindings_changed = encoder->storage_changed = true;
    return true;
}

void rhw_pass_set_storage_buffer(rhw_context *context, rhw_pass id, int slot, rhw_buffer buffer,
                                 size_t offset, size_t size)
{
    static const char *const where = "rhw_pass_set_storage_buffer";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (encoder) {
        (void)rhw_encoder_set_storage_buffer(encoder, slot, buffer, offset, size, false, where);
        rhw_context_leave(context);
    }
}

void rhw_pass_set_read_only_storage_buffer(rhw_context *context, rhw_pass id, int slot, rhw_buffer buffer,
                                           size_t offset, size_t size)
{
    static const char *const where = "rhw_pass_set_read_only_storage_buffer";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (encoder) {
        (void)rhw_encoder_set_storage_buffer(encoder, slot, buffer, offset, size, true, where);
        rhw_context_leave(context);
    }
}

// Images and texel buffers ------------------------------------------------------------------------------

static bool check_slot(const struct rhw_context *context, int slot, const char *where)
{
    return rhw_check(context, slot >= 0 && slot < RHW_MAX_STORAGE_IMAGES, "%s: slot is %d; it is in 0..%d",
                     where, slot, RHW_MAX_STORAGE_IMAGES - 1);
}

// Check that the pass neither draws into nor reads a texel of a level that is to be written. Texels are told apart by
// level and layer.
static bool check_written(const struct rhw_encoder *encoder, rhw_texture id,
                          const struct rhw_texture_data *texture, int level, const char *where)
{
    const struct rhw_context *const context = encoder->context;
    struct rhw_texture_data *const *const item = rhw_pool_item(&context->textures, id.index);
    const struct rhw_texel_range texels =
        rhw_texel_range_of(&texture->mip[level], 0, texture->mip[level].slices);
    return rhw_pass_stores_level(encoder, item, level) ||
           (rhw_check(context, !rhw_pass_attaches(encoder, texels),
                      "%s: level %d of %s is an attachment of this pass, or has a layer of one; it must be "
                      "another",
                      where, level, rhw_name_of(&context->textures, id.index).text) &&
            rhw_check(context, !rhw_pass_reads(encoder, texels),
                      "%s: level %d of %s is sampled in this %s or set for reading alone, or has a layer "
                      "that is; it must be another",
                      where, level, rhw_name_of(&context->textures, id.index).text,
                      rhw_recording_noun(&context->recording)));
}

// Check that the pass neither draws into nor writes a level that is to be read.
static bool check_read(const struct rhw_encoder *encoder, rhw_texture id,
                       const struct rhw_texture_data *texture, int level, const char *where)
{
    const struct rhw_context *const context = encoder->context;
    return rhw_check(context, !rhw_pass_draws_into(encoder, texture, 1u << level),
                     "%s: level %d of %s is an attachment of this pass, or has a layer of one; it must be "
                     "another",
                     where, level, rhw_name_of(&context->textures, id.index).text) &&
           rhw_check(context, !rhw_pass_stores_texture(encoder, texture, 1u << level),
                     "%s: level %d of %s is a storage image of this %s, or has a layer of one; it must be "
                     "another",
                     where, level, rhw_name_of(&context->textures, id.index).text,
                     rhw_recording_noun(&context->recording));
}

static void bind_image(struct rhw_encoder *encoder, int slot, struct rhw_bound_image image)
{
    encoder->bound.images[slot] = image;
    encoder->bindings_changed = encoder->storage_changed = true;
}

// Note that shader functions write the texels of a level. Return false where it is misuse.
static bool note_written(struct rhw_encoder *encoder, struct rhw_texture_data *const *item, int level,
                         const char *where)
{
    struct rhw_texture_data *const texture = *item;
    if (!rhw_pass_stores_level(encoder, item, level)) {
        if (!rhw_memory_note_stored_level(&encoder->memory, &texture->mip[level], texture->info->size,
                                          where)) {
            return false;
        }
        encoder->out_of_memory |= !rhw_pass_note_stored(encoder, item, level);
    }
    if (encoder->context->uses) {
        return true; // a recording notes it in the texture when it runs
    }
    rhw_texture_note_attached(texture, encoder->context->recording.generation);
    rhw_texture_note_written(texture);
    texture->written |= 1u << level;
    return true;
}

bool rhw_encoder_set_storage_image(struct rhw_encoder *encoder, int slot, rhw_texture id, int level,
                                   bool is_read_only, const char *where)
{
    struct rhw_context *const context = encoder->context;
    struct rhw_bound_image bound = {.level = level, .is_read_only = is_read_only};
    if (!check_slot(context, slot, where)) {
        return false;
    }
    if (id.index != 0) {
        struct rhw_texture_data *const texture = rhw_context_texture(context, id, where);
        if (!texture || !rhw_binding_check_image(context, id, texture, level, where) ||
            !(is_read_only ? check_read(encoder, id, texture, level, where)
                           : check_written(encoder, id, texture, level, where))) {
            return false;
        }
        bound.texture = rhw_pool_get(&context->textures, id.index, id.generation);
        rhw_encoder_note_use(encoder, &context->textures, id.index, texture->moves);
        if (is_read_only) {
            note_sampled(encoder, bound.texture);
            encoder->out_of_memory |= !rhw_pass_note_read(encoder, bound.texture, 1u << level);
        } else if (!note_written(encoder, bound.texture, level, where)) {
            return false;
        }
    }
    bind_image(encoder, slot, bound);
    return true;
}

void rhw_pass_set_storage_image(rhw_context *context, rhw_pass id, int slot, rhw_texture texture, int level)
{
    static const char *const where = "rhw_pass_set_storage_image";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (encoder) {
        (void)rhw_encoder_set_storage_image(encoder, slot, texture, level, false, where);
        rhw_context_leave(context);
    }
}

void rhw_pass_set_read_only_storage_image(rhw_context *context, rhw_pass id, int slot, rhw_texture texture,
                                          int level)
{
    static const char *const where = "rhw_pass_set_read_only_storage_image";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (encoder) {
        (void)rhw_encoder_set_storage_image(encoder, slot, texture, level, true, where);
        rhw_context_leave(context);
    }
}

bool rhw_encoder_set_texel_buffer(struct rhw_encoder *encoder, int slot, rhw_buffer id,
                                  enum rhw_format format, size_t offset, size_t size, bool is_read_only,
                                  const char *where)
{
    struct rhw_context *const context = encoder->context;
    struct rhw_bound_image bound = {.is_read_only = is_read_only};
    if (!check_slot(context, slot, where)) {
        return false;
    }
    if (id.index != 0) {
        if (!rhw_binding_check_texels(context, format, offset, where) ||
            !bind_range(encoder, id, offset, size, is_read_only, where, &bound.range)) {
            return false;
        }
        bound.format = format;
    }
    bind_image(encoder, slot, bound);
    return true;
}

void rhw_pass_set_texel_buffer(rhw_context *context, rhw_pass id, int slot, rhw_buffer buffer,
                               enum rhw_format format, size_t offset, size_t size)
{
    static const char *const where = "rhw_pass_set_texel_buffer";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (encoder) {
        (void)rhw_encoder_set_texel_buffer(encoder, slot, buffer, format, offset, size, false, where);
        rhw_context_leave(context);
    }
}

void rhw_pass_set_read_only_texel_buffer(rhw_context *context, rhw_pass id, int slot, rhw_buffer buffer,
                                         enum rhw_format format, size_t offset, size_t size)
{
    static const char *const where = "rhw_pass_set_read_only_texel_buffer";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (encoder) {
        (void)rhw_encoder_set_texel_buffer(encoder, slot, buffer, format, offset, size, true, where);
        rhw_context_leave(context);
    }
}

// For draws ---------------------------------------------------------------------------------------------

static bool has_storage(const struct rhw_bound *bound)
{
    for (int i = 0; i < RHW_MAX_STORAGE_BUFFERS; i++) {
        if (bound->storage[i].data) {
            return true;
        }
    }
    for (int i = 0; i < RHW_MAX_STORAGE_IMAGES; i++) {
        if (bound->images[i].texture || bound->images[i].range.data) {
            return true;
        }
    }
    return false;
}

static struct rhw_storage_words words_of(const struct rhw_bound_range *range)
{
    return range->data
               ? rhw_storage_words_of(range->data->bytes + range->offset, range->size, range->is_read_only)
               : (struct rhw_storage_words){.words = NULL};
}

// Return the storage image of a slot.
static struct rhw_storage_image image_of(const struct rhw_bound_image *bound)
{
    if (bound->texture) {
        return rhw_storage_image_of_level(*bound->texture, bound->level, bound->is_read_only);
    }
    const bool has_texels = bound->range.data && bound->range.size >= rhw_format_size(bound->format);
    return has_texels
               ? rhw_storage_image_of_texels(bound->format, bound->range.data->bytes + bound->range.offset,
                                             bound->range.size, bound->is_read_only)
               : (struct rhw_storage_image){.info = NULL};
}

// Return the storage of the next draw, with the bytes that its buffers have now, or NULL when out of memory.
static const struct rhw_storage *storage_of(struct rhw_encoder *encoder)
{
    if (!has_storage(&encoder->bound)) {
        return &rhw_no_storage;
    }
    struct rhw_storage *const storage =
        rhw_arena_alloc(&encoder->pass->arena, sizeof *storage, RHW_CACHE_LINE);
    for (int i = 0; storage && i < RHW_MAX_STORAGE_BUFFERS; i++) {
        storage->buffers[i] = words_of(&encoder->bound.storage[i]);
    }
    for (int i = 0; storage && i < RHW_MAX_STORAGE_IMAGES; i++) {
        storage->images[i] = image_of(&encoder->bound.images[i]);
    }
    return storage;
}

bool rhw_pass_resolve_bindings(struct rhw_encoder *encoder)
{
    struct rhw_bindings *const bindings =
        rhw_arena_alloc(&encoder->pass->arena, rhw_bindings_size(encoder->slots.slot_count), RHW_CACHE_LINE);
    if (encoder->storage_changed) {
        encoder->slots.storage = storage_of(encoder);
    }
    if (!bindings || !encoder->slots.storage) {
        return false;
    }
    rhw_bindings_copy(&encoder->slots, bindings);
    encoder->bindings = bindings;
    encoder->bindings_changed = encoder->storage_changed = false;
    return true;
}

bool rhw_pass_renew_bindings(struct rhw_encoder *encoder)
{
    for (int i = 0; i < encoder->slots.slot_count; i++) {
        const struct rhw_bound_texture *const bound = &encoder->bound.textures[i];
        if (bound->texture && !linearize(encoder, *bound->texture)) {
            return false;
        }
        bind_texture(encoder, i, bound);
    }
    encoder->bindings_changed = encoder->storage_changed = true;
    return true;
}
