// SPDX-License-Identifier: MIT
// Texels of the formats that Vulkan names, plain and compressed, are decoded by the library itself.
#ifndef SCENE_VULKAN_FORMAT_H
#define SCENE_VULKAN_FORMAT_H

#include "model.h"

/// Return the bytes of `width` × `height` texels of a VkFormat, without gaps. Return 0 if the format cannot be read.
size_t scene_vulkan_size(uint32_t format, uint32_t width, uint32_t height);
/// Decode texels of a VkFormat. `image` has its width and height, 1..RHW_MAX_TARGET_SIZE, and gets type, size and
/// texels (malloc). Return NULL on success. Return a short reason (static storage) if not.
const char *scene_vulkan_decode(uint32_t format, const void *bytes, struct scene_image *image);

#endif
