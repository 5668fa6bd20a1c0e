// SPDX-License-Identifier: MIT
// DDS files: textures as Direct3D takes them.
#ifndef SCENE_IMAGE_DDS_H
#define SCENE_IMAGE_DDS_H

#include "model.h"

/// Set the width and height that the header says. Return false if the file ends before it says them.
bool scene_dds_size(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height);
/// Decode a DDS file as scene_image_decode does, but leave has_alpha alone. Of the levels the first one is read,
/// because the others are made of it anyway, and of an array the first texture.
const char *scene_image_decode_dds(const unsigned char *bytes, size_t size, struct scene_image *image);

#endif
