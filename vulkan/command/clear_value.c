// SPDX-License-Identifier: MIT
#include "clear_value.h"

#include <string.h>

// Return the bits of a channel of an integer format, negative ones of a format with a sign, and 0 of other formats.
static int channel_bits(enum rhw_format format, int channel)
{
    switch (format) {
    case RHW_FORMAT_R8_UINT:
    case RHW_FORMAT_RG8_UINT:
    case RHW_FORMAT_RGBA8_UINT:
    case RHW_FORMAT_S8_UINT: return 8;
    case RHW_FORMAT_R8_SINT:
    case RHW_FORMAT_RG8_SINT:
    case RHW_FORMAT_RGBA8_SINT: return -8;
    case RHW_FORMAT_R16_UINT:
    case RHW_FORMAT_RG16_UINT:
    case RHW_FORMAT_RGBA16_UINT: return 16;
    case RHW_FORMAT_R16_SINT:
    case RHW_FORMAT_RG16_SINT:
    case RHW_FORMAT_RGBA16_SINT: return -16;
    case RHW_FORMAT_R32_UINT:
    case RHW_FORMAT_RG32_UINT:
    case RHW_FORMAT_RGBA32_UINT:
    case RHW_FORMAT_R32_SINT:
    case RHW_FORMAT_RG32_SINT:
    case RHW_FORMAT_RGBA32_SINT: return 32;
    case RHW_FORMAT_RGB10A2_UINT: return channel == 3 ? 2 : 10;
    default: return 0;
    }
}

void vulkan_clear_color(enum rhw_format format, const VkClearColorValue *value, float color[4],
                        int32_t integer[4])
{
    memset(color, 0, 4 * sizeof *color);
    memset(integer, 0, 4 * sizeof *integer);
    for (int i = 0; i < 4; i++) {
        const int bits = channel_bits(format, i);
        if (bits == 0) {
            color[i] = value->float32[i];
        } else {
            const int unused = 32 - (bits < 0 ? -bits : bits);
            const uint32_t high = value->uint32[i] << unused;
            integer[i] = bits < 0 ? (int32_t)high >> unused : (int32_t)(high >> unused);
        }
    }
}

float vulkan_clear_depth(float depth)
{
    return depth > 0 ? depth < 1 ? depth : 1 : 0;
}
