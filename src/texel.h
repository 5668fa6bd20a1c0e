// SPDX-License-Identifier: MIT
// One texel of any format from floats, for clear values: the scalar half of the codecs. The kernels' half, which gives the
// same bytes, is kernels/texel/texel_codec.h.
//
// Linear channels of 8 bits stand on the scale 0..255, as in mip generation (kernels/texel/mip_codec.h).
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

// Stores a depth of 0..1 as whole steps of a UNORM format, to nearest, ties to even: adding 2^52 leaves no room for a
// fraction.
static inline void rhw_depth_store(const struct rhw_format_info *format, float depth, unsigned char *texel)
{
    const double rounded = (double)depth * rhw_codec_depth_steps(format->codec) + 0x1p52;
    uint64_t bits;
    memcpy(&bits, &rounded, sizeof bits);
    memcpy(texel, &bits, format->size); // little endian
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
        case RHW_CODEC_DEPTH16:
        case RHW_CODEC_DEPTH24: rhw_depth_store(format, number, texel); break;
        case RHW_CODEC_NONE: break;
        }
    }
}

#endif
