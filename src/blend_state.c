// SPDX-License-Identifier: MIT
// What blending asks of a colour target, worked out once for a draw, and clear values.
#include "blend_state.h"

#include <string.h>

#include "texel.h"

static bool is_over(struct rhw_blend_component component)
{
    return (component.src == RHW_BLEND_SRC_ALPHA || component.src == RHW_BLEND_ONE) &&
           component.dst == RHW_BLEND_ONE_MINUS_SRC_ALPHA && component.operation == RHW_BLEND_ADD;
}

// src × 1 + dst × 0 is replacement, which has faster paths than blending. For float formats it is not the
// same: 0 × infinity is NaN.
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
    if (format->codec == RHW_CODEC_UINT32) {
        return BLEND_UINT_REPLACE;
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
    if (!rhw_codec_is_normalized(format->codec) && state->replaces) {
        return BLEND_FLOAT_REPLACE;
    }
    return BLEND_GENERAL;
}

static float saturate(float value)
{
    const float above = value > 0.0f ? value : 0.0f;
    return above < 1.0f ? above : 1.0f;
}

void rhw_blend_state_init(struct rhw_blend_state *state, const struct rhw_color_target *target,
                          const float constant[4])
{
    memset(state, 0, sizeof *state);
    const struct rhw_format_info *const format = rhw_format_info(target->format);
    const bool normalized = rhw_codec_is_normalized(format->codec);
    const uint8_t channels = (uint8_t)((1 << format->channels) - 1);
    state->format = format;
    state->color = target->color;
    state->alpha = target->alpha;
    state->color_one = target->color.src == RHW_BLEND_ONE;
    state->alpha_one = target->alpha.src == RHW_BLEND_ONE;
    state->write_mask = target->write_mask & channels;
    state->blend = target->blend && rhw_format_has_role(format, RHW_ROLE_BLENDED_TARGET) &&
                   !(normalized && is_replacement(target->color) && is_replacement(target->alpha));
    state->replaces = !state->blend && state->write_mask == channels;
    for (int i = 0; i < 4; i++) {
        state->texel_mask |= !normalized || state->write_mask >> i & 1 ? 0xffu << 8 * i : 0;
        state->constant[i] = normalized ? saturate(constant[i]) : constant[i];
    }
    state->path = choose_path(state);
}

static uint32_t uint_from_float(float value)
{
    return value >= 0x1p32f ? UINT32_MAX : value > 0.0f ? (uint32_t)value : 0;
}

void rhw_blend_state_generalize(struct rhw_blend_state *state)
{
    switch (state->path) {
    case BLEND_RGBA8_REPLACE:
    case BLEND_RGBA8_MASKED:
    case BLEND_SRGB8_REPLACE:
    case BLEND_FLOAT_REPLACE: state->path = BLEND_GENERAL; break;
    default: break;
    }
}

void rhw_clear_texel(const struct rhw_format_info *format, const float clear[4], unsigned char *texel)
{
    float value[4];
    for (int c = 0; c < 4; c++) {
        value[c] = rhw_texel_is_code(format, c) ? saturate(clear[c]) * 255.0f : clear[c];
        if (format->codec == RHW_CODEC_UINT32) {
            const uint32_t bits = uint_from_float(clear[c]);
            memcpy(&value[c], &bits, sizeof bits);
        }
    }
    rhw_texel_store(format, value, texel);
}
