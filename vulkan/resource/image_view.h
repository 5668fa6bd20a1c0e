// SPDX-License-Identifier: MIT
// A view of an image, and the bindings that descriptors have of it.
#ifndef VULKAN_IMAGE_VIEW_H
#define VULKAN_IMAGE_VIEW_H

#include "image.h"

struct VkImageView_T {
    VkImage image;
    VkImageViewType type;
    VkFormat vulkan_format;
    enum rhw_format format; ///< format that texels are read in; of stencil alone S8_UINT
    VkComponentMapping components;
    VkImageSubresourceRange range; ///< its counts are numbers, never VK_REMAINING_MIP_LEVELS

    // The queue's thread has these.
    rhw_texture view;   ///< view for shaders; null id until a command needs it
    rhw_texture target; ///< view for attachments; null id as long as none needs it, or the image's will do
    struct rhw_binding texture; ///< binding of `view` without a sampler
    struct rhw_binding storage; ///< binding of the first level of `view` as a storage image
    bool has_texture, has_storage;
};

// Return the binding of a view for sampled images, for combined ones by way of rhw_binding_of_pair, and for input
// attachments. It is empty where librhw refuses the view. The queue's thread calls this. Return NULL if memory is lost.
const struct rhw_binding *vulkan_image_view_texture(VkQueue queue, VkImageView view);

// Return the binding of a view for storage images. It is empty where librhw refuses the view. The queue's thread calls
// this. Return NULL if memory is lost.
const struct rhw_binding *vulkan_image_view_storage(VkQueue queue, VkImageView view);

// Set *target to a texture that has the level and the layers, or slices, of the view and no other, for attachments. The
// queue's thread calls this. Where librhw refuses the view, *target is the null id, and the result VK_SUCCESS.
VkResult vulkan_image_view_target(VkQueue queue, VkImageView view, rhw_texture *target);

#endif
