// SPDX-License-Identifier: MIT
// The table of texel formats. Vertex formats are regular, so that arithmetic serves them (format.h).
#include "format.h"

#include <assert.h>

#include "block_format.h"
#include "misuse.h"

enum {
    SAMPLED = RHW_ROLE_SAMPLED,
    DEPTH = RHW_ROLE_DEPTH_TARGET,
    COLOR = RHW_ROLE_COLOR_TARGET,
    BLENDED = RHW_ROLE_COLOR_TARGET | RHW_ROLE_BLENDED_TARGET,
    STENCIL = RHW_ROLE_STENCIL_TARGET
};

// R8 and RG8 are there to be sampled (masks, roughness), not drawn into.
// clang-format off
static const struct rhw_format_info formats[RHW_PLAIN_FORMAT_COUNT] = {
    // name, bytes, channels, codec, fast path, roles
    [RHW_FORMAT_NONE] = {"RHW_FORMAT_NONE",
        0, 0, RHW_CODEC_NONE, RHW_TEXELS_GENERAL, 0},
    [RHW_FORMAT_R8_UNORM] = {"RHW_FORMAT_R8_UNORM",
        1, 1, RHW_CODEC_UNORM8, RHW_TEXELS_GENERAL, SAMPLED},
    [RHW_FORMAT_RG8_UNORM] = {"RHW_FORMAT_RG8_UNORM",
        2, 2, RHW_CODEC_UNORM8, RHW_TEXELS_GENERAL, SAMPLED},
    [RHW_FORMAT_RGBA8_UNORM] = {"RHW_FORMAT_RGBA8_UNORM",
        4, 4, RHW_CODEC_UNORM8, RHW_TEXELS_RGBA8_UNORM, SAMPLED | BLENDED},
    [RHW_FORMAT_RGBA8_SRGB] = {"RHW_FORMAT_RGBA8_SRGB",
        4, 4, RHW_CODEC_SRGB8, RHW_TEXELS_RGBA8_SRGB, SAMPLED | BLENDED},
    [RHW_FORMAT_RGBA16_FLOAT] = {"RHW_FORMAT_RGBA16_FLOAT",
        8, 4, RHW_CODEC_FLOAT16, RHW_TEXELS_GENERAL, SAMPLED | BLENDED},
    [RHW_FORMAT_R32_FLOAT] = {"RHW_FORMAT_R32_FLOAT",
        4, 1, RHW_CODEC_FLOAT32, RHW_TEXELS_GENERAL, SAMPLED | BLENDED},
    [RHW_FORMAT_RGBA32_FLOAT] = {"RHW_FORMAT_RGBA32_FLOAT",
        16, 4, RHW_CODEC_FLOAT32, RHW_TEXELS_GENERAL, SAMPLED | BLENDED},
    [RHW_FORMAT_R32_UINT] = {"RHW_FORMAT_R32_UINT",
        4, 1, RHW_CODEC_UINT32, RHW_TEXELS_GENERAL, COLOR},
    [RHW_FORMAT_D32_FLOAT] = {"RHW_FORMAT_D32_FLOAT",
        4, 1, RHW_CODEC_FLOAT32, RHW_TEXELS_GENERAL, SAMPLED | DEPTH},
    [RHW_FORMAT_D16_UNORM] = {"RHW_FORMAT_D16_UNORM",
        2, 1, RHW_CODEC_DEPTH16, RHW_TEXELS_GENERAL, SAMPLED | DEPTH},
    [RHW_FORMAT_D24_UNORM] = {"RHW_FORMAT_D24_UNORM",
        4, 1, RHW_CODEC_DEPTH24, RHW_TEXELS_GENERAL, SAMPLED | DEPTH},
    [RHW_FORMAT_D24_UNORM_S8_UINT] = {"RHW_FORMAT_D24_UNORM_S8_UINT",
        4, 1, RHW_CODEC_DEPTH24, RHW_TEXELS_GENERAL, SAMPLED | DEPTH | STENCIL},
    [RHW_FORMAT_D32_FLOAT_S8_UINT] = {"RHW_FORMAT_D32_FLOAT_S8_UINT",
        4, 1, RHW_CODEC_FLOAT32, RHW_TEXELS_GENERAL, SAMPLED | DEPTH | STENCIL},
    [RHW_FORMAT_S8_UINT] = {"RHW_FORMAT_S8_UINT",
        1, 1, RHW_CODEC_NONE, RHW_TEXELS_GENERAL, STENCIL},
};
// clang-format on

_Static_assert((int)RHW_PLAIN_FORMAT_COUNT + (int)RHW_BLOCK_FORMAT_COUNT == (int)RHW_FORMAT_COUNT,
               "compressed formats stand last");
_Static_assert(RHW_VERTEX_FORMAT_COUNT == 4 * RHW_TYPE_COUNT, "four vertex formats of each type");
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

size_t rhw_format_size(enum rhw_format format)
{
    return rhw_format_valid(format) ? rhw_format_info(format)->size : 0;
}

size_t rhw_vertex_format_size(enum rhw_vertex_format format)
{
    if (!rhw_vertex_format_valid(format)) {
        return 0;
    }
    return (size_t)rhw_vertex_format_components(format) *
           (size_t)rhw_vertex_type_size(rhw_vertex_format_type(format));
}
