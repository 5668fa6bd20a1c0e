// SPDX-License-Identifier: MIT
// The state of the queue's thread while it replays a command buffer.
#ifndef VULKAN_REPLAY_H
#define VULKAN_REPLAY_H

#include "bound.h"
#include "command.h"
#include "feedback.h"
#include "pass_state.h"

struct vulkan_arena_block;

struct vulkan_query_part;

// Kinds of queries that may be under way at once.
enum vulkan_query_kind { VULKAN_QUERY_SAMPLES, VULKAN_QUERY_FEEDBACK, VULKAN_QUERY_KINDS };

// A query that is under way.
struct vulkan_active_query {
    VkQueryPool pool; ///< NULL: none
    uint32_t index;
    struct vulkan_query_part *part; ///< asks the pass of librhw that is open; NULL if none is
};

struct vulkan_replay {
    VkDevice device;
    VkQueue queue;
    rhw_context *context;
    struct vulkan_bound bound;
    struct vulkan_bound bound_before; ///< what was bound when the subpass began, for its next view
    struct vulkan_pass_state pass;
    struct vulkan_active_query active[VULKAN_QUERY_KINDS];
    struct vulkan_feedback feedback;
    struct vulkan_query_part *parts;   ///< all that ask the pass that is open
    const struct vulkan_chunk *chunk;  ///< chunk of the command that is replayed
    struct vulkan_replay_place resume; ///< command behind which replay goes on; its command is NULL mostly
    VkResult result; ///< VK_SUCCESS, or why the device is lost; nothing is replayed any more then
};

// Return memory, aligned to 64 bytes, that stays until the pass of librhw that is open has been closed, or outside of
// passes until the command has been replayed. Return NULL, with `result` set, if there is none.
void *vulkan_replay_allocate(struct vulkan_replay *replay, size_t size);

// Replay command buffers in order. The queue's thread calls this. Return why the device is lost, or VK_SUCCESS.
VkResult vulkan_replay_buffers(VkQueue queue, const VkCommandBuffer *buffers, uint32_t count);

// Forget what vulkan_replay_allocate returned.
void vulkan_replay_release(struct vulkan_replay *replay);

// Give the memory of a queue's replays back.
void vulkan_arena_free(VkQueue queue);

// Take notice of a result of librhw. Return true if it is RHW_OK. Misuse is logged and replay goes on; anything else
// loses the device.
bool vulkan_replay_check(struct vulkan_replay *replay, enum rhw_result result, const char *what);

#endif
