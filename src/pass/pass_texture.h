// SPDX-License-Identifier: MIT
// The textures that a pass sets become part of its draws.
#ifndef RHW_PASS_TEXTURE_H
#define RHW_PASS_TEXTURE_H

#include <stdbool.h>

struct rhw_encoder;

// Give the next draw the textures and the storage that are bound, as they are now. Return false when out of memory.
bool rhw_pass_resolve_textures(struct rhw_encoder *encoder);

#endif
