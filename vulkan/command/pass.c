// SPDX-License-Identifier: MIT
// Render passes as commands. A subpass with several views is replayed once for each of them.
#include "clear_value.h"
#include "pass.h"

#include "device/chain.h"
#include "replay.h"
#include "resource/format.h"

// Replay ----------------------------------------------------------------------------------------------

static uint32_t first_view(uint32_t mask)
{
    return mask ? (uint32_t)__builtin_ctz(mask) : 0;
}

// Clear an attachment that the subpass does not draw into, if nothing has been loaded into it.
static void clear_unloaded(struct vulkan_replay *replay, uint32_t number)
{
    struct vulkan_pass_state *const pass = &replay->pass;
    if (replay->result != VK_SUCCESS || number == VK_ATTACHMENT_UNUSED || !pass->views[number] ||
        pass->loaded[number] >> pass->view_index & 1) {
        return;
    }
    pass->loaded[number] |= 1u << pass->view_index;
    const struct vulkan_attachment *const attachment = &pass->render_pass->attachments[number];
    const VkImageView view = pass->views[number];
    rhw_texture texture;
    replay->result = vulkan_image_view_target(replay->queue, view, &texture);
    if (texture.context == 0) {
        return;
    }
    const VkImageAspectFlags aspects = vulkan_format_aspects(view->image->vulkan_format);
    struct rhw_texture_region region = {
        .x = pass->area.offset.x,
        .y = pass->area.offset.y,
        .z = (int)pass->view_index,
        .width = (int)pass->area.extent.width,
        .height = (int)pass->area.extent.height,
        .depth = pass->subpass->view_mask ? 1 : (int)pass->layers,
    };
    struct rhw_clear_value value = {.depth = vulkan_clear_depth(pass->clears[number].depthStencil.depth),
                                    .stencil = (uint8_t)pass->clears[number].depthStencil.stencil};
    if (aspects == VK_IMAGE_ASPECT_COLOR_BIT) {
        value = (struct rhw_clear_value){0};
        vulkan_clear_color(view->format, &pass->clears[number].color, value.color, value.color_integer);
    }
    if (attachment->load == VK_ATTACHMENT_LOAD_OP_CLEAR && aspects != VK_IMAGE_ASPECT_STENCIL_BIT) {
        vulkan_replay_check(replay, rhw_texture_clear(replay->context, texture, &region, &value), "clear");
    }
    if (attachment->stencil_load == VK_ATTACHMENT_LOAD_OP_CLEAR && aspects & VK_IMAGE_ASPECT_STENCIL_BIT) {
        region.aspect = RHW_ASPECT_STENCIL;
        vulkan_replay_check(replay, rhw_texture_clear(replay->context, texture, &region, &value), "clear");
    }
}

static bool draws_into(const struct vulkan_subpass *subpass, uint32_t number)
{
    bool draws = subpass->depth == number;
    for (uint32_t i = 0; i < subpass->color_count; i++) {
        draws = draws || subpass->colors[i] == number;
    }
    return draws;
}

// Let attachments that are read hold what they are cleared to, before anything is drawn, and so the aspect of another
// one that depth or stencil alone is resolved into.
static void load_inputs(struct vulkan_replay *replay)
{
    struct vulkan_pass_state *const pass = &replay->pass;
    bool reads_own = false;
    for (uint32_t i = 0; i < pass->subpass->input_count; i++) {
        const uint32_t number = pass->subpass->inputs[i];
        if (number != VK_ATTACHMENT_UNUSED && draws_into(pass->subpass, number)) {
            reads_own = reads_own || !(pass->loaded[number] >> pass->view_index & 1);
        } else {
            clear_unloaded(replay, number);
        }
    }
    clear_unloaded(replay, pass->subpass->depth_resolve);
    if (reads_own) {
        const bool splits = pass->splits;
        pass->splits = true; // what is cleared is stored
        vulkan_pass_open(replay, 0);
        vulkan_pass_close(replay);
        pass->splits = splits;
    }
}

struct begin_pass {
    struct vulkan_command command;
    VkRenderPass render_pass;
    VkRect2D area;
    uint32_t width, height, layers;
    uint32_t attachment_count;
    const VkImageView *views;
    const VkClearValue *clears;
    uint32_t *loaded; // what replay notes
};

static void replay_begin_pass(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct begin_pass *const begin = (const struct begin_pass *)command;
    struct vulkan_pass_state *const pass = &replay->pass;
    *pass = (struct vulkan_pass_state){
        .render_pass = begin->render_pass,
        .subpass_index = UINT32_MAX,
        .area = begin->area,
        .width = begin->width,
        .height = begin->height,
        .layers = begin->layers,
        .views = begin->views,
        .clears = begin->clears,
        .loaded = begin->loaded,
    };
    for (uint32_t i = 0; i < begin->attachment_count; i++) {
        pass->loaded[i] = 0;
        if (pass->views[i] && begin->render_pass->attachments[i].is_undefined) {
            vulkan_image_forget(replay->queue, pass->views[i]->image);
        }
    }
}

struct vulkan_begin_subpass {
    struct vulkan_command command;
    bool has_barrier;
};

static void begin_view(struct vulkan_replay *replay)
{
    replay->bound.is_told = false;
    load_inputs(replay);
}

static void replay_begin_subpass(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct vulkan_begin_subpass *const begin = (const struct vulkan_begin_subpass *)command;
    struct vulkan_pass_state *const pass = &replay->pass;
    if (!pass->render_pass) {
        vulkan_log("a subpass is begun, and no render pass has begun");
        return;
    }
    // More subpasses than there are, which Vulkan forbids, are the last one again.
    const bool has_next = pass->subpass_index + 1 < pass->render_pass->subpass_count;
    if (!has_next) {
        vulkan_log("a render pass has %u subpasses, and one more is begun", pass->render_pass->subpass_count);
    }
    pass->subpass_index += has_next ? 1 : 0;
    pass->subpass = &pass->render_pass->subpasses[pass->subpass_index];
    pass->splits = begin->has_barrier;
    pass->has_drawn = false;
    pass->view_index = first_view(pass->subpass->view_mask);
    pass->begin = (struct vulkan_replay_place){command, replay->chunk};
    replay->bound_before = replay->bound;
    begin_view(replay);
}

static bool has_attachments(const struct vulkan_subpass *subpass)
{
    bool has = subpass->depth != VK_ATTACHMENT_UNUSED;
    for (uint32_t i = 0; i < subpass->color_count; i++) {
        has = has || subpass->colors[i] != VK_ATTACHMENT_UNUSED;
    }
    return has;
}

static void replay_end_subpass(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    (void)command;
    struct vulkan_pass_state *const pass = &replay->pass;
    if (!pass->render_pass) {
        vulkan_log("a render pass is ended that has not begun");
        return;
    }
    if (!pass->has_drawn && has_attachments(pass->subpass)) {
        vulkan_pass_open(replay, 0); // what is cleared or resolved
    }
    vulkan_pass_close(replay);
    const uint32_t left = pass->subpass->view_mask & (uint32_t)(~UINT64_C(0) << (pass->view_index + 1));
    if (left) {
        pass->view_index = first_view(left);
        pass->has_drawn = false;
        replay->bound = replay->bound_before;
        replay->resume = pass->begin;
        begin_view(replay);
    }
}

static void replay_end_pass(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    (void)command;
    replay->pass.render_pass = NULL;
    replay->pass.view_index = 0;
}

// Recording -------------------------------------------------------------------------------------------

void vulkan_pass_note_barrier(VkCommandBuffer buffer, bool has_barrier)
{
    if (buffer->subpass) {
        buffer->subpass->has_barrier = buffer->subpass->has_barrier || has_barrier;
    } else if (buffer->continues_pass) {
        buffer->has_barrier = buffer->has_barrier || has_barrier;
    }
}

void vulkan_record_begin_subpass(VkCommandBuffer buffer)
{
    buffer->subpass = vulkan_record(buffer, sizeof *buffer->subpass, replay_begin_subpass);
}

void vulkan_record_end_subpass(VkCommandBuffer buffer)
{
    vulkan_record(buffer, sizeof(struct vulkan_command), replay_end_subpass);
    buffer->subpass = NULL;
}

void vulkan_record_end_pass(VkCommandBuffer buffer)
{
    vulkan_record_end_subpass(buffer);
    vulkan_record(buffer, sizeof(struct vulkan_command), replay_end_pass);
}

void *vulkan_record_begin_pass(VkCommandBuffer buffer, const struct vulkan_pass_begin *begin, size_t more)
{
    const size_t count = begin->attachment_count;
    const size_t each = sizeof(VkImageView) + sizeof(VkClearValue) + sizeof(uint32_t);
    const size_t own = (sizeof(struct begin_pass) + count * each + 15) / 16 * 16;
    struct begin_pass *const command = vulkan_record(buffer, own + more, replay_begin_pass);
    if (!command) {
        return NULL;
    }
    command->render_pass = begin->render_pass;
    command->area = begin->area;
    command->width = begin->width;
    command->height = begin->height;
    command->layers = begin->layers;
    command->attachment_count = begin->attachment_count;
    VkImageView *const views = (VkImageView *)(command + 1);
    VkClearValue *const clears = (VkClearValue *)(void *)(views + count);
    command->views = views;
    command->clears = clears;
    command->loaded = (uint32_t *)(void *)(clears + count);
    for (uint32_t i = 0; i < begin->view_count && i < count; i++) {
        views[i] = begin->views[i];
    }
    for (uint32_t i = 0; i < begin->clear_count && i < count; i++) {
        clears[i] = begin->clears[i];
    }
    unsigned char *const behind = (unsigned char *)command + own;
    if (!begin->render_pass) {
        command->render_pass = (VkRenderPass)(void *)behind;
    }
    return behind;
}

VKAPI_ATTR void VKAPI_CALL vkCmdBeginRenderPass(VkCommandBuffer buffer, const VkRenderPassBeginInfo *info,
                                                VkSubpassContents contents)
{
    (void)contents;
    const VkFramebuffer framebuffer = info->framebuffer;
    const VkDeviceGroupRenderPassBeginInfo *const group =
        vulkan_chain_find(info->pNext, VK_STRUCTURE_TYPE_DEVICE_GROUP_RENDER_PASS_BEGIN_INFO);
    struct vulkan_pass_begin begin = {
        .render_pass = info->renderPass,
        .area = group && group->deviceRenderAreaCount > 0 ? group->pDeviceRenderAreas[0] : info->renderArea,
        .width = framebuffer->width,
        .height = framebuffer->height,
        .layers = framebuffer->layers,
        .attachment_count = info->renderPass->attachment_count,
        .view_count = framebuffer->attachment_count,
        .views = framebuffer->attachments,
        .clear_count = info->clearValueCount,
        .clears = info->pClearValues,
    };
    const VkRenderPassAttachmentBeginInfo *const attachments =
        vulkan_chain_find(info->pNext, VK_STRUCTURE_TYPE_RENDER_PASS_ATTACHMENT_BEGIN_INFO);
    if (framebuffer->is_imageless && attachments) {
        begin.view_count = attachments->attachmentCount;
        begin.views = attachments->pAttachments;
    }
    if (vulkan_record_begin_pass(buffer, &begin, 0)) {
        vulkan_record_begin_subpass(buffer);
    }
}

VKAPI_ATTR void VKAPI_CALL vkCmdBeginRenderPass2(VkCommandBuffer buffer, const VkRenderPassBeginInfo *info,
                                                 const VkSubpassBeginInfo *subpass)
{
    vkCmdBeginRenderPass(buffer, info, subpass->contents);
}

VKAPI_ATTR void VKAPI_CALL vkCmdNextSubpass(VkCommandBuffer buffer, VkSubpassContents contents)
{
    (void)contents;
    vulkan_record_end_subpass(buffer);
    vulkan_record_begin_subpass(buffer);
}

VKAPI_ATTR void VKAPI_CALL vkCmdNextSubpass2(VkCommandBuffer buffer, const VkSubpassBeginInfo *begin,
                                             const VkSubpassEndInfo *end)
{
    (void)end;
    vkCmdNextSubpass(buffer, begin->contents);
}

VKAPI_ATTR void VKAPI_CALL vkCmdEndRenderPass(VkCommandBuffer buffer)
{
    vulkan_record_end_pass(buffer);
}

VKAPI_ATTR void VKAPI_CALL vkCmdEndRenderPass2(VkCommandBuffer buffer, const VkSubpassEndInfo *end)
{
    (void)end;
    vulkan_record_end_pass(buffer);
}
