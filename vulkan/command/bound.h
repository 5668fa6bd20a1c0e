// SPDX-License-Identifier: MIT
// What the commands of one command buffer have bound up to a draw or a dispatch.
#ifndef VULKAN_BOUND_H
#define VULKAN_BOUND_H

#include "descriptor/descriptor_set.h"
#include "pipeline/pipeline.h"

enum {
    VULKAN_MAX_SETS = RHW_SHADER_MAX_SETS,
    VULKAN_MAX_PUSH_SIZE = 256, ///< bytes of push constants
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

// What a pass of librhw has not been told yet, or-ed.
enum vulkan_news {
    VULKAN_NEWS_PIPELINE = 1,
    VULKAN_NEWS_PUSH = 2,
    VULKAN_NEWS_INDICES = 4,
    VULKAN_NEWS_ALL = 7
};

struct vulkan_bound {
    struct vulkan_bound_point graphics, compute;
    _Alignas(16) unsigned char push_constants[VULKAN_MAX_PUSH_SIZE];
    struct vulkan_bound_vertices vertices[RHW_MAX_VERTEX_BUFFERS];
    VkBuffer indices;
    VkDeviceSize index_offset;
    VkIndexType index_type;
    struct vulkan_dynamic_state dynamic;

    /// The pass of librhw that is open knows what is bound, but for what the next members say. Whoever opens a pass
    /// makes it false.
    bool is_told;
    uint32_t news;                 ///< or-ed enum vulkan_news
    uint32_t news_sets;            ///< bit s: set s of graphics
    uint32_t news_vertices;        ///< bit i: vertex buffer i
    uint32_t news_dynamic;         ///< or-ed enum vulkan_dynamic
    struct rhw_shader_frame frame; ///< what shaders were given last
};

#endif
