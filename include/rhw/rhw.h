// SPDX-License-Identifier: MIT
// This header declares the functions of the library, by subject. Include it in every program that draws; include
// shader.h too in a file that has shaders.
//
// A context and all that belongs to it may be used by one thread at a time (types.h). A create function returns RHW_OK,
// RHW_ERROR_OUT_OF_MEMORY, RHW_ERROR_UNSUPPORTED, RHW_ERROR_THREAD or RHW_ERROR_MISUSE. It copies the definition. On
// failure it sets the id, or the pointer, to null. A created thing lives until it is destroyed, at the latest until its
// context is destroyed. To destroy the null id does nothing.
#ifndef RHW_RHW_H
#define RHW_RHW_H

#include "bind.h"
#include "dispatch.h"
#include "limits.h"
#include "explain.h"
#include "pass_def.h"
#include "recording.h"
#include "stats.h"
#include "transfer.h"
#include "types.h"
#include "view.h"

// Context -------------------------------------------------------------------------------------------

/// Create a context as rhw_context_create does, for callers in another language. `debug` says whether
/// RHW_VALIDATE_DEFAULT switches validation on.
RHW_API enum rhw_result rhw_context_create_probed(const struct rhw_context_def *def, bool debug,
                                                  rhw_context **context);

/// Create a context and its worker threads. On failure `*context` is NULL. The function is inline because it tells the
/// library whether the calling file is compiled for debugging (RHW_VALIDATE_DEFAULT).
static inline enum rhw_result rhw_context_create(const struct rhw_context_def *def, rhw_context **context)
{
#if defined(NDEBUG) || defined(__OPTIMIZE__)
    const bool debug = false;
#else
    const bool debug = true;
#endif
    return rhw_context_create_probed(def, debug, context);
}

/// Destroy the context and everything in it. `context` may be NULL. It is misuse while a pass is recorded. A child of
/// fork destroys a copy of its own.
RHW_API void rhw_context_destroy(rhw_context *context);

/// Return the number of threads that draw, the calling thread included.
RHW_API int rhw_context_threads(const rhw_context *context);

/// Set a function that decides whether a pass or a dispatch of the context, rhw_texture_generate_mips, or a function
/// that writes or copies texels into a texture goes on. The thread that called the library calls it before each of
/// its tasks, some thousand times a second, and before each of its workgroups. Within a task of a pass, which is a tile
/// or some thousand triangles, it calls it every 10 ms, or before each call of a shader function that takes longer. It
/// calls it every 10 ms while it waits for other threads. If the function returns false, the calls of shader functions
/// and the tasks outside of passes, of a workgroup or a megabyte each, that are under way are the last ones, and the
/// call returns RHW_ERROR_GIVEN_UP. A shader function that takes long asks rhw_work_is_given_up; the loops of
/// translated shaders (spirv.h) do. All that it wrote to then holds unspecified values, the queries of a pass have no
/// result, and rhw_pass_end does not write the stats. rhw_pass_set_texture asks too, where a large texture is bound at
/// first; the end of the pass then says that it was given up. `goes_on` must not call the library with the same
/// context; that is misuse. A `goes_on` of NULL, as at first, lets all go on.
RHW_API void rhw_context_set_goes_on(rhw_context *context, bool (*goes_on)(void *user), void *user);

/// Return the instruction set that the context uses.
RHW_API enum rhw_isa rhw_context_isa(const rhw_context *context);

/// Return the rhw_context_def.isa_limit that stands for `isa`, or RHW_ISA_BEST for RHW_ISA_COUNT.
RHW_API enum rhw_isa_limit rhw_isa_up_to(enum rhw_isa isa);

/// Return "baseline", "avx2" or "avx512". The string is static.
RHW_API const char *rhw_isa_name(enum rhw_isa isa);

/// Return true if this build has kernels for `isa` and this CPU can run them.
RHW_API bool rhw_isa_supported(enum rhw_isa isa);

/// Return the limits of the library. They are the same in every context.
RHW_API struct rhw_limits rhw_limits_get(void);

// Buffers -------------------------------------------------------------------------------------------

RHW_API enum rhw_result rhw_buffer_create(rhw_context *context, const struct rhw_buffer_def *def,
                                          rhw_buffer *buffer);
RHW_API void rhw_buffer_destroy(rhw_context *context, rhw_buffer buffer);

/// Replace `size` bytes at `offset`. Draws that were recorded before still read the old bytes: if the pass being
/// recorded reads some of the bytes, a write after a draw copies what draws read there, or the whole buffer if that is
/// in a slot. If there is no memory for that, it returns RHW_ERROR_OUT_OF_MEMORY and writes nothing. It is misuse to
/// write bytes that the pass being recorded may write, as storage or by transform feedback. It is also misuse to write
/// bytes that the pass reads, if the pass may write other bytes of the buffer. Bytes that the pass does not use may be
/// written. These rules hold for all functions that write to buffers.
RHW_API enum rhw_result rhw_buffer_write(rhw_context *context, rhw_buffer buffer, size_t offset,
                                         const void *data, size_t size);

/// Copy `size` bytes at `offset` to `data`. It is misuse to read bytes that the pass being recorded may write.
RHW_API enum rhw_result rhw_buffer_read(rhw_context *context, rhw_buffer buffer, size_t offset, void *data,
                                        size_t size);

// Textures ------------------------------------------------------------------------------------------

RHW_API enum rhw_result rhw_texture_create(rhw_context *context, const struct rhw_texture_def *def,
                                           rhw_texture *texture);
RHW_API void rhw_texture_destroy(rhw_context *context, rhw_texture texture);

/// Return the width of a level in texels.
RHW_API int rhw_texture_width(const rhw_context *context, rhw_texture texture, int level);

/// Return the height of a level in texels.
RHW_API int rhw_texture_height(const rhw_context *context, rhw_texture texture, int level);

/// Return the number of slices of a level of a 3D texture, or 1 for another kind of texture.
RHW_API int rhw_texture_depth(const rhw_context *context, rhw_texture texture, int level);

/// Return the number of layers, six for each cube, or 1 if the texture is no array.
RHW_API int rhw_texture_layers(const rhw_context *context, rhw_texture texture);
RHW_API int rhw_texture_mip_levels(const rhw_context *context, rhw_texture texture);
RHW_API int rhw_texture_samples(const rhw_context *context, rhw_texture texture);
RHW_API enum rhw_format rhw_texture_format(const rhw_context *context, rhw_texture texture);

/// Replace a whole level. If the texture has layers or slices, replace the first one of the level. `data` has rows from
/// top to bottom, `row_pitch` bytes apart; 0 means tightly packed. Texels are in the texture's format. Rows of a
/// compressed format are rows of whole blocks, also if the level ends within a block. Draws that were recorded before
/// still see the old texels. It is misuse while the texture, or a view of it, is an attachment of the pass being
/// recorded.
RHW_API enum rhw_result rhw_texture_write(rhw_context *context, rhw_texture texture, int level,
                                          const void *data, size_t row_pitch);

/// Copy a level to `data`, in the memory layout of rhw_texture_write. If the format is compressed, the texels are in
/// rhw_format_decoded, which the blocks were decoded to; the library does not keep the blocks. It is misuse while the
/// texture, or a view of it, is an attachment of the pass being recorded.
RHW_API enum rhw_result rhw_texture_read(rhw_context *context, rhw_texture texture, int level, void *data,
                                         size_t row_pitch);

/// Replace one layer or one slice of a level, as rhw_texture_write does. `layer` is 6 × cube + face for a cube. A level
/// of a 3D texture has rhw_texture_depth slices.
RHW_API enum rhw_result rhw_texture_write_layer(rhw_context *context, rhw_texture texture, int level,
                                                int layer, const void *data, size_t row_pitch);

/// Copy one layer or one slice of a level to `data`, as rhw_texture_read does. `layer` is 6 × cube + face for a cube.
RHW_API enum rhw_result rhw_texture_read_layer(rhw_context *context, rhw_texture texture, int level,
                                               int layer, void *data, size_t row_pitch);

/// Copy one sample, 0..samples − 1, of every texel of a multisampled texture to `data`, in the memory layout of
/// rhw_texture_write.
RHW_API enum rhw_result rhw_texture_read_sample(rhw_context *context, rhw_texture texture, int sample,
                                                void *data, size_t row_pitch);

/// Replace the plane of stencil of a level. `data` has one byte per texel. The format must have stencil.
/// rhw_texture_write_region writes layers, samples and parts of a level.
RHW_API enum rhw_result rhw_texture_write_stencil(rhw_context *context, rhw_texture texture, int level,
                                                  const uint8_t *data, size_t row_pitch);

/// Copy the plane of stencil of a level to `data`, one byte per texel. The format must have stencil.
/// rhw_texture_read_region reads layers, samples and parts of a level.
RHW_API enum rhw_result rhw_texture_read_stencil(rhw_context *context, rhw_texture texture, int level,
                                                 uint8_t *data, size_t row_pitch);

/// Fill the levels from 1 on, in all layers, from level 0. A box filter averages in linear light; it weighs odd sizes
/// exactly, and averages 2×2×2 texels of a 3D texture. If there is no memory for that, the function returns
/// RHW_ERROR_OUT_OF_MEMORY and the levels stay as they are; RHW_ERROR_GIVEN_UP says that the program gave it up
/// (rhw_context_set_goes_on). It is misuse for a compressed format: write its levels.
RHW_API enum rhw_result rhw_texture_generate_mips(rhw_context *context, rhw_texture texture);

/// Tell that something else than this texture's own passes and functions has written to the program's memory that the
/// texture stands on: to `layer_count` layers, or slices of a 3D texture, of a level, from `layer` on. A count of 0
/// takes all from `layer` on. What another texture on the same memory writes counts too; what a view of this texture
/// writes does not. The next pass that uses the texture sees the new texels. With rhw_texture_def.memory_is_told every
/// write must be told before that pass; without it there is no need. It is misuse for a texture on memory of the
/// library, and while the pass being recorded samples the texture or draws into it.
RHW_API enum rhw_result rhw_texture_changed(rhw_context *context, rhw_texture texture, int level, int layer,
                                            int layer_count);

/// Set `position` to the place of a sample in its pixel, 0..1 from the top left (Vulkan 1.3 §27.5,
/// standardSampleLocations). `samples` is 1, 2, 4, 8 or 16. Return false, and set the pixel's centre, for other
/// numbers.
RHW_API bool rhw_sample_position(int samples, int sample, float position[2]);

// Samplers ------------------------------------------------------------------------------------------

RHW_API enum rhw_result rhw_sampler_create(rhw_context *context, const struct rhw_sampler_def *def,
                                           rhw_sampler *sampler);
RHW_API void rhw_sampler_destroy(rhw_context *context, rhw_sampler sampler);

// Pipelines -----------------------------------------------------------------------------------------

/// What the compiler's flags can do to the arithmetic of a file that has shaders.
enum rhw_arithmetic_flaw {
    /// The compiler rounds a * b + c once, because -ffp-contract=off is missing.
    RHW_ARITHMETIC_FUSED = 1,
    /// The compiler turns (a + b) - a into b, because of -ffast-math or a part of it; or it adds in a wider type.
    RHW_ARITHMETIC_REORDERED = 2
};

/// Return the or-ed rhw_arithmetic_flaw of the file that includes this header, or 0 if its floats are those of the
/// library. The preprocessor cannot see contraction, so the function computes values that show it.
static inline uint32_t rhw_arithmetic_flaws(void)
{
    volatile float one = 1; // the compiler does not know this value
    const float a = 1 + one / 4096, b = one * 16777216;
    // The product is 2^-24 if it is fused. If not, it is 0, or 2^-23 where rounding is upwards.
    const float product = a * a - (1 + one / 2048);
    // The sum is 0, 2 or 4, depending on the rounding mode.
    const float sum = (b + 1.25f) - b;
    uint32_t flaws = 0;
    if (product > 0 && product < 1.0f / 8388608) {
        flaws |= RHW_ARITHMETIC_FUSED;
    }
    if (sum > 1 && sum < 2) {
        flaws |= RHW_ARITHMETIC_REORDERED;
    }
    return flaws;
}

/// Create a pipeline as rhw_pipeline_create does, for callers in another language. `flaws` is the value of
/// rhw_arithmetic_flaws where the shader functions were compiled, or 0 if no C compiler compiled them.
RHW_API enum rhw_result rhw_pipeline_create_probed(rhw_context *context, const struct rhw_pipeline_def *def,
                                                   uint32_t flaws, rhw_pipeline *pipeline);

/// Create a pipeline. The function is inline because it tests the compiler flags of the calling file: it is misuse if
/// the flags would make shaders draw other bytes on another machine. The function sees only the flags of the file that
/// calls it. Give files that only have shaders the same flags, as the CMake and pkg-config packages do.
static inline enum rhw_result rhw_pipeline_create(rhw_context *context, const struct rhw_pipeline_def *def,
                                                  rhw_pipeline *pipeline)
{
    return rhw_pipeline_create_probed(context, def, rhw_arithmetic_flaws(), pipeline);
}

RHW_API void rhw_pipeline_destroy(rhw_context *context, rhw_pipeline pipeline);

// Passes --------------------------------------------------------------------------------------------
// A program records draws between the begin and the end of a pass; rhw_pass_end runs them. A context has one pass at a
// time. A draw sees what its buffers and textures hold when it is recorded. A program may write them, and may create or
// destroy anything, before the pass has ended. A thing that is destroyed while it is set stays set.

/// Begin a pass. The attachments stay as they are until the pass ends. On failure `*pass` is the null id, with one
/// exception: while a pass is recorded, or another call is under way, the function leaves `*pass` alone, because
/// `*pass` may hold the id that ends the first pass.
RHW_API enum rhw_result rhw_pass_begin(rhw_context *context, const struct rhw_pass_def *def, rhw_pass *pass);

// The state of a pass ------------------------------------------------------------------------------
// State lasts until it is set again. Draws and a change of pipeline keep it. A call that is misuse leaves the state as
// it is.

/// Set the pipeline. The pipeline's targets must have the formats of the attachments, in order.
RHW_API void rhw_pass_set_pipeline(rhw_context *context, rhw_pass pass, rhw_pipeline pipeline);

/// Set a vertex buffer. `slot` is 0..RHW_MAX_VERTEX_BUFFERS − 1. `offset` is the number of bytes to element 0. A null
/// buffer is misuse: a slot that no attribute reads need not be unbound.
RHW_API void rhw_pass_set_vertex_buffer(rhw_context *context, rhw_pass pass, int slot, rhw_buffer buffer,
                                        size_t offset);

/// Set the index buffer. `offset` is the number of bytes to index 0.
RHW_API void rhw_pass_set_index_buffer(rhw_context *context, rhw_pass pass, rhw_buffer buffer,
                                       enum rhw_index_type type, size_t offset);

/// Set `size` bytes of a buffer as a vertex buffer; a size of 0 goes up to the end of the buffer. offset + size must
/// lie within the buffer. Draws treat bytes behind the range as outside of the buffer. It is misuse to set bytes that
/// this pass may write, or that are mapped for writing.
RHW_API void rhw_pass_set_vertex_buffer_range(rhw_context *context, rhw_pass pass, int slot,
                                              rhw_buffer buffer, size_t offset, size_t size);

/// Set `size` bytes of a buffer as the index buffer, with the rules of rhw_pass_set_vertex_buffer_range.
RHW_API void rhw_pass_set_index_buffer_range(rhw_context *context, rhw_pass pass, rhw_buffer buffer,
                                             enum rhw_index_type type, size_t offset, size_t size);

/// Copy `size` bytes, at most RHW_MAX_UNIFORM_SIZE, as the uniforms. At a draw there must be at least as many bytes as
/// the program's uniform_size.
RHW_API void rhw_pass_set_uniforms(rhw_context *context, rhw_pass pass, const void *data, size_t size);

// The next three functions take memory of the program in place of a buffer, as client arrays of OpenGL do. Nothing is
// copied: draws read the memory both when they are recorded and while the pass runs, on any thread. It must stay, with
// the bytes that it has at the first draw that reads it, until rhw_pass_end or rhw_pass_cancel has returned. The
// library neither owns the memory nor keeps a record of it, and draws read nothing outside of its `size` bytes. A
// context that validates reports memory that shares bytes with an attachment, with storage that shader functions write,
// or with transform feedback of the pass; others draw unspecified values then. A NULL `memory` has size 0.

/// Set `size` bytes of the program's memory as a vertex buffer, at any address. `slot` is 0..RHW_MAX_VERTEX_BUFFERS −
/// 1. Element 0 is at `memory`. A vertex that does not lie wholly within the `size` bytes reads zeros.
RHW_API void rhw_pass_set_vertex_memory(rhw_context *context, rhw_pass pass, int slot, const void *memory,
                                        size_t size);

/// Set `size` bytes of the program's memory as the index buffer. Index 0 is at `memory`. The address may be any; a
/// context that validates reports one that is no multiple of an index. An index outside of the `size` bytes reads 0.
RHW_API void rhw_pass_set_index_memory(rhw_context *context, rhw_pass pass, const void *memory,
                                       enum rhw_index_type type, size_t size);

/// Set `size` bytes of the program's memory as the uniforms, of which there may be more than RHW_MAX_UNIFORM_SIZE.
/// Shader functions receive the pointer `memory` itself, so its alignment is what their uniforms ask for. At a draw
/// there must be at least as many bytes as the program's uniform_size.
RHW_API void rhw_pass_set_uniform_memory(rhw_context *context, rhw_pass pass, const void *memory,
                                         size_t size);

/// Set a texture and a sampler. A null texture unbinds the slot; a sample of an unbound slot is 0, 0, 0, 1. It is
/// misuse to set a texture with a level and layer of an attachment, or of a storage image, of this pass. Sample a view
/// of other levels or layers instead (view.h), or end the pass and sample in the next pass, which loads the
/// attachments. Depth and stencil that are attached read_only may be sampled too.
RHW_API void rhw_pass_set_texture(rhw_context *context, rhw_pass pass, int slot, rhw_texture texture,
                                  rhw_sampler sampler);

/// Set the bytes from `offset` to offset + size of a buffer as a storage buffer, which shader functions read and write
/// (shader_storage.h). `slot` is 0..RHW_MAX_STORAGE_BUFFERS − 1. `offset` is a multiple of 4. A size of 0 goes up to
/// the end of the buffer. A null buffer unbinds the slot. The buffer holds what the functions write when the pass has
/// ended. It is misuse if this pass also reads the bytes as vertices, as indices or in a read-only slot. Once the bytes
/// are set, they are refused as vertices, indices, read-only storage and commands until the pass ends.
RHW_API void rhw_pass_set_storage_buffer(rhw_context *context, rhw_pass pass, int slot, rhw_buffer buffer,
                                         size_t offset, size_t size);

/// Set a range of a buffer as a storage buffer that shader functions only read (WebGPU, read-only-storage). `slot`,
/// `offset` and `size` are as in rhw_pass_set_storage_buffer. The pass may read the bytes in any other way too. The
/// program may write them between draws, as it may write vertex buffers. Writes and atomics of shader functions do
/// nothing and give 0.
RHW_API void rhw_pass_set_read_only_storage_buffer(rhw_context *context, rhw_pass pass, int slot,
                                                   rhw_buffer buffer, size_t offset, size_t size);

/// Set a level of a texture, with all its layers or slices, as a storage image, which shader functions read and write
/// (shader_storage.h). `slot` is 0..RHW_MAX_STORAGE_IMAGES − 1. The format must be one that can be drawn into as
/// colour, and the texture must have one sample. A null texture unbinds the slot. The level counts as an attachment of
/// this pass: it is misuse if the pass attaches it, or reads it in another way, for example by sampling.
RHW_API void rhw_pass_set_storage_image(rhw_context *context, rhw_pass pass, int slot, rhw_texture texture,
                                        int level);

/// Set a level of a texture as a storage image that shader functions only read (WebGPU, read-only storage textures).
/// The pass may also sample the level, and set it for reading in other slots. The program may write it between draws,
/// as it may write sampled textures. It is misuse if the pass attaches the level, or sets it as an image to be written.
/// Writes and atomics of shader functions do nothing and give 0.
RHW_API void rhw_pass_set_read_only_storage_image(rhw_context *context, rhw_pass pass, int slot,
                                                  rhw_texture texture, int level);

/// Set the bytes from `offset` to offset + size of a buffer as a storage image of one row, with texels of a colour
/// format, which shader functions read and write. A size of 0 goes up to the end of the buffer. `offset` is a multiple
/// of the texel's size. A null buffer unbinds the slot. The bytes count as a storage buffer of this pass.
RHW_API void rhw_pass_set_texel_buffer(rhw_context *context, rhw_pass pass, int slot, rhw_buffer buffer,
                                       enum rhw_format format, size_t offset, size_t size);

/// Set a range of a buffer as a texel buffer that shader functions only read (Vulkan, uniform texel buffers). The
/// parameters are as in rhw_pass_set_texel_buffer; the rules of rhw_pass_set_read_only_storage_buffer hold.
RHW_API void rhw_pass_set_read_only_texel_buffer(rhw_context *context, rhw_pass pass, int slot,
                                                 rhw_buffer buffer, enum rhw_format format, size_t offset,
                                                 size_t size);

/// Set viewport 0. At the beginning of a pass every viewport is the whole pass.
RHW_API void rhw_pass_set_viewport(rhw_context *context, rhw_pass pass, const struct rhw_viewport *viewport);

/// Set scissor 0: the rectangle that draws reach, in pixels of the pass. It may reach beyond the pass to any side. At
/// the beginning of a pass every scissor is the whole pass.
RHW_API void rhw_pass_set_scissor(rhw_context *context, rhw_pass pass, const struct rhw_rect *scissor);

/// Set the viewports `first` .. first + count − 1 of RHW_MAX_VIEWPORTS, for programs that write viewport_index.
/// Viewport 0 is the viewport of rhw_pass_set_viewport.
RHW_API void rhw_pass_set_viewports(rhw_context *context, rhw_pass pass, int first, int count,
                                    const struct rhw_viewport *viewports);

/// Set the scissors `first` .. first + count − 1 of RHW_MAX_VIEWPORTS, for programs that write viewport_index. Scissor
/// 0 is the scissor of rhw_pass_set_scissor.
RHW_API void rhw_pass_set_scissors(rhw_context *context, rhw_pass pass, int first, int count,
                                   const struct rhw_rect *scissors);

/// Set the colour of the RHW_BLEND_CONSTANT factors, in linear values.
RHW_API void rhw_pass_set_blend_constant(rhw_context *context, rhw_pass pass, const float constant[4]);

/// Set the value that stencil tests compare with and RHW_STENCIL_REPLACE writes, for front and back faces. Both are 0
/// at the beginning of a pass.
RHW_API void rhw_pass_set_stencil_reference(rhw_context *context, rhw_pass pass, uint8_t front, uint8_t back);

/// Use these masks in place of the read_mask and write_mask of all pipelines, until NULL is set.
RHW_API void rhw_pass_set_stencil_masks(rhw_context *context, rhw_pass pass,
                                        const struct rhw_stencil_masks *masks);

/// Use this depth bias in place of the depth_bias of all pipelines, until NULL is set.
RHW_API void rhw_pass_set_depth_bias(rhw_context *context, rhw_pass pass, const struct rhw_depth_bias *bias);

/// Use this stipple in place of the line_stipple of all pipelines, until NULL is set. A stipple with factor 0 draws
/// whole lines.
RHW_API void rhw_pass_set_line_stipple(rhw_context *context, rhw_pass pass,
                                       const struct rhw_line_stipple *stipple);

/// Use this width in place of the line_width of all pipelines, until 0 is set. It is 1..RHW_MAX_LINE_WIDTH pixels.
RHW_API void rhw_pass_set_line_width(rhw_context *context, rhw_pass pass, float width);

/// Set the range of pipelines with depth_bounds_test, 0 <= least <= most <= 1. It is 0 and 1 at the beginning of a
/// pass.
RHW_API void rhw_pass_set_depth_bounds(rhw_context *context, rhw_pass pass, float least, float most);

// The draws of a pass ------------------------------------------------------------------------------

/// Clear rectangles of attachments, with all their samples, after what was drawn before and before what is drawn after
/// (vkCmdClearAttachments). Pipeline, scissor, masks, depth bias and queries stay set and do not affect the clear.
/// Every rectangle counts as a draw in the numbers of draws.
RHW_API void rhw_pass_clear_attachments(rhw_context *context, rhw_pass pass, const struct rhw_clear *clear);

/// Draw `count` vertices of the vertex buffers from vertex `first` on, for `instances` instances from `first_instance`
/// on. A vertex outside of its buffer reads zeros (robustBufferAccess2).
RHW_API void rhw_pass_draw(rhw_context *context, rhw_pass pass, uint32_t first, uint32_t count,
                           uint32_t first_instance, uint32_t instances);

/// Draw the vertices of `count` indices of the index buffer from index `first` on, with `base_vertex` added to each
/// index, for `instances` instances from `first_instance` on. An index outside of the index buffer reads 0.
RHW_API void rhw_pass_draw_indexed(rhw_context *context, rhw_pass pass, uint32_t first, uint32_t count,
                                   int32_t base_vertex, uint32_t first_instance, uint32_t instances);

/// Make a rhw_pass_draw of each struct rhw_draw_command in a buffer. The function reads the commands during the call
/// and does not see what is written to them later. Commands and count must lie within their buffers, in bytes that this
/// pass does not write.
RHW_API void rhw_pass_draw_indirect(rhw_context *context, rhw_pass pass,
                                    const struct rhw_draw_commands *commands);

/// Make a rhw_pass_draw_indexed of each struct rhw_draw_indexed_command in a buffer, with the rules of
/// rhw_pass_draw_indirect.
RHW_API void rhw_pass_draw_indexed_indirect(rhw_context *context, rhw_pass pass,
                                            const struct rhw_draw_commands *commands);

/// Draw from vertex 0 on as many whole vertices as a buffer's counter has bytes for: (counter − counter_offset) /
/// stride, or none if the counter is less than counter_offset (vkCmdDrawIndirectByteCountEXT; DrawAuto of Direct3D 11).
/// The function reads the counter during the call; the rules of rhw_pass_draw_indirect hold for the buffer.
RHW_API void rhw_pass_draw_indirect_byte_count(rhw_context *context, rhw_pass pass,
                                               const struct rhw_draw_byte_count *draw);

/// Let draws belong to a group until the matching pop. Messages name the group: "[draw 7 in shadows / trees ...]".
/// Groups may stand in groups. Every group must be popped before the pass ends.
RHW_API void rhw_pass_push_debug_group(rhw_context *context, rhw_pass pass, const char *label);
RHW_API void rhw_pass_pop_debug_group(rhw_context *context, rhw_pass pass);

// Transform feedback of a pass ---------------------------------------------------------------------
// Transform feedback keeps what vertex functions write, in buffers (VK_EXT_transform_feedback; Vulkan 1.3 §27.1,
// "Transform Feedback"). Primitives arrive as lists of points, lines or triangles: strips, fans and restarts are taken
// apart, and adjacent vertices are left out. Primitives arrive in the order in which they were drawn, whatever the
// number of threads, before any primitive is clipped or culled.

/// Let draws write to the targets 0..count − 1, one draw behind the other. The pipeline that is set must have
/// feedback_outputs, and it stays set until the end of transform feedback. If a primitive does not fit whole into every
/// target, neither it nor any later primitive is written. A pass does not read what it writes: it is misuse if this
/// pass uses the bytes as vertices, indices or storage, or if two targets share bytes. Of memory of the program only a
/// context that validates reports this. The targets hold the new bytes when the pass has ended.
RHW_API void rhw_pass_begin_transform_feedback(rhw_context *context, rhw_pass pass,
                                               const struct rhw_feedback_target *targets, int count);

/// End transform feedback. `written`, which may be NULL, is an array [RHW_MAX_FEEDBACK_TARGETS]. The function sets it
/// to the bytes that the draws since the beginning write to each target; another range may go on there. The bytes
/// divided by the stride are the number of vertices that a draw of the next pass finds there.
RHW_API void rhw_pass_end_transform_feedback(rhw_context *context, rhw_pass pass, size_t *written);

// Queries of a pass --------------------------------------------------------------------------------

/// Let a query ask about the draws until rhw_pass_end_query. One query of each kind may be under way at a time, and a
/// pass may use each query once. The pass shades draws under a query in their turn, also where later draws hide them. A
/// query of kind TIMESTAMP is misuse.
RHW_API void rhw_pass_begin_query(rhw_context *context, rhw_pass pass, rhw_query query);
RHW_API void rhw_pass_end_query(rhw_context *context, rhw_pass pass, rhw_query query);

/// Let a query of kind TIMESTAMP take the time here. A pass is drawn tile by tile, so the times within a pass are the
/// time of its beginning, if the call comes before the first draw, and the times at which its flushes end (struct
/// rhw_stats). Most passes have one flush.
RHW_API void rhw_pass_write_timestamp(rhw_context *context, rhw_pass pass, rhw_query query);

// The end of a pass --------------------------------------------------------------------------------

/// Run the pass. Everything is drawn when the function returns, and the id is stale. `stats` may be NULL.
///
/// If misuse was reported since the pass began and the assert hook returned, the function draws all that was no misuse
/// and returns RHW_ERROR_MISUSE. Misuse of another thread that called something of this context meanwhile counts too.
/// On another failure the attachments hold unspecified pixels and the function does not write `stats`.
RHW_API enum rhw_result rhw_pass_end(rhw_context *context, rhw_pass pass, struct rhw_stats *stats);

/// End the pass without drawing any of it. The attachments are as they were, and the id is stale. A program that cannot
/// go on while it records a pass calls this.
RHW_API void rhw_pass_cancel(rhw_context *context, rhw_pass pass);

// Dispatches ----------------------------------------------------------------------------------------
// A dispatch runs where it is called, between passes, and is done when the call returns. What passes and dispatches
// before it wrote is there, and what it writes is there for those that follow. It is misuse while a pass is recorded.

/// Run a program for x · y · z workgroups; each number is in 0..RHW_MAX_WORKGROUP_COUNT, and with a 0 nothing runs. The
/// definition is read during the call. The rules of a pass hold for what the slots have: no byte of a buffer and no
/// texel is both written and read in another way.
///
/// The function returns RHW_OK, RHW_ERROR_OUT_OF_MEMORY, RHW_ERROR_MISUSE or RHW_ERROR_GIVEN_UP. On failure, what the
/// program writes holds unspecified values. It is inline because it tests the compiler flags of the calling file, as
/// rhw_pipeline_create does.
static inline enum rhw_result rhw_dispatch(rhw_context *context, const struct rhw_dispatch_def *def,
                                           uint32_t x, uint32_t y, uint32_t z)
{
    return rhw_dispatch_probed(context, def, rhw_arithmetic_flaws(), x, y, z);
}

/// Dispatch with the numbers of a struct rhw_dispatch_command, which stands at `offset` in a buffer. `offset` is a
/// multiple of 4. The function reads the numbers before any workgroup runs, so the program may write them.
static inline enum rhw_result rhw_dispatch_indirect(rhw_context *context, const struct rhw_dispatch_def *def,
                                                    rhw_buffer buffer, size_t offset)
{
    return rhw_dispatch_indirect_probed(context, def, rhw_arithmetic_flaws(), buffer, offset);
}

// Queries -------------------------------------------------------------------------------------------

RHW_API enum rhw_result rhw_query_create(rhw_context *context, const struct rhw_query_def *def,
                                         rhw_query *query);
RHW_API void rhw_query_destroy(rhw_context *context, rhw_query query);

/// Set `*counts` to the answer of the last pass that used the query. If there is no answer, the call is misuse and sets
/// `*counts` to 0: while that pass is recorded, and if no pass that used the query ended with success.
RHW_API enum rhw_result rhw_query_read(rhw_context *context, rhw_query query,
                                       struct rhw_query_counts *counts);

#endif
