// SPDX-License-Identifier: MIT
// 8 texels of any format become floats and back. The sampler gathers its texels from anywhere in a level; blending
// loads and stores the texels of a row. Between them and the floats stand the texels' own words, so that a codec is
// written once.
#ifndef RHW_TEXEL_CODEC_H
#define RHW_TEXEL_CODEC_H

#include "format/format.h"
#include "base/simd_layout.h"
#include "format/srgb.h"
#include "texel_fields.h"

// 8 texels as they stand in memory, in words of 4 bytes. A smaller texel stands in the low bytes of the first word,
// with zero above.
struct raw_texels {
    i32x8 word[4];
};

// Codes of 8 bits ------------------------------------------------------------------------------------

// Return c / 255 correctly rounded, for whole c of 0..255.
RHW_INLINE f32x8 unorm8_to_float(i32x8 code)
{
    return unit_of_steps(rhw_float_from_int(code), 8, 1.0f);
}

// Return values in any range as codes in the lowest byte of each lane, with rubbish above. From 2^23 on floats have no
// fraction, so adding it rounds to nearest, ties to even, and leaves the integer in the low bits. This gives equal bits
// on every instruction set and needs no conversion.
RHW_INLINE i32x8 unorm8_from_float(f32x8 value)
{
    return (i32x8)(rhw_saturate(value) * 255.0f + 0x1p23f);
}

// Return linear values of sRGB codes. A polynomial as exact as the table costs more than looking it up.
RHW_INLINE f32x8 srgb8_to_float(i32x8 code)
{
    return (f32x8)i32x8_look_up(rhw_srgb_decode_table, code);
}

// Return codes of values in any range, in the lowest byte of each lane, with zero above. srgb.h explains the table.
RHW_INLINE i32x8 srgb8_from_float(f32x8 linear)
{
    const i32x8 bits = (i32x8)rhw_clamp(linear, rhw_splat(0x1p-13f), rhw_splat(1.0f));
    const i32x8 bucket = (bits >> 16) - RHW_SRGB_ENCODE_FIRST;
    const i32x8 entry = i32x8_look_up(rhw_srgb_encode_table, bucket);
    return (entry + (bits & 0xffff)) >> 16;
}

// Return the byte of a channel, with zero above.
RHW_INLINE i32x8 channel_byte(i32x8 word, int channel)
{
    return (word >> (8 * channel)) & 0xff;
}

// Put texels of four bytes into the order red, green, blue, alpha from the lowest byte on, or back.
RHW_INLINE i32x8 in_order(enum rhw_channel_order order, i32x8 word)
{
    const i32x8 swapped = ((word & 0xff) << 16) | ((i32x8)((u32x8)word >> 16) & 0xff);
    switch (order) {
    case RHW_ORDER_RGBA: break;
    case RHW_ORDER_BGRA: return (word & (int32_t)0xff00ff00) | swapped;
    case RHW_ORDER_ABGR: {
        const i32x8 pairs = (word << 16) | (i32x8)((u32x8)word >> 16);
        return ((pairs & 0x00ff00ff) << 8) | ((i32x8)((u32x8)pairs >> 8) & 0x00ff00ff);
    }
    }
    return word;
}

// Put four values into the order of the bytes that they become.
RHW_INLINE void order_values(enum rhw_channel_order order, const f32x8 value[4], f32x8 ordered[4])
{
    for (int c = 0; c < 4; c++) {
        ordered[rhw_channel_place(order, c)] = value[c];
    }
}

// Make RGBA8_SRGB texels of four values.
RHW_INLINE i32x8 srgb8_texels(const f32x8 value[4])
{
    return srgb8_from_float(value[0]) | (srgb8_from_float(value[1]) << 8) |
           (srgb8_from_float(value[2]) << 16) | (unorm8_from_float(value[3]) << 24);
}

// Make RGBA8_UNORM texels of four values.
RHW_INLINE i32x8 unorm8_texels(const f32x8 value[4])
{
    f32x8 scaled[4];
    for (int c = 0; c < 4; c++) {
        scaled[c] = value[c] * 255.0f;
    }
    return i32x8_bytes_from_f32x8(scaled);
}

// Make UNORM8 texels of the format's channels.
RHW_INLINE i32x8 unorm8_channels(const struct rhw_format_info *format, const f32x8 value[4])
{
    if (format->channels < 4) {
        i32x8 texel = unorm8_from_float(value[0]) & 0xff;
        if (format->channels == 2) {
            texel |= (unorm8_from_float(value[1]) & 0xff) << 8;
        }
        return texel;
    }
    f32x8 ordered[4];
    order_values(format->order, value, ordered);
    return unorm8_texels(ordered);
}

// Depth ----------------------------------------------------------------------------------------------

// Return whole steps of 0..1, of which there are `steps`, as floats. The function below returns floats as steps,
// rounded to nearest, ties to even, since adding 2^52 leaves a double no room for a fraction. For 65535 and for 2^24 −
// 1 steps, every step times the reciprocal rounds to the float that division gives, in a quarter of the time:
// test_format tries all of them.
RHW_INLINE f32x8 depth_from_steps(f64x8 count, double steps)
{
    return f32x8_from_f64x8(f64x8_mul(count, f64x8_splat(1 / steps)));
}

RHW_INLINE f64x8 steps_of_depth(f32x8 depth, double steps)
{
    const f64x8 scaled = f64x8_mul(f64x8_from_f32x8(depth), f64x8_splat(steps));
    return f64x8_sub(f64x8_add(scaled, f64x8_splat(0x1p52)), f64x8_splat(0x1p52));
}

// Codecs ---------------------------------------------------------------------------------------------

// Return one NaN for all NaNs: which one arithmetic makes differs between processors.
RHW_INLINE f32x8 canonical_nan(f32x8 value)
{
    return rhw_select(rhw_equal(value, value), value, (f32x8)i32x8_splat(0x7fc00000));
}

// Return what a channel reads that the format lacks.
RHW_INLINE f32x8 absent_channel(const struct rhw_format_info *format, int c)
{
    return rhw_format_is_integer(format) ? (f32x8)i32x8_splat(c == 3) : rhw_splat(c == 3 ? 1.0f : 0.0f);
}

// Decode texels to floats, colour linear. Channels that the format lacks read 0, 0, 0, 1. Floats of integer formats are
// the bits of integers, here and everywhere.
RHW_INLINE void decode_texels(const struct rhw_format_info *format, const struct raw_texels *raw,
                              f32x8 value[4])
{
    const int channels = format->channels;
    switch (format->codec) {
    case RHW_CODEC_UNORM8:
        for (int c = 0; c < channels; c++) {
            value[c] = unorm8_to_float(channel_byte(raw->word[0], rhw_channel_place(format->order, c)));
        }
        break;
    case RHW_CODEC_SRGB8: {
        const i32x8 word = in_order(format->order, raw->word[0]);
        for (int c = 0; c < 3; c++) {
            value[c] = srgb8_to_float(channel_byte(word, c));
        }
        value[3] = unorm8_to_float(channel_byte(word, 3));
        break;
    }
    case RHW_CODEC_FLOAT16:
        for (int c = 0; c < channels; c++) {
            value[c] = f32x8_from_half((i32x8)((u32x8)raw->word[c / 2] >> (16 * (c % 2))) & 0xffff);
        }
        break;
    case RHW_CODEC_DEPTH16:
    case RHW_CODEC_DEPTH24: {
        const double steps = rhw_codec_depth_steps(format->codec);
        value[0] = depth_from_steps(f64x8_from_i32x8(raw->word[0] & i32x8_splat((int32_t)steps)), steps);
        break;
    }
    case RHW_CODEC_FIELDS:
        if (__builtin_constant_p(format->bits[0])) {
            decode_known_fields(format, raw->word, value);
        } else {
            decode_fields(format, raw->word, value);
        }
        break;
    case RHW_CODEC_FLOAT32:
    case RHW_CODEC_BITS32:
    case RHW_CODEC_NONE:
        for (int c = 0; c < channels; c++) {
            value[c] = (f32x8)raw->word[c];
        }
        break;
    }
    for (int c = channels; c < 4; c++) {
        value[c] = absent_channel(format, c);
    }
}

// Encode values as texels, rounded to nearest, ties to even. Normalized formats clamp them first.
RHW_INLINE void encode_texels(const struct rhw_format_info *format, const f32x8 value[4],
                              struct raw_texels *raw)
{
    switch (format->codec) {
    case RHW_CODEC_UNORM8: raw->word[0] = unorm8_channels(format, value); break;
    case RHW_CODEC_SRGB8: raw->word[0] = in_order(format->order, srgb8_texels(value)); break;
    case RHW_CODEC_FLOAT16:
        for (int c = 0; c < format->channels; c++) {
            const i32x8 half = i32x8_half_from_f32x8(value[c]);
            raw->word[c / 2] = c % 2 == 0 ? half : raw->word[c / 2] | (half << 16);
        }
        break;
    case RHW_CODEC_FLOAT32:
    case RHW_CODEC_BITS32:
        for (int c = 0; c < format->channels; c++) {
            raw->word[c] = (i32x8)value[c];
        }
        break;
    case RHW_CODEC_DEPTH16:
    case RHW_CODEC_DEPTH24: {
        const f64x8 count = steps_of_depth(rhw_saturate(value[0]), rhw_codec_depth_steps(format->codec));
        // The count is below 2^24, so the conversion is exact.
        raw->word[0] = rhw_int_from_float_unchecked(f32x8_from_f64x8(count));
        break;
    }
    case RHW_CODEC_FIELDS:
        if (__builtin_constant_p(format->bits[0])) {
            encode_known_fields(format, value, raw->word);
        } else {
            encode_fields(format, value, raw->word);
        }
        break;
    case RHW_CODEC_NONE: break;
    }
}

// Loads and stores -----------------------------------------------------------------------------------

// Load 8 texels of 16 bytes that begin at these places.
RHW_INLINE void load_texels16(const void *const place[RHW_LANES], struct raw_texels *raw)
{
    f32x8 column[4];
    f32x8_load_columns(place, column);
    for (int w = 0; w < 4; w++) {
        raw->word[w] = (i32x8)column[w];
    }
}

// Load 8 texels of `size` bytes, 1 or 2, that begin at these places.
RHW_INLINE void load_small_texels(const void *const place[RHW_LANES], size_t size, struct raw_texels *raw)
{
    int32_t word[RHW_LANES];
    for (int i = 0; i < RHW_LANES; i++) {
        const unsigned char *const byte = place[i];
        word[i] = byte[0] | (size == 2 ? byte[1] << 8 : 0);
    }
    raw->word[0] = i32x8_load(word);
}

// Load 8 texels in a row.
RHW_INLINE void load_texel_row(size_t size, const unsigned char *texels, struct raw_texels *raw)
{
    if (size == 4) {
        raw->word[0] = i32x8_load(texels);
        return;
    }
    if (size == 8) {
        const i32x8 a = i32x8_load(texels), b = i32x8_load(texels + 32);
        raw->word[0] = __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14);
        raw->word[1] = __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15);
        return;
    }
    if (size < 4) {
        raw->word[0] = size == 2 ? i32x8_load_shorts(texels) : i32x8_load_bytes(texels);
        return;
    }
    const void *place[RHW_LANES];
    for (int i = 0; i < RHW_LANES; i++) {
        place[i] = texels + (size_t)i * size;
    }
    load_texels16(place, raw);
}

// Store words of 8 texels in a row, of lanes that are set in `mask`.
RHW_INLINE void store_words(unsigned char *texels, i32x8 value, i32x8 mask)
{
    i32x8_store(texels, rhw_select_int(mask, value, i32x8_load(texels)));
}

// Store bits of words of 8 texels in a row, where the mask is not all or nothing per lane.
RHW_INLINE void store_word_bits(unsigned char *texels, i32x8 value, i32x8 mask)
{
    const i32x8 old = i32x8_load(texels);
    i32x8_store(texels, old ^ ((old ^ value) & mask));
}

// Store 8 texels of 16 bytes in a row, of lanes of which `live` has a bit.
RHW_INLINE void store_texels16(const i32x8 word[4], unsigned live, unsigned char *texels)
{
    f32x4 row[RHW_LANES];
    const f32x8 column[4] = {(f32x8)word[0], (f32x8)word[1], (f32x8)word[2], (f32x8)word[3]};
    f32x4_rows(column, row);
    for (int i = 0; i < RHW_LANES; i++) {
        if (live >> i & 1) {
            memcpy(texels + (size_t)i * 16, &row[i], 16);
        }
    }
}

// Store the low bytes of words, `size` of each, 1 or 2, of lanes that are set in `mask`.
RHW_INLINE void store_small_texels(i32x8 word, i32x8 mask, size_t size, unsigned char *texels)
{
    if (size == 2) {
        i32x8_store_shorts(texels, rhw_select_int(mask, word, i32x8_load_shorts(texels)));
    } else {
        i32x8_store_low_bytes(texels, rhw_select_int(mask, word, i32x8_load_bytes(texels)));
    }
}

// Store 8 texels in a row, of lanes that are set in `mask`.
RHW_INLINE void store_texel_row(size_t size, const struct raw_texels *raw, i32x8 mask, unsigned char *texels)
{
    const i32x8 *const word = raw->word;
    if (size == 4) {
        store_words(texels, word[0], mask);
        return;
    }
    if (size == 8) {
        store_words(texels, __builtin_shufflevector(word[0], word[1], 0, 8, 1, 9, 2, 10, 3, 11),
                    __builtin_shufflevector(mask, mask, 0, 0, 1, 1, 2, 2, 3, 3));
        store_words(texels + 32, __builtin_shufflevector(word[0], word[1], 4, 12, 5, 13, 6, 14, 7, 15),
                    __builtin_shufflevector(mask, mask, 4, 4, 5, 5, 6, 6, 7, 7));
        return;
    }
    if (size == 16) {
        store_texels16(word, (unsigned)rhw_mask_bits(mask), texels);
        return;
    }
    store_small_texels(word[0], mask, size, texels);
}

#endif
