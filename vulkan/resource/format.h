// SPDX-License-Identifier: MIT
// Formats of Vulkan as formats of librhw.
#ifndef VULKAN_FORMAT_H
#define VULKAN_FORMAT_H

#include "rhw/rhw.h"
#include <vulkan/vulkan_core.h>

// Return the format of texels, or RHW_FORMAT_NONE if librhw has none that is like it bit for bit.
enum rhw_format vulkan_format(VkFormat format);

// Set *result to the format of an attribute. Return false if librhw has none.
bool vulkan_vertex_format(VkFormat format, enum rhw_vertex_format *result);

// Return the aspects that a format has.
VkImageAspectFlags vulkan_format_aspects(VkFormat format);

// Return true if texels are whole numbers that are not normalized. The format is one of colour.
bool vulkan_format_is_integer(VkFormat format);
bool vulkan_format_is_compressed(VkFormat format);

// Return the bytes of a texel, or of a block, in a copy of one aspect.
size_t vulkan_format_bytes(VkFormat format, VkImageAspectFlags aspect);

#endif
