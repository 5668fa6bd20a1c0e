// SPDX-License-Identifier: MIT
#include "image_region.h"

#include "resource/format.h"
#include "resource/image_twin.h"

#include <string.h>

rhw_texture vulkan_replay_texture(struct vulkan_replay *replay, VkImage image)
{
    rhw_texture texture;
    const VkResult result = vulkan_image_texture(replay->queue, image, &texture);
    replay->result = result != VK_SUCCESS ? result : replay->result;
    return texture;
}

struct rhw_texture_region vulkan_region(VkImage image, const VkImageSubresourceLayers *part,
                                        VkImageAspectFlags aspect, VkOffset3D offset, VkExtent3D extent)
{
    const bool is_3d = image->type == VK_IMAGE_TYPE_3D;
    return (struct rhw_texture_region){
        .level = (int)part->mipLevel,
        .x = offset.x,
        .y = offset.y,
        .z = is_3d ? offset.z : (int)part->baseArrayLayer,
        .width = (int)extent.width,
        .height = (int)extent.height,
        .depth = is_3d ? (int)extent.depth : (int)part->layerCount,
        .aspect = aspect == VK_IMAGE_ASPECT_STENCIL_BIT ? RHW_ASPECT_STENCIL : RHW_ASPECT_DEFAULT,
    };
}

// Return whether [first, first + count) lies within [0, size), which is rounded up to whole blocks.
static bool is_in(int32_t first, uint32_t count, uint32_t size, uint32_t block)
{
    const uint64_t whole = ((uint64_t)size + block - 1) / block * block;
    return first >= 0 && (uint64_t)first + count <= whole;
}

bool vulkan_region_is_within(VkImage image, const VkImageSubresourceLayers *part, VkOffset3D offset,
                             VkExtent3D extent)
{
    if (!image->bytes || part->mipLevel >= image->levels) {
        return false;
    }
    const VkExtent3D level = vulkan_image_extent(image, part->mipLevel);
    const uint32_t slices = vulkan_image_slices(image, part->mipLevel);
    const bool is_3d = image->type == VK_IMAGE_TYPE_3D;
    return is_in(offset.x, extent.width, level.width, (uint32_t)rhw_format_block_width(image->format)) &&
           is_in(offset.y, extent.height, level.height, (uint32_t)rhw_format_block_height(image->format)) &&
           (is_3d ? is_in(offset.z, extent.depth, slices, 1)
                  : part->baseArrayLayer <= slices && part->layerCount <= slices - part->baseArrayLayer);
}

bool vulkan_region_is_empty(VkImage image, const VkImageSubresourceLayers *part, VkExtent3D extent,
                            const char *what)
{
    const uint32_t depth = image->type == VK_IMAGE_TYPE_3D ? extent.depth : part->layerCount;
    const bool is_empty = extent.width == 0 || extent.height == 0 || depth == 0;
    if (is_empty) {
        vulkan_log("%s: a region without texels is left out", what);
    }
    return is_empty;
}

struct vulkan_units vulkan_units_of(VkImage image, const VkImageSubresourceLayers *part, VkExtent3D extent)
{
    const uint32_t width = (uint32_t)rhw_format_block_width(image->format);
    const uint32_t height = (uint32_t)rhw_format_block_height(image->format);
    return (struct vulkan_units){
        .width = (extent.width + width - 1) / width,
        .height = (extent.height + height - 1) / height,
        .depth = image->type == VK_IMAGE_TYPE_3D ? extent.depth : part->layerCount,
        .bytes = rhw_format_block_bytes(image->format),
    };
}

struct vulkan_rows vulkan_rows_of(VkImage image, const VkImageSubresourceLayers *part, VkOffset3D offset)
{
    const size_t column = (size_t)offset.x / (size_t)rhw_format_block_width(image->format);
    const size_t row = (size_t)offset.y / (size_t)rhw_format_block_height(image->format);
    const size_t slice = image->type == VK_IMAGE_TYPE_3D ? (size_t)offset.z : part->baseArrayLayer;
    const struct rhw_level_layout *const level = &image->layout.level[part->mipLevel];
    struct vulkan_rows rows = {image->bytes + image->texels + level->offset, level->row_pitch,
                               level->slice_pitch};
    if (vulkan_format_is_compressed(image->vulkan_format)) {
        rows.first = image->bytes + vulkan_image_blocks(image, part->mipLevel);
        rows.row_pitch = vulkan_image_block_row(image, part->mipLevel);
        rows.slice_pitch = vulkan_image_block_slice(image, part->mipLevel);
    }
    rows.first +=
        slice * rows.slice_pitch + row * rows.row_pitch + column * rhw_format_block_bytes(image->format);
    return rows;
}

void vulkan_rows_copy(struct vulkan_rows to, struct vulkan_rows from, struct vulkan_units units)
{
    for (uint32_t z = 0; z < units.depth; z++) {
        for (uint32_t y = 0; y < units.height; y++) {
            memmove(to.first + z * to.slice_pitch + y * to.row_pitch,
                    from.first + z * from.slice_pitch + y * from.row_pitch, units.width * units.bytes);
        }
    }
}

static uint32_t up_to_end(uint32_t size, int32_t first, uint32_t whole)
{
    const uint32_t left = whole - (uint32_t)first;
    return size < left ? size : left;
}

void vulkan_rows_changed(struct vulkan_replay *replay, VkImage image, const VkImageSubresourceLayers *part,
                         VkOffset3D offset, struct vulkan_units units)
{
    const rhw_texture texture = vulkan_replay_texture(replay, image);
    const int first = image->type == VK_IMAGE_TYPE_3D ? offset.z : (int)part->baseArrayLayer;
    if (replay->result != VK_SUCCESS) {
        return;
    }
    if (!vulkan_format_is_compressed(image->vulkan_format)) {
        vulkan_replay_check(
            replay,
            rhw_texture_changed(replay->context, texture, (int)part->mipLevel, first, (int)units.depth),
            "copy");
        return;
    }
    const VkExtent3D level = vulkan_image_extent(image, part->mipLevel);
    const uint32_t width = units.width * (uint32_t)rhw_format_block_width(image->format);
    const uint32_t height = units.height * (uint32_t)rhw_format_block_height(image->format);
    const struct rhw_texture_region region = {
        .level = (int)part->mipLevel,
        .x = offset.x,
        .y = offset.y,
        .z = first,
        .width = (int)up_to_end(width, offset.x, level.width),
        .height = (int)up_to_end(height, offset.y, level.height),
        .depth = (int)units.depth,
    };
    vulkan_replay_check(replay, vulkan_image_decode(replay->queue, image, &region), "copy");
}
