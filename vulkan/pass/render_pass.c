// SPDX-License-Identifier: MIT
#include "render_pass.h"

#include "device/chain.h"
#include "resource/image_view.h"

#include <stddef.h>
#include <string.h>

VkFormat vulkan_render_pass_format(VkRenderPass pass, uint32_t attachment)
{
    return attachment < pass->attachment_count ? pass->attachments[attachment].format : VK_FORMAT_UNDEFINED;
}

// Return a render pass with room for so much, in one block, or NULL without memory.
static VkRenderPass make_pass(VkDevice device, const VkAllocationCallbacks *callbacks, uint32_t attachments,
                              uint32_t subpasses, size_t inputs)
{
    const size_t first = sizeof(struct vulkan_subpass) * subpasses;
    const size_t second = sizeof(struct vulkan_attachment) * attachments;
    const VkRenderPass pass =
        vulkan_device_allocate(device, callbacks, sizeof *pass + first + second + inputs * sizeof(uint32_t));
    if (pass) {
        pass->attachment_count = attachments;
        pass->subpass_count = subpasses;
        pass->subpasses = (struct vulkan_subpass *)(pass + 1);
        pass->attachments = (struct vulkan_attachment *)(void *)(pass->subpasses + subpasses);
    }
    return pass;
}

// Return the place of the inputs of all subpasses, behind the attachments.
static uint32_t *first_input(VkRenderPass pass)
{
    return (uint32_t *)(void *)(pass->attachments + pass->attachment_count);
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

// References of either version to attachments. The numbers stand `stride` bytes apart.
struct references {
    const uint32_t *first; // NULL: none
    size_t stride;
};

static struct references references_of(const VkAttachmentReference *first)
{
    return (struct references){first ? &first->attachment : NULL, sizeof *first};
}

static struct references references2_of(const VkAttachmentReference2 *first)
{
    return (struct references){first ? &first->attachment : NULL, sizeof *first};
}

// Return the number of reference i. One that the pass does not have counts as unused.
static uint32_t number_at(VkRenderPass pass, struct references references, uint32_t i)
{
    if (!references.first) {
        return VK_ATTACHMENT_UNUSED;
    }
    const char *const place = (const char *)references.first + i * references.stride;
    const uint32_t number = *(const uint32_t *)(const void *)place;
    return number < pass->attachment_count ? number : VK_ATTACHMENT_UNUSED;
}

// What the descriptions of a subpass of both versions have.
struct subpass_parts {
    uint32_t color_count, input_count;
    struct references colors, resolves, inputs, depth;
    VkImageLayout depth_layout;
};

// Set a subpass whose inputs have room at *inputs, which goes on behind them.
static void set_subpass(VkRenderPass pass, struct vulkan_subpass *to, const struct subpass_parts *from,
                        uint32_t **inputs)
{
    to->color_count =
        from->color_count < RHW_MAX_COLOR_ATTACHMENTS ? from->color_count : RHW_MAX_COLOR_ATTACHMENTS;
    for (uint32_t i = 0; i < to->color_count; i++) {
        to->colors[i] = number_at(pass, from->colors, i);
        to->resolves[i] = number_at(pass, from->resolves, i);
    }
    to->input_count = from->input_count;
    to->inputs = *inputs;
    for (uint32_t i = 0; i < to->input_count; i++) {
        *(*inputs)++ = number_at(pass, from->inputs, i);
    }
    to->depth = number_at(pass, from->depth, 0);
    to->depth_layout = to->stencil_layout = from->depth_layout;
    to->depth_resolve = VK_ATTACHMENT_UNUSED;
}

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

// Render passes of Vulkan 1.0 -------------------------------------------------------------------------

VKAPI_ATTR VkResult VKAPI_CALL vkCreateRenderPass(VkDevice device, const VkRenderPassCreateInfo *info,
                                                  const VkAllocationCallbacks *callbacks, VkRenderPass *pass)
{
    size_t input_count = 0;
    for (uint32_t i = 0; i < info->subpassCount; i++) {
        input_count += info->pSubpasses[i].inputAttachmentCount;
    }
    const VkRenderPass made =
        make_pass(device, callbacks, info->attachmentCount, info->subpassCount, input_count);
    *pass = made;
    if (!made) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    for (uint32_t i = 0; i < info->attachmentCount; i++) {
        set_attachment(&made->attachments[i], &info->pAttachments[i]);
    }
    uint32_t *inputs = first_input(made);
    for (uint32_t i = 0; i < info->subpassCount; i++) {
        const VkSubpassDescription *const from = &info->pSubpasses[i];
        const VkAttachmentReference *const depth = from->pDepthStencilAttachment;
        set_subpass(made, &made->subpasses[i],
                    &(struct subpass_parts){
                        .color_count = from->colorAttachmentCount,
                        .input_count = from->inputAttachmentCount,
                        .colors = references_of(from->pColorAttachments),
                        .resolves = references_of(from->pResolveAttachments),
                        .inputs = references_of(from->pInputAttachments),
                        .depth = references_of(depth),
                        .depth_layout = depth ? depth->layout : VK_IMAGE_LAYOUT_UNDEFINED,
                    },
                    &inputs);
        note_uses(made, &made->subpasses[i]);
    }
    const VkRenderPassMultiviewCreateInfo *const views =
        vulkan_chain_find(info->pNext, VK_STRUCTURE_TYPE_RENDER_PASS_MULTIVIEW_CREATE_INFO);
    for (uint32_t i = 0; views && i < views->subpassCount && i < made->subpass_count; i++) {
        made->subpasses[i].view_mask = views->pViewMasks[i];
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

static void set_attachment2(struct vulkan_attachment *to, const VkAttachmentDescription2 *from)
{
    // Behind its header the newer struct has the members of the older one.
    VkAttachmentDescription older;
    memcpy(&older, (const char *)from + offsetof(VkAttachmentDescription2, flags), sizeof older);
    set_attachment(to, &older);
}

static void set_subpass2(VkRenderPass pass, struct vulkan_subpass *to, const VkSubpassDescription2 *from,
                         uint32_t **inputs)
{
    const VkAttachmentReference2 *const depth = from->pDepthStencilAttachment;
    set_subpass(pass, to,
                &(struct subpass_parts){
                    .color_count = from->colorAttachmentCount,
                    .input_count = from->inputAttachmentCount,
                    .colors = references2_of(from->pColorAttachments),
                    .resolves = references2_of(from->pResolveAttachments),
                    .inputs = references2_of(from->pInputAttachments),
                    .depth = references2_of(depth),
                    .depth_layout = depth ? depth->layout : VK_IMAGE_LAYOUT_UNDEFINED,
                },
                inputs);
    to->view_mask = from->viewMask;
    const VkSubpassDescriptionDepthStencilResolve *const resolve =
        vulkan_chain_find(from->pNext, VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE);
    if (resolve) {
        to->depth_resolve = number_at(pass, references2_of(resolve->pDepthStencilResolveAttachment), 0);
        to->depth_resolve_mode = resolve->depthResolveMode;
        to->stencil_resolve_mode = resolve->stencilResolveMode;
    }
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateRenderPass2(VkDevice device, const VkRenderPassCreateInfo2 *info,
                                                   const VkAllocationCallbacks *callbacks, VkRenderPass *pass)
{
    size_t input_count = 0;
    for (uint32_t i = 0; i < info->subpassCount; i++) {
        input_count += info->pSubpasses[i].inputAttachmentCount;
    }
    const VkRenderPass made =
        make_pass(device, callbacks, info->attachmentCount, info->subpassCount, input_count);
    *pass = made;
    if (!made) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    for (uint32_t i = 0; i < info->attachmentCount; i++) {
        set_attachment2(&made->attachments[i], &info->pAttachments[i]);
    }
    uint32_t *inputs = first_input(made);
    for (uint32_t i = 0; i < info->subpassCount; i++) {
        set_subpass2(made, &made->subpasses[i], &info->pSubpasses[i], &inputs);
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
