// SPDX-License-Identifier: MIT
// AVIF files, by libavif.
#ifndef SCENE_IMAGE_AVIF_H
#define SCENE_IMAGE_AVIF_H

#include "model.h"

/// Decode an AVIF file as scene_image_decode does, but leave has_alpha alone. Of an animation the first picture is
/// read.
const char *scene_image_decode_avif(const unsigned char *bytes, size_t size, struct scene_image *image);

#endif
