// SPDX-License-Identifier: MIT
// Queries. A query of librhw asks one pass. A query that is under way while passes open and close has a part for each
// of them, and its answer is their sum.
#ifndef VULKAN_QUERY_H
#define VULKAN_QUERY_H

#include "device/device.h"

struct vulkan_query {
    /// The second one is of transform feedback: primitives that enough room would have held.
    uint64_t values[2];
    bool is_available;
};

struct VkQueryPool_T {
    VkQueryType type;
    uint32_t count;
    struct vulkan_query queries[]; ///< guarded by the queue's lock
};

// Let the query that is under way ask the pass that was opened.
void vulkan_query_resume(struct vulkan_replay *replay);

// Let it ask no more, before the pass is closed.
void vulkan_query_suspend(struct vulkan_replay *replay);

// Add up what the pass that was closed answers.
void vulkan_query_collect(struct vulkan_replay *replay);

#endif
