// SPDX-License-Identifier: MIT
// What formats can be used for.
#ifndef VULKAN_FORMATS_H
#define VULKAN_FORMATS_H

#include <vulkan/vulkan_core.h>

VkFormatProperties vulkan_format_properties(VkFormat format);

#endif
