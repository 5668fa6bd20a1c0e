// SPDX-License-Identifier: MIT
// Compressed texel formats. Their texels are decoded when they are written, into a format that the sampler knows: it has
// no code for blocks, and what samples RGBA8 fast samples these as fast. The price is memory, as for textures that were
// never compressed.
#ifndef RHW_BLOCK_FORMAT_H
#define RHW_BLOCK_FORMAT_H

#include "format.h"

enum {
    RHW_BLOCK_FORMAT_COUNT = RHW_FORMAT_ASTC_12X12_SRGB - RHW_FORMAT_BC1_RGB_UNORM + 1,
    RHW_BLOCK_TEXELS = 12 * 12, // of the largest block
    RHW_DECODED_BYTES =
        12 * 12 * 4 // of the largest block that is decoded; 4 × 4 texels of 16 bytes are fewer
};

struct rhw_block_format;

// Decodes one block, of any bits, into rows of texels of the format `decoded`, one behind the other.
typedef void rhw_block_decoder(const struct rhw_block_format *format, const unsigned char *block,
                               unsigned char *texels);

struct rhw_block_format {
    struct rhw_format_info info; // the name; texels in blocks are neither sampled nor drawn into
    uint8_t width, height;       // texels
    uint8_t bytes;
    enum rhw_format decoded;
    rhw_block_decoder *decode;
};

// NULL for formats that are not compressed, and for what is no format.
const struct rhw_block_format *rhw_block_format(enum rhw_format format);

// Bytes of a row of texels, or of blocks. `format` is valid.
size_t rhw_format_row_size(enum rhw_format format, int width);

#endif
