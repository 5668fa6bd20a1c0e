// SPDX-License-Identifier: MIT
// What the library knows about texel and vertex formats. A row of the table of texel formats (format_table.h) says
// everything about one of them. Nothing else asks which format it has: it asks for a property in the row.
// kernels/texel/texel_fields.h and kernels/texel/texel_codec.h read and write the values of a codec.
#ifndef RHW_FORMAT_H
#define RHW_FORMAT_H

#include "rhw/types.h"

// How a channel of a texel is stored.
enum rhw_texel_codec {
    RHW_CODEC_NONE,
    RHW_CODEC_UNORM8,
    // Four channels: UNORM8 with the sRGB transfer function on the colour, alpha linear.
    RHW_CODEC_SRGB8,
    RHW_CODEC_FLOAT16,
    RHW_CODEC_FLOAT32,
    RHW_CODEC_BITS32,  // integers, whose bits shaders hand over
    RHW_CODEC_FIELDS,  // each channel is some bits of a word, which rhw_format_info names
    RHW_CODEC_DEPTH16, // one channel of UNORM in 16 bits
    RHW_CODEC_DEPTH24  // one channel of UNORM in the low 24 bits of 32
};

// What the bits of a channel are, where the codec leaves that open.
enum rhw_channel_type {
    RHW_CHANNEL_OTHER, // what the codec says
    RHW_CHANNEL_UNORM,
    RHW_CHANNEL_SNORM,
    RHW_CHANNEL_UINT,
    RHW_CHANNEL_SINT,
    RHW_CHANNEL_UFLOAT, // a half without its sign and its lowest bits
    RHW_CHANNEL_SHARED  // 9 bits of each colour, the exponent above them
};

// Where red stands among channels of a byte each.
enum rhw_channel_order { RHW_ORDER_RGBA, RHW_ORDER_BGRA, RHW_ORDER_ABGR };

// Formats that the sampler and blending have fast paths for.
enum rhw_texel_path { RHW_TEXELS_GENERAL, RHW_TEXELS_RGBA8_UNORM, RHW_TEXELS_RGBA8_SRGB };

// What a texture of a format can be. Each role is a bit.
enum {
    RHW_ROLE_COLOR_TARGET = 1,
    RHW_ROLE_BLENDED_TARGET = 2, // a colour target that blending works on
    RHW_ROLE_DEPTH_TARGET = 4,
    RHW_ROLE_SAMPLED = 8,
    RHW_ROLE_STENCIL_TARGET = 16,
    RHW_ROLE_FILTERED = 32 // filtered by linear filters, and by mip generation
};

enum {
    RHW_TEXEL_BYTES = 16, // bytes of the largest texel
    // Formats, NONE too, before the compressed ones (block_format.h).
    RHW_PLAIN_FORMAT_COUNT = RHW_FORMAT_BC1_RGB_UNORM
};

struct rhw_format_info {
    const char *name; // "RHW_FORMAT_RGBA8_UNORM"
    uint8_t size;     // bytes per texel
    // The channels, red first. Channels that the format lacks read 0, 0, 0, 1.
    uint8_t channels;
    enum rhw_texel_codec codec;
    enum rhw_texel_path path;
    uint8_t roles;
    enum rhw_channel_order order; // for UNORM8 and SRGB8
    enum rhw_channel_type type;   // for FIELDS and BITS32
    // For FIELDS: bits are counted from the lowest bit of the texel, and no channel crosses a word of 32 bits.
    uint8_t first[4], bits[4];
};

static inline bool rhw_format_valid(enum rhw_format format)
{
    return (unsigned)format > RHW_FORMAT_NONE && (unsigned)format < RHW_FORMAT_COUNT;
}

// Return the format's row. `format` is NONE or valid.
const struct rhw_format_info *rhw_format_info(enum rhw_format format);

// Report misuse of `where` and return false when `field` of a definition is no texel format.
struct rhw_context;
bool rhw_check_format(const struct rhw_context *context, const char *where, const char *field,
                      enum rhw_format format);

// Return true if shaders read and write the bits of its channels.
static inline bool rhw_format_is_integer(const struct rhw_format_info *info)
{
    return info->type == RHW_CHANNEL_UINT || info->type == RHW_CHANNEL_SINT;
}

// Return true if values are clamped to 0..1, or −1..1, before they are blended and stored.
static inline bool rhw_format_is_normalized(const struct rhw_format_info *info)
{
    return info->type == RHW_CHANNEL_UNORM || info->type == RHW_CHANNEL_SNORM ||
           info->codec == RHW_CODEC_UNORM8 || info->codec == RHW_CODEC_SRGB8 ||
           info->codec == RHW_CODEC_DEPTH16 || info->codec == RHW_CODEC_DEPTH24;
}

// Return where a channel of a byte stands, counted from the lowest byte. A texel of four channels has all orders.
static inline int rhw_channel_place(enum rhw_channel_order order, int channel)
{
    switch (order) {
    case RHW_ORDER_RGBA: return channel;
    case RHW_ORDER_BGRA: return channel == 3 ? 3 : 2 - channel;
    case RHW_ORDER_ABGR: return 3 - channel;
    }
    return channel;
}

// Return the least value of a normalized format.
static inline float rhw_format_least(const struct rhw_format_info *info)
{
    return info->type == RHW_CHANNEL_SNORM ? -1.0f : 0.0f;
}

// Set the bits of the words of a texel that hold a channel which the format has.
void rhw_format_channel_bits(const struct rhw_format_info *info, int channel, uint32_t words[4]);

// Return the number of steps between 0 and 1 that depth of the codec is rounded to. Return 0 where depth is a float.
static inline double rhw_codec_depth_steps(enum rhw_texel_codec codec)
{
    return codec == RHW_CODEC_DEPTH16 ? 0xffff : codec == RHW_CODEC_DEPTH24 ? 0xffffff : 0;
}

// Return true if textures of the format can have the role.
static inline bool rhw_format_has_role(const struct rhw_format_info *info, int role)
{
    return (info->roles & role) != 0;
}

// The types are in the order of enum rhw_vertex_format. It has four entries (1 to 4 components) of each type up to
// SINT32, and one of each type behind it.
enum rhw_vertex_type {
    RHW_TYPE_FLOAT,
    RHW_TYPE_HALF,
    RHW_TYPE_UNORM8,
    RHW_TYPE_SNORM8,
    RHW_TYPE_USCALED8,
    RHW_TYPE_SSCALED8,
    RHW_TYPE_UINT8,
    RHW_TYPE_SINT8,
    RHW_TYPE_UNORM16,
    RHW_TYPE_SNORM16,
    RHW_TYPE_USCALED16,
    RHW_TYPE_SSCALED16,
    RHW_TYPE_UINT16,
    RHW_TYPE_SINT16,
    RHW_TYPE_UINT32,
    RHW_TYPE_SINT32,
    RHW_TYPE_UNORM10,
    RHW_TYPE_SNORM10,
    RHW_TYPE_USCALED10,
    RHW_TYPE_SSCALED10,
    RHW_TYPE_UINT10,
    RHW_TYPE_SINT10,
    RHW_TYPE_BGRA8,
    RHW_TYPE_UNORM10_BGRA,
    RHW_TYPE_SNORM10_BGRA,
    RHW_TYPE_USCALED10_BGRA,
    RHW_TYPE_SSCALED10_BGRA,
    RHW_TYPE_UINT10_BGRA,
    RHW_TYPE_SINT10_BGRA
};

static inline bool rhw_vertex_format_valid(enum rhw_vertex_format format)
{
    return (unsigned)format < RHW_VERTEX_FORMAT_COUNT;
}

// Return the type. Words of doubles are those of integers.
static inline enum rhw_vertex_type rhw_vertex_format_type(enum rhw_vertex_format format)
{
    if (format == RHW_VERTEX_FLOAT64X1 || format == RHW_VERTEX_FLOAT64X2) {
        return RHW_TYPE_UINT32;
    }
    const unsigned packed = (unsigned)format - RHW_VERTEX_UNORM10_10_10_2;
    return (enum rhw_vertex_type)(format >= RHW_VERTEX_UNORM10_10_10_2 ? RHW_TYPE_UNORM10 + packed
                                                                       : (unsigned)format / 4);
}

// Return the components that the vertex function receives.
static inline int rhw_vertex_format_components(enum rhw_vertex_format format)
{
    return format == RHW_VERTEX_FLOAT64X1   ? 2
           : format >= RHW_VERTEX_FLOAT64X2 ? 4
                                            : (int)((unsigned)format % 4) + 1;
}

// Return the bytes of one component, or of all components where they share a word.
static inline int rhw_vertex_type_size(enum rhw_vertex_type type)
{
    return type == RHW_TYPE_FLOAT || type >= RHW_TYPE_UINT32   ? 4
           : type == RHW_TYPE_HALF || type >= RHW_TYPE_UNORM16 ? 2
                                                               : 1;
}

static inline bool rhw_vertex_type_is_integer(enum rhw_vertex_type type)
{
    return type == RHW_TYPE_UINT8 || type == RHW_TYPE_SINT8 || type == RHW_TYPE_UINT16 ||
           type == RHW_TYPE_SINT16 || type == RHW_TYPE_UINT32 || type == RHW_TYPE_SINT32 ||
           type == RHW_TYPE_UINT10 || type == RHW_TYPE_SINT10 || type == RHW_TYPE_UINT10_BGRA ||
           type == RHW_TYPE_SINT10_BGRA;
}

// How an attribute is fetched: its format taken apart.
struct rhw_fetch {
    uint32_t offset;
    uint8_t type, components, size; // enum rhw_vertex_type; components; bytes of all
    bool is_integer;
};

static inline struct rhw_fetch rhw_fetch_of(enum rhw_vertex_format format, uint32_t offset)
{
    const enum rhw_vertex_type type = rhw_vertex_format_type(format);
    return (struct rhw_fetch){offset, (uint8_t)type, (uint8_t)rhw_vertex_format_components(format),
                              (uint8_t)rhw_vertex_format_size(format), rhw_vertex_type_is_integer(type)};
}

#endif
