// SPDX-License-Identifier: MIT
#include "device.h"

#include "features.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

// Bytes of shaders and programs that a device keeps for pipelines that are made of the same.
enum { SHADER_BYTES = 1 << 26 };

void vulkan_log(const char *format, ...)
{
    if (getenv("RHW_VULKAN_LOG")) {
        va_list list;
        va_start(list, format);
        flockfile(stderr); // threads do not mix their lines
        fputs("rhw vulkan: ", stderr);
        vfprintf(stderr, format, list);
        fputc('\n', stderr);
        funlockfile(stderr);
        va_end(list);
    }
}

void *vulkan_device_allocate(VkDevice device, const VkAllocationCallbacks *own, size_t size)
{
    return vulkan_allocate(vulkan_callbacks(own, &device->callbacks), size,
                           VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
}

void vulkan_device_free(VkDevice device, const VkAllocationCallbacks *own, void *memory)
{
    vulkan_free(vulkan_callbacks(own, &device->callbacks), memory);
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo *info,
                                              const VkAllocationCallbacks *callbacks, VkDevice *device)
{
    *device = VK_NULL_HANDLE;
    vulkan_extension_set extensions;
    VkPhysicalDeviceFeatures features;
    VkResult result = vulkan_extensions_enable(info->ppEnabledExtensionNames, info->enabledExtensionCount,
                                               vulkan_extensions_of(true), &extensions);
    if (result == VK_SUCCESS && !vulkan_features_check(info, &features)) {
        result = VK_ERROR_FEATURE_NOT_PRESENT;
    }
    if (result != VK_SUCCESS) {
        return result;
    }
    callbacks = vulkan_callbacks(callbacks, &physical->instance->callbacks);
    const VkDevice made = vulkan_allocate(callbacks, sizeof *made, VK_SYSTEM_ALLOCATION_SCOPE_DEVICE);
    if (!made) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    made->physical = physical;
    made->callbacks = *callbacks;
    made->extensions = extensions;
    made->features = features;
    set_loader_magic_value(made);
    result = rhw_shader_cache_create(SHADER_BYTES, &made->shaders) == RHW_OK
                 ? vulkan_queue_init(&made->queue, made)
                 : VK_ERROR_OUT_OF_HOST_MEMORY;
    if (result != VK_SUCCESS) {
        rhw_shader_cache_destroy(made->shaders);
        vulkan_free(callbacks, made);
        return result;
    }
    made->isa = rhw_context_isa(made->queue.context);
    *device = made;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkDestroyDevice(VkDevice device, const VkAllocationCallbacks *callbacks)
{
    (void)callbacks; // the ones that it was created with are kept
    if (device) {
        vulkan_queue_end(&device->queue);
        rhw_shader_cache_destroy(device->shaders);
        const VkAllocationCallbacks own = device->callbacks;
        vulkan_free(&own, device);
    }
}

VKAPI_ATTR void VKAPI_CALL vkGetDeviceQueue(VkDevice device, uint32_t family, uint32_t index, VkQueue *queue)
{
    (void)family;
    (void)index;
    *queue = &device->queue;
}

VKAPI_ATTR void VKAPI_CALL vkGetDeviceQueue2(VkDevice device, const VkDeviceQueueInfo2 *info, VkQueue *queue)
{
    // A queue that is protected would have been refused.
    *queue = info->flags ? VK_NULL_HANDLE : &device->queue;
}

VKAPI_ATTR void VKAPI_CALL vkGetDeviceGroupPeerMemoryFeatures(VkDevice device, uint32_t heap, uint32_t local,
                                                              uint32_t remote,
                                                              VkPeerMemoryFeatureFlags *features)
{
    (void)device;
    (void)heap;
    (void)local;
    (void)remote;
    *features = VK_PEER_MEMORY_FEATURE_COPY_SRC_BIT | VK_PEER_MEMORY_FEATURE_COPY_DST_BIT |
                VK_PEER_MEMORY_FEATURE_GENERIC_SRC_BIT | VK_PEER_MEMORY_FEATURE_GENERIC_DST_BIT;
}
