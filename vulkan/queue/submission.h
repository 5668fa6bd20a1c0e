// SPDX-License-Identifier: MIT
// What one VkSubmitInfo asks for, copied: semaphores to wait for, command buffers, and what is signalled after them.
#ifndef VULKAN_SUBMISSION_H
#define VULKAN_SUBMISSION_H

#include "fence.h"

// A semaphore with the value that is waited for or signalled.
struct vulkan_point {
    VkSemaphore semaphore;
    uint64_t value;
};

struct vulkan_submission {
    struct vulkan_submission *next;
    uint32_t wait_count, signal_count, buffer_count;
    const struct vulkan_point *waits, *signals;
    const VkCommandBuffer *buffers;
    VkFence fence; ///< signalled behind the others, or VK_NULL_HANDLE
};

#endif
