// SPDX-License-Identifier: MIT
// Blending: 8 fragments in a row against 8 texels of a tile. Replacing and the usual blending of RGBA8 have paths of
// their own; every other combination goes through floats, one vector per channel.
//
// Texels of dead lanes are read and written back unchanged: a tile has one owner, and a load is cheaper
// than a branch.
#ifndef RHW_BLEND_H
#define RHW_BLEND_H

#include "../../blend_state.h"
#include "../texel/texel_codec.h"

// Gives the byte at `shift` of each lane as a float; exact.
RHW_INLINE f8 byte_to_float(i8 texel, int shift)
{
    return rhw_float_from_int((i8)((texel >> shift) & 0xff));
}

// RGBA8 blending with factors (SRC_ALPHA or ONE, ONE_MINUS_SRC_ALPHA), on the scale 0..255, which saves
// the destination a division: result = source · 255 · factor + destination · (1 − source alpha).
static inline void blend_rgba8_over(const struct rhw_blend_state *state, const f8 color[4], i8 mask,
                                    unsigned char *texels)
{
    const i8 old = i8_load(texels);
    const f8 alpha = rhw_saturate(color[3]);
    const f8 keep = 1.0f - alpha;
    const f8 color_scale = state->color_one ? rhw_splat(255.0f) : alpha * 255.0f;
    const f8 alpha_scale = state->alpha_one ? rhw_splat(255.0f) : alpha * 255.0f;
    f8 result[4];
    for (int i = 0; i < 3; i++) {
        result[i] = rhw_saturate(color[i]) * color_scale + byte_to_float(old, 8 * i) * keep;
    }
    result[3] = alpha * alpha_scale + rhw_float_from_int((i8)((u8)old >> 24)) * keep;
    const i8 packed = i8_bytes_from_small_f8(result); // ONE may carry the sum beyond 255
    const i8 written = mask & (i8)i8_splat((int32_t)state->texel_mask);
    i8_store(texels, old ^ ((old ^ packed) & written));
}

RHW_INLINE void store_target(const struct rhw_blend_state *state, const f8 value[4], i8 mask,
                             unsigned char *texels)
{
    struct raw_texels raw;
    encode_texels(state->format, value, &raw);
    store_texel_row(state->format->size, &raw, mask, state->texel_mask, texels);
}

// Gives the factor of channel `i` (3: alpha).
static inline f8 blend_factor(const struct rhw_blend_state *state, enum rhw_blend_factor factor,
                              const f8 src[4], const f8 dst[4], int i)
{
    switch (factor) {
    case RHW_BLEND_DEFAULT: break; // pipeline.c has put what it stands for in its place
    case RHW_BLEND_ZERO: return rhw_splat(0.0f);
    case RHW_BLEND_ONE: return rhw_splat(1.0f);
    case RHW_BLEND_SRC: return src[i];
    case RHW_BLEND_ONE_MINUS_SRC: return 1.0f - src[i];
    case RHW_BLEND_SRC_ALPHA: return src[3];
    case RHW_BLEND_ONE_MINUS_SRC_ALPHA: return 1.0f - src[3];
    case RHW_BLEND_DST: return dst[i];
    case RHW_BLEND_ONE_MINUS_DST: return 1.0f - dst[i];
    case RHW_BLEND_DST_ALPHA: return dst[3];
    case RHW_BLEND_ONE_MINUS_DST_ALPHA: return 1.0f - dst[3];
    case RHW_BLEND_SRC_ALPHA_SATURATED: return i == 3 ? rhw_splat(1.0f) : rhw_min(src[3], 1.0f - dst[3]);
    case RHW_BLEND_CONSTANT: return rhw_splat(state->constant[i]);
    case RHW_BLEND_ONE_MINUS_CONSTANT: return rhw_splat(1.0f - state->constant[i]);
    }
    return rhw_splat(0.0f);
}

static inline f8 blend_channel(const struct rhw_blend_state *state, const f8 src[4], const f8 dst[4], int i)
{
    const struct rhw_blend_component *const component = i == 3 ? &state->alpha : &state->color;
    if (component->operation == RHW_BLEND_MIN) { // MIN and MAX ignore the factors
        return rhw_min(src[i], dst[i]);
    }
    if (component->operation == RHW_BLEND_MAX) {
        return rhw_max(src[i], dst[i]);
    }
    const f8 a = src[i] * blend_factor(state, component->src, src, dst, i);
    const f8 b = dst[i] * blend_factor(state, component->dst, src, dst, i);
    switch (component->operation) {
    case RHW_BLEND_SUBTRACT: return a - b;
    case RHW_BLEND_REVERSE_SUBTRACT: return b - a;
    default: return a + b;
    }
}

// One NaN for all: which one arithmetic makes differs between processors.
RHW_INLINE f8 canonical_nan(f8 value)
{
    return rhw_select(rhw_equal(value, value), value, (f8)i8_splat(0x7fc00000));
}

// Serves any format and any blending. It is not inline, being large and seldom hot.
static __attribute__((noinline)) void blend_general(const struct rhw_blend_state *state, const f8 color[4],
                                                    const i8 *mask, unsigned char *texels)
{
    const bool normalized = rhw_codec_is_normalized(state->format->codec);
    struct raw_texels raw;
    f8 src[4], dst[4], result[4];
    load_texel_row(state->format->size, texels, &raw);
    decode_texels(state->format, &raw, dst);
    for (int i = 0; i < 4; i++) {
        src[i] = normalized ? rhw_saturate(color[i]) : color[i];
    }
    for (int i = 0; i < 4; i++) {
        const f8 value = state->blend ? blend_channel(state, src, dst, i) : src[i];
        result[i] = state->write_mask >> i & 1 ? canonical_nan(value) : dst[i];
    }
    store_target(state, result, *mask, texels);
}

// Blends 8 fragments into the 8 texels at `texels`, in the target's format; lanes whose mask is 0 keep
// theirs.
RHW_INLINE void blend_group(const struct rhw_blend_state *state, const f8 color[4], i8 mask,
                            unsigned char *texels)
{
    switch (state->path) {
    case BLEND_NOTHING: break;
    case BLEND_RGBA8_REPLACE:
    case BLEND_RGBA8_MASKED: {
        const i8 packed = unorm8_texels(color);
        if (state->path == BLEND_RGBA8_REPLACE) {
            store_words(texels, packed, mask);
        } else {
            store_word_bits(texels, packed, mask & i8_splat((int32_t)state->texel_mask));
        }
        break;
    }
    case BLEND_RGBA8_OVER: blend_rgba8_over(state, color, mask, texels); break;
    case BLEND_SRGB8_REPLACE: {
        store_word_bits(texels, srgb8_texels(color), mask & i8_splat((int32_t)state->texel_mask));
        break;
    }
    case BLEND_UINT_REPLACE: store_words(texels, (i8)color[0], mask); break;
    case BLEND_FLOAT_REPLACE: {
        f8 value[4];
        for (int i = 0; i < 4; i++) {
            value[i] = canonical_nan(color[i]);
        }
        store_target(state, value, mask, texels);
        break;
    }
    case BLEND_GENERAL: blend_general(state, color, &mask, texels); break;
    }
}

// Puts the texels of a scattered group side by side for blending, and back.
RHW_INLINE void gather_texels(const int32_t at[8], const unsigned char *texels, size_t size,
                              unsigned char *out)
{
    for (int i = 0; i < 8; i++) {
        memcpy(out + (size_t)i * size, texels + (size_t)at[i] * size, size);
    }
}

RHW_INLINE void scatter_texels(const int32_t at[8], unsigned bits, unsigned char *texels, size_t size,
                               const unsigned char *from)
{
    if (bits == 0xff) {
        for (int i = 0; i < 8; i++) {
            memcpy(texels + (size_t)at[i] * size, from + (size_t)i * size, size);
        }
        return;
    }
    for (; bits != 0; bits &= bits - 1) {
        const int lane = __builtin_ctz(bits);
        memcpy(texels + (size_t)at[lane] * size, from + (size_t)lane * size, size);
    }
}

#endif
