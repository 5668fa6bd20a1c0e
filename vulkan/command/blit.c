// SPDX-License-Identifier: MIT
#include "image_region.h"

struct blit_command {
    struct vulkan_command command;
    VkImage from, to;
    VkImageBlit region;
    enum rhw_filter filter;
};

static struct rhw_blit_region blit_region(VkImage image, const VkImageSubresourceLayers *part,
                                          const VkOffset3D offsets[2])
{
    const bool is_3d = image->type == VK_IMAGE_TYPE_3D, is_1d = image->type == VK_IMAGE_TYPE_1D;
    return (struct rhw_blit_region){
        .level = (int)part->mipLevel,
        .x0 = offsets[0].x,
        .x1 = offsets[1].x,
        .y0 = is_1d ? 0 : offsets[0].y,
        .y1 = is_1d ? 1 : offsets[1].y,
        .z0 = is_3d ? offsets[0].z : (int)part->baseArrayLayer,
        .z1 = is_3d ? offsets[1].z : (int)(part->baseArrayLayer + part->layerCount),
    };
}

static void blit(struct vulkan_replay *replay, const struct blit_command *command, enum rhw_aspect aspect)
{
    const VkImageBlit *const region = &command->region;
    const rhw_texture from = vulkan_replay_texture(replay, command->from);
    const rhw_texture to = vulkan_replay_texture(replay, command->to);
    struct rhw_blit_region source = blit_region(command->from, &region->srcSubresource, region->srcOffsets);
    struct rhw_blit_region target = blit_region(command->to, &region->dstSubresource, region->dstOffsets);
    source.aspect = aspect;
    target.aspect = aspect;
    if (replay->result == VK_SUCCESS) {
        vulkan_replay_check(replay,
                            rhw_texture_blit(replay->context, from, &source, to, &target, command->filter),
                            "vkCmdBlitImage");
    }
}

static void replay_blit(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct blit_command *const one = (const struct blit_command *)command;
    const VkImageAspectFlags aspects = one->region.srcSubresource.aspectMask;
    if (aspects & ~(VkImageAspectFlags)VK_IMAGE_ASPECT_STENCIL_BIT) {
        blit(replay, one, RHW_ASPECT_DEFAULT);
    }
    if (aspects & VK_IMAGE_ASPECT_STENCIL_BIT) {
        blit(replay, one, RHW_ASPECT_STENCIL);
    }
}

VKAPI_ATTR void VKAPI_CALL vkCmdBlitImage(VkCommandBuffer buffer, VkImage from, VkImageLayout from_layout,
                                          VkImage to, VkImageLayout to_layout, uint32_t count,
                                          const VkImageBlit *regions, VkFilter filter)
{
    (void)from_layout;
    (void)to_layout;
    for (uint32_t i = 0; i < count; i++) {
        struct blit_command *const command = vulkan_record(buffer, sizeof *command, replay_blit);
        if (command) {
            command->from = from;
            command->to = to;
            command->region = regions[i];
            command->filter = filter == VK_FILTER_LINEAR ? RHW_FILTER_LINEAR : RHW_FILTER_NEAREST;
        }
    }
}

struct resolve_command {
    struct vulkan_command command;
    VkImage from, to;
    VkImageResolve region;
};

static void replay_resolve(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct resolve_command *const resolve = (const struct resolve_command *)command;
    const VkImageResolve *const region = &resolve->region;
    if (vulkan_region_is_empty(resolve->from, &region->srcSubresource, region->extent, "vkCmdResolveImage")) {
        return;
    }
    const rhw_texture from = vulkan_replay_texture(replay, resolve->from);
    const rhw_texture to = vulkan_replay_texture(replay, resolve->to);
    const struct rhw_texture_region source = vulkan_region(
        resolve->from, &region->srcSubresource, VK_IMAGE_ASPECT_COLOR_BIT, region->srcOffset, region->extent);
    const struct rhw_texture_region target = vulkan_region(
        resolve->to, &region->dstSubresource, VK_IMAGE_ASPECT_COLOR_BIT, region->dstOffset, region->extent);
    if (replay->result == VK_SUCCESS) {
        vulkan_replay_check(
            replay, rhw_texture_resolve(replay->context, from, &source, to, &target, RHW_RESOLVE_DEFAULT),
            "vkCmdResolveImage");
    }
}

VKAPI_ATTR void VKAPI_CALL vkCmdResolveImage(VkCommandBuffer buffer, VkImage from, VkImageLayout from_layout,
                                             VkImage to, VkImageLayout to_layout, uint32_t count,
                                             const VkImageResolve *regions)
{
    (void)from_layout;
    (void)to_layout;
    for (uint32_t i = 0; i < count; i++) {
        struct resolve_command *const command = vulkan_record(buffer, sizeof *command, replay_resolve);
        if (command) {
            command->from = from;
            command->to = to;
            command->region = regions[i];
        }
    }
}
