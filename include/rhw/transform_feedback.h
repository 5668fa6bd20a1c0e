// SPDX-License-Identifier: MIT
// Transform feedback: what vertex functions write, kept in buffers (VK_EXT_transform_feedback; Vulkan 1.3 §27.1, "Transform
// Feedback"). Primitives arrive as lists of points, lines or triangles, strips, fans and restarts taken apart, in the
// order in which they were drawn, whatever the threads, before any is clipped or culled; adjacent vertices are left out.
#ifndef RHW_TRANSFORM_FEEDBACK_H
#define RHW_TRANSFORM_FEEDBACK_H

#include "types.h"

/// Where a pass writes what pipelines list as feedback_outputs. Of memory that is not written the bytes stay.
struct rhw_feedback_target {
    rhw_buffer buffer; ///< null where no output names this target
    size_t offset;     ///< bytes to the first vertex, a multiple of 4
    size_t size;       ///< bytes that may be written; 0: up to the end of the buffer
};

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

/// Where rhw_pass_draw_indirect_byte_count finds its number of vertices, and the rest of what it draws.
struct rhw_draw_byte_count {
    rhw_buffer buffer;       ///< where a uint32_t, the counter, says how many bytes there are
    size_t offset;           ///< bytes to it; a multiple of 4
    uint32_t counter_offset; ///< bytes of these that are no vertices
    uint32_t stride;         ///< bytes of a vertex, at least 1
    uint32_t first_instance, instances;
};

/// Draws from vertex 0 on as many as whole ones fit into the bytes: (counter − counter_offset) / stride, none where the
/// counter is less (vkCmdDrawIndirectByteCountEXT; DrawAuto of Direct3D 11). It is read now, as by
/// rhw_pass_draw_indirect, whose rules hold for the buffer.
RHW_API void rhw_pass_draw_indirect_byte_count(rhw_context *context, rhw_pass pass,
                                               const struct rhw_draw_byte_count *draw);

#endif
