// SPDX-License-Identifier: MIT
// Rows of texels become channels of floats and back, for mip generation. Linear channels of 8 bits stand on the scale
// 0..255, on which averages of codes are exact for the first 8 mip levels. A row may have any width; nothing outside of
// it is touched.
#ifndef RHW_MIP_CODEC_H
#define RHW_MIP_CODEC_H

#include "texel_codec.h"

// Widen texels. The channels that the format has count.
RHW_INLINE void widen_texels(const struct rhw_format_info *format, const struct raw_texels *raw,
                             f32x8 value[4])
{
    const i32x8 word = in_order(format->order, raw->word[0]);
    switch (format->codec) {
    case RHW_CODEC_UNORM8:
        for (int c = 0; c < 4; c++) {
            value[c] = rhw_float_from_int(channel_byte(word, c));
        }
        break;
    case RHW_CODEC_SRGB8:
        for (int c = 0; c < 3; c++) {
            value[c] = srgb8_to_float(channel_byte(word, c));
        }
        value[3] = rhw_float_from_int(channel_byte(word, 3));
        break;
    default: decode_texels(format, raw, value); break;
    }
}

RHW_INLINE void narrow_texels(const struct rhw_format_info *format, const f32x8 value[4],
                              struct raw_texels *raw)
{
    switch (format->codec) {
    case RHW_CODEC_UNORM8: raw->word[0] = in_order(format->order, i32x8_bytes_from_small_f32x8(value)); break;
    case RHW_CODEC_SRGB8:
        raw->word[0] = in_order(format->order,
                                srgb8_from_float(value[0]) | (srgb8_from_float(value[1]) << 8) |
                                    (srgb8_from_float(value[2]) << 16) | ((i32x8)(value[3] + 0x1p23f) << 24));
        break;
    default: {
        f32x8 number[4];
        for (int c = 0; c < 4; c++) {
            number[c] = canonical_nan(value[c]);
        }
        encode_texels(format, number, raw);
        break;
    }
    }
}

// Widen a row. `channels` has room for whole groups of 8 texels.
RHW_INLINE void widen_row(const struct rhw_format_info *format, const unsigned char *texels, int width,
                          float *channels, size_t stride)
{
    const size_t size = format->size;
    for (int x = 0; x < width; x += RHW_LANES) {
        const unsigned char *group = texels + (size_t)x * size;
        unsigned char last[RHW_LANES * RHW_TEXEL_BYTES];
        if (width - x < RHW_LANES) {
            memset(last, 0, sizeof last);
            memcpy(last, group, (size_t)(width - x) * size);
            group = last;
        }
        struct raw_texels raw;
        f32x8 value[4];
        load_texel_row(size, group, &raw);
        widen_texels(format, &raw, value);
        for (int c = 0; c < format->channels; c++) {
            f32x8_store(channels + (size_t)c * stride + x, value[c]);
        }
    }
}

RHW_INLINE void narrow_row(const struct rhw_format_info *format, const float *channels, size_t stride,
                           int width, unsigned char *texels)
{
    const size_t size = format->size;
    for (int x = 0; x < width; x += RHW_LANES) {
        struct raw_texels raw;
        f32x8 value[4] = {{0}, {0}, {0}, {0}};
        for (int c = 0; c < format->channels; c++) {
            value[c] = f32x8_load(channels + (size_t)c * stride + x);
        }
        narrow_texels(format, value, &raw);
        unsigned char *const group = texels + (size_t)x * size;
        if (width - x >= RHW_LANES) {
            store_texel_row(size, &raw, i32x8_splat(-1), group);
        } else {
            unsigned char last[RHW_LANES * RHW_TEXEL_BYTES] = {0};
            store_texel_row(size, &raw, i32x8_splat(-1), last);
            memcpy(group, last, (size_t)(width - x) * size);
        }
    }
}

#endif
