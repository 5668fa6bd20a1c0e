// SPDX-License-Identifier: MIT
// A buffer is a pointer into memory.
#ifndef VULKAN_BUFFER_H
#define VULKAN_BUFFER_H

#include "device/device.h"

struct VkBuffer_T {
    VkDeviceSize size;
    VkBufferUsageFlags usage;
    unsigned char *bytes; ///< first byte; NULL as long as no memory is bound
};

struct VkBufferView_T {
    struct rhw_binding binding; ///< texels, for reading and writing
};

// Return the bytes from `offset` on that a range has, where VK_WHOLE_SIZE goes up to the end, and no more than the
// buffer has. A buffer without memory has none.
VkDeviceSize vulkan_buffer_range(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize range);

// Return the place of a byte, or NULL if the buffer has no such byte.
unsigned char *vulkan_buffer_at(VkBuffer buffer, VkDeviceSize offset);

#endif
