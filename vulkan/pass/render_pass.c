// SPDX-License-Identifier: MIT
#include "render_pass.h"

#include "resource/image_view.h"

#include <string.h>

VkFormat vulkan_render_pass_format(VkRenderPass pass, uint32_t attachment)
{
    return attachment < pass->attachment_count ? pass->attachments[attachment].format : VK_FORMAT_UNDEFINED;
}

// Return a render pass with room for so much, in one block, or NULL where that is too much.
static VkRenderPass make_pass(VkDevice device, const VkAllocationCallbacks *callbacks, uint32_t attachments,
                              uint32_t subpasses)
{
    const size_t first = sizeof(struct vulkan_subpass) * subpasses;
    if (attachments > VULKAN_MAX_ATTACHMENTS) {
        vulkan_log("a render pass of %u attachments; at most %d", (unsigned)attachments,
                   VULKAN_MAX_ATTACHMENTS);
        return NULL;
    }
    const VkRenderPass pass = vulkan_device_allocate(
        device, callbacks, sizeof *pass + first + sizeof(struct vulkan_attachment) * attachments);
    if (pass) {
        pass->attachment_count = attachments;
        pass->subpass_count = subpasses;
        pass->subpasses = (struct vulkan_subpass *)(pass + 1);
        pass->attachments = (struct vulkan_attachment *)(void *)(pass->subpasses + subpasses);
    }
    return pass;
}

static void note_use(VkRenderPass pass, struct vulkan_subpass *subpass, uint32_t number)
{
    if (number != VK_ATTACHMENT_UNUSED) {
        pass->attachments[number].last_subpass = (uint32_t)(subpass - pass->subpasses);
    }
}

// An attachment that is drawn into has the samples of the subpass.
static void note_target(VkRenderPass pass, struct vulkan_subpass *subpass, uint32_t number)
{
    note_use(pass, subpass, number);
    if (number != VK_ATTACHMENT_UNUSED) {
        subpass->samples = pass->attachments[number].samples;
    }
}

static void note_uses(VkRenderPass pass, struct vulkan_subpass *subpass)
{
    for (uint32_t i = 0; i < subpass->input_count; i++) {
        note_use(pass, subpass, subpass->inputs[i]);
    }
    for (uint32_t i = 0; i < subpass->color_count; i++) {
        note_target(pass, subpass, subpass->colors[i]);
        note_use(pass, subpass, subpass->resolves[i]);
    }
    note_target(pass, subpass, subpass->depth);
    note_use(pass, subpass, subpass->depth_resolve);
}

static uint32_t at_most(uint32_t count, uint32_t most)
{
    return count < most ? count : most;
}

// Render passes of Vulkan 1.0 -------------------------------------------------------------------------

static void set_attachment(struct vulkan_attachment *to, const VkAttachmentDescription *from)
{
    *to = (struct vulkan_attachment){
        .format = from->format,
        .samples = (uint32_t)from->samples,
        .load = from->loadOp,
        .stencil_load = from->stencilLoadOp,
        .store = from->storeOp,
        .stencil_store = from->stencilStoreOp,
        .is_undefined = from->initialLayout == VK_IMAGE_LAYOUT_UNDEFINED,
    };
}

static void set_subpass(struct vulkan_subpass *to, const VkSubpassDescription *from)
{
    const VkAttachmentReference *const depth = from->pDepthStencilAttachment;
    to->color_count = at_most(from->colorAttachmentCount, RHW_MAX_COLOR_ATTACHMENTS);
    to->input_count = at_most(from->inputAttachmentCount, VULKAN_MAX_INPUTS);
    for (uint32_t i = 0; i < to->color_count; i++) {
        to->colors[i] = from->pColorAttachments[i].attachment;
        to->resolves[i] =
            from->pResolveAttachments ? from->pResolveAttachments[i].attachment : VK_ATTACHMENT_UNUSED;
    }
    for (uint32_t i = 0; i < to->input_count; i++) {
        to->inputs[i] = from->pInputAttachments[i].attachment;
    }
    to->depth = depth ? depth->attachment : VK_ATTACHMENT_UNUSED;
    to->depth_layout = depth ? depth->layout : VK_IMAGE_LAYOUT_UNDEFINED;
    to->stencil_layout = to->depth_layout;
    to->depth_resolve = VK_ATTACHMENT_UNUSED;
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateRenderPass(VkDevice device, const VkRenderPassCreateInfo *info,
                                                  const VkAllocationCallbacks *callbacks, VkRenderPass *pass)
{
    const VkRenderPass made = make_pass(device, callbacks, info->attachmentCount, info->subpassCount);
    *pass = made;
    if (!made) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    for (uint32_t i = 0; i < info->attachmentCount; i++) {
        set_attachment(&made->attachments[i], &info->pAttachments[i]);
    }
    for (uint32_t i = 0; i < info->subpassCount; i++) {
        set_subpass(&made->subpasses[i], &info->pSubpasses[i]);
        note_uses(made, &made->subpasses[i]);
    }
    for (const VkBaseInStructure *one = info->pNext; one; one = one->pNext) {
        if (one->sType == VK_STRUCTURE_TYPE_RENDER_PASS_MULTIVIEW_CREATE_INFO) {
            const VkRenderPassMultiviewCreateInfo *const views = (const VkRenderPassMultiviewCreateInfo *)one;
            for (uint32_t i = 0; i < views->subpassCount; i++) {
                made->subpasses[i].view_mask = views->pViewMasks[i];
            }
        }
    }
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkDestroyRenderPass(VkDevice device, VkRenderPass pass,
                                               const VkAllocationCallbacks *callbacks)
{
    vulkan_device_free(device, callbacks, pass);
}

VKAPI_ATTR void VKAPI_CALL vkGetRenderAreaGranularity(VkDevice device, VkRenderPass pass,
                                                      VkExtent2D *granularity)
{
    (void)device;
    (void)pass;
    *granularity = (VkExtent2D){1, 1};
}

// Render passes of VK_KHR_create_renderpass2 ----------------------------------------------------------

static const void *find(const void *chain, VkStructureType type)
{
    for (const VkBaseInStructure *one = chain; one; one = one->pNext) {
        if (one->sType == type) {
            return one;
        }
    }
    return NULL;
}

static void set_attachment2(struct vulkan_attachment *to, const VkAttachmentDescription2 *from)
{
    *to = (struct vulkan_attachment){
        .format = from->format,
        .samples = (uint32_t)from->samples,
        .load = from->loadOp,
        .stencil_load = from->stencilLoadOp,
        .store = from->storeOp,
        .stencil_store = from->stencilStoreOp,
        .is_undefined = from->initialLayout == VK_IMAGE_LAYOUT_UNDEFINED,
    };
}

static void set_depth2(struct vulkan_subpass *to, const VkSubpassDescription2 *from)
{
    const VkAttachmentReference2 *const depth = from->pDepthStencilAttachment;
    const VkSubpassDescriptionDepthStencilResolve *const resolve =
        find(from->pNext, VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE);
    to->depth = depth ? depth->attachment : VK_ATTACHMENT_UNUSED;
    to->depth_layout = depth ? depth->layout : VK_IMAGE_LAYOUT_UNDEFINED;
    to->stencil_layout = to->depth_layout;
    to->depth_resolve = VK_ATTACHMENT_UNUSED;
    if (resolve && resolve->pDepthStencilResolveAttachment) {
        to->depth_resolve = resolve->pDepthStencilResolveAttachment->attachment;
        to->depth_resolve_mode = resolve->depthResolveMode;
        to->stencil_resolve_mode = resolve->stencilResolveMode;
    }
}

static void set_subpass2(struct vulkan_subpass *to, const VkSubpassDescription2 *from)
{
    to->color_count = at_most(from->colorAttachmentCount, RHW_MAX_COLOR_ATTACHMENTS);
    to->input_count = at_most(from->inputAttachmentCount, VULKAN_MAX_INPUTS);
    for (uint32_t i = 0; i < to->color_count; i++) {
        to->colors[i] = from->pColorAttachments[i].attachment;
        to->resolves[i] =
            from->pResolveAttachments ? from->pResolveAttachments[i].attachment : VK_ATTACHMENT_UNUSED;
    }
    for (uint32_t i = 0; i < to->input_count; i++) {
        to->inputs[i] = from->pInputAttachments[i].attachment;
    }
    set_depth2(to, from);
    to->view_mask = from->viewMask;
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateRenderPass2(VkDevice device, const VkRenderPassCreateInfo2 *info,
                                                   const VkAllocationCallbacks *callbacks, VkRenderPass *pass)
{
    const VkRenderPass made = make_pass(device, callbacks, info->attachmentCount, info->subpassCount);
    *pass = made;
    if (!made) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    for (uint32_t i = 0; i < info->attachmentCount; i++) {
        set_attachment2(&made->attachments[i], &info->pAttachments[i]);
    }
    for (uint32_t i = 0; i < info->subpassCount; i++) {
        set_subpass2(&made->subpasses[i], &info->pSubpasses[i]);
        note_uses(made, &made->subpasses[i]);
    }
    return VK_SUCCESS;
}

// Framebuffers ----------------------------------------------------------------------------------------

VKAPI_ATTR VkResult VKAPI_CALL vkCreateFramebuffer(VkDevice device, const VkFramebufferCreateInfo *info,
                                                   const VkAllocationCallbacks *callbacks,
                                                   VkFramebuffer *framebuffer)
{
    const bool is_imageless = info->flags & VK_FRAMEBUFFER_CREATE_IMAGELESS_BIT;
    const uint32_t count = is_imageless ? 0 : info->attachmentCount;
    const VkFramebuffer made =
        vulkan_device_allocate(device, callbacks, sizeof *made + count * sizeof(VkImageView));
    *framebuffer = made;
    if (!made) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    made->width = info->width;
    made->height = info->height;
    made->layers = info->layers;
    made->attachment_count = count;
    made->is_imageless = is_imageless;
    if (count > 0) {
        memcpy(made->attachments, info->pAttachments, count * sizeof *made->attachments);
    }
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkDestroyFramebuffer(VkDevice device, VkFramebuffer framebuffer,
                                                const VkAllocationCallbacks *callbacks)
{
    vulkan_device_free(device, callbacks, framebuffer);
}
