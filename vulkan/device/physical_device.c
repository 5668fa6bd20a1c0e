// SPDX-License-Identifier: MIT
// The properties of the one physical device, which is the machine's processor. It says 1.1 and has no conformance
// version: the extension that would tell one is left out.
#include "features.h"
#include "instance.h"
#include "limits.h"
#include "rhw/rhw.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceFeatures(VkPhysicalDevice device,
                                                       VkPhysicalDeviceFeatures *features)
{
    (void)device;
    *features = vulkan_features();
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceFeatures2(VkPhysicalDevice device,
                                                        VkPhysicalDeviceFeatures2 *features)
{
    vkGetPhysicalDeviceFeatures(device, &features->features);
    vulkan_features_fill(features->pNext);
}

static void set_uuid(uint8_t uuid[VK_UUID_SIZE], const char *what)
{
    char text[64];
    snprintf(text, sizeof text, "%s %s rhw", what, rhw_version());
    memset(uuid, 0, VK_UUID_SIZE);
    memcpy(uuid, text, strlen(text) < VK_UUID_SIZE ? strlen(text) : VK_UUID_SIZE);
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceProperties(VkPhysicalDevice device,
                                                         VkPhysicalDeviceProperties *properties)
{
    (void)device;
    *properties = (VkPhysicalDeviceProperties){
        .apiVersion = VK_MAKE_API_VERSION(0, 1, 1, VK_HEADER_VERSION),
        .driverVersion = VK_MAKE_API_VERSION(0, RHW_VERSION_MAJOR, RHW_VERSION_MINOR, RHW_VERSION_PATCH),
        .deviceType = VK_PHYSICAL_DEVICE_TYPE_CPU,
        .limits = vulkan_limits(),
    };
    snprintf(properties->deviceName, sizeof properties->deviceName, "rhw %s", rhw_version());
    set_uuid(properties->pipelineCacheUUID, "cache");
}

static void fill_id(VkPhysicalDeviceIDProperties *id)
{
    set_uuid(id->deviceUUID, "device");
    set_uuid(id->driverUUID, "driver");
    memset(id->deviceLUID, 0, sizeof id->deviceLUID);
    id->deviceNodeMask = 0;
    id->deviceLUIDValid = VK_FALSE;
}

static void fill_subgroup(VkPhysicalDeviceSubgroupProperties *subgroup)
{
    subgroup->subgroupSize = VULKAN_SUBGROUP_SIZE;
    subgroup->supportedStages = VK_SHADER_STAGE_COMPUTE_BIT;
    subgroup->supportedOperations = VK_SUBGROUP_FEATURE_BASIC_BIT | VK_SUBGROUP_FEATURE_VOTE_BIT |
                                    VK_SUBGROUP_FEATURE_ARITHMETIC_BIT | VK_SUBGROUP_FEATURE_BALLOT_BIT |
                                    VK_SUBGROUP_FEATURE_SHUFFLE_BIT |
                                    VK_SUBGROUP_FEATURE_SHUFFLE_RELATIVE_BIT |
                                    VK_SUBGROUP_FEATURE_CLUSTERED_BIT | VK_SUBGROUP_FEATURE_QUAD_BIT;
    subgroup->quadOperationsInAllStages = VK_FALSE;
}

static void fill_resolve(VkPhysicalDeviceDepthStencilResolveProperties *resolve)
{
    resolve->supportedDepthResolveModes = VK_RESOLVE_MODE_SAMPLE_ZERO_BIT | VK_RESOLVE_MODE_AVERAGE_BIT |
                                          VK_RESOLVE_MODE_MIN_BIT | VK_RESOLVE_MODE_MAX_BIT;
    resolve->supportedStencilResolveModes =
        VK_RESOLVE_MODE_SAMPLE_ZERO_BIT | VK_RESOLVE_MODE_MIN_BIT | VK_RESOLVE_MODE_MAX_BIT;
    resolve->independentResolveNone = VK_TRUE;
    resolve->independentResolve = VK_TRUE;
}

static void fill_maintenance3(VkPhysicalDeviceMaintenance3Properties *maintenance)
{
    maintenance->maxPerSetDescriptors = 1 << 20;
    maintenance->maxMemoryAllocationSize = VULKAN_MAX_ALLOCATION;
}

static void fill_feedback(VkPhysicalDeviceTransformFeedbackPropertiesEXT *feedback)
{
    const struct rhw_limits limits = rhw_limits_get();
    feedback->maxTransformFeedbackStreams = limits.max_transform_feedback_streams;
    feedback->maxTransformFeedbackBuffers = limits.max_transform_feedback_buffers;
    feedback->maxTransformFeedbackBufferSize = limits.max_transform_feedback_buffer_size;
    feedback->maxTransformFeedbackStreamDataSize = limits.max_transform_feedback_stream_data_size;
    feedback->maxTransformFeedbackBufferDataSize = limits.max_transform_feedback_buffer_data_size;
    feedback->maxTransformFeedbackBufferDataStride = limits.max_transform_feedback_buffer_data_stride;
    feedback->transformFeedbackQueries = VK_TRUE;
    feedback->transformFeedbackStreamsLinesTriangles = VK_FALSE;
    feedback->transformFeedbackRasterizationStreamSelect = VK_FALSE;
    feedback->transformFeedbackDraw = VK_TRUE;
}

static void fill_extension_properties(VkBaseOutStructure *one)
{
    void *const any = one;
    switch ((int)one->sType) {
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_CUSTOM_BORDER_COLOR_PROPERTIES_EXT:
        ((VkPhysicalDeviceCustomBorderColorPropertiesEXT *)any)->maxCustomBorderColorSamplers =
            rhw_limits_get().max_sampler_allocation_count;
        break;
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_LINE_RASTERIZATION_PROPERTIES_EXT:
        ((VkPhysicalDeviceLineRasterizationPropertiesEXT *)any)->lineSubPixelPrecisionBits =
            rhw_limits_get().sub_pixel_precision_bits;
        break;
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROVOKING_VERTEX_PROPERTIES_EXT:
        ((VkPhysicalDeviceProvokingVertexPropertiesEXT *)any)->provokingVertexModePerPipeline = VK_TRUE;
        ((VkPhysicalDeviceProvokingVertexPropertiesEXT *)any)
            ->transformFeedbackPreservesTriangleFanProvokingVertex = VK_FALSE;
        break;
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TRANSFORM_FEEDBACK_PROPERTIES_EXT: fill_feedback(any); break;
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VERTEX_ATTRIBUTE_DIVISOR_PROPERTIES_EXT:
        ((VkPhysicalDeviceVertexAttributeDivisorPropertiesEXT *)any)->maxVertexAttribDivisor = UINT32_MAX;
        break;
    default: break;
    }
}

static void fill_properties(VkBaseOutStructure *one)
{
    void *const any = one;
    switch (one->sType) {
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES: fill_id(any); break;
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES: fill_subgroup(any); break;
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DEPTH_STENCIL_RESOLVE_PROPERTIES: fill_resolve(any); break;
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES: fill_maintenance3(any); break;
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_POINT_CLIPPING_PROPERTIES:
        ((VkPhysicalDevicePointClippingProperties *)any)->pointClippingBehavior =
            VK_POINT_CLIPPING_BEHAVIOR_ALL_CLIP_PLANES;
        break;
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTIVIEW_PROPERTIES:
        ((VkPhysicalDeviceMultiviewProperties *)any)->maxMultiviewViewCount = VULKAN_MAX_VIEWS;
        ((VkPhysicalDeviceMultiviewProperties *)any)->maxMultiviewInstanceIndex = UINT32_MAX;
        break;
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROTECTED_MEMORY_PROPERTIES:
        ((VkPhysicalDeviceProtectedMemoryProperties *)any)->protectedNoFault = VK_FALSE;
        break;
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_PROPERTIES:
        ((VkPhysicalDeviceTimelineSemaphoreProperties *)any)->maxTimelineSemaphoreValueDifference =
            UINT64_MAX;
        break;
    default: fill_extension_properties(one); break;
    }
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceProperties2(VkPhysicalDevice device,
                                                          VkPhysicalDeviceProperties2 *properties)
{
    vkGetPhysicalDeviceProperties(device, &properties->properties);
    for (VkBaseOutStructure *one = properties->pNext; one; one = one->pNext) {
        fill_properties(one);
    }
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceQueueFamilyProperties(VkPhysicalDevice device, uint32_t *count,
                                                                    VkQueueFamilyProperties *properties)
{
    (void)device;
    if (!properties) {
        *count = 1;
    } else if (*count > 0) {
        *count = 1;
        properties[0] = (VkQueueFamilyProperties){
            .queueFlags = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT,
            .queueCount = 1,
            .timestampValidBits = 64,
            .minImageTransferGranularity = {1, 1, 1},
        };
    }
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceQueueFamilyProperties2(VkPhysicalDevice device, uint32_t *count,
                                                                     VkQueueFamilyProperties2 *properties)
{
    vkGetPhysicalDeviceQueueFamilyProperties(device, count,
                                             properties ? &properties[0].queueFamilyProperties : NULL);
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceMemoryProperties(VkPhysicalDevice device,
                                                               VkPhysicalDeviceMemoryProperties *properties)
{
    (void)device;
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    const VkDeviceSize memory = pages > 0 && page > 0 ? (VkDeviceSize)pages * (VkDeviceSize)page : 1 << 30;
    *properties = (VkPhysicalDeviceMemoryProperties){
        .memoryTypeCount = 1,
        .memoryHeapCount = 1,
        .memoryTypes = {{.propertyFlags =
                             VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                             VK_MEMORY_PROPERTY_HOST_COHERENT_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT}},
        .memoryHeaps = {{.size = memory, .flags = VK_MEMORY_HEAP_DEVICE_LOCAL_BIT}},
    };
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceMemoryProperties2(VkPhysicalDevice device,
                                                                VkPhysicalDeviceMemoryProperties2 *properties)
{
    vkGetPhysicalDeviceMemoryProperties(device, &properties->memoryProperties);
}

VKAPI_ATTR VkResult VKAPI_CALL vkEnumerateDeviceExtensionProperties(VkPhysicalDevice device,
                                                                    const char *layer, uint32_t *count,
                                                                    VkExtensionProperties *properties)
{
    (void)device;
    return layer ? VK_ERROR_LAYER_NOT_PRESENT
                 : vulkan_extensions_enumerate(vulkan_extensions_of(true), count, properties);
}

VKAPI_ATTR VkResult VKAPI_CALL vkEnumerateDeviceLayerProperties(VkPhysicalDevice device, uint32_t *count,
                                                                VkLayerProperties *properties)
{
    (void)device;
    (void)properties;
    *count = 0;
    return VK_SUCCESS;
}

// Memory, semaphores and fences of other processes are not there.

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceExternalBufferProperties(
    VkPhysicalDevice device, const VkPhysicalDeviceExternalBufferInfo *info,
    VkExternalBufferProperties *properties)
{
    (void)device;
    (void)info;
    properties->externalMemoryProperties = (VkExternalMemoryProperties){0};
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceExternalFenceProperties(
    VkPhysicalDevice device, const VkPhysicalDeviceExternalFenceInfo *info,
    VkExternalFenceProperties *properties)
{
    (void)device;
    (void)info;
    properties->exportFromImportedHandleTypes = 0;
    properties->compatibleHandleTypes = 0;
    properties->externalFenceFeatures = 0;
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceExternalSemaphoreProperties(
    VkPhysicalDevice device, const VkPhysicalDeviceExternalSemaphoreInfo *info,
    VkExternalSemaphoreProperties *properties)
{
    (void)device;
    (void)info;
    properties->exportFromImportedHandleTypes = 0;
    properties->compatibleHandleTypes = 0;
    properties->externalSemaphoreFeatures = 0;
}
