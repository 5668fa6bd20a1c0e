// SPDX-License-Identifier: MIT
#include "device/chain.h"
#include "fence.h"

VKAPI_ATTR VkResult VKAPI_CALL vkCreateSemaphore(VkDevice device, const VkSemaphoreCreateInfo *info,
                                                 const VkAllocationCallbacks *callbacks,
                                                 VkSemaphore *semaphore)
{
    *semaphore = vulkan_device_allocate(device, callbacks, sizeof **semaphore);
    if (!*semaphore) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    const VkSemaphoreTypeCreateInfo *const type =
        vulkan_chain_find(info->pNext, VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO);
    if (type) {
        (*semaphore)->is_timeline = type->semaphoreType == VK_SEMAPHORE_TYPE_TIMELINE;
        (*semaphore)->value = type->initialValue;
    }
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkDestroySemaphore(VkDevice device, VkSemaphore semaphore,
                                              const VkAllocationCallbacks *callbacks)
{
    vulkan_device_free(device, callbacks, semaphore);
}

void vulkan_semaphore_signal(VkQueue queue, VkSemaphore semaphore, uint64_t value)
{
    if (semaphore->is_timeline && value > semaphore->value) {
        semaphore->value = value;
        pthread_cond_broadcast(&queue->changed);
    }
}

// The value of a semaphore that a program was told before.
struct told {
    VkSemaphore semaphore;
    uint64_t value;
};

static bool is_new(void *user)
{
    struct told *const told = user;
    const bool is_news = told->semaphore->value != told->semaphore->told;
    told->value = told->semaphore->told = told->semaphore->value;
    return is_news;
}

VKAPI_ATTR VkResult VKAPI_CALL vkGetSemaphoreCounterValue(VkDevice device, VkSemaphore semaphore,
                                                          uint64_t *value)
{
    struct told told = {semaphore, 0};
    const VkResult result = vulkan_queue_ask(&device->queue, semaphore, is_new, &told);
    *value = told.value;
    return result == VK_TIMEOUT ? VK_SUCCESS : result;
}

static bool have_values(void *user)
{
    const VkSemaphoreWaitInfo *const wait = user;
    uint32_t reached = 0;
    for (uint32_t i = 0; i < wait->semaphoreCount; i++) {
        reached += wait->pSemaphores[i]->value >= wait->pValues[i];
    }
    return wait->flags & VK_SEMAPHORE_WAIT_ANY_BIT ? reached > 0 : reached == wait->semaphoreCount;
}

VKAPI_ATTR VkResult VKAPI_CALL vkWaitSemaphores(VkDevice device, const VkSemaphoreWaitInfo *info,
                                                uint64_t timeout)
{
    VkSemaphoreWaitInfo wait = *info;
    return vulkan_queue_wait(&device->queue, have_values, &wait, timeout);
}

VKAPI_ATTR VkResult VKAPI_CALL vkSignalSemaphore(VkDevice device, const VkSemaphoreSignalInfo *info)
{
    pthread_mutex_lock(&device->queue.lock);
    vulkan_semaphore_signal(&device->queue, info->semaphore, info->value);
    pthread_mutex_unlock(&device->queue.lock);
    return VK_SUCCESS;
}
