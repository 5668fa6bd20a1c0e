// SPDX-License-Identifier: MIT
// One texel of any format as floats and back: the scalar half of the codecs, for clear values and mip generation. The
// kernels' half, which gives the same bytes, is kernels/texel/texel_codec.h.
//
// Linear channels of 8 bits stand on the scale 0..255, on which averages of codes are exact for the first 8 mip levels.
#ifndef RHW_TEXEL_H
#define RHW_TEXEL_H

#include "format.h"
#include "half.h"
#include "srgb.h"

// Whether a channel stands on the scale 0..255.
static inline bool rhw_texel_is_code(const struct rhw_format_info *format, int channel)
{
    return format->codec == RHW_CODEC_UNORM8 || (format->codec == RHW_CODEC_SRGB8 && channel == 3);
}

// Channels that the format lacks are 0.
static inline void rhw_texel_load(const struct rhw_format_info *format, const unsigned char *texel,
                                  float value[4])
{
    value[0] = value[1] = value[2] = value[3] = 0;
    for (size_t c = 0; c < format->channels; c++) {
        uint16_t half;
        switch (format->codec) {
        case RHW_CODEC_UNORM8: value[c] = texel[c]; break;
        case RHW_CODEC_SRGB8: value[c] = c < 3 ? rhw_srgb_decode_table[texel[c]] : texel[c]; break;
        case RHW_CODEC_FLOAT16:
            memcpy(&half, texel + c * sizeof half, sizeof half);
            value[c] = rhw_half_to_float(half);
            break;
        case RHW_CODEC_FLOAT32:
        case RHW_CODEC_UINT32: memcpy(&value[c], texel + c * sizeof value[c], sizeof value[c]); break;
        case RHW_CODEC_NONE: break;
        }
    }
}

// To nearest, ties to even, of a value within 0..255: adding 2^23 leaves no room for a fraction.
static inline unsigned char rhw_round_code(float value)
{
    const float rounded = value + 0x1p23f;
    uint32_t bits;
    memcpy(&bits, &rounded, sizeof bits);
    return (unsigned char)bits;
}

// The value, or one quiet NaN for every NaN: which NaN an operation gives depends on the processor.
static inline float rhw_canonical(float value)
{
    static const uint32_t quiet = 0x7fc00000;
    if (value != value) {
        memcpy(&value, &quiet, sizeof value);
    }
    return value;
}

// Values are rounded to nearest, ties to even. Those on the scale 0..255 lie within it.
static inline void rhw_texel_store(const struct rhw_format_info *format, const float value[4],
                                   unsigned char *texel)
{
    for (size_t c = 0; c < format->channels; c++) {
        const float number = rhw_canonical(value[c]);
        uint16_t half;
        switch (format->codec) {
        case RHW_CODEC_UNORM8: texel[c] = rhw_round_code(number); break;
        case RHW_CODEC_SRGB8: texel[c] = c < 3 ? rhw_srgb_encode(number) : rhw_round_code(number); break;
        case RHW_CODEC_FLOAT16:
            half = rhw_half_from_float(number);
            memcpy(texel + c * sizeof half, &half, sizeof half);
            break;
        case RHW_CODEC_FLOAT32: memcpy(texel + c * sizeof number, &number, sizeof number); break;
        case RHW_CODEC_UINT32: memcpy(texel + c * sizeof value[c], &value[c], sizeof value[c]); break;
        case RHW_CODEC_NONE: break;
        }
    }
}

#endif
