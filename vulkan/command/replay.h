// SPDX-License-Identifier: MIT
// The state of the queue's thread while it replays a command buffer.
#ifndef VULKAN_REPLAY_H
#define VULKAN_REPLAY_H

#include "bound.h"
#include "command.h"
#include "pass_state.h"

struct vulkan_arena_block;

struct vulkan_replay {
    VkDevice device;
    VkQueue queue;
    rhw_context *context;
    struct vulkan_bound bound;
    struct vulkan_pass_state pass;
    struct vulkan_arena_block *arena; ///< newest block first
    VkResult result; ///< VK_SUCCESS, or why the device is lost; nothing is replayed any more then
};

// Return memory, aligned to 64 bytes, that stays until the pass of librhw that is open has been closed, or outside of
// passes until the command has been replayed. Return NULL, with `result` set, if there is none.
void *vulkan_replay_allocate(struct vulkan_replay *replay, size_t size);

// Take notice of a result of librhw. Return true if it is RHW_OK. Misuse is logged and replay goes on; anything else
// loses the device.
bool vulkan_replay_check(struct vulkan_replay *replay, enum rhw_result result, const char *what);

#endif
