// SPDX-License-Identifier: MIT
// Commands that set what pipelines leave to them.
#include "replay.h"
#include <string.h>

struct set_viewports {
    struct vulkan_command command;
    uint32_t first, count;
    VkViewport viewports[];
};

static void replay_viewports(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct set_viewports *const set = (const struct set_viewports *)command;
    vulkan_dynamic_set_viewports(&replay->bound.dynamic, set->first, set->count, set->viewports);
    replay->bound.news_dynamic |= VULKAN_DYNAMIC_VIEWPORT;
}

void vkCmdSetViewport(VkCommandBuffer buffer, uint32_t first, uint32_t count, const VkViewport *viewports)
{
    struct set_viewports *const set =
        vulkan_record(buffer, sizeof *set + count * sizeof *viewports, replay_viewports);
    if (set) {
        set->first = first;
        set->count = count;
        memcpy(set->viewports, viewports, count * sizeof *viewports);
    }
}

struct set_scissors {
    struct vulkan_command command;
    uint32_t first, count;
    VkRect2D scissors[];
};

static void replay_scissors(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct set_scissors *const set = (const struct set_scissors *)command;
    vulkan_dynamic_set_scissors(&replay->bound.dynamic, set->first, set->count, set->scissors);
    replay->bound.news_dynamic |= VULKAN_DYNAMIC_SCISSOR;
}

void vkCmdSetScissor(VkCommandBuffer buffer, uint32_t first, uint32_t count, const VkRect2D *scissors)
{
    struct set_scissors *const set =
        vulkan_record(buffer, sizeof *set + count * sizeof *scissors, replay_scissors);
    if (set) {
        set->first = first;
        set->count = count;
        memcpy(set->scissors, scissors, count * sizeof *scissors);
    }
}

// Numbers --------------------------------------------------------------------------------------------

struct set_numbers {
    struct vulkan_command command;
    float numbers[4];
};

// Record up to four numbers.
static void record_numbers(VkCommandBuffer buffer, vulkan_replay_function *replay, const float numbers[4])
{
    struct set_numbers *const set = vulkan_record(buffer, sizeof *set, replay);
    if (set) {
        memcpy(set->numbers, numbers, sizeof set->numbers);
    }
}

static void replay_line_width(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    vulkan_dynamic_set_line_width(&replay->bound.dynamic, ((const struct set_numbers *)command)->numbers[0]);
    replay->bound.news_dynamic |= VULKAN_DYNAMIC_LINE_WIDTH;
}

void vkCmdSetLineWidth(VkCommandBuffer buffer, float width)
{
    record_numbers(buffer, replay_line_width, (const float[4]){width});
}

static void replay_depth_bias(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const float *const numbers = ((const struct set_numbers *)command)->numbers;
    vulkan_dynamic_set_depth_bias(&replay->bound.dynamic, numbers[0], numbers[1], numbers[2]);
    replay->bound.news_dynamic |= VULKAN_DYNAMIC_DEPTH_BIAS;
}

void vkCmdSetDepthBias(VkCommandBuffer buffer, float constant, float clamp, float slope)
{
    record_numbers(buffer, replay_depth_bias, (const float[4]){constant, clamp, slope});
}

static void replay_blend_constants(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    memcpy(replay->bound.dynamic.blend_constant, ((const struct set_numbers *)command)->numbers,
           sizeof replay->bound.dynamic.blend_constant);
    replay->bound.news_dynamic |= VULKAN_DYNAMIC_BLEND_CONSTANT;
}

void vkCmdSetBlendConstants(VkCommandBuffer buffer, const float constants[4])
{
    record_numbers(buffer, replay_blend_constants, constants);
}

static void replay_depth_bounds(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const float *const numbers = ((const struct set_numbers *)command)->numbers;
    vulkan_dynamic_set_depth_bounds(&replay->bound.dynamic, numbers[0], numbers[1]);
    replay->bound.news_dynamic |= VULKAN_DYNAMIC_DEPTH_BOUNDS;
}

void vkCmdSetDepthBounds(VkCommandBuffer buffer, float least, float most)
{
    record_numbers(buffer, replay_depth_bounds, (const float[4]){least, most});
}

struct set_stipple {
    struct vulkan_command command;
    uint32_t factor;
    uint16_t pattern;
};

static void replay_line_stipple(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct set_stipple *const set = (const struct set_stipple *)command;
    vulkan_dynamic_set_line_stipple(&replay->bound.dynamic, set->factor, set->pattern);
    replay->bound.news_dynamic |= VULKAN_DYNAMIC_LINE_STIPPLE;
}

void vkCmdSetLineStippleEXT(VkCommandBuffer buffer, uint32_t factor, uint16_t pattern)
{
    struct set_stipple *const set = vulkan_record(buffer, sizeof *set, replay_line_stipple);
    if (set) {
        set->factor = factor;
        set->pattern = pattern;
    }
}

// Stencil --------------------------------------------------------------------------------------------

struct set_stencil {
    struct vulkan_command command;
    VkStencilFaceFlags faces;
    uint32_t value;
};

static void record_stencil(VkCommandBuffer buffer, vulkan_replay_function *replay, VkStencilFaceFlags faces,
                           uint32_t value)
{
    struct set_stencil *const set = vulkan_record(buffer, sizeof *set, replay);
    if (set) {
        set->faces = faces;
        set->value = value;
    }
}

static void replay_compare_mask(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct set_stencil *const set = (const struct set_stencil *)command;
    vulkan_dynamic_set_compare_mask(&replay->bound.dynamic, set->faces, set->value);
    replay->bound.news_dynamic |= VULKAN_DYNAMIC_COMPARE_MASK;
}

void vkCmdSetStencilCompareMask(VkCommandBuffer buffer, VkStencilFaceFlags faces, uint32_t mask)
{
    record_stencil(buffer, replay_compare_mask, faces, mask);
}

static void replay_write_mask(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct set_stencil *const set = (const struct set_stencil *)command;
    vulkan_dynamic_set_write_mask(&replay->bound.dynamic, set->faces, set->value);
    replay->bound.news_dynamic |= VULKAN_DYNAMIC_WRITE_MASK;
}

void vkCmdSetStencilWriteMask(VkCommandBuffer buffer, VkStencilFaceFlags faces, uint32_t mask)
{
    record_stencil(buffer, replay_write_mask, faces, mask);
}

static void replay_reference(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct set_stencil *const set = (const struct set_stencil *)command;
    vulkan_dynamic_set_reference(&replay->bound.dynamic, set->faces, set->value);
    replay->bound.news_dynamic |= VULKAN_DYNAMIC_REFERENCE;
}

void vkCmdSetStencilReference(VkCommandBuffer buffer, VkStencilFaceFlags faces, uint32_t reference)
{
    record_stencil(buffer, replay_reference, faces, reference);
}
