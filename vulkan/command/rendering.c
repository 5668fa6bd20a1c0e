// SPDX-License-Identifier: MIT
// Dynamic rendering (VK_KHR_dynamic_rendering): a render pass of one subpass stands in the command that begins it.
#include "pass.h"

enum {
    COLORS = RHW_MAX_COLOR_ATTACHMENTS,
    DEPTH = 2 * COLORS, // number of the attachment; its resolve is the next one
    COUNT = DEPTH + 2
};

// What stands behind the command.
struct rendering {
    struct VkRenderPass_T pass;
    struct vulkan_subpass subpass;
    struct vulkan_attachment attachments[COUNT];
};

// What is recorded of the attachments.
struct views {
    VkImageView views[COUNT];
    VkClearValue clears[COUNT];
};

static VkAttachmentLoadOp load_of(const VkRenderingInfo *info, VkAttachmentLoadOp load)
{
    return info->flags & VK_RENDERING_RESUMING_BIT ? VK_ATTACHMENT_LOAD_OP_LOAD : load;
}

static VkAttachmentStoreOp store_of(const VkRenderingInfo *info, VkAttachmentStoreOp store)
{
    return info->flags & VK_RENDERING_SUSPENDING_BIT ? VK_ATTACHMENT_STORE_OP_STORE : store;
}

static uint32_t count_colors(const VkRenderingInfo *info)
{
    return info->colorAttachmentCount < COLORS ? info->colorAttachmentCount : COLORS;
}

static bool is_used(const VkRenderingAttachmentInfo *attachment)
{
    return attachment && attachment->imageView;
}

// Return the view that an attachment is resolved into, or NULL. A rendering that goes on later is resolved by then.
static VkImageView resolve_of(const VkRenderingInfo *info, const VkRenderingAttachmentInfo *attachment)
{
    const bool resolves =
        attachment->resolveMode != VK_RESOLVE_MODE_NONE && !(info->flags & VK_RENDERING_SUSPENDING_BIT);
    return resolves ? attachment->resolveImageView : VK_NULL_HANDLE;
}

static void set_color(const VkRenderingInfo *info, uint32_t i, struct rendering *rendering)
{
    const VkRenderingAttachmentInfo *const color = &info->pColorAttachments[i];
    rendering->subpass.colors[i] = VK_ATTACHMENT_UNUSED;
    rendering->subpass.resolves[i] = VK_ATTACHMENT_UNUSED;
    if (!is_used(color)) {
        return;
    }
    rendering->subpass.colors[i] = 2 * i;
    rendering->subpass.samples = color->imageView->image->samples;
    rendering->attachments[2 * i] = (struct vulkan_attachment){
        .format = color->imageView->vulkan_format,
        .samples = color->imageView->image->samples,
        .load = load_of(info, color->loadOp),
        .store = store_of(info, color->storeOp),
    };
    if (resolve_of(info, color)) {
        rendering->subpass.resolves[i] = 2 * i + 1;
        rendering->attachments[2 * i + 1].format = color->resolveImageView->vulkan_format;
        rendering->attachments[2 * i + 1].samples = 1;
    }
}

static void set_depth(const VkRenderingInfo *info, struct rendering *rendering)
{
    const VkRenderingAttachmentInfo *const depth =
        is_used(info->pDepthAttachment) ? info->pDepthAttachment : NULL;
    const VkRenderingAttachmentInfo *const stencil =
        is_used(info->pStencilAttachment) ? info->pStencilAttachment : NULL;
    const VkRenderingAttachmentInfo *const any = depth ? depth : stencil;
    rendering->subpass.depth = VK_ATTACHMENT_UNUSED;
    rendering->subpass.depth_resolve = VK_ATTACHMENT_UNUSED;
    if (!any) {
        return;
    }
    rendering->subpass.depth = DEPTH;
    rendering->subpass.samples = any->imageView->image->samples;
    rendering->subpass.depth_layout = depth ? depth->imageLayout : VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL;
    rendering->subpass.stencil_layout = stencil ? stencil->imageLayout : VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL;
    rendering->attachments[DEPTH] = (struct vulkan_attachment){
        .format = any->imageView->image->vulkan_format,
        .samples = any->imageView->image->samples,
        .load = depth ? load_of(info, depth->loadOp) : VK_ATTACHMENT_LOAD_OP_LOAD,
        .store = depth ? store_of(info, depth->storeOp) : VK_ATTACHMENT_STORE_OP_STORE,
        .stencil_load = stencil ? load_of(info, stencil->loadOp) : VK_ATTACHMENT_LOAD_OP_LOAD,
        .stencil_store = stencil ? store_of(info, stencil->storeOp) : VK_ATTACHMENT_STORE_OP_STORE,
    };
    const bool resolves_depth = depth && resolve_of(info, depth);
    const bool resolves_stencil = stencil && resolve_of(info, stencil);
    if (resolves_depth || resolves_stencil) {
        rendering->subpass.depth_resolve = DEPTH + 1;
        rendering->subpass.depth_resolve_mode = resolves_depth ? depth->resolveMode : VK_RESOLVE_MODE_NONE;
        rendering->subpass.stencil_resolve_mode =
            resolves_stencil ? stencil->resolveMode : VK_RESOLVE_MODE_NONE;
        rendering->attachments[DEPTH + 1] = rendering->attachments[DEPTH];
        rendering->attachments[DEPTH + 1].samples = 1;
        // The image that is resolved into keeps what is not resolved.
        rendering->attachments[DEPTH + 1].load = VK_ATTACHMENT_LOAD_OP_LOAD;
        rendering->attachments[DEPTH + 1].stencil_load = VK_ATTACHMENT_LOAD_OP_LOAD;
    }
}

static void set_views(const VkRenderingInfo *info, struct views *views)
{
    for (uint32_t i = 0; i < count_colors(info); i++) {
        const VkRenderingAttachmentInfo *const color = &info->pColorAttachments[i];
        if (is_used(color)) {
            views->views[2 * i] = color->imageView;
            views->views[2 * i + 1] = resolve_of(info, color);
            views->clears[2 * i] = color->clearValue;
        }
    }
    const VkRenderingAttachmentInfo *const depth_and_stencil[] = {info->pStencilAttachment,
                                                                  info->pDepthAttachment};
    for (int i = 0; i < 2; i++) {
        const VkRenderingAttachmentInfo *const one = depth_and_stencil[i];
        if (is_used(one)) {
            views->views[DEPTH] = one->imageView;
            views->views[DEPTH + 1] = resolve_of(info, one) ? resolve_of(info, one) : views->views[DEPTH + 1];
            if (i == 0) {
                views->clears[DEPTH].depthStencil.stencil = one->clearValue.depthStencil.stencil;
            } else {
                views->clears[DEPTH].depthStencil.depth = one->clearValue.depthStencil.depth;
            }
        }
    }
}

VKAPI_ATTR void VKAPI_CALL vkCmdBeginRendering(VkCommandBuffer buffer, const VkRenderingInfo *info)
{
    struct views views = {0};
    set_views(info, &views);
    const struct vulkan_pass_begin begin = {
        .area = info->renderArea,
        .width = (uint32_t)info->renderArea.offset.x + info->renderArea.extent.width,
        .height = (uint32_t)info->renderArea.offset.y + info->renderArea.extent.height,
        .layers = info->viewMask ? 1 : info->layerCount,
        .attachment_count = COUNT,
        .view_count = COUNT,
        .clear_count = COUNT,
        .views = views.views,
        .clears = views.clears,
    };
    struct rendering *const rendering = vulkan_record_begin_pass(buffer, &begin, sizeof *rendering);
    if (!rendering) {
        return;
    }
    rendering->pass = (struct VkRenderPass_T){COUNT, 1, rendering->attachments, &rendering->subpass};
    rendering->subpass.color_count = count_colors(info);
    rendering->subpass.view_mask = info->viewMask;
    for (uint32_t i = 0; i < rendering->subpass.color_count; i++) {
        set_color(info, i, rendering);
    }
    set_depth(info, rendering);
    vulkan_record_begin_subpass(buffer);
}

VKAPI_ATTR void VKAPI_CALL vkCmdEndRendering(VkCommandBuffer buffer)
{
    vulkan_record_end_pass(buffer);
}
