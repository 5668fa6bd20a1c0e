// SPDX-License-Identifier: MIT
// An image is a texture of librhw on memory of the device. Linear and optimal tiling are the same rows of texels.
#ifndef VULKAN_IMAGE_H
#define VULKAN_IMAGE_H

#include "device/device.h"

struct VkImage_T {
    VkImageCreateFlags flags;
    VkImageType type;
    VkFormat vulkan_format;
    enum rhw_format format;
    VkExtent3D extent;
    uint32_t levels, layers, samples;
    VkImageTiling tiling;
    VkImageUsageFlags usage;
    struct rhw_texture_layout layout; ///< place of the texels behind `bytes` + `texels`
    /// Bytes of the blocks that stand before the texels; 0 if the format is not compressed. Levels follow each other,
    /// in each of them the layers or slices, rows of blocks without gaps.
    size_t texels;
    VkDeviceSize size; ///< bytes of the image in memory
    VkDeviceMemory memory;
    unsigned char *bytes; ///< first byte; NULL as long as no memory is bound

    // The queue's thread has these.
    rhw_texture texture; ///< null id until a command needs it
    /// What the blocks are to views of a format that reads them with the other sign; null id until one is needed.
    rhw_texture twin;
    VkImage next_twinned; ///< in the queue's list of images with twins
};

// Return the definition of the texture of an image.
struct rhw_texture_def vulkan_image_definition(VkImage image);

// Set *texture to the texture of an image that has memory. The queue's thread calls this. On failure, which is lost
// memory, *texture is the null id.
VkResult vulkan_image_texture(VkQueue queue, VkImage image, rhw_texture *texture);

// Forget what is known about the texels of an image, because another resource may have used its memory. The queue's
// thread calls this where the image comes from VK_IMAGE_LAYOUT_UNDEFINED.
void vulkan_image_forget(VkQueue queue, VkImage image);

// Return the width, height and depth of a level.
VkExtent3D vulkan_image_extent(VkImage image, uint32_t level);

// Return the slices of a level of a 3D image, or the layers of another image.
uint32_t vulkan_image_slices(VkImage image, uint32_t level);

// Return the place of the blocks of a level of a compressed image, from the image's first byte on.
size_t vulkan_image_blocks(VkImage image, uint32_t level);

// Return the bytes of a row of blocks, and those of a layer or slice of them.
size_t vulkan_image_block_row(VkImage image, uint32_t level);
size_t vulkan_image_block_slice(VkImage image, uint32_t level);

#endif
