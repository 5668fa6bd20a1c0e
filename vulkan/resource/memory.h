// SPDX-License-Identifier: MIT
// Memory of the device is memory of the machine, always mapped.
#ifndef VULKAN_MEMORY_H
#define VULKAN_MEMORY_H

#include "device/device.h"

struct VkDeviceMemory_T {
    VkDeviceSize size;
    unsigned char *bytes;
};

enum {
    VULKAN_MEMORY_ALIGNMENT = RHW_MEMORY_ALIGNMENT ///< alignment of buffers and images in memory, bytes
};

#endif
