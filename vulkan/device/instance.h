// SPDX-License-Identifier: MIT
// An instance has one physical device, which is a part of it.
#ifndef VULKAN_INSTANCE_H
#define VULKAN_INSTANCE_H

#include "allocation.h"
#include "entry.h"
#include <stdbool.h>
#include <vulkan/vk_icd.h>

struct VkPhysicalDevice_T {
    VK_LOADER_DATA loader;
    VkInstance instance;
};

struct VkInstance_T {
    VK_LOADER_DATA loader;
    VkAllocationCallbacks callbacks;
    vulkan_extension_set extensions;
    uint32_t api_version; ///< version that the program asks for; 1.0 if it asks for none
    struct VkPhysicalDevice_T physical;
};

#endif
