// SPDX-License-Identifier: MIT
// A device has one queue, which is a part of it.
#ifndef VULKAN_DEVICE_H
#define VULKAN_DEVICE_H

#include "instance.h"
#include "queue/queue.h"
#include "rhw/spirv.h"

struct VkDevice_T {
    VK_LOADER_DATA loader;
    VkPhysicalDevice physical;
    VkAllocationCallbacks callbacks;
    vulkan_extension_set extensions;
    VkPhysicalDeviceFeatures features; ///< features that the program switched on
    enum rhw_isa isa;                  ///< instruction set of the queue's context
    rhw_shader_cache *shaders;         ///< what pipelines were made of, for those that are made of the same
    struct VkQueue_T queue;
};

// Return zeroed memory for an object of a device, or NULL.
void *vulkan_device_allocate(VkDevice device, const VkAllocationCallbacks *own, size_t size);

// Give the memory of an object back, which may be NULL.
void vulkan_device_free(VkDevice device, const VkAllocationCallbacks *own, void *memory);

// Write to stderr what went wrong, if RHW_VULKAN_LOG is set. `format` is that of printf.
__attribute__((format(printf, 1, 2))) void vulkan_log(const char *format, ...);

#endif
