// SPDX-License-Identifier: MIT
#include "pass_fit.h"

#include "resource/format.h"

// The views that are attached so far: each colour, what it is resolved into, and those of depth.
struct attached {
    VkImageView views[2 * RHW_MAX_COLOR_ATTACHMENTS + 2];
    int count;
};

static bool share(const struct VkImageView_T *a, const struct VkImageView_T *b)
{
    const VkImageSubresourceRange *const one = &a->range, *const other = &b->range;
    return a->image->bytes == b->image->bytes && one->baseMipLevel == other->baseMipLevel &&
           one->baseArrayLayer < other->baseArrayLayer + other->layerCount &&
           other->baseArrayLayer < one->baseArrayLayer + one->layerCount;
}

static int least(uint32_t a, int b)
{
    return a < (uint32_t)b ? (int)a : b;
}

// Attach a view of so many samples, by which the pass becomes no larger than the view. Return false if it cannot be
// attached beside the earlier ones.
static bool attach(const struct vulkan_pass_state *pass, VkImageView view, uint32_t samples,
                   struct attached *attached, struct rhw_pass_def *def, int *layers)
{
    if (view->image->samples != samples || view->range.layerCount <= pass->view_index) {
        vulkan_log("an attachment is left out: it has %u samples and %u layers", view->image->samples,
                   view->range.layerCount);
        return false;
    }
    for (int i = 0; i < attached->count; i++) {
        if (share(attached->views[i], view)) {
            vulkan_log("an attachment is left out: another one has the same texels");
            return false;
        }
    }
    attached->views[attached->count++] = view;
    const VkExtent3D extent = vulkan_image_extent(view->image, view->range.baseMipLevel);
    if (extent.width < (uint32_t)def->width || extent.height < (uint32_t)def->height) {
        vulkan_log("a pass of %d x %d is cut to an attachment of %u x %u", def->width, def->height,
                   extent.width, extent.height);
    }
    def->width = least(extent.width, def->width);
    def->height = least(extent.height, def->height);
    *layers = least(view->range.layerCount - pass->view_index, *layers);
    return true;
}

static bool resolves(uint32_t samples, bool is_format_equal)
{
    if (samples == 1 || !is_format_equal) {
        vulkan_log("an attachment of %u samples is not resolved: %s", samples,
                   samples == 1 ? "it has one" : "the other one has another format");
        return false;
    }
    return true;
}

static void attach_color(const struct vulkan_pass_state *pass, uint32_t i, struct attached *attached,
                         struct rhw_pass_def *def, int *layers)
{
    struct rhw_color_attachment *const color = &def->colors[i];
    const struct vulkan_subpass *const subpass = pass->subpass;
    if (color->texture.context == 0) {
        return;
    }
    const VkImageView view = pass->views[subpass->colors[i]];
    // One sample is loaded for all of them, as librhw has it.
    const uint32_t samples = view->image->samples == 1 ? 1 : pass->samples;
    if (!attach(pass, view, samples, attached, def, layers)) {
        *color = (struct rhw_color_attachment){.load = RHW_LOAD_DEFAULT};
        return;
    }
    if (color->resolve.context != 0) {
        const VkImageView resolve = pass->views[subpass->resolves[i]];
        if (!resolves(samples, resolve->format == view->format) ||
            !attach(pass, resolve, 1, attached, def, layers)) {
            color->resolve = (rhw_texture){0};
        }
    }
}

static bool has_depth(VkImageView view)
{
    const bool has = vulkan_format_aspects(view->image->vulkan_format) != VK_IMAGE_ASPECT_COLOR_BIT;
    if (!has) {
        vulkan_log("an attachment of depth is left out: it has colours");
    }
    return has;
}

static void attach_depth(const struct vulkan_pass_state *pass, struct attached *attached,
                         struct rhw_pass_def *def, int *layers)
{
    struct rhw_depth_attachment *const depth = &def->depth;
    if (!depth->enabled) {
        return;
    }
    const VkImageView view = pass->views[pass->subpass->depth];
    const uint32_t samples = view->image->samples == 1 ? 1 : pass->samples;
    if (!has_depth(view) || !attach(pass, view, samples, attached, def, layers)) {
        *depth = (struct rhw_depth_attachment){.enabled = false};
        return;
    }
    if (depth->resolve.context != 0) {
        const VkImageView resolve = pass->views[pass->subpass->depth_resolve];
        if (!resolves(samples, true) || !attach(pass, resolve, 1, attached, def, layers)) {
            depth->resolve = (rhw_texture){0};
            depth->resolve_mode = depth->stencil_resolve_mode = RHW_RESOLVE_DEFAULT;
        }
    }
}

// Let the render area lie within the pass. Return false if it is empty.
static bool fit_area(struct rhw_pass_def *def)
{
    struct rhw_rect *const area = &def->render_area;
    const int64_t right = (int64_t)area->x + area->width, bottom = (int64_t)area->y + area->height;
    area->x = area->x > 0 ? area->x : 0;
    area->y = area->y > 0 ? area->y : 0;
    area->width = (int)((right < def->width ? right : def->width) - area->x);
    area->height = (int)((bottom < def->height ? bottom : def->height) - area->y);
    return area->width > 0 && area->height > 0;
}

bool vulkan_pass_fit(const struct vulkan_pass_state *pass, struct rhw_pass_def *def)
{
    struct attached attached = {.count = 0};
    int layers = pass->subpass->view_mask ? 1 : least(pass->layers, RHW_MAX_TEXTURE_LAYERS);
    def->width = least(pass->width, RHW_MAX_TARGET_SIZE);
    def->height = least(pass->height, RHW_MAX_TARGET_SIZE);
    def->color_count = 0;
    for (uint32_t i = 0; i < pass->subpass->color_count; i++) {
        attach_color(pass, i, &attached, def, &layers);
        if (def->colors[i].texture.context != 0) {
            def->color_count = (int)i + 1; // attachments left out at the end do not count
        }
    }
    attach_depth(pass, &attached, def, &layers);
    for (int i = 0; i < def->color_count; i++) {
        def->colors[i].layer_count = layers;
    }
    def->depth.layer_count = layers;
    def->layers = def->color_count > 0 || def->depth.enabled ? 0 : layers;
    const bool has_area = layers > 0 && fit_area(def);
    if (!has_area) {
        vulkan_log("a render pass without a pixel is left out");
    }
    return has_area;
}
