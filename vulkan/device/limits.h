// SPDX-License-Identifier: MIT
// What librhw can do, in the words of Vulkan.
#ifndef VULKAN_LIMITS_H
#define VULKAN_LIMITS_H

#include <vulkan/vulkan_core.h>

VkPhysicalDeviceLimits vulkan_limits(void);

enum {
    VULKAN_SUBGROUP_SIZE = 8,
    VULKAN_MAX_VIEWS = 32, ///< bits of a view mask
    VULKAN_MAX_UNIFORM_RANGE = 65536
};

static const VkDeviceSize VULKAN_MAX_ALLOCATION = (VkDeviceSize)1 << 40; // bytes of memory or of a buffer

#endif
