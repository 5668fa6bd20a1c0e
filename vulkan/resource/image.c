// SPDX-License-Identifier: MIT
#include "image.h"

#include "device/formats.h"
#include "src/driver.h"
#include "format.h"
#include "image_twin.h"
#include "memory.h"

static uint32_t at_level(uint32_t size, uint32_t level)
{
    const uint32_t smaller = size >> level;
    return smaller > 1 ? smaller : 1;
}

VkExtent3D vulkan_image_extent(VkImage image, uint32_t level)
{
    return (VkExtent3D){at_level(image->extent.width, level), at_level(image->extent.height, level),
                        at_level(image->extent.depth, level)};
}

uint32_t vulkan_image_slices(VkImage image, uint32_t level)
{
    return image->type == VK_IMAGE_TYPE_3D ? at_level(image->extent.depth, level) : image->layers;
}

size_t vulkan_image_blocks(VkImage image, uint32_t level)
{
    size_t bytes = 0;
    for (uint32_t i = 0; i < level; i++) {
        bytes += vulkan_image_block_slice(image, i) * vulkan_image_slices(image, i);
    }
    return bytes;
}

size_t vulkan_image_block_row(VkImage image, uint32_t level)
{
    const uint32_t width = (uint32_t)rhw_format_block_width(image->format);
    const uint32_t columns = (at_level(image->extent.width, level) + width - 1) / width;
    return columns * rhw_format_block_bytes(image->format);
}

size_t vulkan_image_block_slice(VkImage image, uint32_t level)
{
    const uint32_t height = (uint32_t)rhw_format_block_height(image->format);
    const uint32_t rows = (at_level(image->extent.height, level) + height - 1) / height;
    return rows * vulkan_image_block_row(image, level);
}

static enum rhw_texture_kind kind_of(VkImageType type)
{
    return type == VK_IMAGE_TYPE_1D   ? RHW_TEXTURE_1D
           : type == VK_IMAGE_TYPE_3D ? RHW_TEXTURE_3D
                                      : RHW_TEXTURE_2D;
}

void vulkan_image_forget(VkQueue queue, VkImage image)
{
    if (image->memory && image->memory->has_aliases && image->texture.context != 0) {
        for (uint32_t level = 0; level < image->levels; level++) {
            rhw_texture_changed(queue->context, image->texture, (int)level, 0, 0);
        }
    }
}

// What the program maps is written at any time, and what another image shares by its commands. Nobody else writes
// without a command of this image.
static bool is_told(VkImage image)
{
    return image->tiling == VK_IMAGE_TILING_OPTIMAL && !(image->flags & VK_IMAGE_CREATE_ALIAS_BIT);
}

struct rhw_texture_def vulkan_image_definition(VkImage image)
{
    return (struct rhw_texture_def){
        .kind = kind_of(image->type),
        .format = image->format,
        .width = (int)image->extent.width,
        .height = (int)image->extent.height,
        .depth = (int)image->extent.depth,
        .layers = image->layers > 1 ? (int)image->layers : 0,
        .mip_levels = (int)image->levels,
        .samples = (int)image->samples,
        .memory = image->bytes ? image->bytes + image->texels : NULL,
        .memory_size = image->bytes ? image->layout.size : 0,
        .memory_is_told = image->bytes && is_told(image),
    };
}

// Set the sizes that follow from the definition. Return false if librhw has no such texture.
static bool lay_out(VkImage image)
{
    const struct rhw_texture_def def = vulkan_image_definition(image);
    rhw_driver_texture_layout(&def, &image->layout);
    const bool is_compressed = vulkan_format_is_compressed(image->vulkan_format);
    const size_t blocks = is_compressed ? vulkan_image_blocks(image, image->levels) : 0;
    image->texels =
        (blocks + VULKAN_MEMORY_ALIGNMENT - 1) / VULKAN_MEMORY_ALIGNMENT * VULKAN_MEMORY_ALIGNMENT;
    image->size = (VkDeviceSize)image->texels + image->layout.size;
    // The sampler numbers texels of all but plain 2D textures with 31 bits.
    const bool is_plain = image->type == VK_IMAGE_TYPE_2D && image->layers == 1;
    const uint64_t texels = image->layout.size / rhw_format_size(rhw_format_decoded(image->format));
    return is_plain || texels * (image->levels > 1 ? 2 : 1) <= INT32_MAX;
}

static bool is_within_limits(const VkImageCreateInfo *info)
{
    const VkPhysicalDeviceImageFormatInfo2 format = {.format = info->format,
                                                     .type = info->imageType,
                                                     .tiling = info->tiling,
                                                     .usage = info->usage,
                                                     .flags = info->flags};
    const VkExtent3D *const extent = &info->extent;
    const uint32_t flat = extent->width > extent->height ? extent->width : extent->height;
    const uint32_t most = flat > extent->depth ? flat : extent->depth;
    VkImageFormatProperties limits;
    return vulkan_image_properties(&format, &limits) == VK_SUCCESS &&
           extent->width - 1 < limits.maxExtent.width && extent->height - 1 < limits.maxExtent.height &&
           extent->depth - 1 < limits.maxExtent.depth && info->mipLevels - 1 < limits.maxMipLevels &&
           most >> (info->mipLevels - 1) > 0 && info->arrayLayers - 1 < limits.maxArrayLayers &&
           info->samples & limits.sampleCounts;
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateImage(VkDevice device, const VkImageCreateInfo *info,
                                             const VkAllocationCallbacks *callbacks, VkImage *image)
{
    *image = VK_NULL_HANDLE;
    const enum rhw_format format = vulkan_format(info->format);
    if (format == RHW_FORMAT_NONE) {
        return VK_ERROR_FORMAT_NOT_SUPPORTED;
    }
    const VkImage made = vulkan_device_allocate(device, callbacks, sizeof *made);
    if (!made) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    *made = (struct VkImage_T){
        .flags = info->flags,
        .type = info->imageType,
        .vulkan_format = info->format,
        .format = format,
        .extent = info->extent,
        .levels = info->mipLevels,
        .layers = info->arrayLayers,
        .samples = (uint32_t)info->samples,
        .tiling = info->tiling,
        .usage = info->usage,
    };
    if (!is_within_limits(info) || !lay_out(made)) {
        vulkan_device_free(device, callbacks, made);
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    *image = made;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkDestroyImage(VkDevice device, VkImage image,
                                          const VkAllocationCallbacks *callbacks)
{
    if (image) {
        vulkan_retire_texture(&device->queue, image->texture);
        vulkan_image_drop_twin(&device->queue, image);
        vulkan_device_free(device, callbacks, image);
    }
}

VKAPI_ATTR void VKAPI_CALL vkGetImageMemoryRequirements(VkDevice device, VkImage image,
                                                        VkMemoryRequirements *requirements)
{
    (void)device;
    *requirements = (VkMemoryRequirements){
        .size = image->size, .alignment = VULKAN_MEMORY_ALIGNMENT, .memoryTypeBits = 1};
}

VKAPI_ATTR void VKAPI_CALL vkGetImageMemoryRequirements2(VkDevice device,
                                                         const VkImageMemoryRequirementsInfo2 *info,
                                                         VkMemoryRequirements2 *requirements)
{
    vkGetImageMemoryRequirements(device, info->image, &requirements->memoryRequirements);
    for (VkBaseOutStructure *one = requirements->pNext; one; one = one->pNext) {
        if (one->sType == VK_STRUCTURE_TYPE_MEMORY_DEDICATED_REQUIREMENTS) {
            VkMemoryDedicatedRequirements *const dedicated = (VkMemoryDedicatedRequirements *)one;
            dedicated->prefersDedicatedAllocation = VK_FALSE;
            dedicated->requiresDedicatedAllocation = VK_FALSE;
        }
    }
}

VKAPI_ATTR VkResult VKAPI_CALL vkBindImageMemory(VkDevice device, VkImage image, VkDeviceMemory memory,
                                                 VkDeviceSize offset)
{
    (void)device;
    if (offset > memory->size || image->size > memory->size - offset) {
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    image->bytes = memory->bytes + offset;
    image->memory = memory;
    vulkan_memory_note_image(memory, offset, image->size);
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL vkBindImageMemory2(VkDevice device, uint32_t count,
                                                  const VkBindImageMemoryInfo *infos)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; i < count && result == VK_SUCCESS; i++) {
        result = vkBindImageMemory(device, infos[i].image, infos[i].memory, infos[i].memoryOffset);
    }
    return result;
}

VKAPI_ATTR void VKAPI_CALL vkGetImageSubresourceLayout(VkDevice device, VkImage image,
                                                       const VkImageSubresource *part,
                                                       VkSubresourceLayout *layout)
{
    (void)device;
    const struct rhw_level_layout *const level = &image->layout.level[part->mipLevel];
    const bool is_stencil = part->aspectMask == VK_IMAGE_ASPECT_STENCIL_BIT && level->stencil_row_pitch != 0;
    const size_t row = is_stencil ? level->stencil_row_pitch : level->row_pitch;
    const size_t slice = is_stencil ? level->stencil_slice_pitch : level->slice_pitch;
    const size_t first = is_stencil ? level->stencil_offset : level->offset;
    const bool is_3d = image->type == VK_IMAGE_TYPE_3D;
    *layout = (VkSubresourceLayout){
        .offset = image->texels + first + (is_3d ? 0 : part->arrayLayer * slice),
        .size = is_3d ? slice * vulkan_image_extent(image, part->mipLevel).depth : slice,
        .rowPitch = row,
        .arrayPitch = slice,
        .depthPitch = slice,
    };
}

VkResult vulkan_image_texture(VkQueue queue, VkImage image, rhw_texture *texture)
{
    if (image->texture.context == 0) {
        const struct rhw_texture_def def = vulkan_image_definition(image);
        if (rhw_texture_create(queue->context, &def, &image->texture) != RHW_OK) {
            *texture = (rhw_texture){0};
            return VK_ERROR_DEVICE_LOST;
        }
    }
    *texture = image->texture;
    return VK_SUCCESS;
}

// No image is sparse.

VKAPI_ATTR void VKAPI_CALL vkGetImageSparseMemoryRequirements(VkDevice device, VkImage image, uint32_t *count,
                                                              VkSparseImageMemoryRequirements *requirements)
{
    (void)device;
    (void)image;
    (void)requirements;
    *count = 0;
}

VKAPI_ATTR void VKAPI_CALL
vkGetImageSparseMemoryRequirements2(VkDevice device, const VkImageSparseMemoryRequirementsInfo2 *info,
                                    uint32_t *count, VkSparseImageMemoryRequirements2 *requirements)
{
    (void)device;
    (void)info;
    (void)requirements;
    *count = 0;
}
