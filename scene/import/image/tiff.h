// SPDX-License-Identifier: MIT
// TIFF files, by libtiff.
#ifndef SCENE_IMAGE_TIFF_H
#define SCENE_IMAGE_TIFF_H

#include "model.h"

/// Set the width and height of the first picture of a file. Return false if the file has none.
bool scene_tiff_size(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height);
/// Decode the first picture of a TIFF file as scene_image_decode does, but leave has_alpha alone.
const char *scene_image_decode_tiff(const unsigned char *bytes, size_t size, struct scene_image *image);

#endif
