// SPDX-License-Identifier: MIT
// The table of compressed formats. format_table.h has the table of the others.
//
// Formats of 8 bits are decoded to RGBA8, which the sampler has fast paths for. BC6H is made of halves. BC4 and BC5
// have fifths and sevenths of bytes and EAC has 11 bits; they become floats, so that nothing is lost but one rounding:
// who stores normals in them counts on more than 8 bits.
#include "block_format.h"

#include "block_decoders.h"

enum { FIRST = RHW_PLAIN_FORMAT_COUNT };

// clang-format off
static const struct rhw_block_format formats[RHW_BLOCK_FORMAT_COUNT] = {
    // A row has a name, the width and height of a block, its bytes, the format that it is decoded to, and the decoder.
    [RHW_FORMAT_BC1_RGB_UNORM - FIRST] = {{.name = "RHW_FORMAT_BC1_RGB_UNORM"},
        4, 4, 8, RHW_FORMAT_RGBA8_UNORM, rhw_decode_bc1_rgb},
    [RHW_FORMAT_BC1_RGB_SRGB - FIRST] = {{.name = "RHW_FORMAT_BC1_RGB_SRGB"},
        4, 4, 8, RHW_FORMAT_RGBA8_SRGB, rhw_decode_bc1_rgb},
    [RHW_FORMAT_BC1_RGBA_UNORM - FIRST] = {{.name = "RHW_FORMAT_BC1_RGBA_UNORM"},
        4, 4, 8, RHW_FORMAT_RGBA8_UNORM, rhw_decode_bc1_rgba},
    [RHW_FORMAT_BC1_RGBA_SRGB - FIRST] = {{.name = "RHW_FORMAT_BC1_RGBA_SRGB"},
        4, 4, 8, RHW_FORMAT_RGBA8_SRGB, rhw_decode_bc1_rgba},
    [RHW_FORMAT_BC2_UNORM - FIRST] = {{.name = "RHW_FORMAT_BC2_UNORM"},
        4, 4, 16, RHW_FORMAT_RGBA8_UNORM, rhw_decode_bc2},
    [RHW_FORMAT_BC2_SRGB - FIRST] = {{.name = "RHW_FORMAT_BC2_SRGB"},
        4, 4, 16, RHW_FORMAT_RGBA8_SRGB, rhw_decode_bc2},
    [RHW_FORMAT_BC3_UNORM - FIRST] = {{.name = "RHW_FORMAT_BC3_UNORM"},
        4, 4, 16, RHW_FORMAT_RGBA8_UNORM, rhw_decode_bc3},
    [RHW_FORMAT_BC3_SRGB - FIRST] = {{.name = "RHW_FORMAT_BC3_SRGB"},
        4, 4, 16, RHW_FORMAT_RGBA8_SRGB, rhw_decode_bc3},
    [RHW_FORMAT_BC4_UNORM - FIRST] = {{.name = "RHW_FORMAT_BC4_UNORM"},
        4, 4, 8, RHW_FORMAT_R32_FLOAT, rhw_decode_bc4_unorm},
    [RHW_FORMAT_BC4_SNORM - FIRST] = {{.name = "RHW_FORMAT_BC4_SNORM"},
        4, 4, 8, RHW_FORMAT_R32_FLOAT, rhw_decode_bc4_snorm},
    [RHW_FORMAT_BC5_UNORM - FIRST] = {{.name = "RHW_FORMAT_BC5_UNORM"},
        4, 4, 16, RHW_FORMAT_RGBA32_FLOAT, rhw_decode_bc5_unorm},
    [RHW_FORMAT_BC5_SNORM - FIRST] = {{.name = "RHW_FORMAT_BC5_SNORM"},
        4, 4, 16, RHW_FORMAT_RGBA32_FLOAT, rhw_decode_bc5_snorm},
    [RHW_FORMAT_BC6H_UFLOAT - FIRST] = {{.name = "RHW_FORMAT_BC6H_UFLOAT"},
        4, 4, 16, RHW_FORMAT_RGBA16_FLOAT, rhw_decode_bc6h_ufloat},
    [RHW_FORMAT_BC6H_SFLOAT - FIRST] = {{.name = "RHW_FORMAT_BC6H_SFLOAT"},
        4, 4, 16, RHW_FORMAT_RGBA16_FLOAT, rhw_decode_bc6h_sfloat},
    [RHW_FORMAT_BC7_UNORM - FIRST] = {{.name = "RHW_FORMAT_BC7_UNORM"},
        4, 4, 16, RHW_FORMAT_RGBA8_UNORM, rhw_decode_bc7},
    [RHW_FORMAT_BC7_SRGB - FIRST] = {{.name = "RHW_FORMAT_BC7_SRGB"},
        4, 4, 16, RHW_FORMAT_RGBA8_SRGB, rhw_decode_bc7},
    [RHW_FORMAT_ETC2_RGB8_UNORM - FIRST] = {{.name = "RHW_FORMAT_ETC2_RGB8_UNORM"},
        4, 4, 8, RHW_FORMAT_RGBA8_UNORM, rhw_decode_etc2_rgb8},
    [RHW_FORMAT_ETC2_RGB8_SRGB - FIRST] = {{.name = "RHW_FORMAT_ETC2_RGB8_SRGB"},
        4, 4, 8, RHW_FORMAT_RGBA8_SRGB, rhw_decode_etc2_rgb8},
    [RHW_FORMAT_ETC2_RGB8A1_UNORM - FIRST] = {{.name = "RHW_FORMAT_ETC2_RGB8A1_UNORM"},
        4, 4, 8, RHW_FORMAT_RGBA8_UNORM, rhw_decode_etc2_rgb8a1},
    [RHW_FORMAT_ETC2_RGB8A1_SRGB - FIRST] = {{.name = "RHW_FORMAT_ETC2_RGB8A1_SRGB"},
        4, 4, 8, RHW_FORMAT_RGBA8_SRGB, rhw_decode_etc2_rgb8a1},
    [RHW_FORMAT_ETC2_RGBA8_UNORM - FIRST] = {{.name = "RHW_FORMAT_ETC2_RGBA8_UNORM"},
        4, 4, 16, RHW_FORMAT_RGBA8_UNORM, rhw_decode_etc2_rgba8},
    [RHW_FORMAT_ETC2_RGBA8_SRGB - FIRST] = {{.name = "RHW_FORMAT_ETC2_RGBA8_SRGB"},
        4, 4, 16, RHW_FORMAT_RGBA8_SRGB, rhw_decode_etc2_rgba8},
    [RHW_FORMAT_EAC_R11_UNORM - FIRST] = {{.name = "RHW_FORMAT_EAC_R11_UNORM"},
        4, 4, 8, RHW_FORMAT_R32_FLOAT, rhw_decode_eac_r11_unorm},
    [RHW_FORMAT_EAC_R11_SNORM - FIRST] = {{.name = "RHW_FORMAT_EAC_R11_SNORM"},
        4, 4, 8, RHW_FORMAT_R32_FLOAT, rhw_decode_eac_r11_snorm},
    [RHW_FORMAT_EAC_RG11_UNORM - FIRST] = {{.name = "RHW_FORMAT_EAC_RG11_UNORM"},
        4, 4, 16, RHW_FORMAT_RGBA32_FLOAT, rhw_decode_eac_rg11_unorm},
    [RHW_FORMAT_EAC_RG11_SNORM - FIRST] = {{.name = "RHW_FORMAT_EAC_RG11_SNORM"},
        4, 4, 16, RHW_FORMAT_RGBA32_FLOAT, rhw_decode_eac_rg11_snorm},
    [RHW_FORMAT_ASTC_4X4_UNORM - FIRST] = {{.name = "RHW_FORMAT_ASTC_4X4_UNORM"},
        4, 4, 16, RHW_FORMAT_RGBA8_UNORM, rhw_decode_astc_unorm},
    [RHW_FORMAT_ASTC_4X4_SRGB - FIRST] = {{.name = "RHW_FORMAT_ASTC_4X4_SRGB"},
        4, 4, 16, RHW_FORMAT_RGBA8_SRGB, rhw_decode_astc_srgb},
    [RHW_FORMAT_ASTC_5X4_UNORM - FIRST] = {{.name = "RHW_FORMAT_ASTC_5X4_UNORM"},
        5, 4, 16, RHW_FORMAT_RGBA8_UNORM, rhw_decode_astc_unorm},
    [RHW_FORMAT_ASTC_5X4_SRGB - FIRST] = {{.name = "RHW_FORMAT_ASTC_5X4_SRGB"},
        5, 4, 16, RHW_FORMAT_RGBA8_SRGB, rhw_decode_astc_srgb},
    [RHW_FORMAT_ASTC_5X5_UNORM - FIRST] = {{.name = "RHW_FORMAT_ASTC_5X5_UNORM"},
        5, 5, 16, RHW_FORMAT_RGBA8_UNORM, rhw_decode_astc_unorm},
    [RHW_FORMAT_ASTC_5X5_SRGB - FIRST] = {{.name = "RHW_FORMAT_ASTC_5X5_SRGB"},
        5, 5, 16, RHW_FORMAT_RGBA8_SRGB, rhw_decode_astc_srgb},
    [RHW_FORMAT_ASTC_6X5_UNORM - FIRST] = {{.name = "RHW_FORMAT_ASTC_6X5_UNORM"},
        6, 5, 16, RHW_FORMAT_RGBA8_UNORM, rhw_decode_astc_unorm},
    [RHW_FORMAT_ASTC_6X5_SRGB - FIRST] = {{.name = "RHW_FORMAT_ASTC_6X5_SRGB"},
        6, 5, 16, RHW_FORMAT_RGBA8_SRGB, rhw_decode_astc_srgb},
    [RHW_FORMAT_ASTC_6X6_UNORM - FIRST] = {{.name = "RHW_FORMAT_ASTC_6X6_UNORM"},
        6, 6, 16, RHW_FORMAT_RGBA8_UNORM, rhw_decode_astc_unorm},
    [RHW_FORMAT_ASTC_6X6_SRGB - FIRST] = {{.name = "RHW_FORMAT_ASTC_6X6_SRGB"},
        6, 6, 16, RHW_FORMAT_RGBA8_SRGB, rhw_decode_astc_srgb},
    [RHW_FORMAT_ASTC_8X5_UNORM - FIRST] = {{.name = "RHW_FORMAT_ASTC_8X5_UNORM"},
        8, 5, 16, RHW_FORMAT_RGBA8_UNORM, rhw_decode_astc_unorm},
    [RHW_FORMAT_ASTC_8X5_SRGB - FIRST] = {{.name = "RHW_FORMAT_ASTC_8X5_SRGB"},
        8, 5, 16, RHW_FORMAT_RGBA8_SRGB, rhw_decode_astc_srgb},
    [RHW_FORMAT_ASTC_8X6_UNORM - FIRST] = {{.name = "RHW_FORMAT_ASTC_8X6_UNORM"},
        8, 6, 16, RHW_FORMAT_RGBA8_UNORM, rhw_decode_astc_unorm},
    [RHW_FORMAT_ASTC_8X6_SRGB - FIRST] = {{.name = "RHW_FORMAT_ASTC_8X6_SRGB"},
        8, 6, 16, RHW_FORMAT_RGBA8_SRGB, rhw_decode_astc_srgb},
    [RHW_FORMAT_ASTC_8X8_UNORM - FIRST] = {{.name = "RHW_FORMAT_ASTC_8X8_UNORM"},
        8, 8, 16, RHW_FORMAT_RGBA8_UNORM, rhw_decode_astc_unorm},
    [RHW_FORMAT_ASTC_8X8_SRGB - FIRST] = {{.name = "RHW_FORMAT_ASTC_8X8_SRGB"},
        8, 8, 16, RHW_FORMAT_RGBA8_SRGB, rhw_decode_astc_srgb},
    [RHW_FORMAT_ASTC_10X5_UNORM - FIRST] = {{.name = "RHW_FORMAT_ASTC_10X5_UNORM"},
        10, 5, 16, RHW_FORMAT_RGBA8_UNORM, rhw_decode_astc_unorm},
    [RHW_FORMAT_ASTC_10X5_SRGB - FIRST] = {{.name = "RHW_FORMAT_ASTC_10X5_SRGB"},
        10, 5, 16, RHW_FORMAT_RGBA8_SRGB, rhw_decode_astc_srgb},
    [RHW_FORMAT_ASTC_10X6_UNORM - FIRST] = {{.name = "RHW_FORMAT_ASTC_10X6_UNORM"},
        10, 6, 16, RHW_FORMAT_RGBA8_UNORM, rhw_decode_astc_unorm},
    [RHW_FORMAT_ASTC_10X6_SRGB - FIRST] = {{.name = "RHW_FORMAT_ASTC_10X6_SRGB"},
        10, 6, 16, RHW_FORMAT_RGBA8_SRGB, rhw_decode_astc_srgb},
    [RHW_FORMAT_ASTC_10X8_UNORM - FIRST] = {{.name = "RHW_FORMAT_ASTC_10X8_UNORM"},
        10, 8, 16, RHW_FORMAT_RGBA8_UNORM, rhw_decode_astc_unorm},
    [RHW_FORMAT_ASTC_10X8_SRGB - FIRST] = {{.name = "RHW_FORMAT_ASTC_10X8_SRGB"},
        10, 8, 16, RHW_FORMAT_RGBA8_SRGB, rhw_decode_astc_srgb},
    [RHW_FORMAT_ASTC_10X10_UNORM - FIRST] = {{.name = "RHW_FORMAT_ASTC_10X10_UNORM"},
        10, 10, 16, RHW_FORMAT_RGBA8_UNORM, rhw_decode_astc_unorm},
    [RHW_FORMAT_ASTC_10X10_SRGB - FIRST] = {{.name = "RHW_FORMAT_ASTC_10X10_SRGB"},
        10, 10, 16, RHW_FORMAT_RGBA8_SRGB, rhw_decode_astc_srgb},
    [RHW_FORMAT_ASTC_12X10_UNORM - FIRST] = {{.name = "RHW_FORMAT_ASTC_12X10_UNORM"},
        12, 10, 16, RHW_FORMAT_RGBA8_UNORM, rhw_decode_astc_unorm},
    [RHW_FORMAT_ASTC_12X10_SRGB - FIRST] = {{.name = "RHW_FORMAT_ASTC_12X10_SRGB"},
        12, 10, 16, RHW_FORMAT_RGBA8_SRGB, rhw_decode_astc_srgb},
    [RHW_FORMAT_ASTC_12X12_UNORM - FIRST] = {{.name = "RHW_FORMAT_ASTC_12X12_UNORM"},
        12, 12, 16, RHW_FORMAT_RGBA8_UNORM, rhw_decode_astc_unorm},
    [RHW_FORMAT_ASTC_12X12_SRGB - FIRST] = {{.name = "RHW_FORMAT_ASTC_12X12_SRGB"},
        12, 12, 16, RHW_FORMAT_RGBA8_SRGB, rhw_decode_astc_srgb},
};
// clang-format on

const struct rhw_block_format *rhw_block_format(enum rhw_format format)
{
    const unsigned index = (unsigned)format - (unsigned)FIRST;
    return index < RHW_BLOCK_FORMAT_COUNT ? &formats[index] : NULL;
}

size_t rhw_format_row_size(enum rhw_format format, int width)
{
    const int block = rhw_format_block_width(format);
    return (size_t)((width + block - 1) / block) * rhw_format_block_bytes(format);
}

int rhw_format_block_width(enum rhw_format format)
{
    const struct rhw_block_format *const block = rhw_block_format(format);
    return block ? block->width : rhw_format_valid(format) ? 1 : 0;
}

int rhw_format_block_height(enum rhw_format format)
{
    const struct rhw_block_format *const block = rhw_block_format(format);
    return block ? block->height : rhw_format_valid(format) ? 1 : 0;
}

size_t rhw_format_block_bytes(enum rhw_format format)
{
    const struct rhw_block_format *const block = rhw_block_format(format);
    return block ? block->bytes : rhw_format_size(format);
}

enum rhw_format rhw_format_decoded(enum rhw_format format)
{
    const struct rhw_block_format *const block = rhw_block_format(format);
    return block ? block->decoded : rhw_format_valid(format) ? format : RHW_FORMAT_NONE;
}
