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
/// pass writes it does not read: the buffers are not set as vertices, indices or storage of this pass, and no two targets of it
/// share bytes. Buffers have their new bytes when the pass has ended.
RHW_API void rhw_pass_begin_transform_feedback(rhw_context *context, rhw_pass pass,
                                               const struct rhw_feedback_target *targets, int count);
/// `written`: [RHW_MAX_FEEDBACK_TARGETS], the bytes that the draws since the beginning write to each target, where
/// another range may go on; may be NULL.
RHW_API void rhw_pass_end_transform_feedback(rhw_context *context, rhw_pass pass, size_t *written);

#endif
