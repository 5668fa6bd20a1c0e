// SPDX-License-Identifier: MIT
// Transform feedback (VK_EXT_transform_feedback). It goes on over passes of librhw: each writes behind the one before.
#ifndef VULKAN_FEEDBACK_H
#define VULKAN_FEEDBACK_H

#include "resource/buffer.h"
#include "rhw/rhw.h"

struct vulkan_replay;

// A range of a buffer that is bound, and how many bytes of it have been written.
struct vulkan_feedback_range {
    VkBuffer buffer; ///< NULL: none
    VkDeviceSize offset, size;
    VkDeviceSize written;
};

struct vulkan_feedback {
    struct vulkan_feedback_range ranges[RHW_MAX_FEEDBACK_TARGETS];
    /// Stands for ranges that are full, so that primitives are counted. No primitive has room there.
    uint32_t no_room[RHW_MAX_FEEDBACK_TARGETS];
    bool is_active; ///< between vkCmdBeginTransformFeedbackEXT and vkCmdEndTransformFeedbackEXT
    bool is_begun;  ///< the pass of librhw that is open writes it
};

// Let the pass that is open write what is drawn, if transform feedback is active. The pipeline is set.
void vulkan_feedback_resume(struct vulkan_replay *replay);

// Let it write no more, before the pass is closed.
void vulkan_feedback_suspend(struct vulkan_replay *replay);

#endif
