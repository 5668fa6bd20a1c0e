// SPDX-License-Identifier: MIT
// Storage under validation.
#include "validation_messages.h"
#include "validation.h"

static void validate(const struct rhw_bindings *textures, int slot, int count, bool is_set, bool is_read_only,
                     const char *noun, enum rhw_storage_operation operation)
{
    const struct rhw_sample_site *const site = &textures->site;
    if ((unsigned)slot >= (unsigned)count) {
        rhw_validation_messages_add(site->validation, RHW_VALIDATION_MISUSE, site->draw,
                                    "a shader function of %s uses %s slot %d; slots are 0..%d",
                                    site->pipeline, noun, slot, count - 1);
    } else if (!is_set) {
        rhw_validation_messages_add(site->validation, RHW_VALIDATION_MISUSE, site->draw,
                                    "a shader function of %s uses %s slot %d, in which nothing is set",
                                    site->pipeline, noun, slot);
    } else if (is_read_only && operation != RHW_STORAGE_LOAD) {
        rhw_validation_messages_add(
            site->validation, RHW_VALIDATION_MISUSE, site->draw,
            "a shader function of %s writes to %s slot %d, which is set for reading alone", site->pipeline,
            noun, slot);
    } else if (textures->drops_effects && operation != RHW_STORAGE_LOAD) {
        rhw_validation_messages_add(
            site->validation, RHW_VALIDATION_MISUSE, site->draw,
            "a shader function of %s writes to %s slot %d; its program declares no such "
            "effects, by RHW_USE_EFFECTS or vertex_effects",
            site->pipeline, noun, slot);
    }
}

void rhw_validate_storage(const struct rhw_bindings *textures, int slot, enum rhw_storage_operation operation)
{
    const int count = RHW_MAX_STORAGE_BUFFERS;
    const struct rhw_storage_words *const words =
        (unsigned)slot < (unsigned)count ? &textures->storage->buffers[slot] : &rhw_no_storage.buffers[0];
    validate(textures, slot, count, words->words, words->is_read_only, "storage", operation);
}

void rhw_validate_image(const struct rhw_bindings *textures, int slot, enum rhw_storage_operation operation)
{
    const int count = RHW_MAX_STORAGE_IMAGES;
    const struct rhw_storage_image *const image =
        (unsigned)slot < (unsigned)count ? &textures->storage->images[slot] : &rhw_no_storage.images[0];
    validate(textures, slot, count, image->texture, image->is_read_only, "image", operation);
}
