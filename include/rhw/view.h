// SPDX-License-Identifier: MIT
// A view names a part of a texture's texels as a texture of its own. A layout tells where the texels lie in memory.
#ifndef RHW_VIEW_H
#define RHW_VIEW_H

#include "types.h"

/// The source of one channel that a shader reads through a view.
enum rhw_swizzle {
    RHW_SWIZZLE_IDENTITY, ///< the texture's channel with the same number
    RHW_SWIZZLE_ZERO,
    RHW_SWIZZLE_ONE,
    RHW_SWIZZLE_RED,
    RHW_SWIZZLE_GREEN,
    RHW_SWIZZLE_BLUE,
    RHW_SWIZZLE_ALPHA
};

/// The part of a texture that a view names (VkImageViewCreateInfo; Vulkan 1.3, "Image Views").
struct rhw_texture_view_def {
    rhw_texture texture; ///< a texture or a view; required
    /// The format that the view reads the texels in. RHW_FORMAT_NONE takes the format of the texture. Another format
    /// must have texels of the same size. A view of colour takes a colour format. A view of depth with stencil takes
    /// the format of depth alone or of stencil alone, as D32_FLOAT and S8_UINT. A view of stencil takes R8_UINT too, in
    /// which shaders read stencil (VK_IMAGE_ASPECT_STENCIL_BIT). A view of a compressed format takes a format whose
    /// blocks are decoded in the same way.
    enum rhw_format format;
    /// The kind of the view. A 1D texture has 1D views. A 2D texture and a cube have 2D and CUBE views; a CUBE view
    /// must be square and takes six layers for each cube. A 3D texture has 3D views, and 2D views of its slices in one
    /// level.
    enum rhw_texture_kind kind;
    int level;  ///< first level
    int levels; ///< number of levels; 0 takes all from `level` on, and one level for a view of slices
    int layer;  ///< first layer, 6 × cube + face, or first slice of a 3D texture
    /// The number of layers, as in struct rhw_texture_def. 0 makes a view that is no array. 1 or more makes an array
    /// with so many layers, or so many cubes for CUBE.
    int layers;
    /// Shaders read the channels through the swizzle. An attachment must not have one. Reads, writes and copies outside
    /// of shaders ignore it.
    enum rhw_swizzle swizzle[4];
    const char *label; ///< name in messages, or NULL
};

/// Create a view of a texture, or of another view. A program uses the view wherever it uses a texture: it samples it,
/// draws into it, writes, reads and copies it. A texture and its views share their texels. The program may destroy the
/// texture and the views in any order; the texels stay until all of them are destroyed.
///
/// A pass may draw into some levels and layers of a texture, write others as storage images, and read yet others, each
/// through a view that has those levels and layers alone. A pass must not read a level and layer that it draws into or
/// writes, through any view, unless the attachment is read_only (Vulkan 1.3 §8.9; WebGPU, usage scopes). Copies and
/// reads outside of the pass count the whole texture: while the pass being recorded draws into one view, no view may be
/// read or written; while the pass samples one view, no view may be written.
///
/// Return RHW_OK, RHW_ERROR_OUT_OF_MEMORY or RHW_ERROR_MISUSE. On failure `*view` is the null id.
RHW_API enum rhw_result rhw_texture_view_create(rhw_context *context, const struct rhw_texture_view_def *def,
                                                rhw_texture *view);

enum {
    RHW_MAX_MIP_LEVELS = 15 ///< number of levels from 16384 texels down to 1
};

/// The place of one level of a texture, in bytes. Slices of a 3D texture, or layers, stand slice_pitch apart.
struct rhw_level_layout {
    size_t offset, row_pitch, slice_pitch;
    /// The place of the plane of stencil that stands beside depth. All three are 0 if there is no plane of stencil.
    size_t stencil_offset, stencil_row_pitch, stencil_slice_pitch;
};

/// The memory of a texture (vkGetImageMemoryRequirements, vkGetImageSubresourceLayout).
struct rhw_texture_layout {
    size_t size; ///< bytes of memory with RHW_MEMORY_PADDING; SIZE_MAX if addresses do not reach that far
    size_t alignment; ///< bytes; RHW_MEMORY_ALIGNMENT
    int levels;
    struct rhw_level_layout level[RHW_MAX_MIP_LEVELS];
    size_t sample_stride; ///< bytes from the texels and stencil of one sample to those of the next sample
};

/// Tell how the texels of a texture with this definition are laid out. The members `memory` and `memory_size` of the
/// definition do not matter. The layout of a compressed format is the layout of its decoded texels.
RHW_API enum rhw_result rhw_texture_query_layout(rhw_context *context, const struct rhw_texture_def *def,
                                                 struct rhw_texture_layout *layout);

#endif
