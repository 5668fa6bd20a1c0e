// SPDX-License-Identifier: MIT
// Which texels the pass being recorded draws into, writes as storage images and samples: no texel is both read and written
// by one pass, or what is read would depend on the tile that is ready first. Texels are told apart by level and layer, as
// Vulkan and WebGPU have it (Vulkan 1.3 §8.9, WebGPU's usage scopes), so a view may be sampled while another level of its
// texture is drawn.
#ifndef RHW_PASS_FEEDBACK_LOOP_H
#define RHW_PASS_FEEDBACK_LOOP_H

#include "texel_range.h"

struct rhw_pass_state;

// Whether an attachment holds some of the texels.
bool rhw_pass_attaches(const struct rhw_pass_state *pass, struct rhw_texel_range texels);
// Whether one that is not read-only holds some of a texture's, all of which a shader may sample.
bool rhw_pass_draws_into(const struct rhw_pass_state *pass, const struct rhw_texture_data *texture);

// Whether a storage image that was set in the pass holds some of a texture's texels.
bool rhw_pass_stores_texture(const struct rhw_pass_state *pass, const struct rhw_texture_data *texture);

// Whether a texture that was set in the pass has some of the texels.
bool rhw_pass_samples(const struct rhw_pass_state *pass, struct rhw_texel_range texels);

// Keep in mind what is set. `item`: in the context's pool; what it holds may be renewed until the pass ends. False when out
// of memory.
bool rhw_pass_note_sampled(struct rhw_pass_state *pass, struct rhw_texture_data *const *item);
bool rhw_pass_note_stored(struct rhw_pass_state *pass, struct rhw_texture_data *texture, int level);

#endif
