// SPDX-License-Identifier: MIT
#include "buffer.h"

#include "device/limits.h"
#include "format.h"
#include "memory.h"

VKAPI_ATTR VkResult VKAPI_CALL vkCreateBuffer(VkDevice device, const VkBufferCreateInfo *info,
                                              const VkAllocationCallbacks *callbacks, VkBuffer *buffer)
{
    *buffer = VK_NULL_HANDLE;
    if (info->size > VULKAN_MAX_ALLOCATION) {
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    *buffer = vulkan_device_allocate(device, callbacks, sizeof **buffer);
    if (!*buffer) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    (*buffer)->size = info->size;
    (*buffer)->usage = info->usage;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkDestroyBuffer(VkDevice device, VkBuffer buffer,
                                           const VkAllocationCallbacks *callbacks)
{
    vulkan_device_free(device, callbacks, buffer);
}

VkDeviceSize vulkan_buffer_range(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize range)
{
    const VkDeviceSize left = buffer->bytes && offset < buffer->size ? buffer->size - offset : 0;
    return range < left ? range : left; // VK_WHOLE_SIZE is the largest number
}

unsigned char *vulkan_buffer_at(VkBuffer buffer, VkDeviceSize offset)
{
    return buffer->bytes && offset < buffer->size ? buffer->bytes + offset : NULL;
}

VKAPI_ATTR void VKAPI_CALL vkGetBufferMemoryRequirements(VkDevice device, VkBuffer buffer,
                                                         VkMemoryRequirements *requirements)
{
    (void)device;
    const VkDeviceSize unit = VULKAN_MEMORY_ALIGNMENT;
    *requirements = (VkMemoryRequirements){
        .size = buffer->size + (unit - buffer->size % unit) % unit,
        .alignment = unit,
        .memoryTypeBits = 1,
    };
}

// Tell that neither buffers nor images need memory of their own.
static void fill_requirements(VkBaseOutStructure *chain)
{
    for (VkBaseOutStructure *one = chain; one; one = one->pNext) {
        if (one->sType == VK_STRUCTURE_TYPE_MEMORY_DEDICATED_REQUIREMENTS) {
            VkMemoryDedicatedRequirements *const dedicated = (VkMemoryDedicatedRequirements *)one;
            dedicated->prefersDedicatedAllocation = VK_FALSE;
            dedicated->requiresDedicatedAllocation = VK_FALSE;
        }
    }
}

VKAPI_ATTR void VKAPI_CALL vkGetBufferMemoryRequirements2(VkDevice device,
                                                          const VkBufferMemoryRequirementsInfo2 *info,
                                                          VkMemoryRequirements2 *requirements)
{
    vkGetBufferMemoryRequirements(device, info->buffer, &requirements->memoryRequirements);
    fill_requirements(requirements->pNext);
}

VKAPI_ATTR VkResult VKAPI_CALL vkBindBufferMemory(VkDevice device, VkBuffer buffer, VkDeviceMemory memory,
                                                  VkDeviceSize offset)
{
    (void)device;
    if (offset > memory->size || buffer->size > memory->size - offset) {
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    buffer->bytes = memory->bytes + offset;
    vulkan_memory_note_buffer(memory, offset, buffer->size);
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL vkBindBufferMemory2(VkDevice device, uint32_t count,
                                                   const VkBindBufferMemoryInfo *infos)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; i < count && result == VK_SUCCESS; i++) {
        result = vkBindBufferMemory(device, infos[i].buffer, infos[i].memory, infos[i].memoryOffset);
    }
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateBufferView(VkDevice device, const VkBufferViewCreateInfo *info,
                                                  const VkAllocationCallbacks *callbacks, VkBufferView *view)
{
    *view = vulkan_device_allocate(device, callbacks, sizeof **view);
    if (!*view) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    const VkBuffer buffer = info->buffer;
    const VkDeviceSize size = vulkan_buffer_range(buffer, info->offset, info->range);
    // A binding that is refused is empty, and reads as 0.
    if (buffer->bytes &&
        !rhw_binding_of_texel_memory(device->isa, vulkan_buffer_at(buffer, info->offset), (size_t)size,
                                     vulkan_format(info->format), false, &(*view)->binding)) {
        vulkan_log("vkCreateBufferView: offset %llu and format %d make no texels",
                   (unsigned long long)info->offset, (int)info->format);
    }
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkDestroyBufferView(VkDevice device, VkBufferView view,
                                               const VkAllocationCallbacks *callbacks)
{
    vulkan_device_free(device, callbacks, view);
}
