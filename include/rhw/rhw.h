// SPDX-License-Identifier: MIT
// The functions of the library, by subject. Include this one; shader.h as well where you write shaders.
#ifndef RHW_RHW_H
#define RHW_RHW_H

#include "limits.h"
#include "explain.h"
#include "pass_def.h"
#include "stats.h"
#include "transfer.h"
#include "types.h"
#include "view.h"

// Context -------------------------------------------------------------------------------------------

/// rhw_context_create for those who call it from another language: `debug` is what RHW_VALIDATE_DEFAULT stands for.
RHW_API enum rhw_result rhw_context_create_probed(const struct rhw_context_def *def, bool debug,
                                                  rhw_context **context);

/// Creates a context and its worker threads. On failure `*context` is NULL. Here, and not in the library, because it
/// tells whether your program is built for debugging.
static inline enum rhw_result rhw_context_create(const struct rhw_context_def *def, rhw_context **context)
{
#if defined(NDEBUG) || defined(__OPTIMIZE__)
    const bool debug = false;
#else
    const bool debug = true;
#endif
    return rhw_context_create_probed(def, debug, context);
}

/// Destroys the context and everything in it. NULL is allowed. Not while a pass is recorded.
RHW_API void rhw_context_destroy(rhw_context *context);
RHW_API int rhw_context_threads(const rhw_context *context);
/// What is asked while a pass of the context runs, before each task of the thread that ends it, some thousand times a
/// second; false gives the pass up: rhw_pass_end returns RHW_ERROR_GIVEN_UP when the tasks under way, a tile or 8192
/// triangles each, are done. What the pass wrote to holds anything then, its queries have no result, and the stats are not
/// written. NULL, at first: nobody is asked. Calls of the library in it are misuse.
RHW_API void rhw_context_set_goes_on(rhw_context *context, bool (*goes_on)(void *user), void *user);
RHW_API enum rhw_isa rhw_context_isa(const rhw_context *context);
/// What rhw_context_def.isa_limit says for `isa`; RHW_ISA_BEST for RHW_ISA_COUNT.
RHW_API enum rhw_isa_limit rhw_isa_up_to(enum rhw_isa isa);
/// "baseline", "avx2" or "avx512"; static storage.
RHW_API const char *rhw_isa_name(enum rhw_isa isa);
/// Whether this build has kernels for `isa` and this CPU runs them.
RHW_API bool rhw_isa_supported(enum rhw_isa isa);

/// What the library can do at most, the same in every context.
RHW_API struct rhw_limits rhw_limits_get(void);

// Buffers -------------------------------------------------------------------------------------------

RHW_API enum rhw_result rhw_buffer_create(rhw_context *context, const struct rhw_buffer_def *def,
                                          rhw_buffer *buffer);
RHW_API void rhw_buffer_destroy(rhw_context *context, rhw_buffer buffer);
/// Replaces `size` bytes at `offset`. Draws that were recorded before read what the buffer held then: where the pass being
/// recorded reads some of the bytes, the first write after a draw gives the buffer new memory. Without memory for that
/// it stays as it is. Bytes that this pass may write, as storage or by transform feedback, are refused, and those that
/// it reads where it may write others of the buffer; bytes that it does not use are free. So it is for all that writes
/// to buffers.
RHW_API enum rhw_result rhw_buffer_write(rhw_context *context, rhw_buffer buffer, size_t offset,
                                         const void *data, size_t size);
/// Copies `size` bytes at `offset` out. Bytes that the pass being recorded may write are refused.
RHW_API enum rhw_result rhw_buffer_read(rhw_context *context, rhw_buffer buffer, size_t offset, void *data,
                                        size_t size);

// Textures and samplers -----------------------------------------------------------------------------

RHW_API enum rhw_result rhw_texture_create(rhw_context *context, const struct rhw_texture_def *def,
                                           rhw_texture *texture);
RHW_API void rhw_texture_destroy(rhw_context *context, rhw_texture texture);
RHW_API int rhw_texture_width(const rhw_context *context, rhw_texture texture, int level);
RHW_API int rhw_texture_height(const rhw_context *context, rhw_texture texture, int level);
/// Slices of a level of a 3D texture; 1 for other kinds.
RHW_API int rhw_texture_depth(const rhw_context *context, rhw_texture texture, int level);
/// Layers, six for each cube; 1 where the texture is no array.
RHW_API int rhw_texture_layers(const rhw_context *context, rhw_texture texture);
RHW_API int rhw_texture_mip_levels(const rhw_context *context, rhw_texture texture);
RHW_API enum rhw_format rhw_texture_format(const rhw_context *context, rhw_texture texture);
/// Replaces a whole level, of textures with layers or slices the first one of it. Rows top to bottom, `row_pitch` bytes
/// apart (0: tightly packed), texels in the texture's format; of a compressed format rows of whole blocks, also where the
/// level ends within one. As with rhw_buffer_write, draws that were recorded before see the texels of then. Not while the
/// texture or a view of it is an attachment of the pass being recorded; the same holds for the next two functions.
RHW_API enum rhw_result rhw_texture_write(rhw_context *context, rhw_texture texture, int level,
                                          const void *data, size_t row_pitch);
/// Copies a level out, in the same layout as rhw_texture_write. Of a compressed format: the texels that its blocks were
/// decoded to, in rhw_format_decoded; the blocks are not kept.
RHW_API enum rhw_result rhw_texture_read(rhw_context *context, rhw_texture texture, int level, void *data,
                                         size_t row_pitch);
/// The same for one layer, 6 × cube + face, or slice of a 3D texture; the level of a 3D texture has
/// rhw_texture_depth of them.
RHW_API enum rhw_result rhw_texture_write_layer(rhw_context *context, rhw_texture texture, int level,
                                                int layer, const void *data, size_t row_pitch);
RHW_API enum rhw_result rhw_texture_read_layer(rhw_context *context, rhw_texture texture, int level,
                                               int layer, void *data, size_t row_pitch);
/// One sample of every texel of a multisampled texture, 0..samples − 1.
RHW_API enum rhw_result rhw_texture_read_sample(rhw_context *context, rhw_texture texture, int sample,
                                                void *data, size_t row_pitch);
RHW_API int rhw_texture_samples(const rhw_context *context, rhw_texture texture);
/// Where a sample lies in its pixel, 0..1 from the top left (Vulkan 1.3 §27.5, standardSampleLocations). `samples`: 1, 2,
/// 4, 8 or 16; false, with the centre, for other numbers.
RHW_API bool rhw_sample_position(int samples, int sample, float position[2]);
/// The same for the plane of stencil, a byte per texel, of a format that has one. For layers, samples and parts of a level
/// see rhw_texture_write_region.
RHW_API enum rhw_result rhw_texture_write_stencil(rhw_context *context, rhw_texture texture, int level,
                                                  const uint8_t *data, size_t row_pitch);
RHW_API enum rhw_result rhw_texture_read_stencil(rhw_context *context, rhw_texture texture, int level,
                                                 uint8_t *data, size_t row_pitch);
/// Fills levels 1.. of all layers from level 0 with a box filter in linear light (odd sizes weighted exactly; of 3D
/// textures over 2×2×2 texels). Without memory for that the levels stay as they are. Levels of compressed formats are
/// written instead.
RHW_API enum rhw_result rhw_texture_generate_mips(rhw_context *context, rhw_texture texture);

RHW_API enum rhw_result rhw_sampler_create(rhw_context *context, const struct rhw_sampler_def *def,
                                           rhw_sampler *sampler);
RHW_API void rhw_sampler_destroy(rhw_context *context, rhw_sampler sampler);

// Pipelines -----------------------------------------------------------------------------------------

/// What the compiler's flags can make of the arithmetic of a file that shaders stand in.
enum rhw_arithmetic_flaw {
    RHW_ARITHMETIC_FUSED = 1,    ///< a * b + c rounded once: -ffp-contract=off is missing
    RHW_ARITHMETIC_REORDERED = 2 ///< (a + b) - a made b: -ffast-math and its parts, or sums in a wider type
};

/// Or-ed rhw_arithmetic_flaw of the file that includes this; 0: its floats are those of the library. Contraction cannot
/// be seen by the preprocessor, so this computes what shows it.
static inline uint32_t rhw_arithmetic_flaws(void)
{
    volatile float one = 1; // unknown to the compiler
    const float a = 1 + one / 4096, b = one * 16777216;
    const float product =
        a * a - (1 + one / 2048);      // 2^-24 when fused; else 0, or 2^-23 where rounding is upwards
    const float sum = (b + 1.25f) - b; // 0, 2 or 4, as rounding goes
    uint32_t flaws = 0;
    if (product > 0 && product < 1.0f / 8388608) {
        flaws |= RHW_ARITHMETIC_FUSED;
    }
    if (sum > 1 && sum < 2) {
        flaws |= RHW_ARITHMETIC_REORDERED;
    }
    return flaws;
}

/// rhw_pipeline_create for those who call it from another language: `flaws` is what rhw_arithmetic_flaws gives where
/// the shader functions were compiled, 0 where no C compiler was.
RHW_API enum rhw_result rhw_pipeline_create_probed(rhw_context *context, const struct rhw_pipeline_def *def,
                                                   uint32_t flaws, rhw_pipeline *pipeline);

/// Creates a pipeline; `*def` is copied. Here, and not in the library, because it is compiled with the flags of your
/// program: one whose flags would draw other bytes on another machine is told (misuse). The flags of the file that
/// calls this are looked at; give the same ones to files that have shaders alone, as the CMake and pkg-config packages
/// do.
static inline enum rhw_result rhw_pipeline_create(rhw_context *context, const struct rhw_pipeline_def *def,
                                                  rhw_pipeline *pipeline)
{
    return rhw_pipeline_create_probed(context, def, rhw_arithmetic_flaws(), pipeline);
}

RHW_API void rhw_pipeline_destroy(rhw_context *context, rhw_pipeline pipeline);

// Passes --------------------------------------------------------------------------------------------
// Draws are recorded between begin and end; end runs them. One pass at a time per context. A draw sees what its buffers
// and textures hold when it is recorded: they may be written, and anything may be created or destroyed, before the pass
// has ended.
// What is destroyed while it is set stays set. Uniforms are copied. Viewport and scissor start as the whole pass.

/// Begins a pass; its attachments stay as they are until it ends. On failure `*pass` is null. Where a pass is being
/// recorded, or another call is under way, `*pass` is left alone: it may be what the first pass is ended by.
RHW_API enum rhw_result rhw_pass_begin(rhw_context *context, const struct rhw_pass_def *def, rhw_pass *pass);
/// State lasts until it is set again: it survives draws and a change of pipeline. A call that is misuse leaves it.
/// The pipeline's targets must have the formats of the attachments, in order.
RHW_API void rhw_pass_set_pipeline(rhw_context *context, rhw_pass pass, rhw_pipeline pipeline);
/// `slot`: 0..RHW_MAX_VERTEX_BUFFERS − 1; `offset`: bytes to element 0. A null buffer is misuse: what no attribute
/// reads need not be unbound.
RHW_API void rhw_pass_set_vertex_buffer(rhw_context *context, rhw_pass pass, int slot, rhw_buffer buffer,
                                        size_t offset);
/// `offset`: bytes to index 0.
RHW_API void rhw_pass_set_index_buffer(rhw_context *context, rhw_pass pass, rhw_buffer buffer,
                                       enum rhw_index_type type, size_t offset);
/// The same of `size` bytes, 0: to the end of the buffer; offset + size is within it. What lies behind them is outside
/// to draws. Bytes that this pass may write, or that are mapped for writing, are refused.
RHW_API void rhw_pass_set_vertex_buffer_range(rhw_context *context, rhw_pass pass, int slot,
                                              rhw_buffer buffer, size_t offset, size_t size);
RHW_API void rhw_pass_set_index_buffer_range(rhw_context *context, rhw_pass pass, rhw_buffer buffer,
                                             enum rhw_index_type type, size_t offset, size_t size);
/// Copies `size` bytes, at most RHW_MAX_UNIFORM_SIZE; at a draw they must be at least the program's uniform_size.
RHW_API void rhw_pass_set_uniforms(rhw_context *context, rhw_pass pass, const void *data, size_t size);
/// A null texture unbinds the slot; sampling an unbound slot gives 0, 0, 0, 1. What has a level and layer of an
/// attachment or storage image of this pass is refused: sample a view of others (view.h), or end the pass and sample in
/// the next one, which loads what it goes on with. Depth and stencil that are attached read_only are sampled too.
RHW_API void rhw_pass_set_texture(rhw_context *context, rhw_pass pass, int slot, rhw_texture texture,
                                  rhw_sampler sampler);
/// Bytes `offset`, a multiple of 4, to offset + size of the buffer, 0: to its end, as storage slot `slot`,
/// 0..RHW_MAX_STORAGE_BUFFERS − 1, which shader functions read and write (shader_storage.h). A null buffer unbinds the
/// slot. What they write is there when the pass has ended. Bytes that this pass reads otherwise, as vertices, indices
/// or in a read-only slot, are refused; once set, they are refused for all of these, and as commands, until it ends.
RHW_API void rhw_pass_set_storage_buffer(rhw_context *context, rhw_pass pass, int slot, rhw_buffer buffer,
                                         size_t offset, size_t size);
/// The same for functions that only read it (WebGPU, read-only-storage): the bytes may be read in any other way too,
/// and written between draws, as those of vertex buffers. Writing and atomics do nothing, and give 0.
RHW_API void rhw_pass_set_read_only_storage_buffer(rhw_context *context, rhw_pass pass, int slot,
                                                   rhw_buffer buffer, size_t offset, size_t size);
/// A level of a texture, all its layers or slices, as image slot `slot`, 0..RHW_MAX_STORAGE_IMAGES − 1, which shader
/// functions read and write (shader_image.h). Its format can be drawn into as colour, its texels have one sample. A null
/// texture unbinds the slot. The level counts as an attachment of this pass, and is neither attached nor read besides,
/// as by sampling.
RHW_API void rhw_pass_set_storage_image(rhw_context *context, rhw_pass pass, int slot, rhw_texture texture,
                                        int level);
/// The same for functions that only read it (WebGPU, read-only storage textures): the level may be sampled and set for
/// reading in other slots too, and is written between draws, as what is sampled. It is neither attached nor set to be
/// written besides. Writing and atomics do nothing, and give 0.
RHW_API void rhw_pass_set_read_only_storage_image(rhw_context *context, rhw_pass pass, int slot,
                                                  rhw_texture texture, int level);
/// Bytes `offset` to offset + size of a buffer, 0: to its end, as an image of one row, read and written as texels of a
/// colour format. `offset` is a multiple of the texel's size. It is a storage buffer of this pass. A null buffer
/// unbinds the slot.
RHW_API void rhw_pass_set_texel_buffer(rhw_context *context, rhw_pass pass, int slot, rhw_buffer buffer,
                                       enum rhw_format format, size_t offset, size_t size);
/// The same for functions that only read it (Vulkan, uniform texel buffers), as rhw_pass_set_read_only_storage_buffer.
RHW_API void rhw_pass_set_read_only_texel_buffer(rhw_context *context, rhw_pass pass, int slot,
                                                 rhw_buffer buffer, enum rhw_format format, size_t offset,
                                                 size_t size);
RHW_API void rhw_pass_set_viewport(rhw_context *context, rhw_pass pass, const struct rhw_viewport *viewport);
/// What draws reach, in pixels of the pass; it may reach beyond that, to any side.
RHW_API void rhw_pass_set_scissor(rhw_context *context, rhw_pass pass, const struct rhw_rect *scissor);
/// Viewports and scissors `first` .. `first` + count − 1 of RHW_MAX_VIEWPORTS, for programs that write viewport_index;
/// the first of all is that of rhw_pass_set_viewport and rhw_pass_set_scissor. Each is the whole pass until it is set.
RHW_API void rhw_pass_set_viewports(rhw_context *context, rhw_pass pass, int first, int count,
                                    const struct rhw_viewport *viewports);
RHW_API void rhw_pass_set_scissors(rhw_context *context, rhw_pass pass, int first, int count,
                                   const struct rhw_rect *scissors);
RHW_API void rhw_pass_set_blend_constant(rhw_context *context, rhw_pass pass, const float constant[4]);
/// What stencil tests compare with and REPLACE writes, by facing. 0 and 0 at the start.
RHW_API void rhw_pass_set_stencil_reference(rhw_context *context, rhw_pass pass, uint8_t front, uint8_t back);
/// Stand in the place of the pipelines' own read_mask and write_mask until NULL is set.
RHW_API void rhw_pass_set_stencil_masks(rhw_context *context, rhw_pass pass,
                                        const struct rhw_stencil_masks *masks);
/// Stands in the place of the pipelines' own depth_bias until NULL is set.
RHW_API void rhw_pass_set_depth_bias(rhw_context *context, rhw_pass pass, const struct rhw_depth_bias *bias);
/// Stands in the place of the pipelines' own line_stipple until NULL is set; with factor 0 there is none.
RHW_API void rhw_pass_set_line_stipple(rhw_context *context, rhw_pass pass,
                                       const struct rhw_line_stipple *stipple);
/// Stands in the place of the pipelines' own line_width until 0 is set: 1..RHW_MAX_LINE_WIDTH pixels.
RHW_API void rhw_pass_set_line_width(rhw_context *context, rhw_pass pass, float width);
/// For pipelines with depth_bounds_test: 0 <= least <= most <= 1. 0 and 1 at the start.
RHW_API void rhw_pass_set_depth_bounds(rhw_context *context, rhw_pass pass, float least, float most);
/// Clears rectangles of attachments, all samples of them, after what was drawn before and below what is drawn after
/// (vkCmdClearAttachments). What the pass has set stays and has no say: pipeline, scissor, masks, depth bias, queries.
/// Every rectangle is a draw in the numbers of draws.
RHW_API void rhw_pass_clear_attachments(rhw_context *context, rhw_pass pass, const struct rhw_clear *clear);
/// Vertices `first`.. of the vertex buffers. Outside of its buffer a vertex reads zeros (robustBufferAccess2).
RHW_API void rhw_pass_draw(rhw_context *context, rhw_pass pass, uint32_t first, uint32_t count,
                           uint32_t first_instance, uint32_t instances);
/// Indices `first`.. of the index buffer, `base_vertex` added to each. An index outside the index buffer
/// reads 0.
RHW_API void rhw_pass_draw_indexed(rhw_context *context, rhw_pass pass, uint32_t first, uint32_t count,
                                   int32_t base_vertex, uint32_t first_instance, uint32_t instances);
/// A draw for each command, which is read from the buffer now: what is written there later is not seen. Commands and
/// count must lie within their buffers, in bytes that this pass does not write.
RHW_API void rhw_pass_draw_indirect(rhw_context *context, rhw_pass pass,
                                    const struct rhw_draw_commands *commands);
RHW_API void rhw_pass_draw_indexed_indirect(rhw_context *context, rhw_pass pass,
                                            const struct rhw_draw_commands *commands);
// Transform feedback (VK_EXT)

/// From here on draws write to the targets 0..count − 1, one behind the other; the pipeline that is set has outputs, and
/// stays. A primitive that does not fit whole into each of the targets is not written, nor are those behind it. What a
/// pass writes it does not read: the bytes are not set as vertices, indices or storage of this pass, and no two targets
/// share any. Buffers have their new bytes when the pass has ended.
RHW_API void rhw_pass_begin_transform_feedback(rhw_context *context, rhw_pass pass,
                                               const struct rhw_feedback_target *targets, int count);
/// `written`: [RHW_MAX_FEEDBACK_TARGETS], the bytes that the draws since the beginning write to each target, where
/// another range may go on; may be NULL. Divided by a stride it is how many vertices a draw of the next pass finds
/// there.
RHW_API void rhw_pass_end_transform_feedback(rhw_context *context, rhw_pass pass, size_t *written);
/// Draws from vertex 0 on as many as whole ones fit into the bytes: (counter − counter_offset) / stride, none where the
/// counter is less (vkCmdDrawIndirectByteCountEXT; DrawAuto of Direct3D 11). It is read now, as by
/// rhw_pass_draw_indirect, whose rules hold for the buffer.
RHW_API void rhw_pass_draw_indirect_byte_count(rhw_context *context, rhw_pass pass,
                                               const struct rhw_draw_byte_count *draw);
/// Draws recorded until the matching pop belong to a group, which messages name: "[draw 7 in shadows / trees ...]".
/// Groups may stand in groups; each is popped before the pass ends.
RHW_API void rhw_pass_push_debug_group(rhw_context *context, rhw_pass pass, const char *label);
RHW_API void rhw_pass_pop_debug_group(rhw_context *context, rhw_pass pass);
/// Draws recorded until rhw_pass_end_query are what the query is about. Of each kind one query may be under way at a time,
/// and each query is used once in a pass. Draws are shaded in their turn then, also where later ones hide
/// them. TIMESTAMP is refused.
RHW_API void rhw_pass_begin_query(rhw_context *context, rhw_pass pass, rhw_query query);
RHW_API void rhw_pass_end_query(rhw_context *context, rhw_pass pass, rhw_query query);
/// For a query of kind TIMESTAMP. As a pass is drawn tile by tile, times within it are those of its beginning, before the
/// first draw, and of the ends of its flushes (struct rhw_stats), mostly one.
RHW_API void rhw_pass_write_timestamp(rhw_context *context, rhw_pass pass, rhw_query query);
/// Runs the pass; all of it is drawn on return, and the id is stale. `stats` may be NULL. Where misuse was reported
/// since the pass began and the assert hook returned, all that was no misuse is drawn, and the result is
/// RHW_ERROR_MISUSE: also where it was that of another thread, which called something of this context meanwhile. On
/// other failures the attachments hold unspecified pixels and `stats` is as it was.
RHW_API enum rhw_result rhw_pass_end(rhw_context *context, rhw_pass pass, struct rhw_stats *stats);
/// Ends the pass without drawing any of it: the attachments are as they were, and the id is stale. For those who find in
/// the middle that they cannot go on.
RHW_API void rhw_pass_cancel(rhw_context *context, rhw_pass pass);

// Queries -------------------------------------------------------------------------------------------

RHW_API enum rhw_result rhw_query_create(rhw_context *context, const struct rhw_query_def *def,
                                         rhw_query *query);
RHW_API void rhw_query_destroy(rhw_context *context, rhw_query query);
/// The answer of the last pass that used the query. Misuse, with `*counts` zeroed, where there is none: while that pass is
/// recorded, and where none was ended with success.
RHW_API enum rhw_result rhw_query_read(rhw_context *context, rhw_query query,
                                       struct rhw_query_counts *counts);

#endif
