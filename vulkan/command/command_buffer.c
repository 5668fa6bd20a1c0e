// SPDX-License-Identifier: MIT
// Chunks go back to the pool when a command buffer is reset, so recording the next frame allocates nothing.
#include "command.h"

#include "replay.h"

#include <string.h>

// Memory ----------------------------------------------------------------------------------------------

static struct vulkan_chunk *make_chunk(VkCommandPool pool, size_t size)
{
    struct vulkan_chunk *chunk = pool->unused;
    if (chunk && size <= VULKAN_CHUNK_SIZE) {
        pool->unused = chunk->next;
        chunk->next = NULL;
        chunk->used = 0;
        return chunk;
    }
    const size_t capacity = size > VULKAN_CHUNK_SIZE ? size : VULKAN_CHUNK_SIZE;
    chunk = vulkan_allocate(&pool->callbacks, sizeof *chunk + capacity, VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
    if (chunk) {
        chunk->capacity = capacity;
    }
    return chunk;
}

static void drop_chunks(VkCommandPool pool, struct vulkan_command_list *list)
{
    while (list->first) {
        struct vulkan_chunk *const chunk = list->first;
        list->first = chunk->next;
        if (chunk->capacity == VULKAN_CHUNK_SIZE) {
            chunk->next = pool->unused;
            pool->unused = chunk;
        } else {
            vulkan_free(&pool->callbacks, chunk);
        }
    }
    list->last = NULL;
}

static void free_unused(VkCommandPool pool)
{
    while (pool->unused) {
        struct vulkan_chunk *const chunk = pool->unused;
        pool->unused = chunk->next;
        vulkan_free(&pool->callbacks, chunk);
    }
}

void *vulkan_record(VkCommandBuffer buffer, size_t size, vulkan_replay_function *replay)
{
    struct vulkan_command_list *const list = &buffer->list;
    const size_t whole = (size + 15) / 16 * 16;
    if (!list->last || list->last->capacity - list->last->used < whole) {
        struct vulkan_chunk *const chunk = make_chunk(buffer->pool, whole);
        if (!chunk) {
            buffer->result = VK_ERROR_OUT_OF_HOST_MEMORY;
            return NULL;
        }
        if (list->last) {
            list->last->next = chunk;
        } else {
            list->first = chunk;
        }
        list->last = chunk;
    }
    struct vulkan_command *const command = (void *)(list->last->commands + list->last->used);
    memset(command, 0, whole);
    command->replay = replay;
    command->size = whole;
    list->last->used += whole;
    return command;
}

// Pools -----------------------------------------------------------------------------------------------

VKAPI_ATTR VkResult VKAPI_CALL vkCreateCommandPool(VkDevice device, const VkCommandPoolCreateInfo *info,
                                                   const VkAllocationCallbacks *callbacks,
                                                   VkCommandPool *pool)
{
    (void)info;
    *pool = vulkan_device_allocate(device, callbacks, sizeof **pool);
    if (!*pool) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    (*pool)->callbacks = *vulkan_callbacks(callbacks, &device->callbacks);
    return VK_SUCCESS;
}

static void reset(VkCommandBuffer buffer)
{
    drop_chunks(buffer->pool, &buffer->list);
    buffer->result = VK_SUCCESS;
    buffer->subpass = NULL;
    buffer->has_barrier = false;
    buffer->continues_pass = false;
}

static void free_buffer(VkCommandBuffer buffer)
{
    const VkCommandPool pool = buffer->pool;
    reset(buffer);
    if (buffer->previous) {
        buffer->previous->next = buffer->next;
    } else {
        pool->buffers = buffer->next;
    }
    if (buffer->next) {
        buffer->next->previous = buffer->previous;
    }
    vulkan_free(&pool->callbacks, buffer);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyCommandPool(VkDevice device, VkCommandPool pool,
                                                const VkAllocationCallbacks *callbacks)
{
    (void)device;
    (void)callbacks; // the ones that it was created with are kept
    if (pool) {
        while (pool->buffers) {
            free_buffer(pool->buffers);
        }
        free_unused(pool);
        const VkAllocationCallbacks own = pool->callbacks;
        vulkan_free(&own, pool);
    }
}

VKAPI_ATTR VkResult VKAPI_CALL vkResetCommandPool(VkDevice device, VkCommandPool pool,
                                                  VkCommandPoolResetFlags flags)
{
    (void)device;
    for (VkCommandBuffer buffer = pool->buffers; buffer; buffer = buffer->next) {
        reset(buffer);
    }
    if (flags & VK_COMMAND_POOL_RESET_RELEASE_RESOURCES_BIT) {
        free_unused(pool);
    }
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkTrimCommandPool(VkDevice device, VkCommandPool pool,
                                             VkCommandPoolTrimFlags flags)
{
    (void)device;
    (void)flags;
    free_unused(pool);
}

// Command buffers -------------------------------------------------------------------------------------

VKAPI_ATTR void VKAPI_CALL vkFreeCommandBuffers(VkDevice device, VkCommandPool pool, uint32_t count,
                                                const VkCommandBuffer *buffers)
{
    (void)device;
    (void)pool;
    for (uint32_t i = 0; i < count; i++) {
        if (buffers[i]) {
            free_buffer(buffers[i]);
        }
    }
}

static VkCommandBuffer make_buffer(VkDevice device, VkCommandPool pool, VkCommandBufferLevel level)
{
    const VkCommandBuffer buffer =
        vulkan_allocate(&pool->callbacks, sizeof *buffer, VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
    if (buffer) {
        set_loader_magic_value(buffer);
        buffer->device = device;
        buffer->pool = pool;
        buffer->level = level;
        buffer->next = pool->buffers;
        if (buffer->next) {
            buffer->next->previous = buffer;
        }
        pool->buffers = buffer;
    }
    return buffer;
}

VKAPI_ATTR VkResult VKAPI_CALL vkAllocateCommandBuffers(VkDevice device,
                                                        const VkCommandBufferAllocateInfo *info,
                                                        VkCommandBuffer *buffers)
{
    for (uint32_t i = 0; i < info->commandBufferCount; i++) {
        buffers[i] = make_buffer(device, info->commandPool, info->level);
        if (!buffers[i]) {
            vkFreeCommandBuffers(device, info->commandPool, i, buffers);
            memset(buffers, 0, info->commandBufferCount * sizeof *buffers);
            return VK_ERROR_OUT_OF_HOST_MEMORY;
        }
    }
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL vkBeginCommandBuffer(VkCommandBuffer buffer,
                                                    const VkCommandBufferBeginInfo *info)
{
    reset(buffer);
    buffer->continues_pass = buffer->level == VK_COMMAND_BUFFER_LEVEL_SECONDARY &&
                             (info->flags & VK_COMMAND_BUFFER_USAGE_RENDER_PASS_CONTINUE_BIT);
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL vkEndCommandBuffer(VkCommandBuffer buffer)
{
    return buffer->result;
}

VKAPI_ATTR VkResult VKAPI_CALL vkResetCommandBuffer(VkCommandBuffer buffer, VkCommandBufferResetFlags flags)
{
    reset(buffer);
    if (flags & VK_COMMAND_BUFFER_RESET_RELEASE_RESOURCES_BIT) {
        free_unused(buffer->pool);
    }
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkCmdSetDeviceMask(VkCommandBuffer buffer, uint32_t mask)
{
    (void)buffer; // there is one device
    (void)mask;
}
