// SPDX-License-Identifier: MIT
// Recording of render passes, for those that are created and those that are described where they begin.
#ifndef VULKAN_PASS_H
#define VULKAN_PASS_H

#include "command.h"
#include "pass_state.h"

struct vulkan_pass_begin {
    VkRenderPass render_pass; ///< NULL: it stands behind the command, in what vulkan_record_begin_pass returns
    VkRect2D area;
    uint32_t width, height, layers;
    uint32_t attachment_count; ///< attachments of the render pass
    uint32_t view_count, clear_count;
    const VkImageView *views;   ///< views; the rest of the attachments has none
    const VkClearValue *clears; ///< clear values; the rest of the attachments has zeros
};

// Record the begin of a render pass. Return `more` bytes of zeros behind the command, or NULL without memory.
void *vulkan_record_begin_pass(VkCommandBuffer buffer, const struct vulkan_pass_begin *begin, size_t more);

void vulkan_record_begin_subpass(VkCommandBuffer buffer);
void vulkan_record_end_subpass(VkCommandBuffer buffer);

// Record the end of a subpass and of its render pass.
void vulkan_record_end_pass(VkCommandBuffer buffer);

#endif
