// SPDX-License-Identifier: MIT
// What kinds of textures there are: the rules for the sizes, layers and levels of a definition.
#ifndef RHW_TEXTURE_SHAPE_H
#define RHW_TEXTURE_SHAPE_H

#include "texture.h"

// Report what is wrong with the kind, the sizes or the number of levels.
bool rhw_texture_shape_check(const struct rhw_context *context, const struct rhw_texture_def *def,
                             const char *where);

// Return the shape of a valid definition.
struct rhw_texture_shape rhw_texture_shape_of(const struct rhw_texture_def *def);

// Report memory of the program's that is misaligned or too small. `def` is valid otherwise.
bool rhw_texture_memory_check(const struct rhw_context *context, const struct rhw_texture_def *def,
                              const char *where);

// Report a layer, or a slice of a 3D texture, that the level does not have.
bool rhw_texture_check_layer(const struct rhw_context *context, rhw_texture id,
                             const struct rhw_texture_data *texture, int level, int layer, const char *where);

// Report a level that the texture does not have.
bool rhw_texture_check_level(const struct rhw_context *context, rhw_texture texture,
                             const struct rhw_texture_data *data, int level, const char *where);

#endif
