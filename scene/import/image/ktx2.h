// SPDX-License-Identifier: MIT
// KTX2 files: textures as graphics processors take them, and those of Basis Universal (KHR_texture_basisu of glTF).
#ifndef SCENE_IMAGE_KTX2_H
#define SCENE_IMAGE_KTX2_H

#include "model.h"

/// Set the width and height that the header says. Return false if the file ends before it says them.
bool scene_ktx2_size(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height);
/// Decode a KTX2 file as scene_image_decode does, but leave has_alpha alone. Of the levels the first one is read,
/// because the others are made of it anyway.
const char *scene_image_decode_ktx2(const unsigned char *bytes, size_t size, struct scene_image *image);

#endif
