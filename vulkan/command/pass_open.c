// SPDX-License-Identifier: MIT
// From a subpass to a pass of librhw. What is not loaded is cleared to 0, so that pictures are the same everywhere.
#include "clear_value.h"
#include "pass_fit.h"
#include "query.h"
#include "replay.h"
#include "resource/format.h"

static enum rhw_resolve resolve_mode(VkResolveModeFlagBits mode)
{
    switch (mode) {
    case VK_RESOLVE_MODE_SAMPLE_ZERO_BIT: return RHW_RESOLVE_SAMPLE_ZERO;
    case VK_RESOLVE_MODE_AVERAGE_BIT: return RHW_RESOLVE_AVERAGE;
    case VK_RESOLVE_MODE_MIN_BIT: return RHW_RESOLVE_MIN;
    case VK_RESOLVE_MODE_MAX_BIT: return RHW_RESOLVE_MAX;
    default: return RHW_RESOLVE_NONE;
    }
}

// Return the texture of an attachment, or the null id for VK_ATTACHMENT_UNUSED.
static rhw_texture texture_of(struct vulkan_replay *replay, uint32_t attachment)
{
    rhw_texture texture = {0};
    if (attachment != VK_ATTACHMENT_UNUSED && replay->pass.views[attachment]) {
        const VkResult result =
            vulkan_image_view_target(replay->queue, replay->pass.views[attachment], &texture);
        replay->result = result != VK_SUCCESS ? result : replay->result;
    }
    return texture;
}

static bool is_loaded(const struct vulkan_pass_state *pass, uint32_t attachment)
{
    return pass->loaded[attachment] >> pass->view_index & 1;
}

static enum rhw_load load_of(const struct vulkan_pass_state *pass, uint32_t attachment,
                             VkAttachmentLoadOp load)
{
    const bool clears = load == VK_ATTACHMENT_LOAD_OP_CLEAR || load == VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    return clears && !is_loaded(pass, attachment) ? RHW_LOAD_CLEAR : RHW_LOAD_LOAD;
}

static enum rhw_store store_of(const struct vulkan_pass_state *pass, uint32_t attachment,
                               VkAttachmentStoreOp store)
{
    const bool is_last =
        pass->render_pass->attachments[attachment].last_subpass == pass->subpass_index && !pass->splits;
    return is_last && store == VK_ATTACHMENT_STORE_OP_DONT_CARE ? RHW_STORE_DISCARD : RHW_STORE_STORE;
}

static void set_color(struct vulkan_replay *replay, uint32_t i, struct rhw_color_attachment *color)
{
    const struct vulkan_pass_state *const pass = &replay->pass;
    const uint32_t number = pass->subpass->colors[i];
    color->texture = texture_of(replay, number);
    if (color->texture.context == 0) {
        return;
    }
    const struct vulkan_attachment *const attachment = &pass->render_pass->attachments[number];
    color->resolve = texture_of(replay, pass->subpass->resolves[i]);
    color->load = load_of(pass, number, attachment->load);
    color->store = store_of(pass, number, attachment->store);
    color->layer = (int)pass->view_index;
    if (attachment->load == VK_ATTACHMENT_LOAD_OP_CLEAR) {
        vulkan_clear_color(pass->views[number]->format, &pass->clears[number].color, color->clear,
                           color->clear_integer);
    }
}

static bool is_depth_read_only(VkImageLayout layout)
{
    return layout == VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL ||
           layout == VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_STENCIL_ATTACHMENT_OPTIMAL ||
           layout == VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL || layout == VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL;
}

static bool is_stencil_read_only(VkImageLayout layout)
{
    return layout == VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL ||
           layout == VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_STENCIL_READ_ONLY_OPTIMAL ||
           layout == VK_IMAGE_LAYOUT_STENCIL_READ_ONLY_OPTIMAL || layout == VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL;
}

VkImageAspectFlags vulkan_pass_depth_aspects(const struct vulkan_pass_state *pass)
{
    const struct vulkan_subpass *const subpass = pass->subpass;
    const VkImageView view = subpass->depth != VK_ATTACHMENT_UNUSED ? pass->views[subpass->depth] : NULL;
    VkImageAspectFlags written = VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
    written &= is_depth_read_only(subpass->depth_layout) ? ~(unsigned)VK_IMAGE_ASPECT_DEPTH_BIT : ~0u;
    written &= is_stencil_read_only(subpass->stencil_layout) ? ~(unsigned)VK_IMAGE_ASPECT_STENCIL_BIT : ~0u;
    return view ? written & vulkan_format_aspects(view->image->vulkan_format) : 0;
}

// What is read only is neither cleared nor thrown away.
static void set_read_only(struct vulkan_replay *replay, struct rhw_depth_attachment *depth)
{
    const struct vulkan_subpass *const subpass = replay->pass.subpass;
    const VkImageAspectFlags aspects =
        vulkan_format_aspects(replay->pass.views[subpass->depth]->image->vulkan_format);
    if (is_depth_read_only(subpass->depth_layout) && aspects & VK_IMAGE_ASPECT_DEPTH_BIT) {
        depth->read_only = depth->load != RHW_LOAD_CLEAR;
        depth->store = depth->read_only ? RHW_STORE_STORE : depth->store;
    }
    if (is_stencil_read_only(subpass->stencil_layout) && aspects & VK_IMAGE_ASPECT_STENCIL_BIT) {
        depth->stencil_read_only = depth->stencil_load != RHW_LOAD_CLEAR;
        depth->stencil_store = depth->stencil_read_only ? RHW_STORE_STORE : depth->stencil_store;
    }
}

// An aspect that the attachment to resolve into does not have is not resolved.
static void set_resolve(const struct vulkan_pass_state *pass, struct rhw_depth_attachment *depth)
{
    const struct vulkan_subpass *const subpass = pass->subpass;
    const VkImageAspectFlags aspects =
        vulkan_format_aspects(pass->views[subpass->depth_resolve]->image->vulkan_format);
    depth->resolve_mode =
        aspects & VK_IMAGE_ASPECT_DEPTH_BIT ? resolve_mode(subpass->depth_resolve_mode) : RHW_RESOLVE_NONE;
    depth->stencil_resolve_mode = aspects & VK_IMAGE_ASPECT_STENCIL_BIT
                                      ? resolve_mode(subpass->stencil_resolve_mode)
                                      : RHW_RESOLVE_NONE;
}

static void set_depth(struct vulkan_replay *replay, struct rhw_depth_attachment *depth)
{
    const struct vulkan_pass_state *const pass = &replay->pass;
    const struct vulkan_subpass *const subpass = pass->subpass;
    depth->texture = texture_of(replay, subpass->depth);
    if (depth->texture.context == 0) {
        return;
    }
    const struct vulkan_attachment *const attachment = &pass->render_pass->attachments[subpass->depth];
    depth->enabled = true;
    depth->load = load_of(pass, subpass->depth, attachment->load);
    depth->store = store_of(pass, subpass->depth, attachment->store);
    depth->stencil_load = load_of(pass, subpass->depth, attachment->stencil_load);
    depth->stencil_store = store_of(pass, subpass->depth, attachment->stencil_store);
    depth->layer = (int)pass->view_index;
    if (attachment->load == VK_ATTACHMENT_LOAD_OP_CLEAR) {
        depth->clear = vulkan_clear_depth(pass->clears[subpass->depth].depthStencil.depth);
    }
    if (attachment->stencil_load == VK_ATTACHMENT_LOAD_OP_CLEAR) {
        depth->stencil_clear = (uint8_t)pass->clears[subpass->depth].depthStencil.stencil;
    }
    set_read_only(replay, depth);
    depth->resolve = texture_of(replay, subpass->depth_resolve);
    if (depth->resolve.context != 0) {
        set_resolve(pass, depth);
    }
}

static void note_loaded(struct vulkan_pass_state *pass, uint32_t attachment)
{
    if (attachment != VK_ATTACHMENT_UNUSED) {
        pass->loaded[attachment] |= 1u << pass->view_index;
    }
}

// Remember that the attachments of the subpass hold something from now on.
static void note_all_loaded(struct vulkan_pass_state *pass)
{
    const struct vulkan_subpass *const subpass = pass->subpass;
    for (uint32_t i = 0; i < subpass->color_count; i++) {
        note_loaded(pass, subpass->colors[i]);
        note_loaded(pass, subpass->resolves[i]);
    }
    note_loaded(pass, subpass->depth);
    note_loaded(pass, subpass->depth_resolve);
}

// Describe the pass of librhw. Return false if there is nothing to draw into.
static bool define(struct vulkan_replay *replay, struct rhw_pass_def *def)
{
    const struct vulkan_pass_state *const pass = &replay->pass;
    *def = (struct rhw_pass_def){
        .samples = (int)pass->samples,
        .render_area = {pass->area.offset.x, pass->area.offset.y, (int)pass->area.extent.width,
                        (int)pass->area.extent.height},
    };
    for (uint32_t i = 0; i < pass->subpass->color_count; i++) {
        set_color(replay, i, &def->colors[i]);
    }
    set_depth(replay, &def->depth);
    return replay->result == VK_SUCCESS && vulkan_pass_fit(pass, def);
}

// Return what pipelines draw into.
static struct vulkan_targets targets_of(const struct vulkan_pass_state *pass, const struct rhw_pass_def *def)
{
    struct vulkan_targets targets = {.count = def->color_count};
    for (int i = 0; i < def->color_count; i++) {
        const bool is_there = def->colors[i].texture.context != 0;
        targets.formats[i] = is_there ? pass->views[pass->subpass->colors[i]]->format : RHW_FORMAT_NONE;
    }
    if (def->depth.enabled) {
        const VkImageAspectFlags aspects =
            vulkan_format_aspects(pass->views[pass->subpass->depth]->image->vulkan_format);
        targets.has_depth = aspects & VK_IMAGE_ASPECT_DEPTH_BIT;
        targets.has_stencil = aspects & VK_IMAGE_ASPECT_STENCIL_BIT;
        targets.keeps_depth = def->depth.read_only;
        targets.keeps_stencil = def->depth.stencil_read_only;
    }
    return targets;
}

bool vulkan_pass_open(struct vulkan_replay *replay, uint32_t samples)
{
    struct vulkan_pass_state *const pass = &replay->pass;
    if (pass->is_open || !pass->render_pass || replay->result != VK_SUCCESS) {
        return pass->is_open;
    }
    const uint32_t own = pass->subpass->samples;
    pass->samples = own != 0 ? own : samples != 0 ? samples : 1;
    struct rhw_pass_def def;
    if (!define(replay, &def)) {
        return false;
    }
    pass->is_open =
        vulkan_replay_check(replay, rhw_pass_begin(replay->context, &def, &pass->pass), "render pass");
    if (pass->is_open) {
        pass->targets = targets_of(pass, &def);
        pass->drawn = def.render_area;
        pass->drawn_layers = def.depth.layer_count;
        note_all_loaded(pass);
        pass->has_drawn = true;
        replay->bound.is_told = false;
        vulkan_query_resume(replay);
    }
    return pass->is_open;
}

void vulkan_pass_close(struct vulkan_replay *replay)
{
    struct vulkan_pass_state *const pass = &replay->pass;
    if (!pass->is_open) {
        return;
    }
    vulkan_feedback_suspend(replay);
    vulkan_query_suspend(replay);
    pass->is_open = false;
    vulkan_replay_check(replay, rhw_pass_end(replay->context, pass->pass, NULL), "render pass");
    vulkan_query_collect(replay);
    vulkan_replay_release(replay);
}
