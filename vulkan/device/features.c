// SPDX-License-Identifier: MIT
#include "features.h"

#include <string.h>

VkPhysicalDeviceFeatures vulkan_features(void)
{
    return (VkPhysicalDeviceFeatures){
        .robustBufferAccess = VK_TRUE,
        .fullDrawIndexUint32 = VK_TRUE,
        .imageCubeArray = VK_TRUE,
        .independentBlend = VK_TRUE,
        .sampleRateShading = VK_TRUE,
        .dualSrcBlend = VK_TRUE,
        .logicOp = VK_TRUE,
        .multiDrawIndirect = VK_TRUE,
        .drawIndirectFirstInstance = VK_TRUE,
        .depthClamp = VK_TRUE,
        .depthBiasClamp = VK_TRUE,
        .fillModeNonSolid = VK_TRUE,
        .depthBounds = VK_TRUE,
        .wideLines = VK_TRUE,
        .largePoints = VK_TRUE,
        .alphaToOne = VK_TRUE,
        .multiViewport = VK_TRUE,
        .samplerAnisotropy = VK_TRUE,
        .textureCompressionETC2 = VK_TRUE,
        .textureCompressionASTC_LDR = VK_TRUE,
        .textureCompressionBC = VK_TRUE,
        .occlusionQueryPrecise = VK_TRUE,
        .vertexPipelineStoresAndAtomics = VK_TRUE,
        .fragmentStoresAndAtomics = VK_TRUE,
        .shaderImageGatherExtended = VK_TRUE,
        .shaderStorageImageExtendedFormats = VK_TRUE,
        .shaderStorageImageReadWithoutFormat = VK_TRUE,
        .shaderStorageImageWriteWithoutFormat = VK_TRUE,
        .shaderUniformBufferArrayDynamicIndexing = VK_TRUE,
        .shaderSampledImageArrayDynamicIndexing = VK_TRUE,
        .shaderStorageBufferArrayDynamicIndexing = VK_TRUE,
        .shaderStorageImageArrayDynamicIndexing = VK_TRUE,
        .shaderClipDistance = VK_TRUE,
        .shaderCullDistance = VK_TRUE,
        .inheritedQueries = VK_TRUE,
    };
}

// A struct of features is a header and truths behind it.
struct feature_struct {
    VkBaseOutStructure header;
    VkBool32 features[];
};

enum { MOST = 6 }; // features of one of the structs

// The structs of extensions and of Vulkan 1.1, with what the driver has of each.
static const struct {
    VkStructureType type;
    uint32_t count;
    VkBool32 features[MOST];
} structs[] = {
    {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_16BIT_STORAGE_FEATURES, 4, {0}},
    {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTIVIEW_FEATURES, 3, {1, 0, 0}},
    {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VARIABLE_POINTERS_FEATURES, 2, {0}},
    {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROTECTED_MEMORY_FEATURES, 1, {0}},
    {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SAMPLER_YCBCR_CONVERSION_FEATURES, 1, {0}},
    {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_DRAW_PARAMETERS_FEATURES, 1, {1}},
    {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES, 1, {1}},
    {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_IMAGELESS_FRAMEBUFFER_FEATURES, 1, {1}},
    {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES, 1, {1}},
    {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_HOST_QUERY_RESET_FEATURES, 1, {1}},
    {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES, 1, {1}},
    // Views exchange channels after texels and borders have been filtered, so a sampler need not know how.
    {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BORDER_COLOR_SWIZZLE_FEATURES_EXT, 2, {1, 1}},
    {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_CUSTOM_BORDER_COLOR_FEATURES_EXT, 2, {1, 1}},
    {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DEPTH_CLIP_ENABLE_FEATURES_EXT, 1, {1}},
    {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_INDEX_TYPE_UINT8_FEATURES_EXT, 1, {1}},
    {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_LINE_RASTERIZATION_FEATURES_EXT, 6, {1, 1, 1, 1, 1, 1}},
    {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROVOKING_VERTEX_FEATURES_EXT, 2, {1, 0}},
    {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TRANSFORM_FEEDBACK_FEATURES_EXT, 2, {1, 0}},
    {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VERTEX_ATTRIBUTE_DIVISOR_FEATURES_EXT, 2, {1, 1}},
};

enum { STRUCT_COUNT = sizeof structs / sizeof *structs };

static int find_struct(VkStructureType type)
{
    int i = 0;
    while (i < STRUCT_COUNT && structs[i].type != type) {
        i++;
    }
    return i;
}

void vulkan_features_fill(void *chain)
{
    for (struct feature_struct *one = chain; one; one = (struct feature_struct *)one->header.pNext) {
        const int i = find_struct(one->header.sType);
        if (i < STRUCT_COUNT) {
            memcpy(one->features, structs[i].features, structs[i].count * sizeof(VkBool32));
        }
    }
}

static bool is_within(const VkBool32 *wanted, const VkBool32 *had, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (wanted[i] && !had[i]) {
            return false;
        }
    }
    return true;
}

bool vulkan_features_check(const VkDeviceCreateInfo *info, VkPhysicalDeviceFeatures *enabled)
{
    *enabled = (VkPhysicalDeviceFeatures){0};
    if (info->pEnabledFeatures) {
        *enabled = *info->pEnabledFeatures;
    }
    for (const struct feature_struct *one = info->pNext; one;
         one = (const struct feature_struct *)one->header.pNext) {
        const int i = find_struct(one->header.sType);
        if (one->header.sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2) {
            *enabled = ((const VkPhysicalDeviceFeatures2 *)(const void *)one)->features;
        } else if (i < STRUCT_COUNT && !is_within(one->features, structs[i].features, structs[i].count)) {
            return false;
        }
    }
    const VkPhysicalDeviceFeatures had = vulkan_features();
    return is_within((const VkBool32 *)enabled, (const VkBool32 *)&had, sizeof had / sizeof(VkBool32));
}
