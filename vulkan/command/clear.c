// SPDX-License-Identifier: MIT
#include "clear_value.h"
#include "image_region.h"

// Images ----------------------------------------------------------------------------------------------

struct clear_command {
    struct vulkan_command command;
    VkImage image;
    VkImageSubresourceRange range;
    struct rhw_clear_value value;
};

static void clear_level(struct vulkan_replay *replay, const struct clear_command *clear, uint32_t level,
                        enum rhw_aspect aspect)
{
    const VkImage image = clear->image;
    const bool is_3d = image->type == VK_IMAGE_TYPE_3D;
    const bool takes_all = clear->range.layerCount == VK_REMAINING_ARRAY_LAYERS;
    const rhw_texture texture = vulkan_replay_texture(replay, image);
    const struct rhw_texture_region region = {
        .level = (int)level,
        .z = is_3d ? 0 : (int)clear->range.baseArrayLayer,
        .depth = is_3d || takes_all ? 0 : (int)clear->range.layerCount,
        .aspect = aspect,
    };
    if (replay->result == VK_SUCCESS) {
        vulkan_replay_check(replay, rhw_texture_clear(replay->context, texture, &region, &clear->value),
                            "clear");
    }
}

static void replay_clear(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct clear_command *const clear = (const struct clear_command *)command;
    const VkImageSubresourceRange *const range = &clear->range;
    const uint32_t levels = clear->image->levels;
    if (range->baseMipLevel >= levels || range->layerCount == 0) {
        vulkan_log("clear: a range without texels is left out");
        return;
    }
    const uint32_t left = levels - range->baseMipLevel;
    const uint32_t count = range->levelCount < left ? range->levelCount : left;
    for (uint32_t i = 0; i < count; i++) {
        if (range->aspectMask & ~(VkImageAspectFlags)VK_IMAGE_ASPECT_STENCIL_BIT) {
            clear_level(replay, clear, range->baseMipLevel + i, RHW_ASPECT_DEFAULT);
        }
        if (range->aspectMask & VK_IMAGE_ASPECT_STENCIL_BIT) {
            clear_level(replay, clear, range->baseMipLevel + i, RHW_ASPECT_STENCIL);
        }
    }
}

static void record_clear(VkCommandBuffer buffer, VkImage image, const VkImageSubresourceRange *range,
                         const struct rhw_clear_value *value)
{
    struct clear_command *const command = vulkan_record(buffer, sizeof *command, replay_clear);
    if (command) {
        command->image = image;
        command->range = *range;
        command->value = *value;
    }
}

VKAPI_ATTR void VKAPI_CALL vkCmdClearColorImage(VkCommandBuffer buffer, VkImage image, VkImageLayout layout,
                                                const VkClearColorValue *color, uint32_t count,
                                                const VkImageSubresourceRange *ranges)
{
    (void)layout;
    struct rhw_clear_value value = {0};
    vulkan_clear_color(image->format, color, value.color, value.color_integer);
    for (uint32_t i = 0; i < count; i++) {
        record_clear(buffer, image, &ranges[i], &value);
    }
}

VKAPI_ATTR void VKAPI_CALL vkCmdClearDepthStencilImage(VkCommandBuffer buffer, VkImage image,
                                                       VkImageLayout layout,
                                                       const VkClearDepthStencilValue *depth, uint32_t count,
                                                       const VkImageSubresourceRange *ranges)
{
    (void)layout;
    const struct rhw_clear_value value = {.depth = vulkan_clear_depth(depth->depth),
                                          .stencil = (uint8_t)depth->stencil};
    for (uint32_t i = 0; i < count; i++) {
        record_clear(buffer, image, &ranges[i], &value);
    }
}

// Attachments -----------------------------------------------------------------------------------------

struct attachment_clear {
    struct vulkan_command command;
    VkClearAttachment attachment;
    VkClearRect rect;
};

// Return the part of a rectangle that lies in the area that is drawn.
static struct rhw_rect within(const VkRect2D *rect, const struct rhw_rect *area)
{
    const int left = rect->offset.x > area->x ? rect->offset.x : area->x;
    const int top = rect->offset.y > area->y ? rect->offset.y : area->y;
    const int64_t rect_right = (int64_t)rect->offset.x + rect->extent.width;
    const int64_t rect_bottom = (int64_t)rect->offset.y + rect->extent.height;
    const int64_t area_right = (int64_t)area->x + area->width;
    const int64_t area_bottom = (int64_t)area->y + area->height;
    const int64_t right = rect_right < area_right ? rect_right : area_right;
    const int64_t bottom = rect_bottom < area_bottom ? rect_bottom : area_bottom;
    return (struct rhw_rect){left, top, right > left ? (int)(right - left) : 0,
                             bottom > top ? (int)(bottom - top) : 0};
}

// Set what is cleared to what, of what the subpass draws into. Return false if that is nothing.
static bool set_clear(const struct vulkan_pass_state *pass, const VkClearAttachment *attachment,
                      struct rhw_clear *clear)
{
    const struct vulkan_subpass *const subpass = pass->subpass;
    if (attachment->aspectMask & VK_IMAGE_ASPECT_COLOR_BIT) {
        const uint32_t i = attachment->colorAttachment;
        const uint32_t number = i < subpass->color_count ? subpass->colors[i] : VK_ATTACHMENT_UNUSED;
        if (number == VK_ATTACHMENT_UNUSED || !pass->views[number]) {
            return false;
        }
        clear->colors = 1u << i;
        vulkan_clear_color(pass->views[number]->format, &attachment->clearValue.color, clear->color[i],
                           clear->color_integer[i]);
        return true;
    }
    const VkImageAspectFlags aspects = attachment->aspectMask & vulkan_pass_depth_aspects(pass);
    clear->depth = aspects & VK_IMAGE_ASPECT_DEPTH_BIT;
    clear->stencil = aspects & VK_IMAGE_ASPECT_STENCIL_BIT;
    clear->depth_value = vulkan_clear_depth(attachment->clearValue.depthStencil.depth);
    clear->stencil_value = (uint8_t)attachment->clearValue.depthStencil.stencil;
    return aspects != 0;
}

static void replay_attachment(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct attachment_clear *const one = (const struct attachment_clear *)command;
    struct vulkan_pass_state *const pass = &replay->pass;
    struct rhw_clear clear = {0};
    if (!pass->render_pass) {
        vulkan_log("attachments are not cleared: no render pass has begun");
        return;
    }
    if (!set_clear(pass, &one->attachment, &clear) || !vulkan_pass_open(replay, 0)) {
        return;
    }
    const struct rhw_rect rect = within(&one->rect.rect, &pass->drawn);
    const int64_t layers = pass->drawn_layers - (int64_t)one->rect.baseArrayLayer;
    if (rect.width != (int64_t)one->rect.rect.extent.width || one->rect.layerCount > layers ||
        rect.height != (int64_t)one->rect.rect.extent.height) {
        vulkan_log("a clear of attachments is cut to %d x %d in %lld layers", rect.width, rect.height,
                   (long long)layers);
    }
    clear.rects = &rect;
    clear.rect_count = 1;
    clear.layer = (int)one->rect.baseArrayLayer;
    clear.layer_count = (int)(one->rect.layerCount < layers ? one->rect.layerCount : layers);
    if (rect.width > 0 && rect.height > 0 && clear.layer_count > 0) {
        rhw_pass_clear_attachments(replay->context, pass->pass, &clear);
    }
}

VKAPI_ATTR void VKAPI_CALL vkCmdClearAttachments(VkCommandBuffer buffer, uint32_t count,
                                                 const VkClearAttachment *attachments, uint32_t rect_count,
                                                 const VkClearRect *rects)
{
    for (uint32_t i = 0; i < count * rect_count; i++) {
        struct attachment_clear *const command = vulkan_record(buffer, sizeof *command, replay_attachment);
        if (command) {
            command->attachment = attachments[i / rect_count];
            command->rect = rects[i % rect_count];
        }
    }
}
