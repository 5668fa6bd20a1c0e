// SPDX-License-Identifier: MIT
// Commands are replayed in order, so a barrier has something to do inside of render passes alone: what was drawn is
// stored, and loaded by what is drawn then.
#include "replay.h"

static void replay_barrier(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    (void)command;
    vulkan_pass_close(replay);
}

VKAPI_ATTR void VKAPI_CALL vkCmdPipelineBarrier(VkCommandBuffer buffer, VkPipelineStageFlags from,
                                                VkPipelineStageFlags to, VkDependencyFlags flags,
                                                uint32_t memory_count, const VkMemoryBarrier *memory,
                                                uint32_t buffer_count, const VkBufferMemoryBarrier *buffers,
                                                uint32_t image_count, const VkImageMemoryBarrier *images)
{
    (void)from;
    (void)to;
    (void)flags;
    (void)memory_count;
    (void)memory;
    (void)buffer_count;
    (void)buffers;
    (void)image_count;
    (void)images;
    if (buffer->subpass || buffer->continues_pass) {
        vulkan_pass_note_barrier(buffer, true);
        vulkan_record(buffer, sizeof(struct vulkan_command), replay_barrier);
    }
}
