// SPDX-License-Identifier: MIT
#include "replay.h"
#include "resource/buffer.h"

#include <string.h>

struct copy_command {
    struct vulkan_command command;
    unsigned char *to;
    const unsigned char *from;
    size_t size;
};

static void replay_copy(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    (void)replay;
    const struct copy_command *const copy = (const struct copy_command *)command;
    if (copy->size > 0) {
        memmove(copy->to, copy->from, copy->size);
    }
}

// Return the smaller number.
static VkDeviceSize least(VkDeviceSize a, VkDeviceSize b)
{
    return a < b ? a : b;
}

// Tell if buffers do not have all of `asked` bytes.
static void tell_cut(const char *what, VkDeviceSize size, VkDeviceSize asked)
{
    if (size < asked) {
        vulkan_log("%s: %llu bytes of %llu lie within the buffers", what, (unsigned long long)size,
                   (unsigned long long)asked);
    }
}

// Bytes that one of the buffers does not have are not copied.
VKAPI_ATTR void VKAPI_CALL vkCmdCopyBuffer(VkCommandBuffer buffer, VkBuffer from, VkBuffer to, uint32_t count,
                                           const VkBufferCopy *regions)
{
    for (uint32_t i = 0; i < count; i++) {
        struct copy_command *const command = vulkan_record(buffer, sizeof *command, replay_copy);
        if (command) {
            command->from = vulkan_buffer_at(from, regions[i].srcOffset);
            command->to = vulkan_buffer_at(to, regions[i].dstOffset);
            command->size = (size_t)least(vulkan_buffer_range(from, regions[i].srcOffset, regions[i].size),
                                          vulkan_buffer_range(to, regions[i].dstOffset, regions[i].size));
            tell_cut("vkCmdCopyBuffer", command->size, regions[i].size);
        }
    }
}

// The bytes stand behind the command.
VKAPI_ATTR void VKAPI_CALL vkCmdUpdateBuffer(VkCommandBuffer buffer, VkBuffer to, VkDeviceSize offset,
                                             VkDeviceSize size, const void *data)
{
    struct copy_command *const command = vulkan_record(buffer, sizeof *command + (size_t)size, replay_copy);
    if (command) {
        memcpy(command + 1, data, (size_t)size);
        command->from = (const unsigned char *)(command + 1);
        command->to = vulkan_buffer_at(to, offset);
        command->size = (size_t)vulkan_buffer_range(to, offset, size);
        tell_cut("vkCmdUpdateBuffer", command->size, size);
    }
}

struct fill_command {
    struct vulkan_command command;
    unsigned char *to;
    size_t words;
    uint32_t word;
};

static void replay_fill(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    (void)replay;
    const struct fill_command *const fill = (const struct fill_command *)command;
    uint32_t *const words = (uint32_t *)(void *)fill->to;
    for (size_t i = 0; i < fill->words; i++) {
        words[i] = fill->word;
    }
}

VKAPI_ATTR void VKAPI_CALL vkCmdFillBuffer(VkCommandBuffer buffer, VkBuffer to, VkDeviceSize offset,
                                           VkDeviceSize size, uint32_t word)
{
    struct fill_command *const command = vulkan_record(buffer, sizeof *command, replay_fill);
    if (command) {
        command->to = vulkan_buffer_at(to, offset);
        command->words = (size_t)vulkan_buffer_range(to, offset, size) / sizeof word;
        tell_cut("vkCmdFillBuffer", command->words * sizeof word, size == VK_WHOLE_SIZE ? 0 : size);
        command->word = word;
    }
}
