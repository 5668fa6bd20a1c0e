// SPDX-License-Identifier: MIT
// Compressed texel formats. Their texels are decoded when they are written, into a format that the sampler knows: it
// has no code for blocks, and samples them as fast as RGBA8. The price is memory: they take as much as textures that
// were never compressed.
#ifndef RHW_BLOCK_FORMAT_H
#define RHW_BLOCK_FORMAT_H

#include "format.h"

enum {
    RHW_BLOCK_FORMAT_COUNT = RHW_FORMAT_ASTC_12X12_SRGB - RHW_FORMAT_BC1_RGB_UNORM + 1,
    RHW_BLOCK_TEXELS = 12 * 12, // texels of the largest block
    // Bytes of the largest block that is decoded. A block of 4 × 4 texels of 16 bytes has fewer.
    RHW_DECODED_BYTES = 12 * 12 * 4
};

struct rhw_block_format;

// Decode one block, of any bits, into rows of texels of the format `decoded`, one row behind the other.
typedef void rhw_block_decoder(const struct rhw_block_format *format, const unsigned char *block,
                               unsigned char *texels);

struct rhw_block_format {
    // The name. Texels in blocks are neither sampled nor drawn into, so nothing else is set.
    struct rhw_format_info info;
    uint8_t width, height; // texels
    uint8_t bytes;
    enum rhw_format decoded;
    rhw_block_decoder *decode;
};

// Return the format's row. Return NULL for formats that are not compressed, and for what is no format.
const struct rhw_block_format *rhw_block_format(enum rhw_format format);

// Return the bytes of a row of texels, or of blocks. `format` is valid.
size_t rhw_format_row_size(enum rhw_format format, int width);

#endif
