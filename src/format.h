// SPDX-License-Identifier: MIT
// What the library knows about texel and vertex formats, in one table each.
#ifndef RHW_FORMAT_H
#define RHW_FORMAT_H

#include "rhw/types.h"

// How a channel of a texel is stored.
enum rhw_texel_codec {
    RHW_CODEC_NONE,
    RHW_CODEC_UNORM8,
    RHW_CODEC_SRGB8, // UNORM8 with the sRGB transfer function on the colour channels
    RHW_CODEC_FLOAT16,
    RHW_CODEC_FLOAT32,
    RHW_CODEC_UINT32
};

struct rhw_format_info {
    const char *name; // "RHW_FORMAT_RGBA8_UNORM"
    uint8_t size;     // bytes per texel
    uint8_t channels;
    enum rhw_texel_codec codec;
    bool color_target;
    bool blend;   // as a colour target
    bool sampled; // rhw_sample and mip generation work on it
};

static inline bool rhw_format_valid(enum rhw_format format)
{
    return (unsigned)format > RHW_FORMAT_NONE && (unsigned)format < RHW_FORMAT_COUNT;
}

// `format` is NONE or valid.
const struct rhw_format_info *rhw_format_info(enum rhw_format format);

// In the order of enum rhw_vertex_format, which has four entries (1 to 4 components) of each.
enum rhw_vertex_type {
    RHW_TYPE_FLOAT,
    RHW_TYPE_HALF,
    RHW_TYPE_UNORM8,
    RHW_TYPE_SNORM8,
    RHW_TYPE_UINT8,
    RHW_TYPE_SINT8,
    RHW_TYPE_UNORM16,
    RHW_TYPE_SNORM16,
    RHW_TYPE_UINT16,
    RHW_TYPE_SINT16,
    RHW_TYPE_COUNT
};

static inline bool rhw_vertex_format_valid(enum rhw_vertex_format format)
{
    return (unsigned)format < RHW_VERTEX_FORMAT_COUNT;
}

static inline enum rhw_vertex_type rhw_vertex_format_type(enum rhw_vertex_format format)
{
    return (enum rhw_vertex_type)((unsigned)format / 4);
}

static inline int rhw_vertex_format_components(enum rhw_vertex_format format)
{
    return (int)((unsigned)format % 4) + 1;
}

// Bytes of one component.
static inline int rhw_vertex_type_size(enum rhw_vertex_type type)
{
    return type == RHW_TYPE_FLOAT ? 4 : type == RHW_TYPE_HALF || type >= RHW_TYPE_UNORM16 ? 2 : 1;
}

#endif
