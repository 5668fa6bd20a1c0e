// SPDX-License-Identifier: MIT
// Memory of the device is memory of the machine, always mapped.
#ifndef VULKAN_MEMORY_H
#define VULKAN_MEMORY_H

#include "device/device.h"

#include <pthread.h>
#include <stdatomic.h>

struct VkDeviceMemory_T {
    VkDeviceSize size;
    unsigned char *bytes; ///< zeros at first, so that what a program forgets to write is the same everywhere
    void *block;          ///< what is given back to the C library
    pthread_mutex_t lock; ///< guards the two that follow
    struct vulkan_memory_range {
        VkDeviceSize begin, end;
    } images, buffers; ///< what was bound lies within
    /// Something was bound to bytes there before an image was, or after: they may share bytes.
    atomic_bool has_aliases;
};

// Remember what is bound to memory.
void vulkan_memory_note_image(VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize size);
void vulkan_memory_note_buffer(VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize size);

enum {
    VULKAN_MEMORY_ALIGNMENT = RHW_MEMORY_ALIGNMENT ///< alignment of buffers and images in memory, bytes
};

#endif
