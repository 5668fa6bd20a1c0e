// SPDX-License-Identifier: MIT
// Check what is to be bound, for a public function `where`. Report misuse and return false where a rule is broken.
#ifndef RHW_BINDING_CHECK_H
#define RHW_BINDING_CHECK_H

#include <stdbool.h>
#include <stddef.h>

#include "rhw/types.h"

struct rhw_context;
struct rhw_sampler_data;
struct rhw_texture_data;

// Check that a texture can be sampled.
bool rhw_binding_check_texture(const struct rhw_context *context, rhw_texture id,
                               const struct rhw_texture_data *texture, const char *where);
// Check that a sampler fits a texture.
bool rhw_binding_check_sampler(const struct rhw_context *context, rhw_texture id, rhw_sampler sampler_id,
                               const struct rhw_sampler_data *sampler, const char *where);
// Check that a level can be an image.
bool rhw_binding_check_image(const struct rhw_context *context, rhw_texture id,
                             const struct rhw_texture_data *texture, int level, const char *where);
// Check that bytes from `offset` on can be texels of a format.
bool rhw_binding_check_texels(const struct rhw_context *context, enum rhw_format format, size_t offset,
                              const char *where);

// Return true if a sampler fits a texture.
bool rhw_sampler_fits(const struct rhw_texture_data *texture, const struct rhw_sampler_data *sampler);
// Return true if a buffer can have texels of the format, which exists: it is one of colour, and not compressed.
bool rhw_format_has_texels(enum rhw_format format);

#endif
