// SPDX-License-Identifier: MIT
// The queue has a list of the images with twins (VkQueue_T.twinned): blocks that are written to one image are those of
// its aliases, too. The program's threads destroy images, so that a lock guards the list.
#include "image_twin.h"

// Return true if two formats read the same blocks, one of them with a sign.
static bool are_twins(enum rhw_format a, enum rhw_format b)
{
    static const enum rhw_format twins[][2] = {{RHW_FORMAT_BC4_UNORM, RHW_FORMAT_BC4_SNORM},
                                               {RHW_FORMAT_BC5_UNORM, RHW_FORMAT_BC5_SNORM},
                                               {RHW_FORMAT_BC6H_UFLOAT, RHW_FORMAT_BC6H_SFLOAT},
                                               {RHW_FORMAT_EAC_R11_UNORM, RHW_FORMAT_EAC_R11_SNORM},
                                               {RHW_FORMAT_EAC_RG11_UNORM, RHW_FORMAT_EAC_RG11_SNORM}};
    bool are = false;
    for (size_t i = 0; i < sizeof twins / sizeof *twins; i++) {
        are = are || (a == twins[i][0] && b == twins[i][1]) || (a == twins[i][1] && b == twins[i][0]);
    }
    return are;
}

static enum rhw_result decode(VkQueue queue, VkImage image, rhw_texture texture,
                              const struct rhw_texture_region *region)
{
    const uint32_t level = (uint32_t)region->level;
    const size_t row = vulkan_image_block_row(image, level), slice = vulkan_image_block_slice(image, level);
    const size_t column = (size_t)(region->x / rhw_format_block_width(image->format));
    const size_t first = vulkan_image_blocks(image, level) + (size_t)region->z * slice +
                         (size_t)(region->y / rhw_format_block_height(image->format)) * row +
                         column * rhw_format_block_bytes(image->format);
    return rhw_texture_write_region(queue->context, texture, region, image->bytes + first, row, slice);
}

// Return true if two images have their blocks in the same bytes. They are one image, or aliases, which are made alike.
static bool share_blocks(const struct VkImage_T *a, const struct VkImage_T *b)
{
    return a->bytes == b->bytes && a->format == b->format && a->extent.width == b->extent.width &&
           a->extent.height == b->extent.height && a->levels == b->levels && a->layers == b->layers;
}

enum rhw_result vulkan_image_decode(VkQueue queue, VkImage image, const struct rhw_texture_region *region)
{
    rhw_texture texture;
    if (vulkan_image_texture(queue, image, &texture) != VK_SUCCESS) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    enum rhw_result result = decode(queue, image, texture, region);
    pthread_mutex_lock(&queue->twins_lock);
    for (VkImage other = queue->twinned; other && result == RHW_OK; other = other->next_twinned) {
        result = share_blocks(image, other) ? decode(queue, image, other->twin, region) : RHW_OK;
    }
    pthread_mutex_unlock(&queue->twins_lock);
    return result;
}

// Make the twin, and decode all blocks to it.
static enum rhw_result make_twin(VkQueue queue, VkImage image, enum rhw_format format)
{
    struct rhw_texture_def def = vulkan_image_definition(image);
    def.format = format;
    def.memory = NULL;
    def.memory_size = 0;
    def.memory_is_told = false;
    enum rhw_result result = rhw_texture_create(queue->context, &def, &image->twin);
    for (uint32_t level = 0; result == RHW_OK && level < image->levels; level++) {
        const VkExtent3D extent = vulkan_image_extent(image, level);
        const struct rhw_texture_region all = {.level = (int)level,
                                               .width = (int)extent.width,
                                               .height = (int)extent.height,
                                               .depth = (int)image->layers};
        result = decode(queue, image, image->twin, &all);
    }
    if (result != RHW_OK && image->twin.context != 0) {
        rhw_texture_destroy(queue->context, image->twin);
        image->twin = (rhw_texture){0};
    } else if (result == RHW_OK) {
        pthread_mutex_lock(&queue->twins_lock);
        image->next_twinned = queue->twinned;
        queue->twinned = image;
        pthread_mutex_unlock(&queue->twins_lock);
    }
    return result;
}

void vulkan_image_drop_twin(VkQueue queue, VkImage image)
{
    if (image->twin.context == 0) {
        return;
    }
    pthread_mutex_lock(&queue->twins_lock);
    VkImage *place = &queue->twinned;
    while (*place != image) {
        place = &(*place)->next_twinned;
    }
    *place = image->next_twinned;
    pthread_mutex_unlock(&queue->twins_lock);
    vulkan_retire_texture(queue, image->twin);
}

enum rhw_result vulkan_image_texture_as(VkQueue queue, VkImage image, enum rhw_format format,
                                        rhw_texture *texture)
{
    if (!are_twins(image->format, format)) {
        return vulkan_image_texture(queue, image, texture) == VK_SUCCESS ? RHW_OK : RHW_ERROR_OUT_OF_MEMORY;
    }
    const enum rhw_result result = image->twin.context == 0 ? make_twin(queue, image, format) : RHW_OK;
    *texture = image->twin;
    return result;
}
