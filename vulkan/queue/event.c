// SPDX-License-Identifier: MIT
#include "command/replay.h"
#include "fence.h"

VKAPI_ATTR VkResult VKAPI_CALL vkCreateEvent(VkDevice device, const VkEventCreateInfo *info,
                                             const VkAllocationCallbacks *callbacks, VkEvent *event)
{
    (void)info;
    *event = vulkan_device_allocate(device, callbacks, sizeof **event);
    return *event ? VK_SUCCESS : VK_ERROR_OUT_OF_HOST_MEMORY;
}

VKAPI_ATTR void VKAPI_CALL vkDestroyEvent(VkDevice device, VkEvent event,
                                          const VkAllocationCallbacks *callbacks)
{
    vulkan_device_free(device, callbacks, event);
}

static void set(VkQueue queue, VkEvent event, bool is_set)
{
    pthread_mutex_lock(&queue->lock);
    event->is_set = is_set;
    pthread_cond_broadcast(&queue->changed);
    pthread_mutex_unlock(&queue->lock);
}

VKAPI_ATTR VkResult VKAPI_CALL vkSetEvent(VkDevice device, VkEvent event)
{
    set(&device->queue, event, true);
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL vkResetEvent(VkDevice device, VkEvent event)
{
    set(&device->queue, event, false);
    return VK_SUCCESS;
}

static bool is_set(void *user)
{
    const struct VkEvent_T *const event = user;
    return event->is_set;
}

VKAPI_ATTR VkResult VKAPI_CALL vkGetEventStatus(VkDevice device, VkEvent event)
{
    const VkResult result = vulkan_queue_ask(&device->queue, event, is_set, event);
    return result == VK_TIMEOUT ? VK_EVENT_RESET : result == VK_SUCCESS ? VK_EVENT_SET : result;
}

struct event_command {
    struct vulkan_command command;
    VkEvent event;
    bool is_set;
};

static void replay_set(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct event_command *const event = (const struct event_command *)command;
    set(replay->queue, event->event, event->is_set);
}

// The program may set the event while the queue waits for it.
static void replay_wait(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct event_command *const event = (const struct event_command *)command;
    (void)vulkan_queue_wait(replay->queue, is_set, event->event, UINT64_MAX);
}

static void record(VkCommandBuffer buffer, VkEvent event, bool state, vulkan_replay_function *replay)
{
    struct event_command *const command = vulkan_record(buffer, sizeof *command, replay);
    if (command) {
        command->event = event;
        command->is_set = state;
    }
}

VKAPI_ATTR void VKAPI_CALL vkCmdSetEvent(VkCommandBuffer buffer, VkEvent event, VkPipelineStageFlags stages)
{
    (void)stages;
    record(buffer, event, true, replay_set);
}

VKAPI_ATTR void VKAPI_CALL vkCmdResetEvent(VkCommandBuffer buffer, VkEvent event, VkPipelineStageFlags stages)
{
    (void)stages;
    record(buffer, event, false, replay_set);
}

VKAPI_ATTR void VKAPI_CALL vkCmdWaitEvents(VkCommandBuffer buffer, uint32_t count, const VkEvent *events,
                                           VkPipelineStageFlags from, VkPipelineStageFlags to,
                                           uint32_t memory_count, const VkMemoryBarrier *memory,
                                           uint32_t buffer_count, const VkBufferMemoryBarrier *buffers,
                                           uint32_t image_count, const VkImageMemoryBarrier *images)
{
    for (uint32_t i = 0; i < count; i++) {
        record(buffer, events[i], true, replay_wait);
    }
    vkCmdPipelineBarrier(buffer, from, to, 0, memory_count, memory, buffer_count, buffers, image_count,
                         images);
}
