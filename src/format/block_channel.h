// SPDX-License-Identifier: MIT
// Channels of blocks that are decoded to floats: BC4, BC5 and EAC.
#ifndef RHW_BLOCK_CHANNEL_H
#define RHW_BLOCK_CHANNEL_H

#include <string.h>

#include "block_format.h"

enum { RHW_CHANNEL_TEXELS = 16 };

// Store channel `channel` of all texels.
static inline void rhw_store_channel(const struct rhw_block_format *format,
                                     const float value[RHW_CHANNEL_TEXELS], int channel,
                                     unsigned char *texels)
{
    const size_t size = rhw_format_info(format->decoded)->size;
    for (size_t i = 0; i < RHW_CHANNEL_TEXELS; i++) {
        memcpy(texels + size * i + sizeof value[i] * (size_t)channel, &value[i], sizeof value[i]);
    }
}

// Store 0 and 1 as the channels behind red and green, where texels have them.
static inline void rhw_store_blue_alpha(const struct rhw_block_format *format, unsigned char *texels)
{
    static const float zero[RHW_CHANNEL_TEXELS];
    static const float one[RHW_CHANNEL_TEXELS] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
    const int channels = rhw_format_info(format->decoded)->channels;
    for (int c = 2; c < channels; c++) {
        rhw_store_channel(format, c == 3 ? one : zero, c, texels);
    }
}

#endif
