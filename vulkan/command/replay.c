// SPDX-License-Identifier: MIT
#include "replay.h"

#include "query.h"

#include <stdlib.h>
#include <string.h>

// Memory ----------------------------------------------------------------------------------------------

enum { BLOCK_SIZE = 1 << 18 };

struct vulkan_arena_block {
    struct vulkan_arena_block *next;
    size_t used, capacity;
    _Alignas(64) unsigned char bytes[];
};

// Return a block of at least `size` bytes, with nothing used.
static struct vulkan_arena_block *make_block(size_t size)
{
    const size_t capacity = size > BLOCK_SIZE ? (size + 63) / 64 * 64 : BLOCK_SIZE;
    struct vulkan_arena_block *const block = aligned_alloc(64, sizeof *block + capacity);
    if (block) {
        block->used = 0;
        block->capacity = capacity;
    }
    return block;
}

void *vulkan_replay_allocate(struct vulkan_replay *replay, size_t size)
{
    struct vulkan_arena_block **const arena = &replay->queue->arena;
    const size_t whole = (size + 63) / 64 * 64;
    if (!*arena || (*arena)->capacity - (*arena)->used < whole) {
        struct vulkan_arena_block *const block = make_block(whole);
        if (!block) {
            replay->result = VK_ERROR_DEVICE_LOST;
            return NULL;
        }
        block->next = *arena;
        *arena = block;
    }
    void *const memory = (*arena)->bytes + (*arena)->used;
    (*arena)->used += whole;
    return memory;
}

// The oldest block stays for what comes next.
void vulkan_replay_release(struct vulkan_replay *replay)
{
    struct vulkan_arena_block *block = replay->queue->arena;
    while (block && block->next) {
        struct vulkan_arena_block *const next = block->next;
        free(block);
        block = next;
    }
    replay->queue->arena = block;
    if (block) {
        block->used = 0;
    }
}

void vulkan_arena_free(VkQueue queue)
{
    while (queue->arena) {
        struct vulkan_arena_block *const next = queue->arena->next;
        free(queue->arena);
        queue->arena = next;
    }
}

// Results ---------------------------------------------------------------------------------------------

bool vulkan_replay_check(struct vulkan_replay *replay, enum rhw_result result, const char *what)
{
    if (result == RHW_OK) {
        return true;
    }
    vulkan_log("%s: %s", what, rhw_result_string(result));
    if (result != RHW_ERROR_MISUSE) {
        replay->result = VK_ERROR_DEVICE_LOST;
    }
    return false;
}

// Commands --------------------------------------------------------------------------------------------

// Return the command behind one, or NULL. `*chunk` is the chunk of it.
static const struct vulkan_command *behind(const struct vulkan_chunk **chunk,
                                           const struct vulkan_command *command)
{
    const unsigned char *const next = (const unsigned char *)command + command->size;
    if (next < (*chunk)->commands + (*chunk)->used) {
        return (const void *)next;
    }
    *chunk = (*chunk)->next;
    return *chunk ? (const void *)(*chunk)->commands : NULL;
}

void vulkan_command_list_replay(const struct vulkan_command_list *list, struct vulkan_replay *replay)
{
    const struct vulkan_chunk *chunk = list->first;
    const struct vulkan_command *command = chunk ? (const void *)chunk->commands : NULL;
    while (command && replay->result == VK_SUCCESS) {
        replay->chunk = chunk;
        command->replay(replay, command);
        if (replay->resume.command) {
            command = replay->resume.command;
            chunk = replay->resume.chunk;
            replay->resume.command = NULL;
        }
        command = behind(&chunk, command);
    }
}

// Forget what a command buffer has bound and begun: the next one knows nothing of it.
static void begin_buffer(struct vulkan_replay *replay)
{
    vulkan_feedback_suspend(replay);
    memset(&replay->feedback, 0, sizeof replay->feedback);
    memset(&replay->bound, 0, sizeof replay->bound);
}

VkResult vulkan_replay_buffers(VkQueue queue, const VkCommandBuffer *buffers, uint32_t count)
{
    struct vulkan_replay *const replay = calloc(1, sizeof *replay);
    if (!replay) {
        return VK_ERROR_DEVICE_LOST;
    }
    replay->device = queue->device;
    replay->queue = queue;
    replay->context = queue->context;
    for (uint32_t i = 0; i < count && replay->result == VK_SUCCESS; i++) {
        vulkan_query_suspend(replay);
        memset(replay->active, 0, sizeof replay->active);
        begin_buffer(replay);
        vulkan_command_list_replay(&buffers[i]->list, replay);
    }
    if (replay->pass.is_open) {
        rhw_pass_cancel(replay->context, replay->pass.pass);
    }
    const VkResult result = replay->result;
    free(replay);
    return result;
}

struct execute_command {
    struct vulkan_command command;
    uint32_t count;
    VkCommandBuffer buffers[];
};

static void replay_execute(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct execute_command *const execute = (const struct execute_command *)command;
    for (uint32_t i = 0; i < execute->count; i++) {
        begin_buffer(replay);
        vulkan_command_list_replay(&execute->buffers[i]->list, replay);
    }
    begin_buffer(replay);
}

VKAPI_ATTR void VKAPI_CALL vkCmdExecuteCommands(VkCommandBuffer buffer, uint32_t count,
                                                const VkCommandBuffer *buffers)
{
    struct execute_command *const command =
        vulkan_record(buffer, sizeof *command + count * sizeof *buffers, replay_execute);
    if (!command) {
        return;
    }
    command->count = count;
    memcpy(command->buffers, buffers, count * sizeof *buffers);
    for (uint32_t i = 0; i < count; i++) {
        vulkan_pass_note_barrier(buffer, buffers[i]->has_barrier);
    }
}
