// SPDX-License-Identifier: MIT
// Commands are replayed in order, so a barrier has something to do inside of render passes alone: what was drawn is
// stored, and loaded by what is drawn then. An image that comes from UNDEFINED may have shared its memory meanwhile.
#include "replay.h"
#include "resource/memory.h"

struct forget {
    struct vulkan_command command;
    VkImage image;
};

static void replay_forget(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    vulkan_image_forget(replay->queue, ((const struct forget *)command)->image);
}

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
    for (uint32_t i = 0; i < image_count; i++) {
        if (images[i].oldLayout == VK_IMAGE_LAYOUT_UNDEFINED) {
            struct forget *const command = vulkan_record(buffer, sizeof *command, replay_forget);
            if (command) {
                command->image = images[i].image;
            }
        }
    }
    if (buffer->subpass || buffer->continues_pass) {
        vulkan_pass_note_barrier(buffer, true);
        vulkan_record(buffer, sizeof(struct vulkan_command), replay_barrier);
    }
}
