// SPDX-License-Identifier: MIT
// Textures on memory of the program's: whether there is enough of it.
#ifndef RHW_TEXTURE_LAYOUT_H
#define RHW_TEXTURE_LAYOUT_H

#include "rhw/types.h"

// Reports memory that is misaligned or too small; `def` is valid otherwise.
bool rhw_texture_memory_check(const struct rhw_context *context, const struct rhw_texture_def *def,
                              const char *where);

#endif
