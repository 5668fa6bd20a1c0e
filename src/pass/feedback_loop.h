// SPDX-License-Identifier: MIT
// Which texels the pass being recorded draws into, writes as storage images and reads: no texel is both read and
// written by one pass, or what is read would depend on the tile that is ready first. Texels are told apart by level and
// layer, as Vulkan and WebGPU have it (Vulkan 1.3 §8.9, WebGPU's usage scopes), so a view may be sampled while another
// level of its texture is drawn.
#ifndef RHW_PASS_FEEDBACK_LOOP_H
#define RHW_PASS_FEEDBACK_LOOP_H

#include "resource/texel_range.h"

struct rhw_encoder;

// Whether an attachment holds some of the texels.
bool rhw_pass_attaches(const struct rhw_encoder *encoder, struct rhw_texel_range texels);
// Whether one that is not read-only holds some of a texture's levels, a bit each, which a shader may read.
bool rhw_pass_draws_into(const struct rhw_encoder *encoder, const struct rhw_texture_data *texture,
                         uint32_t levels);

// Whether a storage image that was set in the pass to be written holds some of a texture's levels.
bool rhw_pass_stores_texture(const struct rhw_encoder *encoder, const struct rhw_texture_data *texture,
                             uint32_t levels);

// Whether what was set in the pass to be read, textures and images, has some of the texels.
bool rhw_pass_reads(const struct rhw_encoder *encoder, struct rhw_texel_range texels);

// All levels of a texture, a bit each.
static inline uint32_t rhw_all_levels(const struct rhw_texture_data *texture)
{
    return (1u << texture->levels) - 1;
}

// Keep in mind what is set. `item`: in the context's pool; what it holds may be renewed until the pass ends. False when
// out of memory.
bool rhw_pass_note_read(struct rhw_encoder *encoder, struct rhw_texture_data *const *item, uint32_t levels);
bool rhw_pass_note_stored(struct rhw_encoder *encoder, struct rhw_texture_data *texture, int level);

#endif
