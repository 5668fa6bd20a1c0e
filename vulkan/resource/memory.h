// SPDX-License-Identifier: MIT
// Memory of the device is memory of the machine, always mapped.
#ifndef VULKAN_MEMORY_H
#define VULKAN_MEMORY_H

#include "device/device.h"

struct VkDeviceMemory_T {
    VkDeviceSize size;
    unsigned char *bytes; ///< zeros at first, so that what a program forgets to write is the same everywhere
    void *block;          ///< what is given back to the C library
    VkDeviceSize first_image, end_images; ///< bytes that images were bound to lie within
    /// Something was bound to bytes there before an image was, or after: they may share bytes.
    bool has_aliases;
};

// Remember what is bound to memory.
void vulkan_memory_note_image(VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize size);
void vulkan_memory_note_buffer(VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize size);

enum {
    VULKAN_MEMORY_ALIGNMENT = RHW_MEMORY_ALIGNMENT ///< alignment of buffers and images in memory, bytes
};

#endif
