// SPDX-License-Identifier: MIT
// Commands that bind: pipelines, sets, push constants, vertices and indices. Replaying one only takes notice of it; a
// draw or a dispatch tells librhw.
#include "replay.h"
#include <string.h>

struct bind_pipeline {
    struct vulkan_command command;
    VkPipeline pipeline;
};

static struct vulkan_bound_point *point_of(struct vulkan_replay *replay, VkPipelineBindPoint point)
{
    return point == VK_PIPELINE_BIND_POINT_COMPUTE ? &replay->bound.compute : &replay->bound.graphics;
}

static void replay_pipeline(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    VkPipeline pipeline = ((const struct bind_pipeline *)command)->pipeline;
    point_of(replay, pipeline->point)->pipeline = pipeline;
    if (pipeline->point == VK_PIPELINE_BIND_POINT_GRAPHICS) {
        replay->bound.news |= VULKAN_NEWS_PIPELINE;
    }
}

void vkCmdBindPipeline(VkCommandBuffer buffer, VkPipelineBindPoint point, VkPipeline pipeline)
{
    struct bind_pipeline *const bind = vulkan_record(buffer, sizeof *bind, replay_pipeline);
    (void)point;
    if (bind) {
        bind->pipeline = pipeline;
    }
}

// Sets -----------------------------------------------------------------------------------------------

struct bind_sets {
    struct vulkan_command command;
    VkPipelineBindPoint point;
    uint32_t first, count, offset_count;
    VkDescriptorSet sets[]; // dynamic offsets stand behind the sets
};

static void replay_sets(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct bind_sets *const bind = (const struct bind_sets *)command;
    struct vulkan_bound_point *const point = point_of(replay, bind->point);
    const uint32_t *offset = (const uint32_t *)&bind->sets[bind->count];
    const uint32_t *const end = offset + bind->offset_count;
    for (uint32_t i = 0; i < bind->count && bind->first + i < VULKAN_MAX_SETS; i++) {
        VkDescriptorSet set = bind->sets[i];
        const uint32_t number = bind->first + i;
        point->sets[number] = set;
        for (uint32_t d = 0; set && d < set->layout->dynamic_count; d++) {
            point->offsets[number][d] = offset < end ? *offset++ : 0;
        }
        if (bind->point == VK_PIPELINE_BIND_POINT_GRAPHICS) {
            replay->bound.news_sets |= 1u << number;
        }
    }
}

void vkCmdBindDescriptorSets(VkCommandBuffer buffer, VkPipelineBindPoint point, VkPipelineLayout layout,
                             uint32_t first, uint32_t count, const VkDescriptorSet *sets,
                             uint32_t offset_count, const uint32_t *offsets)
{
    struct bind_sets *const bind = vulkan_record(
        buffer, sizeof *bind + count * sizeof *sets + offset_count * sizeof *offsets, replay_sets);
    (void)layout;
    if (bind) {
        bind->point = point;
        bind->first = first;
        bind->count = count;
        bind->offset_count = offset_count;
        memcpy(bind->sets, sets, count * sizeof *sets);
        if (offset_count > 0) {
            memcpy(&bind->sets[count], offsets, offset_count * sizeof *offsets);
        }
    }
}

// Push constants -------------------------------------------------------------------------------------

struct push_constants {
    struct vulkan_command command;
    uint32_t offset, size;
    unsigned char bytes[];
};

static void replay_push(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct push_constants *const push = (const struct push_constants *)command;
    memcpy(replay->bound.push_constants + push->offset, push->bytes, push->size);
    replay->bound.news |= VULKAN_NEWS_PUSH;
}

void vkCmdPushConstants(VkCommandBuffer buffer, VkPipelineLayout layout, VkShaderStageFlags stages,
                        uint32_t offset, uint32_t size, const void *values)
{
    (void)layout;
    (void)stages;
    if (offset > VULKAN_MAX_PUSH_SIZE || size > VULKAN_MAX_PUSH_SIZE - offset) {
        return;
    }
    struct push_constants *const push = vulkan_record(buffer, sizeof *push + size, replay_push);
    if (push) {
        push->offset = offset;
        push->size = size;
        memcpy(push->bytes, values, size);
    }
}

// Vertices and indices -------------------------------------------------------------------------------

struct bind_vertices {
    struct vulkan_command command;
    uint32_t first, count;
    struct vulkan_bound_vertices vertices[];
};

static void replay_vertices(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct bind_vertices *const bind = (const struct bind_vertices *)command;
    for (uint32_t i = 0; i < bind->count && bind->first + i < RHW_MAX_VERTEX_BUFFERS; i++) {
        replay->bound.vertices[bind->first + i] = bind->vertices[i];
        replay->bound.news_vertices |= 1u << (bind->first + i);
    }
}

void vkCmdBindVertexBuffers(VkCommandBuffer buffer, uint32_t first, uint32_t count, const VkBuffer *buffers,
                            const VkDeviceSize *offsets)
{
    struct bind_vertices *const bind =
        vulkan_record(buffer, sizeof *bind + count * sizeof *bind->vertices, replay_vertices);
    if (bind) {
        bind->first = first;
        bind->count = count;
        for (uint32_t i = 0; i < count; i++) {
            bind->vertices[i] = (struct vulkan_bound_vertices){buffers[i], offsets[i]};
        }
    }
}

struct bind_indices {
    struct vulkan_command command;
    VkBuffer buffer;
    VkDeviceSize offset;
    VkIndexType type;
};

static void replay_indices(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct bind_indices *const bind = (const struct bind_indices *)command;
    replay->bound.indices = bind->buffer;
    replay->bound.index_offset = bind->offset;
    replay->bound.index_type = bind->type;
    replay->bound.news |= VULKAN_NEWS_INDICES;
}

void vkCmdBindIndexBuffer(VkCommandBuffer buffer, VkBuffer indices, VkDeviceSize offset, VkIndexType type)
{
    struct bind_indices *const bind = vulkan_record(buffer, sizeof *bind, replay_indices);
    if (bind) {
        bind->buffer = indices;
        bind->offset = offset;
        bind->type = type;
    }
}
