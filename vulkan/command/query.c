// SPDX-License-Identifier: MIT
#include "query.h"

#include "replay.h"
#include "resource/buffer.h"

#include <string.h>

// Parts -----------------------------------------------------------------------------------------------

// What a pass answers about a query. The query of a timestamp is the null id: its time is that of the pass's end.
struct vulkan_query_part {
    struct vulkan_query_part *next;
    VkQueryPool pool;
    uint32_t index;
    rhw_query query;
    bool ends; ///< the query has its answer with this part
};

static void add(struct vulkan_replay *replay, VkQueryPool pool, uint32_t index, const uint64_t values[2],
                bool ends)
{
    if (index >= pool->count) {
        vulkan_log("a query has number %u in a pool of %u", index, pool->count);
        return;
    }
    pthread_mutex_lock(&replay->queue->lock);
    pool->queries[index].values[0] += values[0];
    pool->queries[index].values[1] += values[1];
    pool->queries[index].is_available = pool->queries[index].is_available || ends;
    pthread_cond_broadcast(&replay->queue->changed);
    pthread_mutex_unlock(&replay->queue->lock);
}

static struct vulkan_query_part *make_part(struct vulkan_replay *replay, VkQueryPool pool, uint32_t index)
{
    struct vulkan_query_part *const part = vulkan_replay_allocate(replay, sizeof *part);
    if (part) {
        *part = (struct vulkan_query_part){.next = replay->parts, .pool = pool, .index = index};
        replay->parts = part;
    }
    return part;
}

// Let a query that is under way ask the pass that is open.
static void resume(struct vulkan_replay *replay, enum vulkan_query_kind kind)
{
    struct vulkan_active_query *const active = &replay->active[kind];
    active->part = NULL;
    if (!active->pool) {
        return;
    }
    struct vulkan_query_part *const part = make_part(replay, active->pool, active->index);
    const struct rhw_query_def def = {.kind = kind == VULKAN_QUERY_FEEDBACK ? RHW_QUERY_TRANSFORM_FEEDBACK
                                                                            : RHW_QUERY_OCCLUSION};
    if (part && vulkan_replay_check(replay, rhw_query_create(replay->context, &def, &part->query), "query")) {
        rhw_pass_begin_query(replay->context, replay->pass.pass, part->query);
        active->part = part;
    }
}

void vulkan_query_resume(struct vulkan_replay *replay)
{
    for (int kind = 0; kind < VULKAN_QUERY_KINDS; kind++) {
        resume(replay, (enum vulkan_query_kind)kind);
    }
}

static void suspend(struct vulkan_replay *replay, struct vulkan_active_query *active)
{
    if (active->part) {
        rhw_pass_end_query(replay->context, replay->pass.pass, active->part->query);
        active->part = NULL;
    }
}

void vulkan_query_suspend(struct vulkan_replay *replay)
{
    for (int kind = 0; kind < VULKAN_QUERY_KINDS; kind++) {
        suspend(replay, &replay->active[kind]);
    }
}

void vulkan_query_collect(struct vulkan_replay *replay)
{
    // One time for all, since the list is not in their order.
    const uint64_t now = replay->parts ? vulkan_now() : 0;
    for (struct vulkan_query_part *part = replay->parts; part; part = part->next) {
        uint64_t values[2] = {now, 0};
        if (part->query.context != 0) {
            struct rhw_query_counts counts = {0};
            if (replay->result == VK_SUCCESS) {
                rhw_query_read(replay->context, part->query, &counts);
            }
            const bool is_feedback = part->pool->type == VK_QUERY_TYPE_TRANSFORM_FEEDBACK_STREAM_EXT;
            values[0] = is_feedback ? counts.primitives_written : counts.samples_passed;
            values[1] = is_feedback ? counts.primitives_needed : 0;
            rhw_query_destroy(replay->context, part->query);
        }
        add(replay, part->pool, part->index, values, part->ends);
    }
    replay->parts = NULL;
}

// Commands --------------------------------------------------------------------------------------------

struct query_command {
    struct vulkan_command command;
    VkQueryPool pool;
    uint32_t index, count;
};

// Return how many of `count` queries a pool has from `first` on.
static uint32_t count_within(VkQueryPool pool, uint32_t first, uint32_t count)
{
    const uint32_t left = first < pool->count ? pool->count - first : 0;
    if (count > left) {
        vulkan_log("queries from %u on are %u: their pool has %u", first, count, pool->count);
    }
    return count < left ? count : left;
}

static void reset(VkQueue queue, VkQueryPool pool, uint32_t first, uint32_t count)
{
    count = count_within(pool, first, count);
    pthread_mutex_lock(&queue->lock);
    for (uint32_t i = 0; i < count; i++) {
        pool->queries[first + i] = (struct vulkan_query){0};
    }
    pthread_mutex_unlock(&queue->lock);
}

static void replay_reset(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct query_command *const query = (const struct query_command *)command;
    reset(replay->queue, query->pool, query->index, query->count);
}

// Return the query of the view that is drawn. Views use queries that follow each other (Vulkan 1.1, "Multiview").
static uint32_t query_of_view(const struct vulkan_replay *replay, uint32_t index)
{
    const struct vulkan_pass_state *const pass = &replay->pass;
    const uint32_t views = pass->subpass ? pass->subpass->view_mask : 0;
    return index + (uint32_t)__builtin_popcount(views & ((1u << pass->view_index) - 1));
}

static enum vulkan_query_kind kind_of(VkQueryPool pool)
{
    return pool->type == VK_QUERY_TYPE_TRANSFORM_FEEDBACK_STREAM_EXT ? VULKAN_QUERY_FEEDBACK
                                                                     : VULKAN_QUERY_SAMPLES;
}

static void replay_begin(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct query_command *const query = (const struct query_command *)command;
    const enum vulkan_query_kind kind = kind_of(query->pool);
    replay->active[kind].pool = query->pool;
    replay->active[kind].index = query_of_view(replay, query->index);
    if (replay->pass.is_open) {
        resume(replay, kind);
    }
}

static void replay_end(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct query_command *const query = (const struct query_command *)command;
    struct vulkan_active_query *const active = &replay->active[kind_of(query->pool)];
    struct vulkan_query_part *const part = active->part;
    suspend(replay, active);
    if (part) {
        part->ends = true;
    } else if (active->pool) {
        add(replay, active->pool, active->index, (const uint64_t[2]){0}, true);
    }
    active->pool = VK_NULL_HANDLE;
}

static void replay_timestamp(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct query_command *const query = (const struct query_command *)command;
    const uint32_t index = query_of_view(replay, query->index);
    struct vulkan_query_part *const part =
        replay->pass.is_open ? make_part(replay, query->pool, index) : NULL;
    if (part) {
        part->ends = true;
    } else {
        add(replay, query->pool, index, (const uint64_t[2]){vulkan_now()}, true);
    }
}

static void record(VkCommandBuffer buffer, VkQueryPool pool, uint32_t index, uint32_t count,
                   vulkan_replay_function *replay)
{
    struct query_command *const command = vulkan_record(buffer, sizeof *command, replay);
    if (command) {
        command->pool = pool;
        command->index = index;
        command->count = count;
    }
}

VKAPI_ATTR void VKAPI_CALL vkCmdResetQueryPool(VkCommandBuffer buffer, VkQueryPool pool, uint32_t first,
                                               uint32_t count)
{
    record(buffer, pool, first, count, replay_reset);
}

VKAPI_ATTR void VKAPI_CALL vkCmdBeginQuery(VkCommandBuffer buffer, VkQueryPool pool, uint32_t index,
                                           VkQueryControlFlags flags)
{
    (void)flags; // every answer is precise
    record(buffer, pool, index, 1, replay_begin);
}

VKAPI_ATTR void VKAPI_CALL vkCmdEndQuery(VkCommandBuffer buffer, VkQueryPool pool, uint32_t index)
{
    record(buffer, pool, index, 1, replay_end);
}

// There is one stream.

VKAPI_ATTR void VKAPI_CALL vkCmdBeginQueryIndexedEXT(VkCommandBuffer buffer, VkQueryPool pool, uint32_t index,
                                                     VkQueryControlFlags flags, uint32_t stream)
{
    (void)stream;
    vkCmdBeginQuery(buffer, pool, index, flags);
}

VKAPI_ATTR void VKAPI_CALL vkCmdEndQueryIndexedEXT(VkCommandBuffer buffer, VkQueryPool pool, uint32_t index,
                                                   uint32_t stream)
{
    (void)stream;
    vkCmdEndQuery(buffer, pool, index);
}

VKAPI_ATTR void VKAPI_CALL vkCmdWriteTimestamp(VkCommandBuffer buffer, VkPipelineStageFlagBits stage,
                                               VkQueryPool pool, uint32_t index)
{
    (void)stage;
    record(buffer, pool, index, 1, replay_timestamp);
}

// Pools -----------------------------------------------------------------------------------------------

VKAPI_ATTR VkResult VKAPI_CALL vkCreateQueryPool(VkDevice device, const VkQueryPoolCreateInfo *info,
                                                 const VkAllocationCallbacks *callbacks, VkQueryPool *pool)
{
    *pool = vulkan_device_allocate(device, callbacks,
                                   sizeof **pool + info->queryCount * sizeof(struct vulkan_query));
    if (!*pool) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    (*pool)->type = info->queryType;
    (*pool)->count = info->queryCount;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkDestroyQueryPool(VkDevice device, VkQueryPool pool,
                                              const VkAllocationCallbacks *callbacks)
{
    vulkan_device_free(device, callbacks, pool);
}

VKAPI_ATTR void VKAPI_CALL vkResetQueryPool(VkDevice device, VkQueryPool pool, uint32_t first, uint32_t count)
{
    reset(&device->queue, pool, first, count);
}

// Results ---------------------------------------------------------------------------------------------

struct results {
    VkQueryPool pool;
    uint32_t first, count;
    unsigned char *data;
    VkDeviceSize size; // bytes at `data`
    VkDeviceSize stride;
    VkQueryResultFlags flags;
};

static bool are_available(void *user)
{
    const struct results *const results = user;
    bool all = true;
    for (uint32_t i = 0; i < results->count; i++) {
        all = all && results->pool->queries[results->first + i].is_available;
    }
    return all;
}

static unsigned char *write_number(unsigned char *at, uint64_t value, VkQueryResultFlags flags)
{
    const uint32_t narrow = value > UINT32_MAX ? UINT32_MAX : (uint32_t)value;
    const size_t size = flags & VK_QUERY_RESULT_64_BIT ? sizeof value : sizeof narrow;
    memcpy(at, flags & VK_QUERY_RESULT_64_BIT ? (const void *)&value : (const void *)&narrow, size);
    return at + size;
}

// Return whether an answer of `each` bytes has room.
static bool has_room(const struct results *results, VkDeviceSize each, uint32_t index)
{
    return each <= results->size && (index == 0 || results->stride <= (results->size - each) / index);
}

// Write the answers. Return VK_NOT_READY if one is missing. The queue's lock is held.
static VkResult write_results(const struct results *results)
{
    VkResult result = VK_SUCCESS;
    const VkDeviceSize number = results->flags & VK_QUERY_RESULT_64_BIT ? sizeof(uint64_t) : sizeof(uint32_t);
    const int numbers = results->pool->type == VK_QUERY_TYPE_TRANSFORM_FEEDBACK_STREAM_EXT ? 2 : 1;
    const bool tells = results->flags & VK_QUERY_RESULT_WITH_AVAILABILITY_BIT;
    const VkDeviceSize each = (VkDeviceSize)(numbers + tells) * number;
    for (uint32_t i = 0; i < results->count && has_room(results, each, i); i++) {
        const struct vulkan_query *const query = &results->pool->queries[results->first + i];
        unsigned char *at = results->data + i * results->stride;
        for (int n = 0; n < numbers; n++) {
            if (query->is_available || results->flags & VK_QUERY_RESULT_PARTIAL_BIT) {
                write_number(at, query->values[n], results->flags);
            }
            at += number;
        }
        if (tells) {
            write_number(at, query->is_available, results->flags);
        }
        result = query->is_available ? result : VK_NOT_READY;
    }
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL vkGetQueryPoolResults(VkDevice device, VkQueryPool pool, uint32_t first,
                                                     uint32_t count, size_t size, void *data,
                                                     VkDeviceSize stride, VkQueryResultFlags flags)
{
    struct results results = {pool, first, count_within(pool, first, count), data, size, stride, flags};
    if (flags & VK_QUERY_RESULT_WAIT_BIT) {
        const VkResult result = vulkan_queue_wait(&device->queue, are_available, &results, UINT64_MAX);
        if (result != VK_SUCCESS) {
            return result;
        }
    }
    pthread_mutex_lock(&device->queue.lock);
    const VkResult result = write_results(&results);
    pthread_mutex_unlock(&device->queue.lock);
    return result;
}

struct copy_command {
    struct vulkan_command command;
    struct results results;
};

static void replay_copy(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct copy_command *const copy = (const struct copy_command *)command;
    pthread_mutex_lock(&replay->queue->lock);
    write_results(&copy->results);
    pthread_mutex_unlock(&replay->queue->lock);
}

VKAPI_ATTR void VKAPI_CALL vkCmdCopyQueryPoolResults(VkCommandBuffer buffer, VkQueryPool pool, uint32_t first,
                                                     uint32_t count, VkBuffer to, VkDeviceSize offset,
                                                     VkDeviceSize stride, VkQueryResultFlags flags)
{
    struct copy_command *const command = vulkan_record(buffer, sizeof *command, replay_copy);
    if (command) {
        command->results = (struct results){.pool = pool,
                                            .first = first,
                                            .count = count_within(pool, first, count),
                                            .data = vulkan_buffer_at(to, offset),
                                            .size = vulkan_buffer_range(to, offset, VK_WHOLE_SIZE),
                                            .stride = stride,
                                            .flags = flags};
    }
}
