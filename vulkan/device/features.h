// SPDX-License-Identifier: MIT
// The optional features of Vulkan that the driver has.
#ifndef VULKAN_FEATURES_H
#define VULKAN_FEATURES_H

#include <stdbool.h>
#include <vulkan/vulkan_core.h>

VkPhysicalDeviceFeatures vulkan_features(void);

// Fill the structs of a chain that have features.
void vulkan_features_fill(void *chain);

// Return false if a feature that vkCreateDevice asks for is not there. *enabled gets those of Vulkan 1.0.
bool vulkan_features_check(const VkDeviceCreateInfo *info, VkPhysicalDeviceFeatures *enabled);

#endif
