// SPDX-License-Identifier: MIT
// What formats can be used for.
#ifndef VULKAN_FORMATS_H
#define VULKAN_FORMATS_H

#include <vulkan/vulkan_core.h>

VkFormatProperties vulkan_format_properties(VkFormat format);

// Tell the limits of an image. Return VK_ERROR_FORMAT_NOT_SUPPORTED, with zeros, if there is no such image.
VkResult vulkan_image_properties(const VkPhysicalDeviceImageFormatInfo2 *info,
                                 VkImageFormatProperties *properties);

#endif
