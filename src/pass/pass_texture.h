// SPDX-License-Identifier: MIT
// What a pass sets of textures.
#ifndef RHW_PASS_TEXTURE_H
#define RHW_PASS_TEXTURE_H

#include <stdbool.h>

struct rhw_encoder;

// Gives the next draw the textures and the storage that are bound, as they are now. False when out of memory.
bool rhw_pass_resolve_textures(struct rhw_encoder *encoder);

#endif
