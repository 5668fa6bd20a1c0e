// SPDX-License-Identifier: MIT
// What moves texels and bytes without drawing: regions of textures written, read, copied, cleared, scaled and resolved,
// buffers filled and copied. Everything happens at once, on the caller's call, also while a pass is recorded: its draws keep
// what they were recorded with (rhw_buffer_write), and a texture that the pass draws into is refused until that has ended.
// The rules are those of Vulkan 1.3, chapters "Copy Commands" and "Clear Commands".
#ifndef RHW_TRANSFER_H
#define RHW_TRANSFER_H

#include "pass_def.h"

/// What of a format's texels is meant.
enum rhw_aspect {
    RHW_ASPECT_DEFAULT, ///< colour or depth; stencil of a format that has nothing else
    RHW_ASPECT_STENCIL  ///< the plane of stencil, a byte per texel
};

/// A box of texels of a level. All zero: level 0, whole.
struct rhw_texture_region {
    int level;
    int x, y, z; ///< its first texel; z: slice of a 3D texture, layer of others, 6 × cube + face
    int width, height, depth; ///< 0: up to the end of the level; depth counts slices or layers
    enum rhw_aspect aspect;
    int sample; ///< of a multisampled texture, where one sample is written or read; elsewhere 0
};

/// Where texels stand in a buffer (VkBufferImageCopy): row r of slice s of a region begins at offset +
/// (s · image_height + r) · row_length · bytes of a texel. No alignment is asked.
/// Where blocks are copied into a texture: rows and bytes of blocks, and both lengths are multiples of a block's.
struct rhw_texel_layout {
    size_t offset;    ///< bytes
    int row_length;   ///< texels, at least the region's width; 0: that
    int image_height; ///< rows, at least the region's height; 0: that
};

/// Replaces the texels of a region: rows `row_pitch` bytes apart (0: tightly packed), slices or layers `slice_pitch` (0:
/// one behind the other), in the texture's format. Of a compressed format they are of whole blocks: x and y are multiples of a block's size, width
/// and height are too or end with the level, whose last blocks may reach out of it (Vulkan 1.3, vkCmdCopyBufferToImage).
/// `region` may be NULL: level 0, whole.
RHW_API enum rhw_result rhw_texture_write_region(rhw_context *context, rhw_texture texture,
                                                 const struct rhw_texture_region *region, const void *data,
                                                 size_t row_pitch, size_t slice_pitch);
/// Copies a region out, in the same layout; of a compressed format the texels that its blocks were decoded to.
RHW_API enum rhw_result rhw_texture_read_region(rhw_context *context, rhw_texture texture,
                                                const struct rhw_texture_region *region, void *data,
                                                size_t row_pitch, size_t slice_pitch);
/// The same from and to a buffer. `layout` may be NULL: from byte 0, tightly packed. Both must hold all of the region.
RHW_API enum rhw_result rhw_texture_copy_from_buffer(rhw_context *context, rhw_texture texture,
                                                     const struct rhw_texture_region *region,
                                                     rhw_buffer buffer,
                                                     const struct rhw_texel_layout *layout);
RHW_API enum rhw_result rhw_texture_copy_to_buffer(rhw_context *context, rhw_texture texture,
                                                   const struct rhw_texture_region *region, rhw_buffer buffer,
                                                   const struct rhw_texel_layout *layout);
/// Copies a region to the place that `to` begins at; its sizes are 0 or those of `from`. Texels are copied bit for bit:
/// colour formats have texels of one size, others are equal. Layers and slices may become each other. Both textures have
/// the same number of samples, which are all copied. Regions that overlap in one texture are misuse.
RHW_API enum rhw_result rhw_texture_copy(rhw_context *context, rhw_texture from_texture,
                                         const struct rhw_texture_region *from, rhw_texture to_texture,
                                         const struct rhw_texture_region *to);

/// What texels are cleared to; of a format what it has of these.
struct rhw_clear_value {
    float color[4];           ///< linear values; 0 for integer formats
    int32_t color_integer[4]; ///< of integer formats, which take the low bits; 0 for others
    float depth;              ///< 0..1
    uint8_t stencil;
};

/// Gives all texels of a region, with all their samples, one value. `region` may be NULL: all levels and layers, depth
/// and stencil. Not of compressed formats.
RHW_API enum rhw_result rhw_texture_clear(rhw_context *context, rhw_texture texture,
                                          const struct rhw_texture_region *region,
                                          const struct rhw_clear_value *value);

/// What rhw_texture_blit reads or writes: from corner x0, y0, z0 up to x1, y1, z1, which lie between texels. Where the
/// second is less than the first, the region is mirrored on that axis. 0 and 0: the whole level, on that axis.
struct rhw_blit_region {
    int level;
    int x0, y0, z0, x1, y1, z1; ///< z: slices of a 3D texture, layers of others
    enum rhw_aspect aspect;
};

/// Fills a region of a texture with one of another, scaled to its size, mirrored where one of both is (Vulkan 1.3, "Image
/// Copies With Scaling"). Texels are converted: values of one format become those of the other, linear light included;
/// UINT only to UINT and SINT to SINT, with the low bits. Slices of a 3D texture are scaled as columns and rows are; layers
/// become as many layers or slices. A linear filter repeats the texels at the edge of the region. Integers, depth and
/// stencil take RHW_FILTER_NEAREST, and of depth and stencil the formats are equal. Textures have one sample. Regions that
/// overlap in one texture are misuse.
RHW_API enum rhw_result rhw_texture_blit(rhw_context *context, rhw_texture from_texture,
                                         const struct rhw_blit_region *from, rhw_texture to_texture,
                                         const struct rhw_blit_region *to, enum rhw_filter filter);

/// Makes one texel of the samples of each, as passes do when they store. Formats are equal; `to_texture` has one sample;
/// the sizes of `to` are 0 or those of `from`.
RHW_API enum rhw_result rhw_texture_resolve(rhw_context *context, rhw_texture from_texture,
                                            const struct rhw_texture_region *from, rhw_texture to_texture,
                                            const struct rhw_texture_region *to, enum rhw_resolve mode);

// Buffers, beside rhw_buffer_write --------------------------------------------------------------------

/// Fills `size` bytes at `offset` with a word of 32 bits, little endian; both are multiples of 4. Size 0: as many whole
/// words as there are up to the end (vkCmdFillBuffer, VK_WHOLE_SIZE).
RHW_API enum rhw_result rhw_buffer_fill(rhw_context *context, rhw_buffer buffer, size_t offset, size_t size,
                                        uint32_t word);
/// Copies `size` bytes. Ranges that overlap in one buffer are misuse.
RHW_API enum rhw_result rhw_buffer_copy(rhw_context *context, rhw_buffer from, size_t from_offset,
                                        rhw_buffer to, size_t to_offset, size_t size);

/// What a program does with the bytes of a mapped buffer.
enum rhw_map_access { RHW_MAP_READ_WRITE, RHW_MAP_READ };

/// Gives the address of `size` bytes at `offset`, 0: up to the end, until rhw_buffer_unmap or rhw_buffer_destroy. Bytes
/// that the pass being recorded uses are refused, and passes refuse bytes that are mapped, but where both only read
/// them; other bytes of the buffer are free to passes. Functions that write to buffers refuse one that is mapped. A
/// buffer is mapped once at a time. On failure `*data` is NULL.
RHW_API enum rhw_result rhw_buffer_map(rhw_context *context, rhw_buffer buffer, size_t offset, size_t size,
                                       enum rhw_map_access access, void **data);
RHW_API void rhw_buffer_unmap(rhw_context *context, rhw_buffer buffer);

#endif
