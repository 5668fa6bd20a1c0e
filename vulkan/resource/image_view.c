// SPDX-License-Identifier: MIT
#include "image_view.h"

#include "format.h"
#include "image_twin.h"

static enum rhw_format view_format(const VkImageViewCreateInfo *info)
{
    const enum rhw_format format = vulkan_format(info->format);
    switch (format) {
    case RHW_FORMAT_D24_UNORM_S8_UINT:
    case RHW_FORMAT_D32_FLOAT_S8_UINT:
    case RHW_FORMAT_S8_UINT: break;
    default: return format;
    }
    if (info->subresourceRange.aspectMask == VK_IMAGE_ASPECT_STENCIL_BIT) {
        return RHW_FORMAT_R8_UINT;
    }
    return format == RHW_FORMAT_D24_UNORM_S8_UINT ? RHW_FORMAT_D24_UNORM : RHW_FORMAT_D32_FLOAT;
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateImageView(VkDevice device, const VkImageViewCreateInfo *info,
                                                 const VkAllocationCallbacks *callbacks, VkImageView *view)
{
    *view = VK_NULL_HANDLE;
    const VkImageView made = vulkan_device_allocate(device, callbacks, sizeof *made);
    if (!made) {
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    made->image = info->image;
    made->type = info->viewType;
    made->vulkan_format = info->format;
    made->format = view_format(info);
    made->components = info->components;
    made->range = info->subresourceRange;
    VkImageSubresourceRange *const range = &made->range;
    if (range->levelCount == VK_REMAINING_MIP_LEVELS) {
        range->levelCount = info->image->levels - range->baseMipLevel;
    }
    if (range->layerCount == VK_REMAINING_ARRAY_LAYERS) {
        const uint32_t slices =
            made->type == VK_IMAGE_VIEW_TYPE_3D ? 1 : vulkan_image_slices(info->image, range->baseMipLevel);
        range->layerCount = slices - range->baseArrayLayer;
    }
    *view = made;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkDestroyImageView(VkDevice device, VkImageView view,
                                              const VkAllocationCallbacks *callbacks)
{
    if (view) {
        vulkan_retire_texture(&device->queue, view->view);
        vulkan_retire_texture(&device->queue, view->target);
        vulkan_device_free(device, callbacks, view);
    }
}

static enum rhw_texture_kind kind_of(VkImageViewType type)
{
    switch (type) {
    case VK_IMAGE_VIEW_TYPE_1D:
    case VK_IMAGE_VIEW_TYPE_1D_ARRAY: return RHW_TEXTURE_1D;
    case VK_IMAGE_VIEW_TYPE_3D: return RHW_TEXTURE_3D;
    case VK_IMAGE_VIEW_TYPE_CUBE:
    case VK_IMAGE_VIEW_TYPE_CUBE_ARRAY: return RHW_TEXTURE_CUBE;
    default: return RHW_TEXTURE_2D;
    }
}

// Return the layers of an array, cubes of an array of cubes, or 0 of what is no array.
static int array_layers(VkImageView view)
{
    switch (view->type) {
    case VK_IMAGE_VIEW_TYPE_1D_ARRAY:
    case VK_IMAGE_VIEW_TYPE_2D_ARRAY: return (int)view->range.layerCount;
    case VK_IMAGE_VIEW_TYPE_CUBE_ARRAY: return (int)view->range.layerCount / 6;
    default: return 0;
    }
}

// Return how many channels a format has, where its blocks are decoded to texels of more channels, and else 4.
static int channels_of(VkFormat format)
{
    switch (format) {
    case VK_FORMAT_BC5_UNORM_BLOCK:
    case VK_FORMAT_BC5_SNORM_BLOCK:
    case VK_FORMAT_EAC_R11G11_UNORM_BLOCK:
    case VK_FORMAT_EAC_R11G11_SNORM_BLOCK: return 2;
    case VK_FORMAT_BC1_RGB_UNORM_BLOCK:
    case VK_FORMAT_BC1_RGB_SRGB_BLOCK:
    case VK_FORMAT_BC6H_UFLOAT_BLOCK:
    case VK_FORMAT_BC6H_SFLOAT_BLOCK:
    case VK_FORMAT_ETC2_R8G8B8_UNORM_BLOCK:
    case VK_FORMAT_ETC2_R8G8B8_SRGB_BLOCK: return 3;
    default: return 4;
    }
}

// Return what a component of a view reads. A channel that the format lacks is 0, or 1 for alpha, in the colour of a
// border too (Vulkan 1.3, "Conversion to RGBA").
static enum rhw_swizzle swizzle_of(VkImageView view, VkComponentSwizzle swizzle, VkComponentSwizzle own)
{
    const VkComponentSwizzle read = swizzle == VK_COMPONENT_SWIZZLE_IDENTITY ? own : swizzle;
    if ((int)read - VK_COMPONENT_SWIZZLE_R >= channels_of(view->vulkan_format)) {
        return read == VK_COMPONENT_SWIZZLE_A ? RHW_SWIZZLE_ONE : RHW_SWIZZLE_ZERO;
    }
    static const enum rhw_swizzle swizzles[] = {
        [VK_COMPONENT_SWIZZLE_IDENTITY] = RHW_SWIZZLE_IDENTITY,
        [VK_COMPONENT_SWIZZLE_ZERO] = RHW_SWIZZLE_ZERO,
        [VK_COMPONENT_SWIZZLE_ONE] = RHW_SWIZZLE_ONE,
        [VK_COMPONENT_SWIZZLE_R] = RHW_SWIZZLE_RED,
        [VK_COMPONENT_SWIZZLE_G] = RHW_SWIZZLE_GREEN,
        [VK_COMPONENT_SWIZZLE_B] = RHW_SWIZZLE_BLUE,
        [VK_COMPONENT_SWIZZLE_A] = RHW_SWIZZLE_ALPHA,
    };
    return (unsigned)swizzle < sizeof swizzles / sizeof *swizzles ? swizzles[swizzle] : RHW_SWIZZLE_IDENTITY;
}

// Make the view for shaders, if it is not there.
static enum rhw_result make_view(VkQueue queue, VkImageView view)
{
    if (view->view.context != 0) {
        return RHW_OK;
    }
    struct rhw_texture_view_def def = {
        .format = view->format,
        .kind = kind_of(view->type),
        .level = (int)view->range.baseMipLevel,
        .levels = (int)view->range.levelCount,
        .layer = (int)view->range.baseArrayLayer,
        .layers = array_layers(view),
        .swizzle = {swizzle_of(view, view->components.r, VK_COMPONENT_SWIZZLE_R),
                    swizzle_of(view, view->components.g, VK_COMPONENT_SWIZZLE_G),
                    swizzle_of(view, view->components.b, VK_COMPONENT_SWIZZLE_B),
                    swizzle_of(view, view->components.a, VK_COMPONENT_SWIZZLE_A)},
    };
    const enum rhw_result result = vulkan_image_texture_as(queue, view->image, view->format, &def.texture);
    return result == RHW_OK ? rhw_texture_view_create(queue->context, &def, &view->view) : result;
}

const struct rhw_binding *vulkan_image_view_texture(VkQueue queue, VkImageView view)
{
    if (!view->has_texture) {
        const rhw_sampler none = {0};
        enum rhw_result result = make_view(queue, view);
        if (result == RHW_OK) {
            result = rhw_binding_of_texture(queue->context, view->view, none, &view->texture);
        }
        view->has_texture = result == RHW_OK || result == RHW_ERROR_MISUSE;
    }
    return view->has_texture ? &view->texture : NULL;
}

const struct rhw_binding *vulkan_image_view_storage(VkQueue queue, VkImageView view)
{
    if (!view->has_storage) {
        enum rhw_result result = make_view(queue, view);
        if (result == RHW_OK) {
            result = rhw_binding_of_image(queue->context, view->view, 0, false, &view->storage);
        }
        view->has_storage = result == RHW_OK || result == RHW_ERROR_MISUSE;
    }
    return view->has_storage ? &view->storage : NULL;
}

// Return the format of an attachment: depth and stencil are drawn together.
static enum rhw_format target_format(VkImageView view)
{
    const bool is_color = vulkan_format_aspects(view->image->vulkan_format) == VK_IMAGE_ASPECT_COLOR_BIT;
    return is_color ? view->format : view->image->format;
}

VkResult vulkan_image_view_target(VkQueue queue, VkImageView view, rhw_texture *target)
{
    const VkImage image = view->image;
    const VkResult result = vulkan_image_texture(queue, image, target);
    const bool is_whole = image->levels == 1 && image->layers == 1 && image->type != VK_IMAGE_TYPE_3D &&
                          target_format(view) == image->format;
    if (result != VK_SUCCESS || is_whole) {
        return result;
    }
    if (view->target.context == 0) {
        const struct rhw_texture_view_def def = {
            .texture = *target,
            .format = target_format(view),
            .kind = image->type == VK_IMAGE_TYPE_1D ? RHW_TEXTURE_1D : RHW_TEXTURE_2D,
            .level = (int)view->range.baseMipLevel,
            .levels = 1,
            .layer = (int)view->range.baseArrayLayer,
            .layers = (int)view->range.layerCount,
        };
        const enum rhw_result made = rhw_texture_view_create(queue->context, &def, &view->target);
        if (made != RHW_OK) {
            *target = (rhw_texture){0};
            return made == RHW_ERROR_MISUSE ? VK_SUCCESS : VK_ERROR_DEVICE_LOST;
        }
    }
    *target = view->target;
    return VK_SUCCESS;
}
