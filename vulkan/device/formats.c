// SPDX-License-Identifier: MIT
#include "formats.h"

#include "chain.h"
#include "limits.h"
#include "resource/format.h"

// Return the features of a texture in words of Vulkan.
static VkFormatFeatureFlags texture_features(enum rhw_format format)
{
    static const struct {
        uint32_t rhw;
        VkFormatFeatureFlags vulkan;
    } pairs[] = {
        {RHW_FEATURE_SAMPLED, VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_BLIT_SRC_BIT |
                                  VK_FORMAT_FEATURE_TRANSFER_SRC_BIT | VK_FORMAT_FEATURE_TRANSFER_DST_BIT},
        {RHW_FEATURE_FILTERED, VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT},
        {RHW_FEATURE_COLOR_ATTACHMENT,
         VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT | VK_FORMAT_FEATURE_BLIT_DST_BIT},
        {RHW_FEATURE_BLENDED, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT},
        {RHW_FEATURE_DEPTH_ATTACHMENT, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT |
                                           VK_FORMAT_FEATURE_BLIT_SRC_BIT | VK_FORMAT_FEATURE_BLIT_DST_BIT},
        {RHW_FEATURE_STENCIL_ATTACHMENT,
         VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT |
             VK_FORMAT_FEATURE_BLIT_SRC_BIT | VK_FORMAT_FEATURE_BLIT_DST_BIT |
             VK_FORMAT_FEATURE_TRANSFER_SRC_BIT | VK_FORMAT_FEATURE_TRANSFER_DST_BIT},
        {RHW_FEATURE_STORAGE_IMAGE, VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT},
        {RHW_FEATURE_STORAGE_ATOMIC, VK_FORMAT_FEATURE_STORAGE_IMAGE_ATOMIC_BIT},
    };
    const uint32_t has = rhw_format_features(format);
    VkFormatFeatureFlags features = 0;
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        features |= has & pairs[i].rhw ? pairs[i].vulkan : 0;
    }
    return features;
}

static VkFormatFeatureFlags buffer_features(VkFormat format)
{
    const uint32_t has = rhw_format_features(vulkan_format(format));
    enum rhw_vertex_format vertex;
    VkFormatFeatureFlags features =
        vulkan_vertex_format(format, &vertex) ? VK_FORMAT_FEATURE_VERTEX_BUFFER_BIT : 0;
    if (has & RHW_FEATURE_TEXEL_BUFFER) {
        features |= VK_FORMAT_FEATURE_UNIFORM_TEXEL_BUFFER_BIT | VK_FORMAT_FEATURE_STORAGE_TEXEL_BUFFER_BIT;
        features |= has & RHW_FEATURE_STORAGE_ATOMIC ? VK_FORMAT_FEATURE_STORAGE_TEXEL_BUFFER_ATOMIC_BIT : 0;
    }
    return features;
}

VkFormatProperties vulkan_format_properties(VkFormat format)
{
    const enum rhw_format own = vulkan_format(format);
    VkFormatProperties properties = {.bufferFeatures = buffer_features(format)};
    if (own != RHW_FORMAT_NONE) {
        properties.optimalTilingFeatures = texture_features(own);
        const bool is_linear = !vulkan_format_is_compressed(format) &&
                               vulkan_format_aspects(format) == VK_IMAGE_ASPECT_COLOR_BIT;
        properties.linearTilingFeatures = is_linear ? properties.optimalTilingFeatures : 0;
    }
    return properties;
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceFormatProperties(VkPhysicalDevice device, VkFormat format,
                                                               VkFormatProperties *properties)
{
    (void)device;
    *properties = vulkan_format_properties(format);
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceFormatProperties2(VkPhysicalDevice device, VkFormat format,
                                                                VkFormatProperties2 *properties)
{
    vkGetPhysicalDeviceFormatProperties(device, format, &properties->formatProperties);
}

// Images ----------------------------------------------------------------------------------------------

// Return the features that a use of an image needs.
static VkFormatFeatureFlags needs(VkImageUsageFlags usage)
{
    VkFormatFeatureFlags features = 0;
    features |= usage & VK_IMAGE_USAGE_TRANSFER_SRC_BIT ? VK_FORMAT_FEATURE_TRANSFER_SRC_BIT : 0;
    features |= usage & VK_IMAGE_USAGE_TRANSFER_DST_BIT ? VK_FORMAT_FEATURE_TRANSFER_DST_BIT : 0;
    features |= usage & VK_IMAGE_USAGE_SAMPLED_BIT ? VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT : 0;
    features |= usage & VK_IMAGE_USAGE_STORAGE_BIT ? VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT : 0;
    features |= usage & VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT ? VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT : 0;
    features |= usage & VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                    ? VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT
                    : 0;
    return features;
}

static uint32_t level_count(VkExtent3D most)
{
    uint32_t size = most.width > most.height ? most.width : most.height;
    uint32_t levels = 1;
    for (size = size > most.depth ? size : most.depth; size > 1; size /= 2) {
        levels++;
    }
    return levels;
}

static bool is_target(const VkPhysicalDeviceImageFormatInfo2 *info, VkFormatFeatureFlags features)
{
    const VkFormatFeatureFlags targets =
        VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT | VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT;
    return features & targets && info->type == VK_IMAGE_TYPE_2D && info->tiling == VK_IMAGE_TILING_OPTIMAL &&
           !(info->usage & VK_IMAGE_USAGE_STORAGE_BIT) &&
           !(info->flags & VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT);
}

static bool is_supported(const VkPhysicalDeviceImageFormatInfo2 *info, VkFormatFeatureFlags features)
{
    // Bits of flags whose images are not there.
    const VkImageCreateFlags missing =
        VK_IMAGE_CREATE_SPARSE_BINDING_BIT | VK_IMAGE_CREATE_SPARSE_RESIDENCY_BIT |
        VK_IMAGE_CREATE_SPARSE_ALIASED_BIT | VK_IMAGE_CREATE_PROTECTED_BIT | VK_IMAGE_CREATE_DISJOINT_BIT |
        VK_IMAGE_CREATE_BLOCK_TEXEL_VIEW_COMPATIBLE_BIT;
    const bool is_compressed = vulkan_format_is_compressed(info->format);
    const bool is_color = vulkan_format_aspects(info->format) == VK_IMAGE_ASPECT_COLOR_BIT;
    const bool has_type = info->type == VK_IMAGE_TYPE_1D   ? !is_compressed
                          : info->type == VK_IMAGE_TYPE_3D ? !is_compressed && is_color
                                                           : true;
    // With extended usage it is views of other formats that may be used so.
    const VkFormatFeatureFlags wanted =
        info->flags & VK_IMAGE_CREATE_EXTENDED_USAGE_BIT ? 0 : needs(info->usage);
    return features != 0 && !(info->flags & missing) && (features & wanted) == wanted &&
           (info->tiling == VK_IMAGE_TILING_OPTIMAL || info->type == VK_IMAGE_TYPE_2D) &&
           info->tiling <= VK_IMAGE_TILING_LINEAR && has_type;
}

VkResult vulkan_image_properties(const VkPhysicalDeviceImageFormatInfo2 *info,
                                 VkImageFormatProperties *properties)
{
    const VkFormatProperties format = vulkan_format_properties(info->format);
    const VkFormatFeatureFlags features =
        info->tiling == VK_IMAGE_TILING_LINEAR ? format.linearTilingFeatures : format.optimalTilingFeatures;
    *properties = (VkImageFormatProperties){0};
    if (!is_supported(info, features)) {
        return VK_ERROR_FORMAT_NOT_SUPPORTED;
    }
    const VkPhysicalDeviceLimits limits = vulkan_limits();
    const uint32_t flat = info->flags & VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT ? limits.maxImageDimensionCube
                                                                            : limits.maxImageDimension2D;
    const uint32_t deep = limits.maxImageDimension3D;
    const bool is_linear = info->tiling == VK_IMAGE_TILING_LINEAR;
    properties->maxExtent = info->type == VK_IMAGE_TYPE_1D   ? (VkExtent3D){limits.maxImageDimension1D, 1, 1}
                            : info->type == VK_IMAGE_TYPE_2D ? (VkExtent3D){flat, flat, 1}
                                                             : (VkExtent3D){deep, deep, deep};
    properties->maxMipLevels = is_linear ? 1 : level_count(properties->maxExtent);
    properties->maxArrayLayers = is_linear || info->type == VK_IMAGE_TYPE_3D ? 1 : limits.maxImageArrayLayers;
    properties->sampleCounts =
        is_target(info, features) ? limits.framebufferColorSampleCounts : VK_SAMPLE_COUNT_1_BIT;
    properties->maxResourceSize = (VkDeviceSize)1 << 31;
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL vkGetPhysicalDeviceImageFormatProperties(
    VkPhysicalDevice device, VkFormat format, VkImageType type, VkImageTiling tiling, VkImageUsageFlags usage,
    VkImageCreateFlags flags, VkImageFormatProperties *properties)
{
    (void)device;
    const VkPhysicalDeviceImageFormatInfo2 info = {
        .format = format, .type = type, .tiling = tiling, .usage = usage, .flags = flags};
    return vulkan_image_properties(&info, properties);
}

VKAPI_ATTR VkResult VKAPI_CALL vkGetPhysicalDeviceImageFormatProperties2(
    VkPhysicalDevice device, const VkPhysicalDeviceImageFormatInfo2 *info,
    VkImageFormatProperties2 *properties)
{
    (void)device;
    const VkPhysicalDeviceExternalImageFormatInfo *const external =
        vulkan_chain_find(info->pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTERNAL_IMAGE_FORMAT_INFO);
    if (external && external->handleType != 0) {
        properties->imageFormatProperties = (VkImageFormatProperties){0};
        return VK_ERROR_FORMAT_NOT_SUPPORTED;
    }
    return vulkan_image_properties(info, &properties->imageFormatProperties);
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceSparseImageFormatProperties(
    VkPhysicalDevice device, VkFormat format, VkImageType type, VkSampleCountFlagBits samples,
    VkImageUsageFlags usage, VkImageTiling tiling, uint32_t *count, VkSparseImageFormatProperties *properties)
{
    (void)device;
    (void)format;
    (void)type;
    (void)samples;
    (void)usage;
    (void)tiling;
    (void)properties;
    *count = 0;
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceSparseImageFormatProperties2(
    VkPhysicalDevice device, const VkPhysicalDeviceSparseImageFormatInfo2 *info, uint32_t *count,
    VkSparseImageFormatProperties2 *properties)
{
    (void)device;
    (void)info;
    (void)properties;
    *count = 0;
}
