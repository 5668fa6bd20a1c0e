// SPDX-License-Identifier: MIT
// State of draws that a pipeline either has or leaves to commands. A pipeline says what it has; a command buffer, while
// it is replayed, what is set at the moment. Only what changed is given to librhw.
#ifndef VULKAN_DYNAMIC_STATE_H
#define VULKAN_DYNAMIC_STATE_H

#include <stdint.h>
#include <vulkan/vulkan_core.h>

#include "rhw/rhw.h"

// Parts of the state, which are or-ed.
enum vulkan_dynamic {
    VULKAN_DYNAMIC_VIEWPORT = 1 << 0,
    VULKAN_DYNAMIC_SCISSOR = 1 << 1,
    VULKAN_DYNAMIC_LINE_WIDTH = 1 << 2,
    VULKAN_DYNAMIC_DEPTH_BIAS = 1 << 3,
    VULKAN_DYNAMIC_BLEND_CONSTANT = 1 << 4,
    VULKAN_DYNAMIC_DEPTH_BOUNDS = 1 << 5,
    VULKAN_DYNAMIC_COMPARE_MASK = 1 << 6,
    VULKAN_DYNAMIC_WRITE_MASK = 1 << 7,
    VULKAN_DYNAMIC_REFERENCE = 1 << 8,
    VULKAN_DYNAMIC_LINE_STIPPLE = 1 << 9,
    VULKAN_DYNAMIC_ALL = (1 << 10) - 1
};

struct vulkan_dynamic_state {
    struct rhw_viewport viewports[RHW_MAX_VIEWPORTS];
    struct rhw_rect scissors[RHW_MAX_VIEWPORTS];
    uint32_t viewport_count, scissor_count; // how many are set, from 0 on
    float line_width;
    struct rhw_depth_bias depth_bias;
    struct rhw_line_stipple line_stipple;
    float blend_constant[4];
    float depth_bounds[2];
    struct rhw_stencil_masks masks;
    uint8_t reference[2]; // [front, back]
};

// Return the or-ed parts that a VkDynamicState stands for, or 0.
uint32_t vulkan_dynamic_of(VkDynamicState state);

// Set parts of a state as a command, or the creation of a pipeline, gives them.
void vulkan_dynamic_set_viewports(struct vulkan_dynamic_state *state, uint32_t first, uint32_t count,
                                  const VkViewport *viewports);
void vulkan_dynamic_set_scissors(struct vulkan_dynamic_state *state, uint32_t first, uint32_t count,
                                 const VkRect2D *scissors);
void vulkan_dynamic_set_line_width(struct vulkan_dynamic_state *state, float width);
void vulkan_dynamic_set_depth_bias(struct vulkan_dynamic_state *state, float constant, float clamp,
                                   float slope);
void vulkan_dynamic_set_line_stipple(struct vulkan_dynamic_state *state, uint32_t factor, uint16_t pattern);
void vulkan_dynamic_set_depth_bounds(struct vulkan_dynamic_state *state, float least, float most);
void vulkan_dynamic_set_compare_mask(struct vulkan_dynamic_state *state, VkStencilFaceFlags faces,
                                     uint32_t mask);
void vulkan_dynamic_set_write_mask(struct vulkan_dynamic_state *state, VkStencilFaceFlags faces,
                                   uint32_t mask);
void vulkan_dynamic_set_reference(struct vulkan_dynamic_state *state, VkStencilFaceFlags faces,
                                  uint32_t reference);

// Copy the or-ed parts from one state to another.
void vulkan_dynamic_copy(struct vulkan_dynamic_state *to, const struct vulkan_dynamic_state *from,
                         uint32_t parts);

// Give the or-ed parts to the pass that is recorded.
void vulkan_dynamic_apply(const struct vulkan_dynamic_state *state, uint32_t parts, rhw_context *context,
                          rhw_pass pass);

#endif
