// SPDX-License-Identifier: MIT
// What shaders reach: the sets and push constants that are bound, as bindings of librhw in a frame.
#ifndef VULKAN_SHADER_INPUT_H
#define VULKAN_SHADER_INPUT_H

#include "replay.h"

// Make the bindings of the sets with these bits that the pipeline of a bind point uses, and put them into a frame.
// Return false without memory.
bool vulkan_shader_input_sets(struct vulkan_replay *replay, const struct vulkan_bound_point *point,
                              uint32_t sets, struct rhw_shader_frame *frame);

// Put a copy of the push constants into a frame. Return false without memory.
bool vulkan_shader_input_push(struct vulkan_replay *replay, uint32_t size, struct rhw_shader_frame *frame);

// Put a copy of the push constants into a frame, and behind it the base vertex, first instance and number of a draw.
// Return false without memory.
bool vulkan_shader_input_draw(struct vulkan_replay *replay, const uint32_t numbers[3],
                              struct rhw_shader_frame *frame);

#endif
