// SPDX-License-Identifier: MIT
// What pipelines are made of is kept for the whole device, whether they name a pipeline cache or not
// (VkDevice_T.shaders). So a pipeline cache has nothing of its own, caches are merged from the beginning, and the data
// is the header that Vulkan asks for: translating a shader takes less than a millisecond, which a file would not save.
#include "device/device.h"
#include <string.h>

struct VkPipelineCache_T {
    unsigned char unused;
};

VkResult vkCreatePipelineCache(VkDevice device, const VkPipelineCacheCreateInfo *info,
                               const VkAllocationCallbacks *allocator, VkPipelineCache *cache)
{
    (void)info;
    *cache = vulkan_device_allocate(device, allocator, sizeof **cache);
    return *cache ? VK_SUCCESS : VK_ERROR_OUT_OF_HOST_MEMORY;
}

void vkDestroyPipelineCache(VkDevice device, VkPipelineCache cache, const VkAllocationCallbacks *allocator)
{
    vulkan_device_free(device, allocator, cache);
}

VkResult vkGetPipelineCacheData(VkDevice device, VkPipelineCache cache, size_t *size, void *data)
{
    (void)cache;
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(device->physical, &properties);
    VkPipelineCacheHeaderVersionOne header = {.headerSize = sizeof header,
                                              .headerVersion = VK_PIPELINE_CACHE_HEADER_VERSION_ONE,
                                              .vendorID = properties.vendorID,
                                              .deviceID = properties.deviceID};
    memcpy(header.pipelineCacheUUID, properties.pipelineCacheUUID, sizeof header.pipelineCacheUUID);
    if (!data) {
        *size = sizeof header;
        return VK_SUCCESS;
    }
    if (*size < sizeof header) {
        *size = 0;
        return VK_INCOMPLETE;
    }
    memcpy(data, &header, sizeof header);
    *size = sizeof header;
    return VK_SUCCESS;
}

VkResult vkMergePipelineCaches(VkDevice device, VkPipelineCache cache, uint32_t count,
                               const VkPipelineCache *sources)
{
    (void)device;
    (void)cache;
    (void)count;
    (void)sources;
    return VK_SUCCESS;
}
