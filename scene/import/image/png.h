// SPDX-License-Identifier: MIT
// Large PNG files, read row by row and reduced on the way, so that the whole image never is in memory.
#ifndef SCENE_IMAGE_PNG_H
#define SCENE_IMAGE_PNG_H

#include "model.h"

/// Whether the bytes are a PNG file whose rows follow one another (one without interlacing).
bool scene_image_is_png_of_rows(const unsigned char *bytes, size_t size);
/// As scene_image_decode, no longer than `side` each way.
const char *scene_image_decode_png_reduced(const unsigned char *bytes, size_t size, uint32_t side,
                                           bool is_color, struct scene_image *image);

#endif
