// SPDX-License-Identifier: MIT
// Blending writes 8 fragments in a row over 8 texels of a tile. Replacing and the usual blending of RGBA8 have paths of
// their own; every other combination goes through floats, one vector per channel.
//
// Texels of dead lanes are read and written back unchanged: a tile has one owner, and a load is cheaper than a branch.
#ifndef RHW_BLEND_H
#define RHW_BLEND_H

#include "pipeline/blend_state.h"
#include "kernels/texel/texel_codec.h"
#include "format/format_table.h"

// Return the byte at `shift` of each lane as a float; it is exact.
RHW_INLINE f32x8 byte_to_float(i32x8 texel, int shift)
{
    return rhw_float_from_int((i32x8)((texel >> shift) & 0xff));
}

// Blend RGBA8 with factors (SRC_ALPHA or ONE, ONE_MINUS_SRC_ALPHA), on the scale 0..255. This saves the destination a
// division: result = source · 255 · factor + destination · (1 − source alpha).
static inline void blend_rgba8_over(const struct rhw_blend_state *state, const f32x8 color[4], i32x8 mask,
                                    unsigned char *texels)
{
    const i32x8 old = i32x8_load(texels);
    const f32x8 alpha = rhw_saturate(color[3]);
    const f32x8 keep = 1.0f - alpha;
    const f32x8 color_scale = state->color_one ? rhw_splat(255.0f) : alpha * 255.0f;
    const f32x8 alpha_scale = state->alpha_one ? rhw_splat(255.0f) : alpha * 255.0f;
    f32x8 result[4];
    for (int i = 0; i < 3; i++) {
        result[i] = rhw_saturate(color[i]) * color_scale + byte_to_float(old, 8 * i) * keep;
    }
    result[3] = alpha * alpha_scale + rhw_float_from_int((i32x8)((u32x8)old >> 24)) * keep;
    const i32x8 packed = i32x8_bytes_from_small_f32x8(result); // ONE may carry the sum beyond 255
    const i32x8 written = mask & (i32x8)i32x8_splat((int32_t)state->texel_mask[0]);
    i32x8_store(texels, old ^ ((old ^ packed) & written));
}

// Blend RGBA8_SRGB by the usual factors in linear light. The result has the bytes of the general path.
static __attribute__((noinline)) void blend_srgb8_over(const struct rhw_blend_state *state,
                                                       const f32x8 *color, const i32x8 *mask,
                                                       unsigned char *texels)
{
    const i32x8 old = i32x8_load(texels);
    const f32x8 alpha = rhw_saturate(color[3]);
    const f32x8 keep = 1.0f - alpha;
    f32x8 result[4];
    for (int i = 0; i < 3; i++) {
        const f32x8 src = rhw_saturate(color[i]);
        result[i] = (state->color_one ? src : src * alpha) + srgb8_to_float(channel_byte(old, i)) * keep;
    }
    result[3] = (state->alpha_one ? alpha : alpha * alpha) + unorm8_to_float(channel_byte(old, 3)) * keep;
    store_word_bits(texels, srgb8_texels(result), *mask & (i32x8)i32x8_splat((int32_t)state->texel_mask[0]));
}

// Blend RGBA8 with factors ONE and ONE. The result has the bytes of the general path. This path takes 8 % of
// shadow_volumes' instructions away.
static __attribute__((noinline)) void blend_rgba8_sum(const struct rhw_blend_state *state, const f32x8 *color,
                                                      const i32x8 *mask, unsigned char *texels)
{
    const i32x8 old = i32x8_load(texels);
    f32x8 result[4];
    for (int i = 0; i < 4; i++) {
        result[i] = rhw_saturate(color[i]) + unorm8_to_float(channel_byte(old, i));
    }
    store_word_bits(texels, unorm8_texels(result), *mask & (i32x8)i32x8_splat((int32_t)state->texel_mask[0]));
}

// Return the factor of channel `i`; channel 3 is alpha. src[4..7] is the second source.
static inline f32x8 any_blend_factor(const struct rhw_blend_state *state, enum rhw_blend_factor factor,
                                     const f32x8 *src, const f32x8 dst[4], int i)
{
    switch (factor) {
    case RHW_BLEND_DEFAULT: break; // pipeline.c has put another factor in its place
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
    case RHW_BLEND_CONSTANT_ALPHA: return rhw_splat(state->constant[3]);
    case RHW_BLEND_ONE_MINUS_CONSTANT_ALPHA: return rhw_splat(1.0f - state->constant[3]);
    case RHW_BLEND_SRC1: return src[4 + i];
    case RHW_BLEND_ONE_MINUS_SRC1: return 1.0f - src[4 + i];
    case RHW_BLEND_SRC1_ALPHA: return src[7];
    case RHW_BLEND_ONE_MINUS_SRC1_ALPHA: return 1.0f - src[7];
    }
    return rhw_splat(0.0f);
}

// Return a blend factor as a target holds it: 1 less a negative value of an SNORM format is above 1 (Vulkan 1.3 §29.1).
static inline f32x8 blend_factor(const struct rhw_blend_state *state, enum rhw_blend_factor factor,
                                 const f32x8 *src, const f32x8 dst[4], int i)
{
    const f32x8 value = any_blend_factor(state, factor, src, dst, i);
    return state->least < 0 ? rhw_min(value, rhw_splat(1.0f)) : value;
}

static inline f32x8 blend_channel(const struct rhw_blend_state *state, const f32x8 *src, const f32x8 dst[4],
                                  int i)
{
    const struct rhw_blend_component *const component = i == 3 ? &state->alpha : &state->color;
    if (component->operation == RHW_BLEND_MIN) { // MIN and MAX ignore the factors
        return rhw_min(src[i], dst[i]);
    }
    if (component->operation == RHW_BLEND_MAX) {
        return rhw_max(src[i], dst[i]);
    }
    const f32x8 a = src[i] * blend_factor(state, component->src, src, dst, i);
    const f32x8 b = dst[i] * blend_factor(state, component->dst, src, dst, i);
    switch (component->operation) {
    case RHW_BLEND_SUBTRACT: return a - b;
    case RHW_BLEND_REVERSE_SUBTRACT: return b - a;
    default: return a + b;
    }
}

// Return the outcome of a logic operation (Vulkan 1.3 §29.2, "Logical Operations").
RHW_INLINE i32x8 combine_bits(enum rhw_logic logic, i32x8 src, i32x8 dst)
{
    switch (logic) {
    case RHW_LOGIC_CLEAR: return i32x8_splat(0);
    case RHW_LOGIC_AND: return src & dst;
    case RHW_LOGIC_AND_REVERSE: return src & ~dst;
    case RHW_LOGIC_AND_INVERTED: return ~src & dst;
    case RHW_LOGIC_NO_OP: return dst;
    case RHW_LOGIC_XOR: return src ^ dst;
    case RHW_LOGIC_OR: return src | dst;
    case RHW_LOGIC_NOR: return ~(src | dst);
    case RHW_LOGIC_EQUIVALENT: return ~(src ^ dst);
    case RHW_LOGIC_INVERT: return ~dst;
    case RHW_LOGIC_OR_REVERSE: return src | ~dst;
    case RHW_LOGIC_COPY_INVERTED: return ~src;
    case RHW_LOGIC_OR_INVERTED: return ~src | dst;
    case RHW_LOGIC_NAND: return ~(src & dst);
    case RHW_LOGIC_SET: return i32x8_splat(-1);
    default: return src;
    }
}

// Set the blended values of the first `count` channels.
static __attribute__((noinline)) void blend_any_values(const struct rhw_blend_state *state, const f32x8 *src,
                                                       const f32x8 *dst, int count, f32x8 *result)
{
    for (int i = 0; i < count; i++) {
        result[i] = blend_channel(state, src, dst, i);
    }
}

// Set the blended values of the channels that the format has. Sums have the operations of blend_channel.
RHW_INLINE void blend_values(const struct rhw_blend_state *state, const struct rhw_format_info *format,
                             const struct raw_texels *old, const f32x8 *src, f32x8 result[4])
{
    f32x8 dst[4];
    decode_texels(format, old, dst);
    if (!state->is_sum) {
        blend_any_values(state, src, dst, format->channels, result);
        return;
    }
    for (int i = 0; i < format->channels; i++) {
        result[i] = src[i] + dst[i];
    }
}

// Set four values as a normalized format holds them; NaN becomes 0.
RHW_INLINE void clamp_values(const struct rhw_format_info *format, const f32x8 *value, f32x8 *clamped)
{
    const float least = rhw_format_least(format);
    for (int i = 0; i < 4; i++) {
        clamped[i] = rhw_clamp(value[i], rhw_splat(least), rhw_splat(1.0f));
    }
    for (int i = 0; i < 4 && least < 0; i++) {
        clamped[i] = rhw_select(rhw_equal(value[i], value[i]), clamped[i], rhw_splat(0.0f));
    }
}

// Put into texels the old bits that they keep, and the bits that logic operations make of the old ones.
static __attribute__((noinline)) void merge_bits(const struct rhw_blend_state *state,
                                                 const struct raw_texels *old, struct raw_texels *raw)
{
    for (int w = 0; w < (state->format->size + 3) / 4; w++) {
        const i32x8 word = combine_bits(state->logic, raw->word[w], old->word[w]);
        raw->word[w] = old->word[w] ^ ((old->word[w] ^ word) & (int32_t)state->texel_mask[w]);
    }
}

// Encode values. The codecs of normalized formats clamp, and make 0 of NaN; floats without a sign have one NaN.
RHW_INLINE void encode_values(const struct rhw_format_info *format, const f32x8 *value,
                              struct raw_texels *raw)
{
    f32x8 number[4] = {rhw_splat(0.0f), rhw_splat(0.0f), rhw_splat(0.0f), rhw_splat(0.0f)};
    const bool keeps_nan = rhw_format_is_normalized(format) || rhw_format_is_integer(format) ||
                           format->type == RHW_CHANNEL_UFLOAT;
    for (int i = 0; i < format->channels; i++) {
        number[i] = keeps_nan ? value[i] : canonical_nan(value[i]);
    }
    encode_texels(format, number, raw);
}

// Groups of 8 fragments, and the rows of 8 texels of a target that they are put into.
struct texel_rows {
    int count;
    const f32x8 *color;    // 4 channels of group 0, and a second source behind them
    size_t stride;         // vectors from a group's color to the next one's
    unsigned char *texels; // a tile
    const int32_t *at;     // the number of the first texel of each row
    const i32x8 *mask;     // lanes of the only group that count; NULL: all lanes of all groups
};

RHW_INLINE void store_row(const struct texel_rows *rows, const struct rhw_format_info *format,
                          const struct raw_texels *raw, unsigned char *texels)
{
    if (rows->mask) {
        store_texel_row(format->size, raw, *rows->mask, texels);
    } else {
        store_texel_row(format->size, raw, i32x8_splat(-1), texels);
    }
}

// Put values into the place of texels of a format. Where a call names the format, it is a constant of this function.
// Texels may be anything to the compiler, so what the loops need of `rows` is loaded before them.
RHW_INLINE void replace_format(const struct rhw_format_info *format, const struct texel_rows *rows)
{
    const struct texel_rows all = *rows;
    for (int g = 0; g < all.count; g++) {
        struct raw_texels raw;
        encode_values(format, all.color + (size_t)g * all.stride, &raw);
        store_row(&all, format, &raw, all.texels + (size_t)all.at[g] * format->size);
    }
}

RHW_INLINE void blend_format(const struct rhw_blend_state *state, const struct rhw_format_info *format,
                             const struct texel_rows *rows)
{
    const struct texel_rows all = *rows;
    for (int g = 0; g < all.count; g++) {
        unsigned char *const texels = all.texels + (size_t)all.at[g] * format->size;
        const f32x8 *src = all.color + (size_t)g * all.stride;
        struct raw_texels old, raw;
        f32x8 clamped[8], result[4];
        load_texel_row(format->size, texels, &old);
        if (rhw_format_is_normalized(format)) {
            if (state->reads_second) {
                clamp_values(format, src + 4, clamped + 4);
            }
            clamp_values(format, src, clamped);
            src = clamped;
        }
        if (state->blend) {
            blend_values(state, format, &old, src, result);
            src = result;
        }
        encode_values(format, src, &raw);
        if (!state->writes_all || state->logic != RHW_LOGIC_OFF) {
            merge_bits(state, &old, &raw);
        }
        store_row(&all, format, &raw, texels);
    }
}

// Encode what was blended. A normalized format blends clamped sources with texels, all of them finite, so SNORM need
// not ask for NaN again, which takes two operations a channel.
RHW_INLINE void encode_blended(const struct rhw_format_info *format, const f32x8 *value,
                               struct raw_texels *raw)
{
    if (format->type == RHW_CHANNEL_SNORM && __builtin_constant_p(format->bits[0])) {
        raw->word[0] = raw->word[1] = i32x8_splat(0);
        encode_normalized(format, value, true, raw->word);
    } else {
        encode_values(format, value, raw);
    }
}

// Blend by the usual factors, with the operations of blend_format.
RHW_INLINE void blend_format_over(const struct rhw_blend_state *state, const struct rhw_format_info *format,
                                  const struct texel_rows *rows)
{
    const struct texel_rows all = *rows;
    const bool color_one = state->color_one, alpha_one = state->alpha_one;
    for (int g = 0; g < all.count; g++) {
        unsigned char *const texels = all.texels + (size_t)all.at[g] * format->size;
        const f32x8 *src = all.color + (size_t)g * all.stride;
        struct raw_texels old, raw;
        f32x8 clamped[4], dst[4], result[4];
        load_texel_row(format->size, texels, &old);
        decode_texels(format, &old, dst);
        if (rhw_format_is_normalized(format)) {
            clamp_values(format, src, clamped);
            src = clamped;
        }
        f32x8 keep = 1.0f - src[3];
        if (rhw_format_least(format) < 0) {
            keep = rhw_min(keep, rhw_splat(1.0f)); // see blend_factor
        }
        for (int i = 0; i < format->channels; i++) {
            result[i] = ((i == 3 ? alpha_one : color_one) ? src[i] : src[i] * src[3]) + dst[i] * keep;
        }
        encode_blended(format, result, &raw);
        store_row(&all, format, &raw, texels);
    }
}

enum texel_action { BLEND_TEXELS, BLEND_TEXELS_OVER, REPLACE_TEXELS };

// A compiler that does not optimize keeps room on the stack for all that it puts into a function, which would be 1.9 MB
// for all formats, of the 2 MiB that a thread of Windows has.
#ifdef __OPTIMIZE__
RHW_INLINE
#else
static
#endif
void act_on_format(enum texel_action action, const struct rhw_blend_state *state,
                   const struct rhw_format_info *format, const struct texel_rows *rows)
{
    switch (action) {
    case REPLACE_TEXELS: replace_format(format, rows); break;
    case BLEND_TEXELS_OVER: blend_format_over(state, format, rows); break;
    case BLEND_TEXELS: blend_format(state, format, rows); break;
    }
}

// Act on the state's format, as a constant where it is common as a target.
RHW_INLINE void act_on_known_format(enum texel_action action, const struct rhw_blend_state *state,
                                    const struct texel_rows *rows)
{
#define ACT_ON(name) \
    case RHW_FORMAT_##name: act_on_format(action, state, &rhw_format_table[RHW_FORMAT_##name], rows); break
    switch (state->known) {
        ACT_ON(R8_UNORM);
        ACT_ON(RG8_UNORM);
        ACT_ON(RGBA8_UNORM);
        ACT_ON(BGRA8_UNORM);
        ACT_ON(ABGR8_UNORM);
        ACT_ON(RGBA8_SRGB);
        ACT_ON(BGRA8_SRGB);
        ACT_ON(ABGR8_SRGB);
        ACT_ON(R8_SNORM);
        ACT_ON(RG8_SNORM);
        ACT_ON(RGBA8_SNORM);
        ACT_ON(R16_UNORM);
        ACT_ON(RG16_UNORM);
        ACT_ON(RGBA16_UNORM);
        ACT_ON(R16_SNORM);
        ACT_ON(RG16_SNORM);
        ACT_ON(RGBA16_SNORM);
        ACT_ON(RGB10A2_UNORM);
        ACT_ON(RG11B10_FLOAT);
        ACT_ON(RGB565_UNORM);
        ACT_ON(RGBA4_UNORM);
        ACT_ON(RGB5A1_UNORM);
        ACT_ON(BGRA4_UNORM);
        ACT_ON(A1RGB5_UNORM);
        ACT_ON(R16_FLOAT);
        ACT_ON(RG16_FLOAT);
        ACT_ON(RGBA16_FLOAT);
        ACT_ON(R32_FLOAT);
        ACT_ON(RG32_FLOAT);
        ACT_ON(RGBA32_FLOAT);
    default: act_on_format(action, state, state->format, rows); break;
    }
#undef ACT_ON
}

// Blend any format in any way. The write mask counts bits, so that what is kept stays as it was. This function and the
// next two are not inline, being large, and take rows together, for what a call costs.
static __attribute__((noinline)) void blend_rows(const struct rhw_blend_state *state,
                                                 const struct texel_rows *rows)
{
    act_on_known_format(BLEND_TEXELS, state, rows);
}

// Blend all channels of any format by the usual factors.
static __attribute__((noinline)) void blend_rows_over(const struct rhw_blend_state *state,
                                                      const struct texel_rows *rows)
{
    act_on_known_format(BLEND_TEXELS_OVER, state, rows);
}

// Put values into the place of texels of any format.
static __attribute__((noinline)) void replace_rows(const struct rhw_blend_state *state,
                                                   const struct texel_rows *rows)
{
    act_on_known_format(REPLACE_TEXELS, state, rows);
}

// Take one of the paths of any format.
RHW_INLINE void act_on_rows(const struct rhw_blend_state *state, const struct texel_rows *rows)
{
    if (state->path == BLEND_REPLACE) {
        replace_rows(state, rows);
    } else if (state->path == BLEND_OVER) {
        blend_rows_over(state, rows);
    } else {
        blend_rows(state, rows);
    }
}

// Return one row, at `texels`.
RHW_INLINE struct texel_rows one_row(const f32x8 *color, const i32x8 *mask, unsigned char *texels)
{
    static const int32_t at = 0;
    return (struct texel_rows){.count = 1, .color = color, .texels = texels, .at = &at, .mask = mask};
}

// Blend 8 fragments into the 8 texels at `texels`, in the target's format. Lanes whose mask is 0 keep their texels.
// `color` has 4 channels. Behind them stand the channels of the second source if the state reads it.
RHW_INLINE void blend_group(const struct rhw_blend_state *state, const f32x8 *color, i32x8 mask,
                            unsigned char *texels)
{
    switch (state->path) {
    case BLEND_NOTHING: break;
    case BLEND_RGBA8_REPLACE:
    case BLEND_RGBA8_MASKED: {
        const i32x8 packed = unorm8_texels(color);
        if (state->path == BLEND_RGBA8_REPLACE) {
            store_words(texels, packed, mask);
        } else {
            store_word_bits(texels, packed, mask & i32x8_splat((int32_t)state->texel_mask[0]));
        }
        break;
    }
    case BLEND_RGBA8_OVER: blend_rgba8_over(state, color, mask, texels); break;
    case BLEND_SRGB8_REPLACE: {
        store_word_bits(texels, srgb8_texels(color), mask & i32x8_splat((int32_t)state->texel_mask[0]));
        break;
    }
    case BLEND_SRGB8_OVER: blend_srgb8_over(state, color, &mask, texels); break;
    case BLEND_RGBA8_SUM: blend_rgba8_sum(state, color, &mask, texels); break;
    case BLEND_BITS_REPLACE: store_words(texels, (i32x8)color[0], mask); break;
    case BLEND_REPLACE:
    case BLEND_OVER:
    case BLEND_GENERAL: {
        const i32x8 lanes = mask; // a copy, so that the mask of other paths stays in a register
        const struct texel_rows row = one_row(color, &lanes, texels);
        act_on_rows(state, &row);
        break;
    }
    }
}

// Return true if a path puts whole texels in the place of others, whatever these held.
RHW_INLINE bool replaces_texels(const struct rhw_blend_state *state)
{
    switch (state->path) {
    case BLEND_RGBA8_REPLACE:
    case BLEND_BITS_REPLACE:
    case BLEND_REPLACE: return true;
    case BLEND_SRGB8_REPLACE: return state->writes_all;
    default: return false;
    }
}

RHW_INLINE bool replaces_words(const struct rhw_blend_state *state)
{
    return replaces_texels(state) && state->format->size == 4;
}

// Set the texels that a path puts in the place of others.
RHW_INLINE void replacing_texels(const struct rhw_blend_state *state, const f32x8 *color,
                                 unsigned char texels[RHW_LANES * RHW_TEXEL_BYTES])
{
    const struct texel_rows row = one_row(color, NULL, texels);
    switch (state->path) {
    case BLEND_RGBA8_REPLACE: i32x8_store(texels, unorm8_texels(color)); break;
    case BLEND_SRGB8_REPLACE: i32x8_store(texels, srgb8_texels(color)); break;
    case BLEND_REPLACE: replace_rows(state, &row); break;
    default: i32x8_store(texels, (i32x8)color[0]); break;
    }
}

// Return texels of 4 bytes that replace others, as words.
RHW_INLINE i32x8 replacing_words(const struct rhw_blend_state *state, const f32x8 *color)
{
    _Alignas(32) unsigned char texels[RHW_LANES * RHW_TEXEL_BYTES] = {0};
    switch (state->path) {
    case BLEND_RGBA8_REPLACE: return unorm8_texels(color);
    case BLEND_SRGB8_REPLACE: return srgb8_texels(color);
    case BLEND_REPLACE: replacing_texels(state, color, texels); return i32x8_load(texels);
    default: return (i32x8)color[0];
    }
}

// Scattered groups -------------------------------------------------------------------------------------

RHW_INLINE void gather_sized(const int32_t at[8], const unsigned char *texels, size_t size,
                             unsigned char *out)
{
    for (int i = 0; i < 8; i++) {
        memcpy(out + (size_t)i * size, texels + (size_t)at[i] * size, size);
    }
}

RHW_INLINE void scatter_sized(const int32_t at[8], unsigned bits, unsigned char *texels, size_t size,
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

// gather_texels puts the texels of a scattered group side by side for blending, and scatter_texels puts them back. The
// usual sizes are constants: 16 calls of memcpy would take longer than the blending. Words are loaded into lanes. A
// vector that is read from where single words were just written waits until all of these are in the cache: this took
// particles 11 % of their time.
RHW_INLINE void gather_texels(const int32_t at[8], const unsigned char *texels, size_t size,
                              unsigned char *out)
{
    switch (size) {
    case 1: gather_sized(at, texels, 1, out); break;
    case 2: gather_sized(at, texels, 2, out); break;
    case 4: i32x8_store(out, i32x8_gather(texels, i32x8_load(at))); break;
    case 8: gather_sized(at, texels, 8, out); break;
    case 16: gather_sized(at, texels, 16, out); break;
    default: gather_sized(at, texels, size, out); break;
    }
}

RHW_INLINE void scatter_texels(const int32_t at[8], unsigned bits, unsigned char *texels, size_t size,
                               const unsigned char *from)
{
    switch (size) {
    case 1: scatter_sized(at, bits, texels, 1, from); break;
    case 2: scatter_sized(at, bits, texels, 2, from); break;
    case 4: scatter_sized(at, bits, texels, 4, from); break;
    case 8: scatter_sized(at, bits, texels, 8, from); break;
    case 16: scatter_sized(at, bits, texels, 16, from); break;
    default: scatter_sized(at, bits, texels, size, from); break;
    }
}

#endif
