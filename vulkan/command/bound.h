// SPDX-License-Identifier: MIT
// What the commands of one command buffer have bound up to a draw or a dispatch.
#ifndef VULKAN_BOUND_H
#define VULKAN_BOUND_H

#include "rhw/rhw.h"
#include "rhw/spirv.h"
#include <vulkan/vulkan_core.h>

enum {
    VULKAN_MAX_SETS = RHW_SHADER_MAX_SETS,
    VULKAN_MAX_PUSH_SIZE = 256,      ///< bytes of push constants
    VULKAN_MAX_DYNAMIC_BUFFERS = 16, ///< buffers with dynamic offsets in all sets of a pipeline layout
};

// What a bind point has.
struct vulkan_bound_point {
    VkPipeline pipeline;
    VkDescriptorSet sets[VULKAN_MAX_SETS];
    uint32_t offsets[VULKAN_MAX_SETS][VULKAN_MAX_DYNAMIC_BUFFERS]; ///< dynamic offsets of each set, in order
};

struct vulkan_bound_vertices {
    VkBuffer buffer;
    VkDeviceSize offset;
};

// What the dynamic state of pipelines takes.
struct vulkan_dynamic_state {
    VkViewport viewports[RHW_MAX_VIEWPORTS];
    VkRect2D scissors[RHW_MAX_VIEWPORTS];
    float line_width;
    float depth_bias_constant, depth_bias_clamp, depth_bias_slope;
    float blend_constants[4];
    float depth_bounds[2];
    uint32_t stencil_compare_mask[2], stencil_write_mask[2], stencil_reference[2]; ///< [front, back]
};

struct vulkan_bound {
    struct vulkan_bound_point graphics, compute;
    unsigned char push_constants[VULKAN_MAX_PUSH_SIZE];
    struct vulkan_bound_vertices vertices[RHW_MAX_VERTEX_BUFFERS];
    VkBuffer indices;
    VkDeviceSize index_offset;
    VkIndexType index_type;
    struct vulkan_dynamic_state dynamic;
    bool is_told; ///< the pass of librhw that is open knows what is bound; false after anything changes
};

#endif
