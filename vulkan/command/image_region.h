// SPDX-License-Identifier: MIT
// Parts of images as regions of librhw, and blocks of compressed images as rows of bytes.
#ifndef VULKAN_IMAGE_REGION_H
#define VULKAN_IMAGE_REGION_H

#include "replay.h"
#include "resource/image.h"

// Return the region of one aspect. The z of offset and extent are of a 3D image alone.
struct rhw_texture_region vulkan_region(VkImage image, const VkImageSubresourceLayers *part,
                                        VkImageAspectFlags aspect, VkOffset3D offset, VkExtent3D extent);

// Return whether a region of an image lies within it, where an extent counts up to a whole block.
bool vulkan_region_is_within(VkImage image, const VkImageSubresourceLayers *part, VkOffset3D offset,
                             VkExtent3D extent);

// Return whether a region has no texels, which Vulkan forbids, and tell so. To librhw 0 texels are all there are.
bool vulkan_region_is_empty(VkImage image, const VkImageSubresourceLayers *part, VkExtent3D extent,
                            const char *what);

// Rows of texels or blocks in memory.
struct vulkan_rows {
    unsigned char *first;
    size_t row_pitch, slice_pitch; ///< bytes
};

// Numbers of texels or blocks.
struct vulkan_units {
    uint32_t width, height, depth;
    size_t bytes; ///< bytes of each
};

// Return an extent in texels as an extent in blocks, or in texels of a format that is not compressed.
struct vulkan_units vulkan_units_of(VkImage image, const VkImageSubresourceLayers *part, VkExtent3D extent);

// Return where the blocks of an image begin, or the texels of one that is not compressed.
struct vulkan_rows vulkan_rows_of(VkImage image, const VkImageSubresourceLayers *part, VkOffset3D offset);

// Copy rows of units.
void vulkan_rows_copy(struct vulkan_rows to, struct vulkan_rows from, struct vulkan_units units);

// Let the texture know the blocks or texels that were written to the image's memory.
void vulkan_rows_changed(struct vulkan_replay *replay, VkImage image, const VkImageSubresourceLayers *part,
                         VkOffset3D offset, struct vulkan_units units);

// Return the texture of an image, or the null id, with the replay's result set.
rhw_texture vulkan_replay_texture(struct vulkan_replay *replay, VkImage image);

#endif
