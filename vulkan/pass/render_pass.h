// SPDX-License-Identifier: MIT
// Render passes and framebuffers. The structs of VK_KHR_create_renderpass2 are the ones that are kept; the older ones
// are put into them. Dynamic rendering makes a render pass of one subpass for the time it lasts.
#ifndef VULKAN_RENDER_PASS_H
#define VULKAN_RENDER_PASS_H

#include "device/device.h"

struct vulkan_attachment {
    VkFormat format;
    uint32_t samples;
    VkAttachmentLoadOp load, stencil_load;
    VkAttachmentStoreOp store, stencil_store;
    uint32_t last_subpass; ///< last subpass that uses it
    bool is_undefined;     ///< it comes from VK_IMAGE_LAYOUT_UNDEFINED
};

struct vulkan_subpass {
    uint32_t color_count, input_count;
    uint32_t colors[RHW_MAX_COLOR_ATTACHMENTS];   ///< numbers of attachments, or VK_ATTACHMENT_UNUSED
    uint32_t resolves[RHW_MAX_COLOR_ATTACHMENTS]; ///< numbers of attachments, or VK_ATTACHMENT_UNUSED
    const uint32_t *inputs;                       ///< numbers of attachments, or VK_ATTACHMENT_UNUSED
    uint32_t depth, depth_resolve;                ///< number of the attachment, or VK_ATTACHMENT_UNUSED
    VkImageLayout depth_layout, stencil_layout;
    VkResolveModeFlagBits depth_resolve_mode, stencil_resolve_mode;
    uint32_t view_mask; ///< 0 without multiview
    uint32_t samples;   ///< samples of its attachments; 0 if it has none
};

struct VkRenderPass_T {
    uint32_t attachment_count, subpass_count;
    struct vulkan_attachment *attachments;
    struct vulkan_subpass *subpasses;
};

struct VkFramebuffer_T {
    uint32_t width, height, layers;
    uint32_t attachment_count;
    bool is_imageless;
    VkImageView attachments[]; ///< not set if the framebuffer is imageless
};

// Return the format of an attachment of a subpass, or VK_FORMAT_UNDEFINED for VK_ATTACHMENT_UNUSED.
VkFormat vulkan_render_pass_format(VkRenderPass pass, uint32_t attachment);

#endif
