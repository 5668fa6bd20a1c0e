// SPDX-License-Identifier: MIT
#include "memory.h"

#include <stdint.h>
#include <stdlib.h>

// Return zeros, which are pages of the system that nothing has touched where there are many of them.
static unsigned char *allocate(VkDeviceSize size, void **block)
{
    const size_t more = VULKAN_MEMORY_ALIGNMENT + RHW_MEMORY_PADDING;
    *block = size < SIZE_MAX - more ? calloc(1, (size_t)size + more) : NULL;
    if (!*block) {
        return NULL;
    }
    unsigned char *const bytes = *block;
    const size_t past = (uintptr_t)bytes % VULKAN_MEMORY_ALIGNMENT;
    return past == 0 ? bytes : bytes + VULKAN_MEMORY_ALIGNMENT - past;
}

static bool overlap(struct vulkan_memory_range a, struct vulkan_memory_range b)
{
    return a.begin < b.end && b.begin < a.end;
}

static void widen(struct vulkan_memory_range *range, struct vulkan_memory_range more)
{
    const bool is_first = range->end == 0;
    range->begin = is_first || more.begin < range->begin ? more.begin : range->begin;
    range->end = more.end > range->end ? more.end : range->end;
}

void vulkan_memory_note_buffer(VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize size)
{
    const struct vulkan_memory_range mine = {offset, offset + size};
    pthread_mutex_lock(&memory->lock);
    if (overlap(mine, memory->images)) {
        memory->has_aliases = true;
    }
    widen(&memory->buffers, mine);
    pthread_mutex_unlock(&memory->lock);
}

void vulkan_memory_note_image(VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize size)
{
    const struct vulkan_memory_range mine = {offset, offset + size};
    pthread_mutex_lock(&memory->lock);
    if (overlap(mine, memory->images) || overlap(mine, memory->buffers)) {
        memory->has_aliases = true;
    }
    widen(&memory->images, mine);
    pthread_mutex_unlock(&memory->lock);
}

VKAPI_ATTR VkResult VKAPI_CALL vkAllocateMemory(VkDevice device, const VkMemoryAllocateInfo *info,
                                                const VkAllocationCallbacks *callbacks,
                                                VkDeviceMemory *memory)
{
    *memory = VK_NULL_HANDLE;
    VkPhysicalDeviceMemoryProperties properties;
    vkGetPhysicalDeviceMemoryProperties(device->physical, &properties);
    if (info->allocationSize > properties.memoryHeaps[0].size) {
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    const VkDeviceMemory made = vulkan_device_allocate(device, callbacks, sizeof *made);
    if (!made) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    made->size = info->allocationSize;
    made->bytes = allocate(info->allocationSize, &made->block);
    if (!made->bytes) {
        vulkan_device_free(device, callbacks, made);
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    pthread_mutex_init(&made->lock, NULL);
    *memory = made;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkFreeMemory(VkDevice device, VkDeviceMemory memory,
                                        const VkAllocationCallbacks *callbacks)
{
    if (memory) {
        free(memory->block);
        pthread_mutex_destroy(&memory->lock);
        vulkan_device_free(device, callbacks, memory);
    }
}

VKAPI_ATTR VkResult VKAPI_CALL vkMapMemory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset,
                                           VkDeviceSize size, VkMemoryMapFlags flags, void **data)
{
    (void)device;
    (void)size;
    (void)flags;
    *data = memory->bytes + offset;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkUnmapMemory(VkDevice device, VkDeviceMemory memory)
{
    (void)device;
    (void)memory;
}

VKAPI_ATTR VkResult VKAPI_CALL vkFlushMappedMemoryRanges(VkDevice device, uint32_t count,
                                                         const VkMappedMemoryRange *ranges)
{
    (void)device;
    (void)count;
    (void)ranges;
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL vkInvalidateMappedMemoryRanges(VkDevice device, uint32_t count,
                                                              const VkMappedMemoryRange *ranges)
{
    (void)device;
    (void)count;
    (void)ranges;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkGetDeviceMemoryCommitment(VkDevice device, VkDeviceMemory memory,
                                                       VkDeviceSize *committed)
{
    (void)device;
    *committed = memory->size;
}
