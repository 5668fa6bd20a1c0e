// SPDX-License-Identifier: MIT
// The table of texel formats. Vertex formats are regular, so that arithmetic serves them (format.h).
#include "format.h"

#include <assert.h>

#include "block_format.h"
#include "context/misuse.h"

enum {
    FILTERED = RHW_ROLE_SAMPLED | RHW_ROLE_FILTERED,
    INTEGER = RHW_ROLE_SAMPLED | RHW_ROLE_COLOR_TARGET,
    DEPTH = RHW_ROLE_DEPTH_TARGET,
    BLENDED = RHW_ROLE_COLOR_TARGET | RHW_ROLE_BLENDED_TARGET,
    STENCIL = RHW_ROLE_STENCIL_TARGET
};

// Describe 1, 2 or 4 channels of so many bits, one after the other.
#define FIELDS1(size, kind) .type = RHW_CHANNEL_##kind, .first = {0}, .bits = {size}
#define FIELDS2(size, kind) .type = RHW_CHANNEL_##kind, .first = {0, size}, .bits = {size, size}
#define FIELDS4(size, kind) \
    .type = RHW_CHANNEL_##kind, .first = {0, size, 2 * (size), 3 * (size)}, .bits = {size, size, size, size}

// clang-format off
static const struct rhw_format_info formats[RHW_PLAIN_FORMAT_COUNT] = {
    // A row has a name, bytes, channels, codec, fast path and roles.
    [RHW_FORMAT_NONE] = {"RHW_FORMAT_NONE",
        0, 0, RHW_CODEC_NONE, RHW_TEXELS_GENERAL, 0, .order = RHW_ORDER_RGBA},
    [RHW_FORMAT_R8_UNORM] = {"RHW_FORMAT_R8_UNORM",
        1, 1, RHW_CODEC_UNORM8, RHW_TEXELS_GENERAL, FILTERED | BLENDED, .order = RHW_ORDER_RGBA,
        .known = RHW_KNOWN_R8},
    [RHW_FORMAT_RG8_UNORM] = {"RHW_FORMAT_RG8_UNORM",
        2, 2, RHW_CODEC_UNORM8, RHW_TEXELS_GENERAL, FILTERED | BLENDED, .order = RHW_ORDER_RGBA,
        .known = RHW_KNOWN_RG8},
    [RHW_FORMAT_RGBA8_UNORM] = {"RHW_FORMAT_RGBA8_UNORM",
        4, 4, RHW_CODEC_UNORM8, RHW_TEXELS_RGBA8_UNORM, FILTERED | BLENDED, .order = RHW_ORDER_RGBA},
    [RHW_FORMAT_BGRA8_UNORM] = {"RHW_FORMAT_BGRA8_UNORM",
        4, 4, RHW_CODEC_UNORM8, RHW_TEXELS_GENERAL, FILTERED | BLENDED, .order = RHW_ORDER_BGRA,
        .known = RHW_KNOWN_BGRA8},
    [RHW_FORMAT_ABGR8_UNORM] = {"RHW_FORMAT_ABGR8_UNORM",
        4, 4, RHW_CODEC_UNORM8, RHW_TEXELS_GENERAL, FILTERED | BLENDED, .order = RHW_ORDER_ABGR},
    [RHW_FORMAT_R8_SRGB] = {"RHW_FORMAT_R8_SRGB",
        1, 1, RHW_CODEC_SRGB8, RHW_TEXELS_GENERAL, FILTERED | BLENDED, .order = RHW_ORDER_RGBA},
    [RHW_FORMAT_RG8_SRGB] = {"RHW_FORMAT_RG8_SRGB",
        2, 2, RHW_CODEC_SRGB8, RHW_TEXELS_GENERAL, FILTERED | BLENDED, .order = RHW_ORDER_RGBA},
    [RHW_FORMAT_RGBA8_SRGB] = {"RHW_FORMAT_RGBA8_SRGB",
        4, 4, RHW_CODEC_SRGB8, RHW_TEXELS_RGBA8_SRGB, FILTERED | BLENDED, .order = RHW_ORDER_RGBA},
    [RHW_FORMAT_BGRA8_SRGB] = {"RHW_FORMAT_BGRA8_SRGB",
        4, 4, RHW_CODEC_SRGB8, RHW_TEXELS_GENERAL, FILTERED | BLENDED, .order = RHW_ORDER_BGRA,
        .known = RHW_KNOWN_BGRA8_SRGB},
    [RHW_FORMAT_ABGR8_SRGB] = {"RHW_FORMAT_ABGR8_SRGB",
        4, 4, RHW_CODEC_SRGB8, RHW_TEXELS_GENERAL, FILTERED | BLENDED, .order = RHW_ORDER_ABGR},
    [RHW_FORMAT_R8_SNORM] = {"RHW_FORMAT_R8_SNORM",
        1, 1, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, FILTERED | BLENDED, FIELDS1(8, SNORM)},
    [RHW_FORMAT_RG8_SNORM] = {"RHW_FORMAT_RG8_SNORM",
        2, 2, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, FILTERED | BLENDED, FIELDS2(8, SNORM)},
    [RHW_FORMAT_RGBA8_SNORM] = {"RHW_FORMAT_RGBA8_SNORM",
        4, 4, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, FILTERED | BLENDED, FIELDS4(8, SNORM)},
    [RHW_FORMAT_R8_UINT] = {"RHW_FORMAT_R8_UINT",
        1, 1, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, INTEGER, FIELDS1(8, UINT)},
    [RHW_FORMAT_RG8_UINT] = {"RHW_FORMAT_RG8_UINT",
        2, 2, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, INTEGER, FIELDS2(8, UINT)},
    [RHW_FORMAT_RGBA8_UINT] = {"RHW_FORMAT_RGBA8_UINT",
        4, 4, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, INTEGER, FIELDS4(8, UINT)},
    [RHW_FORMAT_R8_SINT] = {"RHW_FORMAT_R8_SINT",
        1, 1, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, INTEGER, FIELDS1(8, SINT)},
    [RHW_FORMAT_RG8_SINT] = {"RHW_FORMAT_RG8_SINT",
        2, 2, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, INTEGER, FIELDS2(8, SINT)},
    [RHW_FORMAT_RGBA8_SINT] = {"RHW_FORMAT_RGBA8_SINT",
        4, 4, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, INTEGER, FIELDS4(8, SINT)},
    [RHW_FORMAT_R16_UNORM] = {"RHW_FORMAT_R16_UNORM",
        2, 1, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, FILTERED | BLENDED, FIELDS1(16, UNORM),
        .known = RHW_KNOWN_R16},
    [RHW_FORMAT_RG16_UNORM] = {"RHW_FORMAT_RG16_UNORM",
        4, 2, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, FILTERED | BLENDED, FIELDS2(16, UNORM),
        .known = RHW_KNOWN_RG16},
    [RHW_FORMAT_RGBA16_UNORM] = {"RHW_FORMAT_RGBA16_UNORM",
        8, 4, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, FILTERED | BLENDED, FIELDS4(16, UNORM),
        .known = RHW_KNOWN_RGBA16},
    [RHW_FORMAT_R16_SNORM] = {"RHW_FORMAT_R16_SNORM",
        2, 1, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, FILTERED | BLENDED, FIELDS1(16, SNORM)},
    [RHW_FORMAT_RG16_SNORM] = {"RHW_FORMAT_RG16_SNORM",
        4, 2, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, FILTERED | BLENDED, FIELDS2(16, SNORM)},
    [RHW_FORMAT_RGBA16_SNORM] = {"RHW_FORMAT_RGBA16_SNORM",
        8, 4, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, FILTERED | BLENDED, FIELDS4(16, SNORM)},
    [RHW_FORMAT_R16_UINT] = {"RHW_FORMAT_R16_UINT",
        2, 1, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, INTEGER, FIELDS1(16, UINT)},
    [RHW_FORMAT_RG16_UINT] = {"RHW_FORMAT_RG16_UINT",
        4, 2, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, INTEGER, FIELDS2(16, UINT)},
    [RHW_FORMAT_RGBA16_UINT] = {"RHW_FORMAT_RGBA16_UINT",
        8, 4, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, INTEGER, FIELDS4(16, UINT)},
    [RHW_FORMAT_R16_SINT] = {"RHW_FORMAT_R16_SINT",
        2, 1, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, INTEGER, FIELDS1(16, SINT)},
    [RHW_FORMAT_RG16_SINT] = {"RHW_FORMAT_RG16_SINT",
        4, 2, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, INTEGER, FIELDS2(16, SINT)},
    [RHW_FORMAT_RGBA16_SINT] = {"RHW_FORMAT_RGBA16_SINT",
        8, 4, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, INTEGER, FIELDS4(16, SINT)},
    [RHW_FORMAT_R16_FLOAT] = {"RHW_FORMAT_R16_FLOAT",
        2, 1, RHW_CODEC_FLOAT16, RHW_TEXELS_GENERAL, FILTERED | BLENDED, .order = RHW_ORDER_RGBA,
        .known = RHW_KNOWN_R16_FLOAT},
    [RHW_FORMAT_RG16_FLOAT] = {"RHW_FORMAT_RG16_FLOAT",
        4, 2, RHW_CODEC_FLOAT16, RHW_TEXELS_GENERAL, FILTERED | BLENDED, .order = RHW_ORDER_RGBA,
        .known = RHW_KNOWN_RG16_FLOAT},
    [RHW_FORMAT_RGBA16_FLOAT] = {"RHW_FORMAT_RGBA16_FLOAT",
        8, 4, RHW_CODEC_FLOAT16, RHW_TEXELS_GENERAL, FILTERED | BLENDED, .order = RHW_ORDER_RGBA,
        .known = RHW_KNOWN_RGBA16_FLOAT},
    [RHW_FORMAT_R32_UINT] = {"RHW_FORMAT_R32_UINT",
        4, 1, RHW_CODEC_BITS32, RHW_TEXELS_GENERAL, INTEGER, .type = RHW_CHANNEL_UINT},
    [RHW_FORMAT_RG32_UINT] = {"RHW_FORMAT_RG32_UINT",
        8, 2, RHW_CODEC_BITS32, RHW_TEXELS_GENERAL, INTEGER, .type = RHW_CHANNEL_UINT},
    [RHW_FORMAT_RGBA32_UINT] = {"RHW_FORMAT_RGBA32_UINT",
        16, 4, RHW_CODEC_BITS32, RHW_TEXELS_GENERAL, INTEGER, .type = RHW_CHANNEL_UINT},
    [RHW_FORMAT_R32_SINT] = {"RHW_FORMAT_R32_SINT",
        4, 1, RHW_CODEC_BITS32, RHW_TEXELS_GENERAL, INTEGER, .type = RHW_CHANNEL_SINT},
    [RHW_FORMAT_RG32_SINT] = {"RHW_FORMAT_RG32_SINT",
        8, 2, RHW_CODEC_BITS32, RHW_TEXELS_GENERAL, INTEGER, .type = RHW_CHANNEL_SINT},
    [RHW_FORMAT_RGBA32_SINT] = {"RHW_FORMAT_RGBA32_SINT",
        16, 4, RHW_CODEC_BITS32, RHW_TEXELS_GENERAL, INTEGER, .type = RHW_CHANNEL_SINT},
    [RHW_FORMAT_R32_FLOAT] = {"RHW_FORMAT_R32_FLOAT",
        4, 1, RHW_CODEC_FLOAT32, RHW_TEXELS_GENERAL, FILTERED | BLENDED, .order = RHW_ORDER_RGBA,
        .known = RHW_KNOWN_R32_FLOAT},
    [RHW_FORMAT_RG32_FLOAT] = {"RHW_FORMAT_RG32_FLOAT",
        8, 2, RHW_CODEC_FLOAT32, RHW_TEXELS_GENERAL, FILTERED | BLENDED, .order = RHW_ORDER_RGBA,
        .known = RHW_KNOWN_RG32_FLOAT},
    [RHW_FORMAT_RGBA32_FLOAT] = {"RHW_FORMAT_RGBA32_FLOAT",
        16, 4, RHW_CODEC_FLOAT32, RHW_TEXELS_GENERAL, FILTERED | BLENDED, .order = RHW_ORDER_RGBA,
        .known = RHW_KNOWN_RGBA32_FLOAT},
    [RHW_FORMAT_RGB10A2_UNORM] = {"RHW_FORMAT_RGB10A2_UNORM",
        4, 4, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, FILTERED | BLENDED,
        .type = RHW_CHANNEL_UNORM, .first = {0, 10, 20, 30}, .bits = {10, 10, 10, 2},
        .known = RHW_KNOWN_RGB10A2},
    [RHW_FORMAT_RGB10A2_UINT] = {"RHW_FORMAT_RGB10A2_UINT",
        4, 4, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, INTEGER,
        .type = RHW_CHANNEL_UINT, .first = {0, 10, 20, 30}, .bits = {10, 10, 10, 2}},
    [RHW_FORMAT_RG11B10_FLOAT] = {"RHW_FORMAT_RG11B10_FLOAT",
        4, 3, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, FILTERED | BLENDED,
        .type = RHW_CHANNEL_UFLOAT, .first = {0, 11, 22}, .bits = {11, 11, 10}},
    [RHW_FORMAT_RGB9E5_FLOAT] = {"RHW_FORMAT_RGB9E5_FLOAT",
        4, 3, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, FILTERED,
        .type = RHW_CHANNEL_SHARED, .first = {0, 9, 18}, .bits = {9, 9, 9}},
    [RHW_FORMAT_RGB565_UNORM] = {"RHW_FORMAT_RGB565_UNORM",
        2, 3, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, FILTERED | BLENDED,
        .type = RHW_CHANNEL_UNORM, .first = {11, 5, 0}, .bits = {5, 6, 5},
        .known = RHW_KNOWN_RGB565},
    [RHW_FORMAT_RGBA4_UNORM] = {"RHW_FORMAT_RGBA4_UNORM",
        2, 4, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, FILTERED | BLENDED,
        .type = RHW_CHANNEL_UNORM, .first = {12, 8, 4, 0}, .bits = {4, 4, 4, 4}},
    [RHW_FORMAT_RGB5A1_UNORM] = {"RHW_FORMAT_RGB5A1_UNORM",
        2, 4, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, FILTERED | BLENDED,
        .type = RHW_CHANNEL_UNORM, .first = {11, 6, 1, 0}, .bits = {5, 5, 5, 1}},
    [RHW_FORMAT_BGRA4_UNORM] = {"RHW_FORMAT_BGRA4_UNORM",
        2, 4, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, FILTERED | BLENDED,
        .type = RHW_CHANNEL_UNORM, .first = {4, 8, 12, 0}, .bits = {4, 4, 4, 4}},
    [RHW_FORMAT_A1RGB5_UNORM] = {"RHW_FORMAT_A1RGB5_UNORM",
        2, 4, RHW_CODEC_FIELDS, RHW_TEXELS_GENERAL, FILTERED | BLENDED,
        .type = RHW_CHANNEL_UNORM, .first = {10, 5, 0, 15}, .bits = {5, 5, 5, 1}},
    [RHW_FORMAT_D32_FLOAT] = {"RHW_FORMAT_D32_FLOAT",
        4, 1, RHW_CODEC_FLOAT32, RHW_TEXELS_GENERAL, FILTERED | DEPTH, .order = RHW_ORDER_RGBA},
    [RHW_FORMAT_D16_UNORM] = {"RHW_FORMAT_D16_UNORM",
        2, 1, RHW_CODEC_DEPTH16, RHW_TEXELS_GENERAL, FILTERED | DEPTH, .order = RHW_ORDER_RGBA},
    [RHW_FORMAT_D24_UNORM] = {"RHW_FORMAT_D24_UNORM",
        4, 1, RHW_CODEC_DEPTH24, RHW_TEXELS_GENERAL, FILTERED | DEPTH, .order = RHW_ORDER_RGBA},
    [RHW_FORMAT_D24_UNORM_S8_UINT] = {"RHW_FORMAT_D24_UNORM_S8_UINT",
        4, 1, RHW_CODEC_DEPTH24, RHW_TEXELS_GENERAL, FILTERED | DEPTH | STENCIL, .order = RHW_ORDER_RGBA},
    [RHW_FORMAT_D32_FLOAT_S8_UINT] = {"RHW_FORMAT_D32_FLOAT_S8_UINT",
        4, 1, RHW_CODEC_FLOAT32, RHW_TEXELS_GENERAL, FILTERED | DEPTH | STENCIL, .order = RHW_ORDER_RGBA},
    [RHW_FORMAT_S8_UINT] = {"RHW_FORMAT_S8_UINT",
        1, 1, RHW_CODEC_NONE, RHW_TEXELS_GENERAL, STENCIL, .order = RHW_ORDER_RGBA},
};
// clang-format on

_Static_assert((int)RHW_PLAIN_FORMAT_COUNT + (int)RHW_BLOCK_FORMAT_COUNT == (int)RHW_FORMAT_COUNT,
               "compressed formats stand last");
_Static_assert((int)RHW_VERTEX_FLOAT64X1 == 4 * (RHW_TYPE_SINT32 + 1), "four vertex formats of each type");
_Static_assert((int)RHW_VERTEX_SINT10_10_10_2_BGRA - (int)RHW_VERTEX_UNORM10_10_10_2 ==
                   (int)RHW_TYPE_SINT10_BGRA - (int)RHW_TYPE_UNORM10,
               "one of each that shares a word");
_Static_assert((int)RHW_VERTEX_HALF1 == 4 * RHW_TYPE_HALF &&
                   (int)RHW_VERTEX_UNORM8X1 == 4 * RHW_TYPE_UNORM8 &&
                   (int)RHW_VERTEX_SINT8X1 == 4 * RHW_TYPE_SINT8 &&
                   (int)RHW_VERTEX_UNORM16X1 == 4 * RHW_TYPE_UNORM16 &&
                   (int)RHW_VERTEX_SINT16X1 == 4 * RHW_TYPE_SINT16,
               "vertex types stand in the order of the formats");

const struct rhw_format_info *rhw_format_info(enum rhw_format format)
{
    assert((unsigned)format < RHW_FORMAT_COUNT);
    const struct rhw_block_format *const block = rhw_block_format(format);
    return block ? &block->info : &formats[format];
}

bool rhw_check_format(const struct rhw_context *context, const char *where, const char *field,
                      enum rhw_format format)
{
    return rhw_check(context, format != RHW_FORMAT_NONE, "%s: %s is not set (RHW_FORMAT_NONE)", where,
                     field) &&
           rhw_check(context, rhw_format_valid(format), "%s: %s is %d; it must be %s (%d) to %s (%d)", where,
                     field, (int)format, formats[RHW_FORMAT_NONE + 1].name, RHW_FORMAT_NONE + 1,
                     rhw_format_info((enum rhw_format)(RHW_FORMAT_COUNT - 1))->name, RHW_FORMAT_COUNT - 1);
}

void rhw_format_channel_bits(const struct rhw_format_info *info, int channel, uint32_t words[4])
{
    int first = 0, bits = 0;
    switch (info->codec) {
    case RHW_CODEC_UNORM8:
    case RHW_CODEC_SRGB8: first = 8 * rhw_channel_place(info->order, channel), bits = 8; break;
    case RHW_CODEC_FLOAT16: first = 16 * channel, bits = 16; break;
    case RHW_CODEC_FLOAT32:
    case RHW_CODEC_BITS32: first = 32 * channel, bits = 32; break;
    case RHW_CODEC_FIELDS: first = info->first[channel], bits = info->bits[channel]; break;
    case RHW_CODEC_DEPTH16:
    case RHW_CODEC_DEPTH24:
    case RHW_CODEC_NONE: break;
    }
    if (channel < info->channels) {
        words[first / 32] |= (uint32_t)((((uint64_t)1 << bits) - 1) << first % 32);
    }
}

// Return the features of a format that is not compressed.
static uint32_t features_of(const struct rhw_format_info *info)
{
    static const struct {
        int role;
        uint32_t feature;
    } features[] = {{RHW_ROLE_SAMPLED, RHW_FEATURE_SAMPLED},
                    {RHW_ROLE_FILTERED, RHW_FEATURE_FILTERED},
                    {RHW_ROLE_COLOR_TARGET, RHW_FEATURE_COLOR_ATTACHMENT | RHW_FEATURE_STORAGE_IMAGE},
                    {RHW_ROLE_BLENDED_TARGET, RHW_FEATURE_BLENDED},
                    {RHW_ROLE_DEPTH_TARGET, RHW_FEATURE_DEPTH_ATTACHMENT},
                    {RHW_ROLE_STENCIL_TARGET, RHW_FEATURE_STENCIL_ATTACHMENT}};
    uint32_t found = 0;
    for (size_t i = 0; i < sizeof features / sizeof features[0]; i++) {
        found |= rhw_format_has_role(info, features[i].role) ? features[i].feature : 0;
    }
    if (!rhw_format_has_role(info, RHW_ROLE_DEPTH_TARGET | RHW_ROLE_STENCIL_TARGET)) {
        found |= RHW_FEATURE_TEXEL_BUFFER;
    }
    return found | (info->codec == RHW_CODEC_BITS32 && info->channels == 1 ? RHW_FEATURE_STORAGE_ATOMIC : 0);
}

uint32_t rhw_format_features(enum rhw_format format)
{
    if (!rhw_format_valid(format)) {
        return 0;
    }
    const enum rhw_format stored = rhw_format_decoded(format);
    const uint32_t read = RHW_FEATURE_SAMPLED | RHW_FEATURE_FILTERED;
    return features_of(rhw_format_info(stored)) & (stored == format ? UINT32_MAX : read);
}

size_t rhw_format_size(enum rhw_format format)
{
    return rhw_format_valid(format) ? rhw_format_info(format)->size : 0;
}

size_t rhw_vertex_format_size(enum rhw_vertex_format format)
{
    if (!rhw_vertex_format_valid(format)) {
        return 0;
    }
    const enum rhw_vertex_type type = rhw_vertex_format_type(format);
    const int components = type >= RHW_TYPE_UNORM10 ? 1 : rhw_vertex_format_components(format);
    return (size_t)components * (size_t)rhw_vertex_type_size(type);
}
