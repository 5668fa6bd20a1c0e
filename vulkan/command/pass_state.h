// SPDX-License-Identifier: MIT
// The render pass that is replayed: where it draws, and the pass of librhw that draws it. That pass is opened when the
// first draw, clear or query needs it, and closed at the end of the subpass, or earlier at a barrier.
#ifndef VULKAN_PASS_STATE_H
#define VULKAN_PASS_STATE_H

#include "pass/render_pass.h"
#include "pipeline/pipeline_targets.h"
#include "resource/image_view.h"

// A command in its chunk.
struct vulkan_replay_place {
    const struct vulkan_command *command;
    const struct vulkan_chunk *chunk;
};

struct vulkan_pass_state {
    VkRenderPass render_pass; ///< NULL outside of render passes
    uint32_t subpass_index;
    const struct vulkan_subpass *subpass;
    // By number of the attachment, in the command that began the render pass
    const VkImageView *views;
    const VkClearValue *clears;
    uint32_t *loaded; ///< views in which the attachment has been loaded or cleared, as bits
    VkRect2D area;
    uint32_t width, height, layers;   ///< size of the framebuffer
    uint32_t samples;                 ///< samples of the pass of librhw that is open
    uint32_t view_index;              ///< view that is drawn; 0 without multiview
    bool splits;                      ///< the subpass has barriers inside
    bool has_drawn;                   ///< the pass of librhw was open in this view
    struct vulkan_replay_place begin; ///< begin of the subpass
    bool is_open;                     ///< `pass` is a pass of librhw
    rhw_pass pass;
    struct vulkan_targets targets; ///< what it draws into
    struct rhw_rect drawn;         ///< the part of `area` that its attachments have
    int drawn_layers;              ///< how many layers they have
};

// Open the pass of librhw for a draw whose pipeline has `samples` samples, if it is not open. Return false if that
// fails, or if no render pass is under way; the replay knows why. A pass that was opened anew knows nothing of what is
// bound (vulkan_bound.is_told).
bool vulkan_pass_open(struct vulkan_replay *replay, uint32_t samples);

// Return the aspects of the depth and stencil attachment of the subpass that may be written, or 0 if there is none.
VkImageAspectFlags vulkan_pass_depth_aspects(const struct vulkan_pass_state *pass);

// Close the pass of librhw, if it is open. What is in the replay's arena may be thrown away then.
void vulkan_pass_close(struct vulkan_replay *replay);

// Remember that the subpass that is recorded has a barrier inside, if `has_barrier`.
void vulkan_pass_note_barrier(VkCommandBuffer buffer, bool has_barrier);

#endif
