// SPDX-License-Identifier: MIT
// What blending asks of a colour target, worked out once for a draw, and clear values.
#include "blend_state.h"

#include <string.h>

#include "half.h"
#include "srgb.h"

static uint8_t format_channels(enum rhw_format format)
{
    switch (format) {
    case RHW_FORMAT_R8_UNORM:
    case RHW_FORMAT_R32_FLOAT:
    case RHW_FORMAT_R32_UINT: return 1;
    case RHW_FORMAT_RG8_UNORM: return 3;
    default: return 15;
    }
}

static bool is_normalized(enum rhw_format format)
{
    return format == RHW_FORMAT_R8_UNORM || format == RHW_FORMAT_RG8_UNORM ||
           format == RHW_FORMAT_RGBA8_UNORM || format == RHW_FORMAT_RGBA8_SRGB;
}

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
    if (state->write_mask == 0) {
        return BLEND_NOTHING;
    }
    if (state->format == RHW_FORMAT_R32_UINT) {
        return BLEND_UINT_REPLACE;
    }
    if (state->format == RHW_FORMAT_RGBA8_UNORM && !state->blend) {
        return state->write_mask == 15 ? BLEND_RGBA8_REPLACE : BLEND_RGBA8_MASKED;
    }
    if (state->format == RHW_FORMAT_RGBA8_SRGB && !state->blend) {
        return BLEND_SRGB8_REPLACE;
    }
    if (state->format == RHW_FORMAT_RGBA8_UNORM && is_over(state->color) && is_over(state->alpha)) {
        return BLEND_RGBA8_OVER;
    }
    if (!is_normalized(state->format) && state->replaces) {
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
    state->format = target->format;
    state->color = target->color;
    state->alpha = target->alpha;
    state->color_one = target->color.src == RHW_BLEND_ONE;
    state->alpha_one = target->alpha.src == RHW_BLEND_ONE;
    state->write_mask = target->write_mask & format_channels(target->format);
    const bool normalized = is_normalized(target->format);
    state->blend = target->blend && target->format != RHW_FORMAT_R32_UINT &&
                   !(normalized && is_replacement(target->color) && is_replacement(target->alpha));
    state->replaces = !state->blend && state->write_mask == format_channels(target->format);
    for (int i = 0; i < 4; i++) {
        state->texel_mask |= state->write_mask >> i & 1 ? 0xffu << 8 * i : 0;
        state->constant[i] = normalized ? saturate(constant[i]) : constant[i];
    }
    state->path = choose_path(state);
}

// Adding 2^23 leaves no room for a fraction: the addition rounds to nearest, ties to even.
static unsigned char unorm8_from_float(float value)
{
    const float rounded = saturate(value) * 255.0f + 0x1p23f;
    uint32_t bits;
    memcpy(&bits, &rounded, sizeof bits);
    return (unsigned char)bits;
}

static uint32_t uint_from_float(float value)
{
    return value >= 0x1p32f ? UINT32_MAX : value > 0.0f ? (uint32_t)value : 0;
}

// Blending stores every NaN as this one, because the sign of the NaN that arithmetic makes differs
// between processors.
float rhw_canonical(float value)
{
    static const uint32_t quiet = 0x7fc00000;
    if (value != value) {
        memcpy(&value, &quiet, sizeof value);
    }
    return value;
}

void rhw_clear_texel(enum rhw_format format, const float clear[4], unsigned char texel[16])
{
    float value[4];
    uint16_t half[4];
    for (int i = 0; i < 4; i++) {
        value[i] = rhw_canonical(clear[i]);
        half[i] = rhw_half_from_float(value[i]);
    }
    memset(texel, 0, 16);
    switch (format) {
    case RHW_FORMAT_R8_UNORM:
    case RHW_FORMAT_RG8_UNORM:
    case RHW_FORMAT_RGBA8_UNORM:
        for (int i = 0; i < 4; i++) {
            texel[i] = unorm8_from_float(value[i]);
        }
        break;
    case RHW_FORMAT_RGBA8_SRGB:
        for (int i = 0; i < 3; i++) {
            texel[i] = rhw_srgb_encode(value[i]);
        }
        texel[3] = unorm8_from_float(value[3]);
        break;
    case RHW_FORMAT_RGBA16_FLOAT: memcpy(texel, half, sizeof half); break;
    case RHW_FORMAT_R32_UINT: {
        const uint32_t bits = uint_from_float(clear[0]);
        memcpy(texel, &bits, sizeof bits);
        break;
    }
    default: memcpy(texel, value, sizeof value); break;
    }
}
