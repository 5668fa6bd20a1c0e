// SPDX-License-Identifier: MIT
// A recorded command is a struct that begins with struct vulkan_command: the function that replays it, and its size.
// Commands stand behind one another in chunks, which their command buffer has from its pool.
//
//     struct draw {
//         struct vulkan_command command;
//         uint32_t first, count;
//     };
//     static void replay_draw(struct vulkan_replay *replay, const struct vulkan_command *command)
//     {
//         const struct draw *const draw = (const struct draw *)command;
//         …
//     }
//     void vkCmdDraw(VkCommandBuffer buffer, …)
//     {
//         struct draw *const draw = vulkan_record(buffer, sizeof *draw, replay_draw);
//         if (draw) {
//             draw->first = first;
#ifndef VULKAN_COMMAND_H
#define VULKAN_COMMAND_H

#include "device/device.h"

struct vulkan_begin_subpass;
struct vulkan_command;

typedef void vulkan_replay_function(struct vulkan_replay *replay, const struct vulkan_command *command);

struct vulkan_command {
    vulkan_replay_function *replay;
    size_t size; ///< bytes up to the next command, a multiple of 16
};

enum {
    VULKAN_CHUNK_SIZE = 65536 ///< bytes of commands in a chunk; one that is larger has a chunk of its own
};

struct vulkan_chunk {
    struct vulkan_chunk *next;
    size_t used, capacity; ///< bytes at `commands`
    _Alignas(16) unsigned char commands[];
};

// Commands in order.
struct vulkan_command_list {
    struct vulkan_chunk *first, *last;
};

struct VkCommandPool_T {
    VkAllocationCallbacks callbacks;
    VkCommandBuffer buffers;     ///< first of its buffers
    struct vulkan_chunk *unused; ///< chunks of VULKAN_CHUNK_SIZE
};

struct VkCommandBuffer_T {
    VK_LOADER_DATA loader;
    VkDevice device;
    VkCommandPool pool;
    VkCommandBuffer previous, next; ///< neighbours in the pool
    VkCommandBufferLevel level;
    struct vulkan_command_list list;
    VkResult result; ///< why recording failed, told by vkEndCommandBuffer
    // What the recording functions know while they record
    struct vulkan_begin_subpass *subpass; ///< command that began the subpass; NULL outside of render passes
    bool has_barrier;                     ///< a secondary one: it has a barrier inside of a render pass
    bool continues_pass; ///< a secondary one that is recorded for the inside of a render pass
};

// Return a new command of zeros behind the others, or NULL. Without memory the command buffer remembers that.
void *vulkan_record(VkCommandBuffer buffer, size_t size, vulkan_replay_function *replay);

// Replay commands in order.
void vulkan_command_list_replay(const struct vulkan_command_list *list, struct vulkan_replay *replay);

#endif
