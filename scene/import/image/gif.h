// SPDX-License-Identifier: MIT
// GIF files, by giflib.
#ifndef SCENE_IMAGE_GIF_H
#define SCENE_IMAGE_GIF_H

#include "model.h"

/// Set the width and height that the header says. Return false if the file ends before it says them.
bool scene_gif_size(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height);
/// Decode a GIF file as scene_image_decode does, but leave has_alpha alone. Of an animation the first picture is read.
const char *scene_image_decode_gif(const unsigned char *bytes, size_t size, struct scene_image *image);

#endif
