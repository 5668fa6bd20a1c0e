// SPDX-License-Identifier: MIT
// Views of textures, and where texels lie in memory.
#ifndef RHW_VIEW_H
#define RHW_VIEW_H

#include "types.h"

/// What a channel of a view reads.
enum rhw_swizzle {
    RHW_SWIZZLE_IDENTITY, ///< the channel of that place
    RHW_SWIZZLE_ZERO,
    RHW_SWIZZLE_ONE,
    RHW_SWIZZLE_RED,
    RHW_SWIZZLE_GREEN,
    RHW_SWIZZLE_BLUE,
    RHW_SWIZZLE_ALPHA
};

/// Names a part of a texture's texels as a texture of its own (VkImageViewCreateInfo; Vulkan 1.3, "Image Views").
struct rhw_texture_view_def {
    rhw_texture texture; ///< or a view; to be set
    /// NONE: the texture's own. Else one with texels of the same size, both of colour; of depth with stencil also the format
    /// of one of both, as D32_FLOAT and S8_UINT; of stencil R8_UINT, as which shaders read it (VK_IMAGE_ASPECT_STENCIL_BIT).
    /// Of a compressed format one whose blocks are decoded in the same way.
    enum rhw_format format;
    /// 1D of 1D textures; 2D and CUBE of 2D textures and cubes, which are then square and have six layers for each; 3D of 3D
    /// textures, and 2D of their slices, of one level
    enum rhw_texture_kind kind;
    int level, levels; ///< the first, and how many; 0: all from there on; of slices: one
    int layer;         ///< the first; 6 × cube + face; slice of a 3D texture
    int layers;        ///< as in rhw_texture_def: 0: no array; an array's layers, 1.., of CUBE its cubes
    /// What shaders read; attachments have none, and what is read, written and copied outside of shaders ignores it.
    enum rhw_swizzle swizzle[4];
    const char *label; ///< for messages
};

/// Creates a view, which is used wherever a texture is: sampled, drawn into, written, read and copied. Texture and views
/// share their texels. A pass may draw into some levels and layers of them, write others as storage images and read
/// others again, each by a view that has those alone; a level and layer that it draws into or writes, other than
/// read_only, it does not read, by any name (Vulkan 1.3 §8.9, WebGPU's usage scopes). Copies and reads ask about
/// textures as a whole: none of them is read or written while the pass being recorded draws into one, and none written
/// while it samples one. Either is destroyed before the other; the texels stay until all are.
RHW_API enum rhw_result rhw_texture_view_create(rhw_context *context, const struct rhw_texture_view_def *def,
                                                rhw_texture *view);

enum { RHW_MAX_MIP_LEVELS = 15 }; ///< 16384 down to 1

/// Where a level of a texture lies, in bytes. Layers and slices of a 3D texture stand slice_pitch apart.
struct rhw_level_layout {
    size_t offset, row_pitch, slice_pitch;
    size_t stencil_offset, stencil_row_pitch,
        stencil_slice_pitch; ///< of a plane of stencil beside depth; else 0
};

/// What a texture takes (vkGetImageMemoryRequirements, vkGetImageSubresourceLayout).
struct rhw_texture_layout {
    size_t size;      ///< bytes of memory, RHW_MEMORY_PADDING included; SIZE_MAX: more than addresses reach
    size_t alignment; ///< RHW_MEMORY_ALIGNMENT
    int levels;
    struct rhw_level_layout level[RHW_MAX_MIP_LEVELS];
    size_t sample_stride; ///< from the texels and stencil of one sample to those of the next
};

/// Tells how the texels of a texture with this definition are laid out; `memory` and `memory_size` of it do not matter.
/// Compressed formats: as they are decoded.
RHW_API enum rhw_result rhw_texture_query_layout(rhw_context *context, const struct rhw_texture_def *def,
                                                 struct rhw_texture_layout *layout);

#endif
