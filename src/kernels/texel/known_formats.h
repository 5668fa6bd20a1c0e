// SPDX-License-Identifier: MIT
// The rows of formats that are common as targets (enum rhw_known_format), for the compiler to see. A codec that is
// given one of these rows as a constant asks nothing of it when it runs, and leaves out what the format lacks.
#ifndef RHW_KNOWN_FORMATS_H
#define RHW_KNOWN_FORMATS_H

#include "format/format.h"

// A row has what the table of formats has, as far as codecs read it: test_blend_kernel.c compares them.
static const struct rhw_format_info rhw_known_formats[RHW_KNOWN_COUNT] = {
    [RHW_KNOWN_R8] = {.size = 1, .channels = 1, .codec = RHW_CODEC_UNORM8},
    [RHW_KNOWN_RG8] = {.size = 2, .channels = 2, .codec = RHW_CODEC_UNORM8},
    [RHW_KNOWN_BGRA8] = {.size = 4, .channels = 4, .codec = RHW_CODEC_UNORM8, .order = RHW_ORDER_BGRA},
    [RHW_KNOWN_BGRA8_SRGB] = {.size = 4, .channels = 4, .codec = RHW_CODEC_SRGB8, .order = RHW_ORDER_BGRA},
    [RHW_KNOWN_R16] =
        {.size = 2, .channels = 1, .codec = RHW_CODEC_FIELDS, .type = RHW_CHANNEL_UNORM, .bits = {16}},
    [RHW_KNOWN_RG16] = {.size = 4,
                        .channels = 2,
                        .codec = RHW_CODEC_FIELDS,
                        .type = RHW_CHANNEL_UNORM,
                        .first = {0, 16},
                        .bits = {16, 16}},
    [RHW_KNOWN_RGBA16] = {.size = 8,
                          .channels = 4,
                          .codec = RHW_CODEC_FIELDS,
                          .type = RHW_CHANNEL_UNORM,
                          .first = {0, 16, 32, 48},
                          .bits = {16, 16, 16, 16}},
    [RHW_KNOWN_RGB10A2] = {.size = 4,
                           .channels = 4,
                           .codec = RHW_CODEC_FIELDS,
                           .type = RHW_CHANNEL_UNORM,
                           .first = {0, 10, 20, 30},
                           .bits = {10, 10, 10, 2}},
    [RHW_KNOWN_RGB565] = {.size = 2,
                          .channels = 3,
                          .codec = RHW_CODEC_FIELDS,
                          .type = RHW_CHANNEL_UNORM,
                          .first = {11, 5, 0},
                          .bits = {5, 6, 5}},
    [RHW_KNOWN_R16_FLOAT] = {.size = 2, .channels = 1, .codec = RHW_CODEC_FLOAT16},
    [RHW_KNOWN_RG16_FLOAT] = {.size = 4, .channels = 2, .codec = RHW_CODEC_FLOAT16},
    [RHW_KNOWN_RGBA16_FLOAT] = {.size = 8, .channels = 4, .codec = RHW_CODEC_FLOAT16},
    [RHW_KNOWN_R32_FLOAT] = {.size = 4, .channels = 1, .codec = RHW_CODEC_FLOAT32},
    [RHW_KNOWN_RG32_FLOAT] = {.size = 8, .channels = 2, .codec = RHW_CODEC_FLOAT32},
    [RHW_KNOWN_RGBA32_FLOAT] = {.size = 16, .channels = 4, .codec = RHW_CODEC_FLOAT32},
};

#endif
