// SPDX-License-Identifier: MIT
#include "dynamic_state.h"

#include <math.h>
#include <string.h>

uint32_t vulkan_dynamic_of(VkDynamicState state)
{
    switch (state) {
    case VK_DYNAMIC_STATE_VIEWPORT: return VULKAN_DYNAMIC_VIEWPORT;
    case VK_DYNAMIC_STATE_SCISSOR: return VULKAN_DYNAMIC_SCISSOR;
    case VK_DYNAMIC_STATE_LINE_WIDTH: return VULKAN_DYNAMIC_LINE_WIDTH;
    case VK_DYNAMIC_STATE_DEPTH_BIAS: return VULKAN_DYNAMIC_DEPTH_BIAS;
    case VK_DYNAMIC_STATE_BLEND_CONSTANTS: return VULKAN_DYNAMIC_BLEND_CONSTANT;
    case VK_DYNAMIC_STATE_DEPTH_BOUNDS: return VULKAN_DYNAMIC_DEPTH_BOUNDS;
    case VK_DYNAMIC_STATE_STENCIL_COMPARE_MASK: return VULKAN_DYNAMIC_COMPARE_MASK;
    case VK_DYNAMIC_STATE_STENCIL_WRITE_MASK: return VULKAN_DYNAMIC_WRITE_MASK;
    case VK_DYNAMIC_STATE_STENCIL_REFERENCE: return VULKAN_DYNAMIC_REFERENCE;
    case VK_DYNAMIC_STATE_LINE_STIPPLE_EXT: return VULKAN_DYNAMIC_LINE_STIPPLE;
    default: return 0;
    }
}

// Return the value, or the limit that it is beyond. What is no number becomes `least`.
static float clamped(float value, float least, float most)
{
    return value >= least ? (value <= most ? value : most) : least;
}

static float finite_or_0(float value)
{
    return isfinite(value) ? value : 0;
}

// Vulkan's y points down where librhw's points up, so the viewport turns over.
static struct rhw_viewport viewport_of(const VkViewport *given)
{
    const float most = RHW_MAX_TARGET_SIZE, bound = 2 * (float)RHW_MAX_TARGET_SIZE;
    const float width = clamped(given->width, 1.0f / 256, most);
    const float height = clamped(given->height, -most, most);
    const float x = clamped(given->x, -bound, bound - width);
    const float y =
        height < 0 ? clamped(given->y, -bound - height, bound) : clamped(given->y, -bound, bound - height);
    struct rhw_viewport viewport = {.x = x,
                                    .y = y + height,
                                    .width = width,
                                    .height = -height,
                                    .depth_min = clamped(given->minDepth, 0, 1),
                                    .depth_max = clamped(given->maxDepth, 0, 1)};
    if (viewport.depth_min == 0 && viewport.depth_max == 0) {
        viewport.depth_max = -1; // two zeros would be the range 0..1
    }
    return viewport;
}

void vulkan_dynamic_set_viewports(struct vulkan_dynamic_state *state, uint32_t first, uint32_t count,
                                  const VkViewport *viewports)
{
    for (uint32_t i = 0; i < count && first + i < RHW_MAX_VIEWPORTS; i++) {
        state->viewports[first + i] = viewport_of(&viewports[i]);
        state->viewport_count = state->viewport_count > first + i ? state->viewport_count : first + i + 1;
    }
}

void vulkan_dynamic_set_scissors(struct vulkan_dynamic_state *state, uint32_t first, uint32_t count,
                                 const VkRect2D *scissors)
{
    for (uint32_t i = 0; i < count && first + i < RHW_MAX_VIEWPORTS; i++) {
        const VkRect2D *const given = &scissors[i];
        const uint32_t most = RHW_MAX_TARGET_SIZE;
        state->scissors[first + i] =
            (struct rhw_rect){.x = given->offset.x,
                              .y = given->offset.y,
                              .width = (int)(given->extent.width < most ? given->extent.width : most),
                              .height = (int)(given->extent.height < most ? given->extent.height : most)};
        state->scissor_count = state->scissor_count > first + i ? state->scissor_count : first + i + 1;
    }
}

void vulkan_dynamic_set_line_width(struct vulkan_dynamic_state *state, float width)
{
    state->line_width = clamped(width, 1, RHW_MAX_LINE_WIDTH);
}

void vulkan_dynamic_set_depth_bias(struct vulkan_dynamic_state *state, float constant, float clamp,
                                   float slope)
{
    state->depth_bias = (struct rhw_depth_bias){
        .constant = finite_or_0(constant), .slope = finite_or_0(slope), .clamp = finite_or_0(clamp)};
}

void vulkan_dynamic_set_line_stipple(struct vulkan_dynamic_state *state, uint32_t factor, uint16_t pattern)
{
    const uint32_t most = RHW_MAX_LINE_STIPPLE_FACTOR;
    state->line_stipple = (struct rhw_line_stipple){(int)(factor < most ? factor : most), pattern};
}

void vulkan_dynamic_set_depth_bounds(struct vulkan_dynamic_state *state, float least, float most)
{
    state->depth_bounds[0] = clamped(least, 0, 1);
    state->depth_bounds[1] = clamped(most, state->depth_bounds[0], 1);
}

void vulkan_dynamic_set_compare_mask(struct vulkan_dynamic_state *state, VkStencilFaceFlags faces,
                                     uint32_t mask)
{
    state->masks.read_front = faces & VK_STENCIL_FACE_FRONT_BIT ? (uint8_t)mask : state->masks.read_front;
    state->masks.read_back = faces & VK_STENCIL_FACE_BACK_BIT ? (uint8_t)mask : state->masks.read_back;
}

void vulkan_dynamic_set_write_mask(struct vulkan_dynamic_state *state, VkStencilFaceFlags faces,
                                   uint32_t mask)
{
    state->masks.write_front = faces & VK_STENCIL_FACE_FRONT_BIT ? (uint8_t)mask : state->masks.write_front;
    state->masks.write_back = faces & VK_STENCIL_FACE_BACK_BIT ? (uint8_t)mask : state->masks.write_back;
}

void vulkan_dynamic_set_reference(struct vulkan_dynamic_state *state, VkStencilFaceFlags faces,
                                  uint32_t reference)
{
    state->reference[0] = faces & VK_STENCIL_FACE_FRONT_BIT ? (uint8_t)reference : state->reference[0];
    state->reference[1] = faces & VK_STENCIL_FACE_BACK_BIT ? (uint8_t)reference : state->reference[1];
}

void vulkan_dynamic_copy(struct vulkan_dynamic_state *to, const struct vulkan_dynamic_state *from,
                         uint32_t parts)
{
    if (parts & VULKAN_DYNAMIC_VIEWPORT) {
        memcpy(to->viewports, from->viewports, from->viewport_count * sizeof *from->viewports);
        to->viewport_count = from->viewport_count;
    }
    if (parts & VULKAN_DYNAMIC_SCISSOR) {
        memcpy(to->scissors, from->scissors, from->scissor_count * sizeof *from->scissors);
        to->scissor_count = from->scissor_count;
    }
    to->line_width = parts & VULKAN_DYNAMIC_LINE_WIDTH ? from->line_width : to->line_width;
    to->depth_bias = parts & VULKAN_DYNAMIC_DEPTH_BIAS ? from->depth_bias : to->depth_bias;
    to->line_stipple = parts & VULKAN_DYNAMIC_LINE_STIPPLE ? from->line_stipple : to->line_stipple;
    if (parts & VULKAN_DYNAMIC_BLEND_CONSTANT) {
        memcpy(to->blend_constant, from->blend_constant, sizeof to->blend_constant);
    }
    if (parts & VULKAN_DYNAMIC_DEPTH_BOUNDS) {
        memcpy(to->depth_bounds, from->depth_bounds, sizeof to->depth_bounds);
    }
    if (parts & VULKAN_DYNAMIC_COMPARE_MASK) {
        to->masks.read_front = from->masks.read_front;
        to->masks.read_back = from->masks.read_back;
    }
    if (parts & VULKAN_DYNAMIC_WRITE_MASK) {
        to->masks.write_front = from->masks.write_front;
        to->masks.write_back = from->masks.write_back;
    }
    if (parts & VULKAN_DYNAMIC_REFERENCE) {
        memcpy(to->reference, from->reference, sizeof to->reference);
    }
}

void vulkan_dynamic_apply(const struct vulkan_dynamic_state *state, uint32_t parts, rhw_context *context,
                          rhw_pass pass)
{
    if ((parts & VULKAN_DYNAMIC_VIEWPORT) && state->viewport_count > 0) {
        rhw_pass_set_viewports(context, pass, 0, (int)state->viewport_count, state->viewports);
    }
    if ((parts & VULKAN_DYNAMIC_SCISSOR) && state->scissor_count > 0) {
        rhw_pass_set_scissors(context, pass, 0, (int)state->scissor_count, state->scissors);
    }
    if (parts & VULKAN_DYNAMIC_LINE_WIDTH) {
        rhw_pass_set_line_width(context, pass, state->line_width);
    }
    if (parts & VULKAN_DYNAMIC_DEPTH_BIAS) {
        rhw_pass_set_depth_bias(context, pass, &state->depth_bias);
    }
    if (parts & VULKAN_DYNAMIC_LINE_STIPPLE) {
        rhw_pass_set_line_stipple(context, pass, &state->line_stipple);
    }
    if (parts & VULKAN_DYNAMIC_BLEND_CONSTANT) {
        rhw_pass_set_blend_constant(context, pass, state->blend_constant);
    }
    if (parts & VULKAN_DYNAMIC_DEPTH_BOUNDS) {
        rhw_pass_set_depth_bounds(context, pass, state->depth_bounds[0], state->depth_bounds[1]);
    }
    if (parts & (VULKAN_DYNAMIC_COMPARE_MASK | VULKAN_DYNAMIC_WRITE_MASK)) {
        rhw_pass_set_stencil_masks(context, pass, &state->masks);
    }
    if (parts & VULKAN_DYNAMIC_REFERENCE) {
        rhw_pass_set_stencil_reference(context, pass, state->reference[0], state->reference[1]);
    }
}
