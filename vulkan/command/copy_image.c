// SPDX-License-Identifier: MIT
// Copies between images and buffers. Blocks of compressed images are copied as they are, and decoded where they arrive.
#include "image_region.h"
#include "resource/buffer.h"
#include "resource/format.h"

// Between buffers and images ---------------------------------------------------------------------------

struct buffer_copy {
    struct vulkan_command command;
    VkImage image;
    unsigned char *bytes;
    VkDeviceSize size; // bytes of the buffer
    VkBufferImageCopy region;
};

// Return the rows of texels or blocks in the buffer. Slices that are further apart than numbers reach are as far apart
// as these do.
static struct vulkan_rows buffer_rows(const struct buffer_copy *copy)
{
    const VkBufferImageCopy *const region = &copy->region;
    const VkImage image = copy->image;
    const uint32_t width = (uint32_t)rhw_format_block_width(image->format);
    const uint32_t height = (uint32_t)rhw_format_block_height(image->format);
    const size_t columns = region->bufferRowLength ? region->bufferRowLength : region->imageExtent.width;
    const size_t rows = region->bufferImageHeight ? region->bufferImageHeight : region->imageExtent.height;
    const size_t bytes = vulkan_format_bytes(image->vulkan_format, region->imageSubresource.aspectMask);
    const size_t pitch = (columns + width - 1) / width * bytes, count = (rows + height - 1) / height;
    const bool is_product = pitch == 0 || count <= SIZE_MAX / pitch;
    const bool is_inside = region->bufferOffset < copy->size;
    return (struct vulkan_rows){is_inside ? copy->bytes + region->bufferOffset : NULL, pitch,
                                is_product ? count * pitch : SIZE_MAX};
}

static struct rhw_texture_region image_region(const struct buffer_copy *copy)
{
    const VkBufferImageCopy *const region = &copy->region;
    return vulkan_region(copy->image, &region->imageSubresource, region->imageSubresource.aspectMask,
                         region->imageOffset, region->imageExtent);
}

// Return whether a region has texels and lies within its image and its buffer, so that nothing else is read or written.
static bool is_within(const struct buffer_copy *copy, const char *what)
{
    const VkBufferImageCopy *const region = &copy->region;
    const struct vulkan_rows rows = buffer_rows(copy);
    const struct vulkan_units units =
        vulkan_units_of(copy->image, &region->imageSubresource, region->imageExtent);
    const size_t bytes = vulkan_format_bytes(copy->image->vulkan_format, region->imageSubresource.aspectMask);
    if (vulkan_region_is_empty(copy->image, &region->imageSubresource, region->imageExtent, what)) {
        return false;
    }
    const VkDeviceSize needs =
        (units.depth - 1) * rows.slice_pitch + (units.height - 1) * rows.row_pitch + units.width * bytes;
    // Slices that stand this far apart are no product that goes beyond 64 bits.
    const bool is_near = units.depth <= 1 || rows.slice_pitch <= copy->size;
    const bool is_in_buffer =
        is_near && region->bufferOffset <= copy->size && needs <= copy->size - region->bufferOffset;
    const bool is_in_image = vulkan_region_is_within(copy->image, &region->imageSubresource,
                                                     region->imageOffset, region->imageExtent);
    if (!is_in_buffer || !is_in_image) {
        vulkan_log("%s: a region is left out, which reaches outside of its %s", what,
                   is_in_buffer ? "image" : "buffer");
    }
    return is_in_buffer && is_in_image;
}

static void replay_write(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct buffer_copy *const copy = (const struct buffer_copy *)command;
    if (!is_within(copy, "vkCmdCopyBufferToImage")) {
        return;
    }
    const struct vulkan_rows from = buffer_rows(copy);
    const VkImageSubresourceLayers *const part = &copy->region.imageSubresource;
    if (vulkan_format_is_compressed(copy->image->vulkan_format)) {
        const struct vulkan_units units = vulkan_units_of(copy->image, part, copy->region.imageExtent);
        vulkan_rows_copy(vulkan_rows_of(copy->image, part, copy->region.imageOffset), from, units);
        vulkan_rows_changed(replay, copy->image, part, copy->region.imageOffset, units);
        return;
    }
    const rhw_texture texture = vulkan_replay_texture(replay, copy->image);
    const struct rhw_texture_region region = image_region(copy);
    if (replay->result == VK_SUCCESS) {
        vulkan_replay_check(replay,
                            rhw_texture_write_region(replay->context, texture, &region, from.first,
                                                     from.row_pitch, from.slice_pitch),
                            "vkCmdCopyBufferToImage");
    }
}

static void replay_read(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct buffer_copy *const copy = (const struct buffer_copy *)command;
    if (!is_within(copy, "vkCmdCopyImageToBuffer")) {
        return;
    }
    const struct vulkan_rows to = buffer_rows(copy);
    const VkImageSubresourceLayers *const part = &copy->region.imageSubresource;
    if (vulkan_format_is_compressed(copy->image->vulkan_format)) {
        vulkan_rows_copy(to, vulkan_rows_of(copy->image, part, copy->region.imageOffset),
                         vulkan_units_of(copy->image, part, copy->region.imageExtent));
        return;
    }
    const rhw_texture texture = vulkan_replay_texture(replay, copy->image);
    const struct rhw_texture_region region = image_region(copy);
    if (replay->result == VK_SUCCESS) {
        vulkan_replay_check(replay,
                            rhw_texture_read_region(replay->context, texture, &region, to.first, to.row_pitch,
                                                    to.slice_pitch),
                            "vkCmdCopyImageToBuffer");
    }
}

static void record_buffer_copy(VkCommandBuffer buffer, VkImage image, VkBuffer with,
                               const VkBufferImageCopy *region, vulkan_replay_function *replay)
{
    struct buffer_copy *const command = vulkan_record(buffer, sizeof *command, replay);
    if (command) {
        command->image = image;
        command->bytes = with->bytes;
        command->size = with->bytes ? with->size : 0;
        command->region = *region;
    }
}

VKAPI_ATTR void VKAPI_CALL vkCmdCopyBufferToImage(VkCommandBuffer buffer, VkBuffer from, VkImage to,
                                                  VkImageLayout layout, uint32_t count,
                                                  const VkBufferImageCopy *regions)
{
    (void)layout;
    for (uint32_t i = 0; i < count; i++) {
        record_buffer_copy(buffer, to, from, &regions[i], replay_write);
    }
}

VKAPI_ATTR void VKAPI_CALL vkCmdCopyImageToBuffer(VkCommandBuffer buffer, VkImage from, VkImageLayout layout,
                                                  VkBuffer to, uint32_t count,
                                                  const VkBufferImageCopy *regions)
{
    (void)layout;
    for (uint32_t i = 0; i < count; i++) {
        record_buffer_copy(buffer, from, to, &regions[i], replay_read);
    }
}

// Between images --------------------------------------------------------------------------------------

struct image_copy {
    struct vulkan_command command;
    VkImage from, to;
    VkImageCopy region;
};

// Return the slices of a 3D image, or the layers from the first one of a part on.
static uint32_t slices_from(VkImage image, const VkImageSubresourceLayers *part)
{
    const uint32_t slices = vulkan_image_slices(image, part->mipLevel);
    return image->type == VK_IMAGE_TYPE_3D ? slices : slices - part->baseArrayLayer;
}

// Copy with blocks on one side at least.
static void copy_blocks(struct vulkan_replay *replay, const struct image_copy *copy)
{
    const VkImageCopy *const region = &copy->region;
    const struct vulkan_units units = vulkan_units_of(copy->from, &region->srcSubresource, region->extent);
    // Each block of one side is a texel of the other one, if that is not compressed.
    const VkExtent3D written = {units.width * (uint32_t)rhw_format_block_width(copy->to->format),
                                units.height * (uint32_t)rhw_format_block_height(copy->to->format),
                                copy->to->type == VK_IMAGE_TYPE_3D ? units.depth : 1};
    if (!vulkan_region_is_within(copy->from, &region->srcSubresource, region->srcOffset, region->extent) ||
        !vulkan_region_is_within(copy->to, &region->dstSubresource, region->dstOffset, written) ||
        units.depth > slices_from(copy->to, &region->dstSubresource) ||
        rhw_format_block_bytes(copy->to->format) != units.bytes) {
        vulkan_log("vkCmdCopyImage: a region is left out, which does not fit into both images");
        return;
    }
    vulkan_rows_copy(vulkan_rows_of(copy->to, &region->dstSubresource, region->dstOffset),
                     vulkan_rows_of(copy->from, &region->srcSubresource, region->srcOffset), units);
    vulkan_rows_changed(replay, copy->to, &region->dstSubresource, region->dstOffset, units);
}

static void copy_texels(struct vulkan_replay *replay, const struct image_copy *copy,
                        VkImageAspectFlags aspect)
{
    const VkImageCopy *const region = &copy->region;
    const rhw_texture from = vulkan_replay_texture(replay, copy->from);
    const rhw_texture to = vulkan_replay_texture(replay, copy->to);
    const struct rhw_texture_region source =
        vulkan_region(copy->from, &region->srcSubresource, aspect, region->srcOffset, region->extent);
    struct rhw_texture_region target =
        vulkan_region(copy->to, &region->dstSubresource, aspect, region->dstOffset, region->extent);
    target.depth = source.depth;
    if (replay->result == VK_SUCCESS) {
        vulkan_replay_check(replay, rhw_texture_copy(replay->context, from, &source, to, &target),
                            "vkCmdCopyImage");
    }
}

static void replay_image_copy(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct image_copy *const copy = (const struct image_copy *)command;
    if (vulkan_region_is_empty(copy->from, &copy->region.srcSubresource, copy->region.extent,
                               "vkCmdCopyImage")) {
        return;
    }
    if (vulkan_format_is_compressed(copy->from->vulkan_format) ||
        vulkan_format_is_compressed(copy->to->vulkan_format)) {
        copy_blocks(replay, copy);
        return;
    }
    const VkImageAspectFlags aspects = copy->region.srcSubresource.aspectMask;
    if (aspects & ~(VkImageAspectFlags)VK_IMAGE_ASPECT_STENCIL_BIT) {
        copy_texels(replay, copy, VK_IMAGE_ASPECT_COLOR_BIT);
    }
    if (aspects & VK_IMAGE_ASPECT_STENCIL_BIT && replay->result == VK_SUCCESS) {
        copy_texels(replay, copy, VK_IMAGE_ASPECT_STENCIL_BIT);
    }
}

VKAPI_ATTR void VKAPI_CALL vkCmdCopyImage(VkCommandBuffer buffer, VkImage from, VkImageLayout from_layout,
                                          VkImage to, VkImageLayout to_layout, uint32_t count,
                                          const VkImageCopy *regions)
{
    (void)from_layout;
    (void)to_layout;
    for (uint32_t i = 0; i < count; i++) {
        struct image_copy *const command = vulkan_record(buffer, sizeof *command, replay_image_copy);
        if (command) {
            command->from = from;
            command->to = to;
            command->region = regions[i];
        }
    }
}
