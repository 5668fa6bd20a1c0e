// SPDX-License-Identifier: MIT
// Render passes of one subpass, with attachments of one size that begin cleared and are stored.
#ifndef TEST_VULKAN_PASS_H
#define TEST_VULKAN_PASS_H

#include "vulkan_rig.h"

enum { PASS_SIDE = 8, PASS_TEXELS = PASS_SIDE * PASS_SIDE };

// Create an image to be an attachment: of colours and an input where the format is R8G8B8A8_UNORM, and else of depth and
// stencil.
struct rig_image pass_image(struct rig *rig, VkFormat format, VkSampleCountFlagBits samples);

// Return an attachment that is cleared, in layout `last` after the pass.
VkAttachmentDescription2 pass_attachment(VkFormat format, VkSampleCountFlagBits samples, VkImageLayout last);

VkAttachmentReference2 pass_reference(uint32_t number, VkImageLayout layout, VkImageAspectFlags aspects);

// Create a pass of one subpass, after which everything waits.
VkRenderPass pass_create(struct rig *rig, const VkAttachmentDescription2 *attachments, uint32_t count,
                         VkSubpassDescription2 subpass);

// Begin a pass in all of a framebuffer. `next` is pNext, or NULL.
void pass_begin(struct rig *rig, const void *next, VkRenderPass pass, VkFramebuffer framebuffer,
                const VkClearValue *clears, uint32_t count);

#endif
