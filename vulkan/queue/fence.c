// SPDX-License-Identifier: MIT
#include "fence.h"

VKAPI_ATTR VkResult VKAPI_CALL vkCreateFence(VkDevice device, const VkFenceCreateInfo *info,
                                             const VkAllocationCallbacks *callbacks, VkFence *fence)
{
    *fence = vulkan_device_allocate(device, callbacks, sizeof **fence);
    if (!*fence) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    (*fence)->is_signaled = info->flags & VK_FENCE_CREATE_SIGNALED_BIT;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkDestroyFence(VkDevice device, VkFence fence,
                                          const VkAllocationCallbacks *callbacks)
{
    vulkan_device_free(device, callbacks, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL vkResetFences(VkDevice device, uint32_t count, const VkFence *fences)
{
    pthread_mutex_lock(&device->queue.lock);
    for (uint32_t i = 0; i < count; i++) {
        fences[i]->is_signaled = false;
    }
    pthread_mutex_unlock(&device->queue.lock);
    return VK_SUCCESS;
}

void vulkan_fence_signal(VkQueue queue, VkFence fence)
{
    if (fence) {
        fence->is_signaled = true;
        pthread_cond_broadcast(&queue->changed);
    }
}

struct fences {
    const VkFence *fences;
    uint32_t count;
    bool all;
};

static bool are_signaled(void *user)
{
    const struct fences *const wait = user;
    uint32_t signaled = 0;
    for (uint32_t i = 0; i < wait->count; i++) {
        signaled += wait->fences[i]->is_signaled;
    }
    return wait->all ? signaled == wait->count : signaled > 0;
}

VKAPI_ATTR VkResult VKAPI_CALL vkGetFenceStatus(VkDevice device, VkFence fence)
{
    struct fences wait = {&fence, 1, true};
    const VkResult result = vulkan_queue_ask(&device->queue, fence, are_signaled, &wait);
    return result == VK_TIMEOUT ? VK_NOT_READY : result;
}

VKAPI_ATTR VkResult VKAPI_CALL vkWaitForFences(VkDevice device, uint32_t count, const VkFence *fences,
                                               VkBool32 all, uint64_t timeout)
{
    struct fences wait = {fences, count, all};
    return vulkan_queue_wait(&device->queue, are_signaled, &wait, timeout);
}
