// SPDX-License-Identifier: MIT
// These functions move texels and bytes without drawing. They write, read, copy, clear, scale and resolve regions of
// textures, and fill, copy and map buffers. Each function does its work during the call, on the caller's thread. A
// program may call them while a pass is recorded. Draws of that pass keep the texels and bytes that they were recorded
// with (rhw_buffer_write); a texture that the pass draws into is refused until the pass has ended. The rules are those
// of Vulkan 1.3, chapters "Copy Commands" and "Clear Commands". Functions that return enum rhw_result return RHW_OK,
// RHW_ERROR_OUT_OF_MEMORY or RHW_ERROR_MISUSE.
#ifndef RHW_TRANSFER_H
#define RHW_TRANSFER_H

#include "pass_def.h"

/// The part of a format's texels that a function works on.
enum rhw_aspect {
    RHW_ASPECT_DEFAULT, ///< colour or depth; stencil if the format has nothing else
    RHW_ASPECT_STENCIL  ///< the plane of stencil, one byte per texel
};

/// A box of texels in one level. A zeroed region is the whole of level 0.
struct rhw_texture_region {
    int level;
    int x, y;          ///< first texel
    int z;             ///< first slice of a 3D texture, or first layer of another texture, 6 × cube + face
    int width, height; ///< texels; 0 goes up to the end of the level
    int depth;         ///< number of slices or layers; 0 takes all from `z` on
    enum rhw_aspect aspect;
    int sample; ///< sample that is written or read of a multisampled texture; 0 elsewhere
};

/// The place of texels in a buffer (VkBufferImageCopy). Row r of slice s of a region begins at byte offset + (s ·
/// image_height + r) · row_length · bytes of a texel. No alignment is asked. If a program copies blocks into a
/// compressed texture, rows and bytes are rows and bytes of blocks, and both lengths are multiples of a block's size.
struct rhw_texel_layout {
    size_t offset;    ///< bytes to the first texel
    int row_length;   ///< texels, at least the region's width; 0 means the region's width
    int image_height; ///< rows, at least the region's height; 0 means the region's height
};

/// Replace the texels of a region by `data`, in the texture's format. Rows are `row_pitch` bytes apart; 0 means tightly
/// packed. Slices or layers are `slice_pitch` bytes apart; 0 means one behind the other. If the format is compressed,
/// `data` holds whole blocks: x and y are multiples of a block's size; width and height are multiples too, or end with
/// the level, whose last blocks may reach beyond it (Vulkan 1.3, vkCmdCopyBufferToImage). A `region` of NULL is the
/// whole of level 0.
RHW_API enum rhw_result rhw_texture_write_region(rhw_context *context, rhw_texture texture,
                                                 const struct rhw_texture_region *region, const void *data,
                                                 size_t row_pitch, size_t slice_pitch);
/// Copy the texels of a region to `data`, in the memory layout of rhw_texture_write_region. If the format is
/// compressed, the texels are in rhw_format_decoded, which the blocks were decoded to.
RHW_API enum rhw_result rhw_texture_read_region(rhw_context *context, rhw_texture texture,
                                                const struct rhw_texture_region *region, void *data,
                                                size_t row_pitch, size_t slice_pitch);

/// Replace the texels of a region by texels in a buffer. A `layout` of NULL means texels from byte 0 on, tightly
/// packed. The buffer must hold all texels of the region. The rules for blocks of rhw_texture_write_region hold.
RHW_API enum rhw_result rhw_texture_copy_from_buffer(rhw_context *context, rhw_texture texture,
                                                     const struct rhw_texture_region *region,
                                                     rhw_buffer buffer,
                                                     const struct rhw_texel_layout *layout);
/// Copy the texels of a region to a buffer, as rhw_texture_read_region copies them to memory. A `layout` of NULL means
/// texels from byte 0 on, tightly packed. The buffer must have room for all texels of the region.
RHW_API enum rhw_result rhw_texture_copy_to_buffer(rhw_context *context, rhw_texture texture,
                                                   const struct rhw_texture_region *region, rhw_buffer buffer,
                                                   const struct rhw_texel_layout *layout);

/// Copy a region to the place that `to` begins at. The sizes of `to` are 0 or equal to the sizes of `from`. Texels are
/// copied bit for bit. Two colour formats must have texels of one size; other formats must be equal. Layers may become
/// slices, and slices may become layers. Both textures must have the same number of samples; all samples are copied. It
/// is misuse if the regions overlap in one texture.
RHW_API enum rhw_result rhw_texture_copy(rhw_context *context, rhw_texture from_texture,
                                         const struct rhw_texture_region *from, rhw_texture to_texture,
                                         const struct rhw_texture_region *to);

/// The value that texels are cleared to. A texture takes the members that its format has.
struct rhw_clear_value {
    float color[4];           ///< linear values of formats that are no integers; 0 for integer formats
    int32_t color_integer[4]; ///< values of integer formats, which take the low bits; 0 for other formats
    float depth;              ///< 0..1
    uint8_t stencil;
};

/// Set all samples of all texels of a region to one value. A `region` of NULL is all levels and layers, depth and
/// stencil. Compressed formats are misuse.
RHW_API enum rhw_result rhw_texture_clear(rhw_context *context, rhw_texture texture,
                                          const struct rhw_texture_region *region,
                                          const struct rhw_clear_value *value);

/// The box that rhw_texture_blit reads or writes, from the corner x0, y0, z0 up to the corner x1, y1, z1. Corners lie
/// between texels. If the second coordinate is less than the first one, the box is mirrored on that axis. If both are
/// 0, the box is the whole level on that axis.
struct rhw_blit_region {
    int level;
    int x0, y0, z0; ///< first corner; z counts slices of a 3D texture, or layers of another texture
    int x1, y1, z1; ///< second corner
    enum rhw_aspect aspect;
};

/// Scale a region of a texture to the size of a region of another texture, and write it there. The image is mirrored on
/// an axis if exactly one of the two regions is (Vulkan 1.3, "Image Copies With Scaling"). Values of one format become
/// values of the other format; sRGB values are converted by way of linear light. A UINT format goes only to UINT
/// formats and a SINT format only to SINT formats, which take the nearest value that they hold. Slices of a 3D texture
/// are scaled as columns and rows are; layers become as many layers or slices. A linear filter repeats the texels at
/// the edge of the region. Integers, depth and stencil take RHW_FILTER_NEAREST. Depth and stencil formats must be
/// equal. Textures must have one sample. It is misuse if the regions overlap in one texture.
RHW_API enum rhw_result rhw_texture_blit(rhw_context *context, rhw_texture from_texture,
                                         const struct rhw_blit_region *from, rhw_texture to_texture,
                                         const struct rhw_blit_region *to, enum rhw_filter filter);

/// Make one texel of the samples of each texel, as a pass does when it stores. The formats must be equal, and
/// `to_texture` must have one sample. The sizes of `to` are 0 or equal to the sizes of `from`.
RHW_API enum rhw_result rhw_texture_resolve(rhw_context *context, rhw_texture from_texture,
                                            const struct rhw_texture_region *from, rhw_texture to_texture,
                                            const struct rhw_texture_region *to, enum rhw_resolve mode);

// Buffers --------------------------------------------------------------------------------------------

/// Fill `size` bytes at `offset` with a little-endian word of 32 bits. Both must be multiples of 4. A size of 0 fills
/// as many whole words as there are up to the end of the buffer (vkCmdFillBuffer, VK_WHOLE_SIZE).
RHW_API enum rhw_result rhw_buffer_fill(rhw_context *context, rhw_buffer buffer, size_t offset, size_t size,
                                        uint32_t word);

/// Copy `size` bytes from one buffer to another, or within one buffer. It is misuse if the ranges overlap in one
/// buffer.
RHW_API enum rhw_result rhw_buffer_copy(rhw_context *context, rhw_buffer from, size_t from_offset,
                                        rhw_buffer to, size_t to_offset, size_t size);

/// What a program does with the bytes of a mapped buffer.
enum rhw_map_access { RHW_MAP_READ_WRITE, RHW_MAP_READ };

/// Set `*data` to the address of `size` bytes at `offset`. A size of 0 maps all bytes up to the end of the buffer. The
/// address is valid until rhw_buffer_unmap or rhw_buffer_destroy. A buffer can be mapped once at a time. On failure
/// `*data` is NULL.
///
/// The call refuses bytes that the pass being recorded uses, and passes refuse bytes that are mapped. Both accept bytes
/// that the pass and the program only read. Passes may use other bytes of the buffer. Functions that write to buffers
/// refuse a mapped buffer.
RHW_API enum rhw_result rhw_buffer_map(rhw_context *context, rhw_buffer buffer, size_t offset, size_t size,
                                       enum rhw_map_access access, void **data);

/// End the mapping of a buffer.
RHW_API void rhw_buffer_unmap(rhw_context *context, rhw_buffer buffer);

#endif
