// SPDX-License-Identifier: MIT
// What kinds of textures there are: the rules for the sizes, layers and levels of a definition.
#ifndef RHW_TEXTURE_SHAPE_H
#define RHW_TEXTURE_SHAPE_H

#include "texture.h"

// Reports what is wrong with the kind, the sizes or the number of levels.
bool rhw_texture_shape_check(const struct rhw_context *context, const struct rhw_texture_def *def,
                             const char *where);

// `def` is valid.
struct rhw_texture_shape rhw_texture_shape_of(const struct rhw_texture_def *def);

// Reports memory of the program's that is misaligned or too small; `def` is valid otherwise.
bool rhw_texture_memory_check(const struct rhw_context *context, const struct rhw_texture_def *def,
                              const char *where);

// Reports a layer, or slice of a 3D texture, that the level does not have.
bool rhw_texture_check_layer(const struct rhw_context *context, rhw_texture id,
                             const struct rhw_texture_data *texture, int level, int layer, const char *where);

// Reports a level that the texture does not have.
bool rhw_texture_check_level(const struct rhw_context *context, rhw_texture texture,
                             const struct rhw_texture_data *data, int level, const char *where);

#endif
