// SPDX-License-Identifier: MIT
// Descriptors are in memory of the program's sets, so their numbers are bounded by what one shader may name
// (RHW_SHADER_MAX_RESOURCES) and not by slots of librhw.
#include "limits.h"

#include "command/bound.h"
#include "rhw/rhw.h"
#include "rhw/spirv.h"

enum {
    SAMPLERS = 32,
    UNIFORM_BUFFERS = 32,
    STORAGE_BUFFERS = 32,
    SAMPLED_IMAGES = 64,
    STORAGE_IMAGES = 32,
    INPUTS = RHW_MAX_COLOR_ATTACHMENTS,
    STAGES = 3,
};

_Static_assert(SAMPLERS + UNIFORM_BUFFERS + STORAGE_BUFFERS + SAMPLED_IMAGES + STORAGE_IMAGES + INPUTS <=
                   RHW_SHADER_MAX_RESOURCES,
               "a shader may name all of them");

static void set_images(VkPhysicalDeviceLimits *limits, const struct rhw_limits *rhw)
{
    limits->maxImageDimension1D = rhw->max_image_dimension_1d;
    limits->maxImageDimension2D = rhw->max_image_dimension_2d;
    limits->maxImageDimension3D = rhw->max_image_dimension_3d;
    limits->maxImageDimensionCube = rhw->max_image_dimension_cube;
    limits->maxImageArrayLayers = rhw->max_image_array_layers;
    limits->maxTexelBufferElements = rhw->max_texel_buffer_elements;
    limits->sampledImageColorSampleCounts = rhw->sampled_image_color_sample_counts;
    limits->sampledImageIntegerSampleCounts = rhw->sampled_image_integer_sample_counts;
    limits->sampledImageDepthSampleCounts = rhw->sampled_image_depth_sample_counts;
    limits->sampledImageStencilSampleCounts = rhw->sampled_image_stencil_sample_counts;
    limits->storageImageSampleCounts = rhw->storage_image_sample_counts;
    limits->maxSamplerLodBias = rhw->max_sampler_lod_bias;
    limits->maxSamplerAnisotropy = rhw->max_sampler_anisotropy;
    limits->subTexelPrecisionBits = rhw->sub_texel_precision_bits;
    limits->mipmapPrecisionBits = rhw->mipmap_precision_bits;
    limits->minTexelOffset = rhw->min_texel_offset;
    limits->maxTexelOffset = rhw->max_texel_offset;
    limits->minTexelGatherOffset = rhw->min_texel_gather_offset;
    limits->maxTexelGatherOffset = rhw->max_texel_gather_offset;
}

static void set_descriptors(VkPhysicalDeviceLimits *limits, const struct rhw_limits *rhw)
{
    limits->maxUniformBufferRange = VULKAN_MAX_UNIFORM_RANGE;
    limits->maxStorageBufferRange = rhw->max_storage_buffer_range;
    limits->maxPushConstantsSize = VULKAN_MAX_PUSH_SIZE;
    limits->maxBoundDescriptorSets = VULKAN_MAX_SETS;
    limits->maxPerStageDescriptorSamplers = SAMPLERS;
    limits->maxPerStageDescriptorUniformBuffers = UNIFORM_BUFFERS;
    limits->maxPerStageDescriptorStorageBuffers = STORAGE_BUFFERS;
    limits->maxPerStageDescriptorSampledImages = SAMPLED_IMAGES;
    limits->maxPerStageDescriptorStorageImages = STORAGE_IMAGES;
    limits->maxPerStageDescriptorInputAttachments = INPUTS;
    limits->maxPerStageResources = RHW_SHADER_MAX_RESOURCES;
    limits->maxDescriptorSetSamplers = STAGES * SAMPLERS;
    limits->maxDescriptorSetUniformBuffers = STAGES * UNIFORM_BUFFERS;
    limits->maxDescriptorSetUniformBuffersDynamic = VULKAN_MAX_DYNAMIC_BUFFERS / 2;
    limits->maxDescriptorSetStorageBuffers = STAGES * STORAGE_BUFFERS;
    limits->maxDescriptorSetStorageBuffersDynamic = VULKAN_MAX_DYNAMIC_BUFFERS / 2;
    limits->maxDescriptorSetSampledImages = STAGES * SAMPLED_IMAGES;
    limits->maxDescriptorSetStorageImages = STAGES * STORAGE_IMAGES;
    limits->maxDescriptorSetInputAttachments = INPUTS;
    limits->minTexelBufferOffsetAlignment = 16;
    limits->minUniformBufferOffsetAlignment = 16;
    limits->minStorageBufferOffsetAlignment = 16;
}

static void set_vertices(VkPhysicalDeviceLimits *limits, const struct rhw_limits *rhw)
{
    limits->maxVertexInputAttributes = rhw->max_vertex_input_attributes;
    limits->maxVertexInputBindings = rhw->max_vertex_input_bindings;
    limits->maxVertexInputAttributeOffset = rhw->max_vertex_input_attribute_offset;
    limits->maxVertexInputBindingStride = rhw->max_vertex_input_binding_stride;
    limits->maxVertexOutputComponents = rhw->max_vertex_output_components;
    limits->maxFragmentInputComponents = rhw->max_fragment_input_components;
    limits->maxDrawIndexedIndexValue = UINT32_MAX;
    limits->maxDrawIndirectCount = 1 << 20; // a draw whose shaders read its number keeps 320 bytes
    limits->maxClipDistances = rhw->max_clip_distances;
    limits->maxCullDistances = rhw->max_cull_distances;
    limits->maxCombinedClipAndCullDistances = rhw->max_combined_clip_and_cull_distances;
}

static void set_attachments(VkPhysicalDeviceLimits *limits, const struct rhw_limits *rhw)
{
    limits->maxFragmentOutputAttachments = rhw->max_fragment_output_attachments;
    limits->maxFragmentDualSrcAttachments = rhw->max_fragment_dual_src_attachments;
    limits->maxFragmentCombinedOutputResources = RHW_MAX_COLOR_ATTACHMENTS + STORAGE_BUFFERS + STORAGE_IMAGES;
    limits->maxFramebufferWidth = rhw->max_framebuffer_width;
    limits->maxFramebufferHeight = rhw->max_framebuffer_height;
    limits->maxFramebufferLayers = rhw->max_framebuffer_layers;
    limits->framebufferColorSampleCounts = rhw->framebuffer_color_sample_counts;
    limits->framebufferDepthSampleCounts = rhw->framebuffer_depth_sample_counts;
    limits->framebufferStencilSampleCounts = rhw->framebuffer_stencil_sample_counts;
    limits->framebufferNoAttachmentsSampleCounts = rhw->framebuffer_no_attachments_sample_counts;
    limits->maxColorAttachments = rhw->max_color_attachments;
    limits->maxSampleMaskWords = rhw->max_sample_mask_words;
    limits->standardSampleLocations = rhw->standard_sample_locations;
    limits->minInterpolationOffset = rhw->min_interpolation_offset;
    limits->maxInterpolationOffset = rhw->max_interpolation_offset;
    limits->subPixelInterpolationOffsetBits = rhw->sub_pixel_interpolation_offset_bits;
}

static void set_rasterization(VkPhysicalDeviceLimits *limits, const struct rhw_limits *rhw)
{
    limits->subPixelPrecisionBits = rhw->sub_pixel_precision_bits;
    limits->maxViewports = rhw->max_viewports;
    limits->viewportSubPixelBits = rhw->viewport_sub_pixel_bits;
    for (int i = 0; i < 2; i++) {
        limits->maxViewportDimensions[i] = rhw->max_viewport_dimensions[i];
        limits->viewportBoundsRange[i] = rhw->viewport_bounds_range[i];
        limits->pointSizeRange[i] = rhw->point_size_range[i];
        limits->lineWidthRange[i] = rhw->line_width_range[i];
    }
    limits->pointSizeGranularity = rhw->point_size_granularity;
    limits->lineWidthGranularity = rhw->line_width_granularity;
    limits->strictLines = VK_TRUE;
}

static void set_compute(VkPhysicalDeviceLimits *limits, const struct rhw_limits *rhw)
{
    limits->maxComputeSharedMemorySize = rhw->max_compute_shared_memory_size;
    limits->maxComputeWorkGroupInvocations = rhw->max_compute_work_group_invocations;
    for (int i = 0; i < 3; i++) {
        limits->maxComputeWorkGroupCount[i] = rhw->max_compute_work_group_count[i];
        limits->maxComputeWorkGroupSize[i] = rhw->max_compute_work_group_size[i];
    }
}

VkPhysicalDeviceLimits vulkan_limits(void)
{
    const struct rhw_limits rhw = rhw_limits_get();
    VkPhysicalDeviceLimits limits = {
        .maxMemoryAllocationCount = UINT32_MAX,
        .maxSamplerAllocationCount = rhw.max_sampler_allocation_count,
        .bufferImageGranularity = 1,
        .discreteQueuePriorities = 2,
        .minMemoryMapAlignment = RHW_MEMORY_ALIGNMENT,
        .optimalBufferCopyOffsetAlignment = 1,
        .optimalBufferCopyRowPitchAlignment = 1,
        .nonCoherentAtomSize = 1,
        .timestampComputeAndGraphics = VK_TRUE,
        .timestampPeriod = 1,
    };
    set_images(&limits, &rhw);
    set_descriptors(&limits, &rhw);
    set_vertices(&limits, &rhw);
    set_attachments(&limits, &rhw);
    set_rasterization(&limits, &rhw);
    set_compute(&limits, &rhw);
    return limits;
}
