// SPDX-License-Identifier: MIT
// What blending asks of a colour target, worked out once for a draw, and clear values.
#include "blend_state.h"

#include <string.h>

static bool is_over(struct rhw_blend_component component)
{
    return (component.src == RHW_BLEND_SRC_ALPHA || component.src == RHW_BLEND_ONE) &&
           component.dst == RHW_BLEND_ONE_MINUS_SRC_ALPHA && component.operation == RHW_BLEND_ADD;
}

// Return true for src + dst, which adds lights.
static bool is_sum(struct rhw_blend_component component)
{
    return component.src == RHW_BLEND_ONE && component.dst == RHW_BLEND_ONE &&
           component.operation == RHW_BLEND_ADD;
}

// Return true for src × 1 + dst × 0. It is replacement, which has faster paths than blending. For float formats the two
// differ: 0 × infinity is NaN.
static bool is_replacement(struct rhw_blend_component component)
{
    return component.src == RHW_BLEND_ONE && component.dst == RHW_BLEND_ZERO &&
           component.operation == RHW_BLEND_ADD;
}

static enum rhw_blend_path choose_path(const struct rhw_blend_state *state)
{
    const struct rhw_format_info *const format = state->format;
    if (state->write_mask == 0) {
        return BLEND_NOTHING;
    }
    if (state->logic != RHW_LOGIC_OFF) {
        return BLEND_GENERAL;
    }
    if (format->codec == RHW_CODEC_BITS32 && format->channels == 1) {
        return BLEND_BITS_REPLACE;
    }
    if (format->path == RHW_TEXELS_RGBA8_UNORM && !state->blend) {
        return state->write_mask == 15 ? BLEND_RGBA8_REPLACE : BLEND_RGBA8_MASKED;
    }
    if (format->path == RHW_TEXELS_RGBA8_SRGB && !state->blend) {
        return BLEND_SRGB8_REPLACE;
    }
    if (format->path == RHW_TEXELS_RGBA8_UNORM && is_over(state->color) && is_over(state->alpha)) {
        return BLEND_RGBA8_OVER;
    }
    if (format->path == RHW_TEXELS_RGBA8_SRGB && is_over(state->color) && is_over(state->alpha)) {
        return BLEND_SRGB8_OVER;
    }
    if (format->path == RHW_TEXELS_RGBA8_UNORM && is_sum(state->color) && is_sum(state->alpha)) {
        return BLEND_RGBA8_SUM;
    }
    if (state->blend && state->writes_all && is_over(state->color) && is_over(state->alpha)) {
        return BLEND_OVER;
    }
    return state->replaces ? BLEND_REPLACE : BLEND_GENERAL;
}

static float clamp(float value, float least)
{
    const float above = value > least ? value : least;
    return above < 1.0f ? above : 1.0f;
}

// Return true if logical operations apply to the format. Floats and sRGB have none (Vulkan 1.3 §29.2).
static bool has_logic(const struct rhw_format_info *format)
{
    return rhw_format_is_integer(format) ||
           (rhw_format_is_normalized(format) && format->codec != RHW_CODEC_SRGB8);
}

static bool is_second(enum rhw_blend_factor factor)
{
    return factor >= RHW_BLEND_SRC1 && factor <= RHW_BLEND_ONE_MINUS_SRC1_ALPHA;
}

bool rhw_blend_reads_second(const struct rhw_color_target *target)
{
    return target->blend && (is_second(target->color.src) || is_second(target->color.dst) ||
                             is_second(target->alpha.src) || is_second(target->alpha.dst));
}

void rhw_blend_state_init(struct rhw_blend_state *state, const struct rhw_color_target *target,
                          enum rhw_logic logic, const float constant[4])
{
    memset(state, 0, sizeof *state);
    const struct rhw_format_info *const format = rhw_format_info(target->format);
    const bool normalized = rhw_format_is_normalized(format);
    const uint8_t channels = (uint8_t)((1 << format->channels) - 1);
    state->format = format;
    state->color = target->color;
    state->alpha = target->alpha;
    state->color_one = target->color.src == RHW_BLEND_ONE;
    state->alpha_one = target->alpha.src == RHW_BLEND_ONE;
    state->write_mask = target->write_mask & channels;
    state->logic = has_logic(format) ? logic : RHW_LOGIC_OFF;
    state->least = rhw_format_least(format);
    state->blend = target->blend && logic == RHW_LOGIC_OFF &&
                   rhw_format_has_role(format, RHW_ROLE_BLENDED_TARGET) &&
                   !(normalized && is_replacement(target->color) && is_replacement(target->alpha));
    state->reads_second = state->blend && rhw_blend_reads_second(target);
    state->writes_all = state->write_mask == channels;
    state->replaces = !state->blend && state->logic == RHW_LOGIC_OFF && state->writes_all;
    if (state->writes_all) {
        memset(state->texel_mask, 0xff, sizeof state->texel_mask);
    }
    for (int i = 0; i < 4; i++) {
        if (state->write_mask >> i & 1 && !state->writes_all) {
            rhw_format_channel_bits(format, i, state->texel_mask);
        }
        state->constant[i] = normalized ? clamp(constant[i], state->least) : constant[i];
    }
    state->known = target->format;
    state->is_sum = is_sum(state->color) && is_sum(state->alpha);
    state->path = choose_path(state);
}

void rhw_blend_state_generalize(struct rhw_blend_state *state)
{
    state->known = RHW_FORMAT_NONE;
    state->is_sum = false;
    switch (state->path) {
    case BLEND_RGBA8_REPLACE:
    case BLEND_RGBA8_MASKED:
    case BLEND_SRGB8_REPLACE:
    case BLEND_SRGB8_OVER:
    case BLEND_RGBA8_SUM:
    case BLEND_REPLACE:
    case BLEND_OVER: state->path = BLEND_GENERAL; break;
    default: break;
    }
}
