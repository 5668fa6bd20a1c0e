// SPDX-License-Identifier: MIT
// The render pass that is replayed: where it draws, and the pass of librhw that draws it. That pass is opened when the
// first draw, clear or query needs it, and closed at the end of the subpass, or earlier at a barrier.
#ifndef VULKAN_PASS_STATE_H
#define VULKAN_PASS_STATE_H

#include "pass/render_pass.h"
#include "resource/image_view.h"

enum { VULKAN_MAX_ATTACHMENTS = 2 * RHW_MAX_COLOR_ATTACHMENTS + 2 + 32 };

struct vulkan_pass_state {
    VkRenderPass render_pass; ///< NULL outside of render passes
    uint32_t subpass_index;
    const struct vulkan_subpass *subpass;
    VkImageView views[VULKAN_MAX_ATTACHMENTS]; ///< by number of the attachment
    VkClearValue clears[VULKAN_MAX_ATTACHMENTS];
    VkRect2D area;
    uint32_t width, height, layers; ///< of the framebuffer
    uint32_t samples;               ///< samples of a pixel in this subpass, at least 1; 0 until a draw tells
    uint32_t view_index;            ///< view that is drawn; 0 without multiview
    bool is_open;                   ///< `pass` is a pass of librhw
    bool was_open;                  ///< the subpass has drawn into its attachments already, so they are loaded
    rhw_pass pass;
};

// Open the pass of librhw for a draw whose pipeline has `samples` samples, if it is not open. Return false if that
// fails, or if no render pass is under way; the replay knows why. A pass that was opened anew knows nothing of what is
// bound (vulkan_bound.is_told).
bool vulkan_pass_open(struct vulkan_replay *replay, uint32_t samples);

// Close the pass of librhw, if it is open. What is in the replay's arena may be thrown away then.
void vulkan_pass_close(struct vulkan_replay *replay);

#endif
