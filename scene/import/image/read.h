// SPDX-License-Identifier: MIT
// Decoding of image files that models use as textures: PNG, JPEG, WebP, KTX2, DDS, TIFF, OpenEXR, GIF, AVIF, SGI, TGA,
// BMP, PSD, PNM and Radiance HDR.
#ifndef SCENE_IMAGE_READ_H
#define SCENE_IMAGE_READ_H

#include "model.h"

/// Decode an image file that lies in memory. Fill type, width, height, size, texels (malloc) and has_alpha of `image`.
/// Return NULL on success. Return a short reason (static storage) if not; `image` is unchanged then. Different threads
/// may call it at once.
const char *scene_image_decode(const void *bytes, size_t size, struct scene_image *image);
/// Decode an image as scene_image_decode does, but no longer than `side` each way (image/reduce.h). A `side` of 0
/// leaves its size alone. With `is_color` the means are of light.
const char *scene_image_decode_within(const void *bytes, size_t size, uint32_t side, bool is_color,
                                      struct scene_image *image);
/// Return how many texels an image has, by its header. Return 0 if the header does not say, and SIZE_MAX if it takes a
/// library to read the header.
size_t scene_image_texels(const void *bytes, size_t size);
/// Return true if there is memory for the image that the header says and that so few bytes can hold. What its decoder
/// gets no memory for is then more than an image of its size takes, as damaged files ask for.
bool scene_image_has_memory(const void *bytes, size_t size);
/// Set has_alpha from the texels.
void scene_image_find_alpha(struct scene_image *image);
/// Make `image` the stand-in for one that is missing: an opaque checker of magenta and dark magenta, 8×8 RGBA8. Return
/// false if there is no memory.
bool scene_image_stand_in(struct scene_image *image);

#endif
