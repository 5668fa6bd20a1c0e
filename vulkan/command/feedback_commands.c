// SPDX-License-Identifier: MIT
#include "feedback.h"
#include "replay.h"

enum { RANGES = RHW_MAX_FEEDBACK_TARGETS };

void vulkan_feedback_resume(struct vulkan_replay *replay)
{
    struct vulkan_feedback *const feedback = &replay->feedback;
    struct rhw_feedback_target targets[RANGES] = {{.offset = 0}};
    if (!feedback->is_active || feedback->is_begun) {
        return;
    }
    for (int i = 0; i < RANGES; i++) {
        const struct vulkan_feedback_range *const range = &feedback->ranges[i];
        targets[i] = (struct rhw_feedback_target){.memory = &feedback->no_room[i], .size = 1};
        if (range->buffer && range->buffer->bytes && range->written < range->size) {
            targets[i].memory = range->buffer->bytes + range->offset + range->written;
            targets[i].size = (size_t)(range->size - range->written);
        }
    }
    rhw_pass_begin_transform_feedback(replay->context, replay->pass.pass, targets, RANGES);
    feedback->is_begun = true;
}

void vulkan_feedback_suspend(struct vulkan_replay *replay)
{
    struct vulkan_feedback *const feedback = &replay->feedback;
    size_t written[RANGES] = {0};
    if (!feedback->is_begun) {
        return;
    }
    feedback->is_begun = false;
    rhw_pass_end_transform_feedback(replay->context, replay->pass.pass, written);
    for (int i = 0; i < RANGES; i++) {
        feedback->ranges[i].written += written[i];
    }
}

// Buffers --------------------------------------------------------------------------------------------

struct bind_command {
    struct vulkan_command command;
    uint32_t first, count;
    struct vulkan_feedback_range ranges[RANGES];
};

static void replay_bind(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct bind_command *const bind = (const struct bind_command *)command;
    for (uint32_t i = 0; i < bind->count; i++) {
        replay->feedback.ranges[bind->first + i] = bind->ranges[i];
    }
}

// Return how many of `count` buffers from `first` on there may be.
static uint32_t count_within(uint32_t first, uint32_t count)
{
    const uint32_t left = first < RANGES ? RANGES - first : 0;
    return count < left ? count : left;
}

void vkCmdBindTransformFeedbackBuffersEXT(VkCommandBuffer buffer, uint32_t first, uint32_t count,
                                          const VkBuffer *buffers, const VkDeviceSize *offsets,
                                          const VkDeviceSize *sizes)
{
    struct bind_command *const bind = vulkan_record(buffer, sizeof *bind, replay_bind);
    if (!bind) {
        return;
    }
    bind->first = first;
    bind->count = count_within(first, count);
    for (uint32_t i = 0; i < bind->count; i++) {
        const VkDeviceSize size = sizes ? sizes[i] : VK_WHOLE_SIZE;
        bind->ranges[i] = (struct vulkan_feedback_range){
            buffers[i], offsets[i], vulkan_buffer_range(buffers[i], offsets[i], size), 0};
    }
}

// Begin and end --------------------------------------------------------------------------------------

// Counters are bytes from the begin of the range, where writing goes on.
struct counters_command {
    struct vulkan_command command;
    uint32_t *counters[RANGES]; // NULL: none
};

static void replay_begin(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct counters_command *const begin = (const struct counters_command *)command;
    const uint32_t whole = ~3u; // components have 4 bytes
    replay->feedback.is_active = true;
    for (int i = 0; i < RANGES; i++) {
        replay->feedback.ranges[i].written = begin->counters[i] ? *begin->counters[i] & whole : 0;
    }
}

static void replay_end(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct counters_command *const end = (const struct counters_command *)command;
    vulkan_feedback_suspend(replay);
    replay->feedback.is_active = false;
    for (int i = 0; i < RANGES; i++) {
        if (end->counters[i]) {
            *end->counters[i] = (uint32_t)replay->feedback.ranges[i].written;
        }
    }
}

static void record_counters(VkCommandBuffer buffer, vulkan_replay_function *replay, uint32_t first,
                            uint32_t count, const VkBuffer *buffers, const VkDeviceSize *offsets)
{
    struct counters_command *const command = vulkan_record(buffer, sizeof *command, replay);
    count = buffers ? count_within(first, count) : 0;
    for (uint32_t i = 0; command && i < count; i++) {
        const VkDeviceSize offset = offsets ? offsets[i] : 0;
        if (buffers[i] && vulkan_buffer_range(buffers[i], offset, VK_WHOLE_SIZE) >= sizeof(uint32_t)) {
            command->counters[first + i] = (uint32_t *)(void *)(buffers[i]->bytes + offset);
        }
    }
}

void vkCmdBeginTransformFeedbackEXT(VkCommandBuffer buffer, uint32_t first, uint32_t count,
                                    const VkBuffer *buffers, const VkDeviceSize *offsets)
{
    record_counters(buffer, replay_begin, first, count, buffers, offsets);
}

void vkCmdEndTransformFeedbackEXT(VkCommandBuffer buffer, uint32_t first, uint32_t count,
                                  const VkBuffer *buffers, const VkDeviceSize *offsets)
{
    record_counters(buffer, replay_end, first, count, buffers, offsets);
}
