// SPDX-License-Identifier: MIT
// Memory of the device is memory of the machine, always mapped.
#ifndef VULKAN_MEMORY_H
#define VULKAN_MEMORY_H

#include "device/device.h"

struct VkDeviceMemory_T {
    VkDeviceSize size;
    unsigned char *bytes; ///< zeros at first, so that what a program forgets to write is the same everywhere
    void *block;          ///< what is given back to the C library
};

enum {
    VULKAN_MEMORY_ALIGNMENT = RHW_MEMORY_ALIGNMENT ///< alignment of buffers and images in memory, bytes
};

#endif
