// SPDX-License-Identifier: MIT
// Compressed images whose views read the blocks with either sign. Each sign is a texture of librhw: the one of the
// image, and its twin, which is made when a view needs it.
#ifndef VULKAN_IMAGE_TWIN_H
#define VULKAN_IMAGE_TWIN_H

#include "image.h"

// Set *texture to the texture that has what a view of a format reads: the one of the image, or its twin. The queue's
// thread calls this.
enum rhw_result vulkan_image_texture_as(VkQueue queue, VkImage image, enum rhw_format format,
                                        rhw_texture *texture);

// Decode blocks of a compressed image that were written, to its texture, its twin and the twins of its aliases. The
// region lies in one level. The queue's thread calls this.
enum rhw_result vulkan_image_decode(VkQueue queue, VkImage image, const struct rhw_texture_region *region);

// Destroy the twin of an image, if there is one. Any thread may call this.
void vulkan_image_drop_twin(VkQueue queue, VkImage image);

#endif
