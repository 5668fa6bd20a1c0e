// SPDX-License-Identifier: MIT
#include "vulkan_pass.h"

struct rig_image pass_image(struct rig *rig, VkFormat format, VkSampleCountFlagBits samples)
{
    const bool is_color = format == VK_FORMAT_R8G8B8A8_UNORM;
    return rig_image(rig, format, PASS_SIDE, PASS_SIDE, samples,
                     (VkImageUsageFlags)(is_color ? VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                                        VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT
                                                  : VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT) |
                         VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
}

VkAttachmentDescription2 pass_attachment(VkFormat format, VkSampleCountFlagBits samples, VkImageLayout last)
{
    return (VkAttachmentDescription2){.sType = VK_STRUCTURE_TYPE_ATTACHMENT_DESCRIPTION_2,
                                      .format = format,
                                      .samples = samples,
                                      .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                      .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                      .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                      .stencilStoreOp = VK_ATTACHMENT_STORE_OP_STORE,
                                      .finalLayout = last};
}

VkAttachmentReference2 pass_reference(uint32_t number, VkImageLayout layout, VkImageAspectFlags aspects)
{
    return (VkAttachmentReference2){.sType = VK_STRUCTURE_TYPE_ATTACHMENT_REFERENCE_2,
                                    .attachment = number,
                                    .layout = layout,
                                    .aspectMask = aspects};
}

VkRenderPass pass_create(struct rig *rig, const VkAttachmentDescription2 *attachments, uint32_t count,
                         VkSubpassDescription2 subpass)
{
    const PFN_vkCreateRenderPass2KHR create =
        (PFN_vkCreateRenderPass2KHR)vkGetDeviceProcAddr(rig->device, "vkCreateRenderPass2KHR");
    const VkSubpassDependency2 end = {.sType = VK_STRUCTURE_TYPE_SUBPASS_DEPENDENCY_2,
                                      .srcSubpass = 0,
                                      .dstSubpass = VK_SUBPASS_EXTERNAL,
                                      .srcStageMask = VK_PIPELINE_STAGE_ALL_GRAPHICS_BIT,
                                      .dstStageMask = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                      .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
                                      .dstAccessMask = VK_ACCESS_MEMORY_READ_BIT};
    subpass.sType = VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_2;
    const VkRenderPassCreateInfo2 info = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO_2,
                                          .attachmentCount = count,
                                          .pAttachments = attachments,
                                          .subpassCount = 1,
                                          .pSubpasses = &subpass,
                                          .dependencyCount = 1,
                                          .pDependencies = &end};
    VkRenderPass pass;
    CHECK(create(rig->device, &info, NULL, &pass));
    RIG_KEEP(rig, RENDER_PASS, pass);
    return pass;
}

void pass_begin(struct rig *rig, const void *next, VkRenderPass pass, VkFramebuffer framebuffer,
                const VkClearValue *clears, uint32_t count)
{
    const VkRenderPassBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                         .pNext = next,
                                         .renderPass = pass,
                                         .framebuffer = framebuffer,
                                         .renderArea = {.extent = {PASS_SIDE, PASS_SIDE}},
                                         .clearValueCount = count,
                                         .pClearValues = clears};
    vkCmdBeginRenderPass(rig->commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
}
