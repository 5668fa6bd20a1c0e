// SPDX-License-Identifier: MIT
// Fences, semaphores and events are numbers that the queue's lock guards, and changes of them wake who waits.
#ifndef VULKAN_FENCE_H
#define VULKAN_FENCE_H

#include "device/device.h"

struct VkFence_T {
    bool is_signaled;
};

struct VkSemaphore_T {
    bool is_timeline;
    uint64_t value; ///< counter of a timeline; binary ones are satisfied by the order of what is submitted
    uint64_t told;  ///< value that the program was told last
};

struct VkEvent_T {
    bool is_set;
};

// Signal a fence or set a semaphore to a value. The lock is held.
void vulkan_fence_signal(VkQueue queue, VkFence fence);
void vulkan_semaphore_signal(VkQueue queue, VkSemaphore semaphore, uint64_t value);

#endif
