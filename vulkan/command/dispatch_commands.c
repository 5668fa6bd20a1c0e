// SPDX-License-Identifier: MIT
// Dispatches. Each is one of librhw, with all that is bound.
#include "shader_input.h"
#include <string.h>

struct dispatch {
    struct vulkan_command command;
    uint32_t base[3], counts[3];
};

static void dispatch_bound(struct vulkan_replay *replay, const uint32_t base[3], const uint32_t counts[3])
{
    const struct vulkan_bound_point *const point = &replay->bound.compute;
    struct rhw_shader_frame frame = {.samples = 0};
    if (!point->pipeline) {
        vulkan_log("a dispatch is left out: no pipeline is bound");
        return;
    }
    if (!vulkan_shader_input_sets(replay, point, point->pipeline->used_sets, &frame) ||
        !vulkan_shader_input_push(replay, point->pipeline->push_size, &frame)) {
        return;
    }
    const struct rhw_dispatch_def def = {
        .program = *rhw_shader_program_get_compute(point->pipeline->variants[0].program),
        .uniforms = &frame,
        .uniform_bytes = sizeof frame,
        .base = {base[0], base[1], base[2]}};
    (void)vulkan_replay_check(replay, rhw_dispatch(replay->context, &def, counts[0], counts[1], counts[2]),
                              "a dispatch");
}

static void dispatch(struct vulkan_replay *replay, const uint32_t base[3], const uint32_t counts[3])
{
    dispatch_bound(replay, base, counts);
    if (!replay->pass.is_open) {
        vulkan_replay_release(replay);
    }
}

static void replay_dispatch(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct dispatch *const record = (const struct dispatch *)command;
    dispatch(replay, record->base, record->counts);
}

void vkCmdDispatchBase(VkCommandBuffer buffer, uint32_t base_x, uint32_t base_y, uint32_t base_z, uint32_t x,
                       uint32_t y, uint32_t z)
{
    struct dispatch *const record = vulkan_record(buffer, sizeof *record, replay_dispatch);
    if (record) {
        memcpy(record->base, (const uint32_t[]){base_x, base_y, base_z}, sizeof record->base);
        memcpy(record->counts, (const uint32_t[]){x, y, z}, sizeof record->counts);
    }
}

void vkCmdDispatch(VkCommandBuffer buffer, uint32_t x, uint32_t y, uint32_t z)
{
    vkCmdDispatchBase(buffer, 0, 0, 0, x, y, z);
}

struct dispatch_indirect {
    struct vulkan_command command;
    VkBuffer buffer;
    VkDeviceSize offset;
};

static void replay_dispatch_indirect(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    static const uint32_t zero[3] = {0, 0, 0};
    const struct dispatch_indirect *const record = (const struct dispatch_indirect *)command;
    const VkDeviceSize room = record->buffer->bytes ? record->buffer->size : 0;
    uint32_t counts[3];
    if (record->offset <= room && sizeof counts <= room - record->offset) {
        memcpy(counts, record->buffer->bytes + record->offset, sizeof counts);
        dispatch(replay, zero, counts);
    } else {
        vulkan_log("an indirect dispatch at %llu is left out: its buffer has %llu bytes",
                   (unsigned long long)record->offset, (unsigned long long)room);
    }
}

void vkCmdDispatchIndirect(VkCommandBuffer buffer, VkBuffer commands, VkDeviceSize offset)
{
    struct dispatch_indirect *const record = vulkan_record(buffer, sizeof *record, replay_dispatch_indirect);
    if (record) {
        record->buffer = commands;
        record->offset = offset;
    }
}
