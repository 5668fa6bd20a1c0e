// SPDX-License-Identifier: MIT
// Decoding of image files that models use as textures: PNG, JPEG, WebP, KTX2, TGA, BMP, PSD, PNM and
// Radiance HDR.
#ifndef SCENE_IMAGE_READ_H
#define SCENE_IMAGE_READ_H

#include "model.h"

/// Decodes an image file that lies in memory. Fills type, width, height, size, texels (malloc) and has_alpha
/// of `image`; NULL on success, else a short reason (static storage) and `image` is unchanged. Different
/// threads may call it at once.
const char *scene_image_decode(const void *bytes, size_t size, struct scene_image *image);
/// The same, but no longer than `side` each way (image/reduce.h); 0: as it is. `is_color`: what is averaged then is light.
const char *scene_image_decode_within(const void *bytes, size_t size, uint32_t side, bool is_color,
                                      struct scene_image *image);
/// How many texels an image has, by its header; 0: it does not say.
size_t scene_image_texels(const void *bytes, size_t size);
/// Sets has_alpha from the texels.
void scene_image_find_alpha(struct scene_image *image);
/// Makes `image` the stand-in for one that is missing: an opaque checker of magenta and dark magenta, 8×8 RGBA8.
/// False: no memory.
bool scene_image_stand_in(struct scene_image *image);

#endif
