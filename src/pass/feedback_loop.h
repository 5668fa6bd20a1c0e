// SPDX-License-Identifier: MIT
// This file knows which texels the pass being recorded draws into, writes as storage images, and reads. No pass both
// reads and writes a texel: what it reads would depend on the tile that is ready first. Texels are told apart by level
// and layer, as in Vulkan and WebGPU (Vulkan 1.3 §8.9, WebGPU's usage scopes), so a view may be sampled while another
// level of its texture is drawn.
#ifndef RHW_PASS_FEEDBACK_LOOP_H
#define RHW_PASS_FEEDBACK_LOOP_H

#include "resource/texel_range.h"

struct rhw_encoder;

// Return true if an attachment holds some of the texels.
bool rhw_pass_attaches(const struct rhw_encoder *encoder, struct rhw_texel_range texels);
// Return true if an attachment that is written holds some of a texture's levels. Each bit of `levels` is a level that a
// shader may read.
bool rhw_pass_draws_into(const struct rhw_encoder *encoder, const struct rhw_texture_data *texture,
                         uint32_t levels);

// Return true if a storage image that was set to be written in the pass holds some of a texture's levels.
bool rhw_pass_stores_texture(const struct rhw_encoder *encoder, const struct rhw_texture_data *texture,
                             uint32_t levels);

// Return true if a texture or an image that was set to be read in the pass has some of the texels.
bool rhw_pass_reads(const struct rhw_encoder *encoder, struct rhw_texel_range texels);

// Return all levels of a texture, a bit for each.
static inline uint32_t rhw_all_levels(const struct rhw_texture_data *texture)
{
    return (1u << texture->levels) - 1;
}

// Keep in mind what is set to be read, or to be written. `item` stands in the context's pool, and what it holds may be
// renewed until the pass ends. The use of the item has been noted. Return false when out of memory.
bool rhw_pass_note_read(struct rhw_encoder *encoder, struct rhw_texture_data *const *item, uint32_t levels);
bool rhw_pass_note_stored(struct rhw_encoder *encoder, struct rhw_texture_data *const *item, int level);

// Return true if the level was set in this pass already as a storage image to be written.
bool rhw_pass_stores_level(const struct rhw_encoder *encoder, struct rhw_texture_data *const *item,
                           int level);

#endif
