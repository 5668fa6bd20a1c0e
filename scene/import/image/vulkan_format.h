// SPDX-License-Identifier: MIT
// Texels of the formats that Vulkan names, plain and compressed ones, decoded by the library itself.
#ifndef SCENE_VULKAN_FORMAT_H
#define SCENE_VULKAN_FORMAT_H

#include "model.h"

/// Bytes of `width` × `height` texels of a VkFormat, without gaps; 0: one that we do not read.
size_t scene_vulkan_size(uint32_t format, uint32_t width, uint32_t height);
/// Decodes them. `image` has its width and height, 1..RHW_MAX_TARGET_SIZE; gets type, size and texels (malloc). NULL on
/// success, else a short reason (static storage).
const char *scene_vulkan_decode(uint32_t format, const void *bytes, struct scene_image *image);

#endif
