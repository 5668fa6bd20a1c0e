// SPDX-License-Identifier: MIT
// See texel_pair.h.
#include "texel_pair.h"

#include <math.h>
#include <string.h>

static const struct texel_pair pairs[] = {
    {RHW_FORMAT_RGBA8_UNORM, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, TEXEL_BYTES, 4},
    {RHW_FORMAT_RGBA8_SRGB, GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, TEXEL_BYTES, 4},
    {RHW_FORMAT_R8_UNORM, GL_R8, GL_RED, GL_UNSIGNED_BYTE, TEXEL_BYTES, 1},
    {RHW_FORMAT_RG8_UNORM, GL_RG8, GL_RG, GL_UNSIGNED_BYTE, TEXEL_BYTES, 2},
    {RHW_FORMAT_RGB10A2_UNORM, GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, TEXEL_PACKED, 4},
    {RHW_FORMAT_RGBA8_UINT, GL_RGBA8UI, GL_RGBA_INTEGER, GL_UNSIGNED_BYTE, TEXEL_UNSIGNED, 4},
    {RHW_FORMAT_RGBA8_SINT, GL_RGBA8I, GL_RGBA_INTEGER, GL_BYTE, TEXEL_SIGNED, 4},
    {RHW_FORMAT_RGBA16_UINT, GL_RGBA16UI, GL_RGBA_INTEGER, GL_UNSIGNED_SHORT, TEXEL_UNSIGNED, 4},
    {RHW_FORMAT_R32_SINT, GL_R32I, GL_RED_INTEGER, GL_INT, TEXEL_SIGNED, 1},
    {RHW_FORMAT_R32_UINT, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, TEXEL_UNSIGNED, 1},
    {RHW_FORMAT_RG16_SINT, GL_RG16I, GL_RG_INTEGER, GL_SHORT, TEXEL_SIGNED, 2},
    {RHW_FORMAT_RGBA32_UINT, GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, TEXEL_UNSIGNED, 4},
    {RHW_FORMAT_R16_FLOAT, GL_R16F, GL_RED, GL_HALF_FLOAT, TEXEL_HALF, 1},
    {RHW_FORMAT_RGBA16_FLOAT, GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, TEXEL_HALF, 4},
    {RHW_FORMAT_RG11B10_FLOAT, GL_R11F_G11F_B10F, GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV, TEXEL_11_10, 3},
    {RHW_FORMAT_R32_FLOAT, GL_R32F, GL_RED, GL_FLOAT, TEXEL_FLOAT, 1},
    {RHW_FORMAT_RGBA32_FLOAT, GL_RGBA32F, GL_RGBA, GL_FLOAT, TEXEL_FLOAT, 4},
    {RHW_FORMAT_RGB9E5_FLOAT, GL_RGB9_E5, GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV, TEXEL_FLOAT, 3},
    {RHW_FORMAT_D16_UNORM, GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, TEXEL_UNSIGNED, 1},
    {RHW_FORMAT_D32_FLOAT, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, TEXEL_FLOAT, 1},
    {RHW_FORMAT_D24_UNORM_S8_UINT, GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8,
     TEXEL_UNSIGNED, 1},
    {RHW_FORMAT_D32_FLOAT_S8_UINT, GL_DEPTH32F_STENCIL8, GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV,
     TEXEL_FLOAT, 1},
    {RHW_FORMAT_ETC2_RGB8_UNORM, GL_COMPRESSED_RGB8_ETC2, 0, 0, TEXEL_BYTES, 3},
    {RHW_FORMAT_ETC2_RGBA8_SRGB, GL_COMPRESSED_SRGB8_ALPHA8_ETC2_EAC, 0, 0, TEXEL_BYTES, 4},
    {RHW_FORMAT_ETC2_RGB8A1_UNORM, GL_COMPRESSED_RGB8_PUNCHTHROUGH_ALPHA1_ETC2, 0, 0, TEXEL_BYTES, 4},
    {RHW_FORMAT_EAC_RG11_SNORM, GL_COMPRESSED_SIGNED_RG11_EAC, 0, 0, TEXEL_BYTES, 2},
};

const struct texel_pair *texel_pair_find(enum rhw_format format)
{
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        if (pairs[i].format == format) {
            return &pairs[i];
        }
    }
    return NULL;
}

// A float with 5 bits of exponent below its sign, if it has one.
static double small_float(uint32_t bits, int mantissa_bits)
{
    const uint32_t exponent = bits >> mantissa_bits & 31, mantissa = bits & ((1u << mantissa_bits) - 1);
    const double fraction = ldexp((double)mantissa, -mantissa_bits);
    const double size = exponent == 0    ? ldexp(fraction, -14)
                        : exponent == 31 ? (mantissa ? (double)NAN : (double)INFINITY)
                                         : ldexp(1 + fraction, (int)exponent - 15);
    return mantissa_bits == 10 && bits & 0x8000 ? -size : size;
}

static double integer(const unsigned char *texel, size_t bytes, bool is_signed)
{
    uint32_t value = 0;
    memcpy(&value, texel, bytes);
    const uint32_t sign = 1u << (8 * bytes - 1);
    return is_signed ? (double)(value & (sign - 1)) - (double)(value & sign) : (double)value;
}

void texel_decode(const struct texel_pair *pair, const unsigned char *texel, double value[4])
{
    const size_t bytes = rhw_format_size(pair->format) / (size_t)pair->channels;
    uint32_t word = 0;
    memset(value, 0, 4 * sizeof *value);
    if (pair->kind == TEXEL_PACKED || pair->kind == TEXEL_11_10) {
        memcpy(&word, texel, sizeof word);
    }
    for (int c = 0; c < pair->channels; c++) {
        const unsigned char *const at = texel + bytes * (size_t)c;
        uint16_t half;
        float number;
        switch (pair->kind) {
        case TEXEL_BYTES: value[c] = *at; break;
        case TEXEL_PACKED: value[c] = c == 3 ? word >> 30 : word >> 10 * c & 1023; break;
        case TEXEL_SIGNED:
        case TEXEL_UNSIGNED: value[c] = integer(at, bytes, pair->kind == TEXEL_SIGNED); break;
        case TEXEL_HALF:
            memcpy(&half, at, sizeof half);
            value[c] = small_float(half, 10);
            break;
        case TEXEL_11_10:
            value[c] = c == 2 ? small_float(word >> 22, 5) : small_float(word >> 11 * c & 2047, 6);
            break;
        default: memcpy(&number, at, sizeof number); value[c] = (double)number;
        }
    }
}

double texel_difference(const struct texel_pair *pair, int channel, double a, double b)
{
    if (a == b || (isnan(a) && isnan(b))) {
        return 0;
    }
    int exponent = 0;
    frexp(fmax(fmax(fabs(a), fabs(b)), 0.25), &exponent); // the largest is in 2^(exponent − 1) .. 2^exponent
    const int mantissa_bits = pair->kind == TEXEL_HALF ? 10 : channel == 2 ? 5 : 6;
    switch (pair->kind) {
    case TEXEL_HALF:
    case TEXEL_11_10: return fabs(a - b) / ldexp(1, exponent - 1 - mantissa_bits);
    case TEXEL_FLOAT: return fabs(a - b) * 65536;
    default: return fabs(a - b);
    }
}
