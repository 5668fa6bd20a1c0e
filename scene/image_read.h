// SPDX-License-Identifier: MIT
// Decoding of image files that models use as textures: PNG, JPEG, TGA, BMP, PSD, PNM and Radiance HDR.
#ifndef RHW_SCENE_IMAGE_READ_H
#define RHW_SCENE_IMAGE_READ_H

#include "model.h"

/// Decodes an image file that lies in memory. Fills type, width, height, size, texels (malloc) and has_alpha
/// of `image`; NULL on success, else a short reason (static storage) and `image` is unchanged. Different
/// threads may call it at once.
const char *rhw_image_decode(const void *bytes, size_t size, struct rhw_image *image);
/// Sets has_alpha from the texels.
void rhw_image_find_alpha(struct rhw_image *image);
/// Makes `image` the stand-in for one that is missing: an opaque magenta and black checker, 8×8 RGBA8.
/// False: no memory.
bool rhw_image_stand_in(struct rhw_image *image);

#endif
