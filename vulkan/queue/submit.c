// SPDX-License-Identifier: MIT
// What the program submits is copied before any of it is put into the queue, so that a submission that fails has done
// nothing. The queue's thread frees it, which may not call the program's allocator.
#include "device/chain.h"
#include "submission.h"

#include <stdlib.h>

// Return a submission with room for so much, in one block.
static struct vulkan_submission *make_submission(const VkSubmitInfo *info)
{
    struct vulkan_submission *submission;
    const size_t points = (size_t)info->waitSemaphoreCount + info->signalSemaphoreCount;
    submission = calloc(1, sizeof *submission + points * sizeof(struct vulkan_point) +
                               info->commandBufferCount * sizeof(VkCommandBuffer));
    if (!submission) {
        return NULL;
    }
    struct vulkan_point *const point = (struct vulkan_point *)(submission + 1);
    const VkTimelineSemaphoreSubmitInfo *const values =
        vulkan_chain_find(info->pNext, VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO);
    for (uint32_t i = 0; i < info->waitSemaphoreCount; i++) {
        const bool has_value = values && i < values->waitSemaphoreValueCount;
        point[i] =
            (struct vulkan_point){info->pWaitSemaphores[i], has_value ? values->pWaitSemaphoreValues[i] : 0};
    }
    struct vulkan_point *const signals = point + info->waitSemaphoreCount;
    for (uint32_t i = 0; i < info->signalSemaphoreCount; i++) {
        const bool has_value = values && i < values->signalSemaphoreValueCount;
        signals[i] = (struct vulkan_point){info->pSignalSemaphores[i],
                                           has_value ? values->pSignalSemaphoreValues[i] : 0};
    }
    VkCommandBuffer *const buffers = (VkCommandBuffer *)(void *)(point + points);
    for (uint32_t i = 0; i < info->commandBufferCount; i++) {
        buffers[i] = info->pCommandBuffers[i];
    }
    submission->wait_count = info->waitSemaphoreCount;
    submission->signal_count = info->signalSemaphoreCount;
    submission->buffer_count = info->commandBufferCount;
    submission->waits = point;
    submission->signals = signals;
    submission->buffers = buffers;
    return submission;
}

static void free_all(struct vulkan_submission *first)
{
    while (first) {
        struct vulkan_submission *const next = first->next;
        free(first);
        first = next;
    }
}

static void put(VkQueue queue, struct vulkan_submission *first, struct vulkan_submission *last)
{
    if (queue->last) {
        queue->last->next = first;
    } else {
        queue->first = first;
    }
    queue->last = last;
    pthread_cond_broadcast(&queue->changed);
}

VKAPI_ATTR VkResult VKAPI_CALL vkQueueSubmit(VkQueue queue, uint32_t count, const VkSubmitInfo *submits,
                                             VkFence fence)
{
    static const VkSubmitInfo nothing = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO};
    struct vulkan_submission *first = NULL, **end = &first, *last = NULL;
    for (uint32_t i = 0; i < count || (count == 0 && i == 0); i++) {
        last = make_submission(count == 0 ? &nothing : &submits[i]);
        if (!last) {
            free_all(first);
            return VK_ERROR_OUT_OF_HOST_MEMORY;
        }
        *end = last;
        end = &last->next;
    }
    last->fence = fence;
    pthread_mutex_lock(&queue->lock);
    const bool is_lost = queue->is_lost;
    if (!is_lost) {
        put(queue, first, last);
    }
    pthread_mutex_unlock(&queue->lock);
    if (is_lost) {
        free_all(first);
        return VK_ERROR_DEVICE_LOST;
    }
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL vkQueueBindSparse(VkQueue queue, uint32_t count, const VkBindSparseInfo *infos,
                                                 VkFence fence)
{
    (void)count; // nothing is sparse, so only the fence counts
    (void)infos;
    return vkQueueSubmit(queue, 0, NULL, fence);
}

static bool is_idle(void *user)
{
    const struct VkQueue_T *const queue = user;
    return !queue->first;
}

VKAPI_ATTR VkResult VKAPI_CALL vkQueueWaitIdle(VkQueue queue)
{
    return vulkan_queue_wait(queue, is_idle, queue, UINT64_MAX);
}

VKAPI_ATTR VkResult VKAPI_CALL vkDeviceWaitIdle(VkDevice device)
{
    return vkQueueWaitIdle(&device->queue);
}
