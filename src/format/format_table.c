// SPDX-License-Identifier: MIT
// Where rows of texel formats are found. Vertex formats are regular, so that arithmetic serves them (format.h).
#include "format_table.h"

#include <assert.h>

#include "block_format.h"
#include "context/misuse.h"

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
    return block ? &block->info : &rhw_format_table[format];
}

bool rhw_check_format(const struct rhw_context *context, const char *where, const char *field,
                      enum rhw_format format)
{
    return rhw_check(context, format != RHW_FORMAT_NONE, "%s: %s is not set (RHW_FORMAT_NONE)", where,
                     field) &&
           rhw_check(context, rhw_format_valid(format), "%s: %s is %d; it must be %s (%d) to %s (%d)", where,
                     field, (int)format, rhw_format_table[RHW_FORMAT_NONE + 1].name, RHW_FORMAT_NONE + 1,
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
