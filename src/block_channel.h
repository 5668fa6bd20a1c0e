// SPDX-License-Identifier: MIT
// Channels of blocks that are decoded to floats: BC4, BC5 and EAC.
#ifndef RHW_BLOCK_CHANNEL_H
#define RHW_BLOCK_CHANNEL_H

#include <string.h>

#include "block_format.h"

static inline void rhw_store_float(const struct rhw_block_format *format, unsigned char *texels, int texel,
                                   int channel, float value)
{
    const size_t size = rhw_format_info(format->decoded)->size;
    memcpy(texels + size * (size_t)texel + sizeof value * (size_t)channel, &value, sizeof value);
}

// 0, 0, 0, 1 in all texels of a block.
static inline void rhw_store_opaque_black(const struct rhw_block_format *format, unsigned char *texels)
{
    const int channels = rhw_format_info(format->decoded)->channels;
    for (int i = 0; i < format->width * format->height; i++) {
        for (int c = 0; c < channels; c++) {
            rhw_store_float(format, texels, i, c, c == 3 ? 1.0f : 0.0f);
        }
    }
}

#endif
