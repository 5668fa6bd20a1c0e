// SPDX-License-Identifier: MIT
// The textures and the storage that a pass sets become the bindings of its draws.
#ifndef RHW_PASS_BINDING_H
#define RHW_PASS_BINDING_H

#include <stdbool.h>
#include <stddef.h>

#include "rhw/types.h"

struct rhw_encoder;

// Set what a slot has, for a public function `where`. The null id empties the slot. Report misuse and return false
// where the rules of that slot are broken.
bool rhw_encoder_set_texture(struct rhw_encoder *encoder, int slot, rhw_texture texture, rhw_sampler sampler,
                             const char *where);
bool rhw_encoder_set_storage_buffer(struct rhw_encoder *encoder, int slot, rhw_buffer id, size_t offset,
                                    size_t size, bool is_read_only, const char *where);
bool rhw_encoder_set_storage_image(struct rhw_encoder *encoder, int slot, rhw_texture id, int level,
                                   bool is_read_only, const char *where);
bool rhw_encoder_set_texel_buffer(struct rhw_encoder *encoder, int slot, rhw_buffer id,
                                  enum rhw_format format, size_t offset, size_t size, bool is_read_only,
                                  const char *where);

// Give the next draw the textures and the storage that are bound. Return false when out of memory.
bool rhw_pass_resolve_bindings(struct rhw_encoder *encoder);
// Bind anew what is bound, as it is now: the program has rewritten something. Return false when out of memory.
bool rhw_pass_renew_bindings(struct rhw_encoder *encoder);

#endif
