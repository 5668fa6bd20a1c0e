// SPDX-License-Identifier: MIT
// The format is that of Microsoft's "Programming Guide for DDS". Blocks and texels of floats are decoded by librhw, by
// way of vulkan_format.c. Texels of other formats are words whose channels are told by masks.
#include "dds.h"

#include <stdlib.h>
#include <string.h>

#include "vulkan_format.h"

enum {
    HEADER = 128,   // bytes, with the first four, which every DDS file has
    EXTENDED = 148, // bytes of the header of a file with a DXGI format
    PALETTE = 256 * 4,
};

// What a pixel format has, DDS_PIXELFORMAT.dwFlags.
enum { HAS_ALPHA = 1, ALPHA_ONLY = 2, HAS_CODE = 4, HAS_PALETTE = 0x20, HAS_RGB = 0x40, HAS_GREY = 0x20000 };

// What is done to the texels after decoding.
enum change { AS_IT_IS, GREY, NORMAL, UNMULTIPLY, RED_IN_ALPHA };

struct dds {
    const unsigned char *data; // texels of the first level
    size_t size;
    uint32_t width, height;
    uint32_t format; // VkFormat; 0 for words with masks
    enum change change;
    uint32_t bits;     // bits of a word
    uint32_t masks[4]; // a channel without a mask is 0; alpha is 1
    const unsigned char
        *palette; // colours that words of 8 bits are numbers of, as RGBA; NULL if there are none
};

static const char damaged[] = "damaged DDS", cut[] = "the DDS file ends too early",
                  unread[] = "a DDS file of a pixel format that is not read";

static uint32_t read_32(const unsigned char *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

// Formats ------------------------------------------------------------------------------------------------

enum {
    RGBA16 = 91,
    R16F = 76,
    RG16F = 83,
    RGBA16F = 97,
    R32F = 100,
    RG32F = 103,
    RGBA32F = 109,
    RG11B10F = 122,
    RGB9E5 = 123,
    BC1 = 133,
    BC2 = 135,
    BC3 = 137,
    BC4 = 139,
    BC4_SIGNED = 140,
    BC5 = 141,
    BC5_SIGNED = 142,
    BC6H_UNSIGNED = 143,
    BC6H_SIGNED = 144,
    BC7 = 145,
};

// Formats of Direct3D 9, by four characters. Some have the number of a D3DFORMAT instead.
static const struct {
    const char *name;
    uint32_t format; // VkFormat
    enum change change;
} named_formats[] = {
    {"DXT1", BC1, AS_IT_IS},
    {"DXT2", BC2, UNMULTIPLY},
    {"DXT3", BC2, AS_IT_IS},
    {"DXT4", BC3, UNMULTIPLY},
    {"DXT5", BC3, AS_IT_IS},
    {"RXGB", BC3, RED_IN_ALPHA},
    {"ATI1", BC4, GREY},
    {"BC4U", BC4, GREY},
    {"BC4S", BC4_SIGNED, GREY},
    {"ATI2", BC5, NORMAL},
    {"BC5U", BC5, NORMAL},
    {"BC5S", BC5_SIGNED, NORMAL},
    {"\x24\0\0", RGBA16, AS_IT_IS},
    {"\x6f\0\0", R16F, GREY},
    {"\x70\0\0", RG16F, AS_IT_IS},
    {"\x71\0\0", RGBA16F, AS_IT_IS},
    {"\x72\0\0", R32F, GREY},
    {"\x73\0\0", RG32F, AS_IT_IS},
    {"\x74\0\0", RGBA32F, AS_IT_IS},
};

// Formats by the number of a DXGI_FORMAT.
static const struct {
    uint32_t number, format; // format: VkFormat; 0 for words with masks
    enum change change;
    uint32_t bits, masks[4];
} numbered_formats[] = {
    {2, RGBA32F, AS_IT_IS, 0, {0}},
    {10, RGBA16F, AS_IT_IS, 0, {0}},
    {11, RGBA16, AS_IT_IS, 0, {0}},
    {16, RG32F, AS_IT_IS, 0, {0}},
    {24, 0, AS_IT_IS, 32, {0x3ff, 0xffc00, 0x3ff00000, 0xc0000000}},
    {26, RG11B10F, AS_IT_IS, 0, {0}},
    {28, 0, AS_IT_IS, 32, {0xff, 0xff00, 0xff0000, 0xff000000}},
    {29, 0, AS_IT_IS, 32, {0xff, 0xff00, 0xff0000, 0xff000000}},
    {34, RG16F, AS_IT_IS, 0, {0}},
    {35, 0, AS_IT_IS, 32, {0xffff, 0xffff0000, 0, 0}},
    {41, R32F, GREY, 0, {0}},
    {49, 0, AS_IT_IS, 16, {0xff, 0xff00, 0, 0}},
    {54, R16F, GREY, 0, {0}},
    {56, 0, GREY, 16, {0xffff, 0, 0, 0}},
    {61, 0, GREY, 8, {0xff, 0, 0, 0}},
    {65, 0, AS_IT_IS, 8, {0, 0, 0, 0xff}},
    {67, RGB9E5, AS_IT_IS, 0, {0}},
    {71, BC1, AS_IT_IS, 0, {0}},
    {72, BC1, AS_IT_IS, 0, {0}},
    {74, BC2, AS_IT_IS, 0, {0}},
    {75, BC2, AS_IT_IS, 0, {0}},
    {77, BC3, AS_IT_IS, 0, {0}},
    {78, BC3, AS_IT_IS, 0, {0}},
    {80, BC4, GREY, 0, {0}},
    {81, BC4_SIGNED, GREY, 0, {0}},
    {83, BC5, NORMAL, 0, {0}},
    {84, BC5_SIGNED, NORMAL, 0, {0}},
    {85, 0, AS_IT_IS, 16, {0xf800, 0x7e0, 0x1f, 0}},
    {86, 0, AS_IT_IS, 16, {0x7c00, 0x3e0, 0x1f, 0x8000}},
    {87, 0, AS_IT_IS, 32, {0xff0000, 0xff00, 0xff, 0xff000000}},
    {88, 0, AS_IT_IS, 32, {0xff0000, 0xff00, 0xff, 0}},
    {91, 0, AS_IT_IS, 32, {0xff0000, 0xff00, 0xff, 0xff000000}},
    {93, 0, AS_IT_IS, 32, {0xff0000, 0xff00, 0xff, 0}},
    {95, BC6H_UNSIGNED, AS_IT_IS, 0, {0}},
    {96, BC6H_SIGNED, AS_IT_IS, 0, {0}},
    {98, BC7, AS_IT_IS, 0, {0}},
    {99, BC7, AS_IT_IS, 0, {0}},
    {115, 0, AS_IT_IS, 16, {0xf00, 0xf0, 0xf, 0xf000}},
};

static bool take_named(struct dds *dds, const unsigned char code[4])
{
    for (size_t i = 0; i < sizeof named_formats / sizeof named_formats[0]; i++) {
        if (memcmp(named_formats[i].name, code, 4) == 0) {
            dds->format = named_formats[i].format;
            dds->change = named_formats[i].change;
            return true;
        }
    }
    return false;
}

static bool take_numbered(struct dds *dds, uint32_t number)
{
    for (size_t i = 0; i < sizeof numbered_formats / sizeof numbered_formats[0]; i++) {
        if (numbered_formats[i].number == number) {
            dds->format = numbered_formats[i].format;
            dds->change = numbered_formats[i].change;
            dds->bits = numbered_formats[i].bits;
            memcpy(dds->masks, numbered_formats[i].masks, sizeof dds->masks);
            return true;
        }
    }
    return false;
}

// Header -------------------------------------------------------------------------------------------------

// Read a pixel format that has masks, or a palette behind the header. Return false if it has neither.
static bool read_masks(struct dds *dds, uint32_t flags, const unsigned char *pixel_format)
{
    dds->bits = read_32(pixel_format + 12);
    for (size_t c = 0; c < 4; c++) {
        dds->masks[c] = read_32(pixel_format + 16 + 4 * c);
    }
    if ((flags & HAS_ALPHA) == 0 && (flags & ALPHA_ONLY) == 0) {
        dds->masks[3] = 0;
    }
    if ((flags & HAS_PALETTE) != 0 && dds->bits == 8 && dds->size >= PALETTE) {
        dds->palette = dds->data;
        dds->data += PALETTE;
        dds->size -= PALETTE;
        return true;
    }
    if ((flags & ALPHA_ONLY) != 0) {
        dds->masks[0] = dds->masks[1] = dds->masks[2] = 0;
    } else if ((flags & HAS_GREY) != 0) {
        dds->masks[1] = dds->masks[2] = 0;
        dds->change = GREY;
    } else if ((flags & HAS_RGB) == 0) {
        return false;
    }
    return dds->bits == 8 || dds->bits == 16 || dds->bits == 24 || dds->bits == 32;
}

bool scene_dds_size(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height)
{
    if (size < HEADER) {
        return false;
    }
    *height = read_32(bytes + 12);
    *width = read_32(bytes + 16);
    return true;
}

static const char *open_file(const unsigned char *bytes, size_t size, struct dds *dds)
{
    enum { CUBE = 0x200, VOLUME = 0x200000 };    // bits of dwCaps2
    enum { EXTENDED_CUBE = 4, EXTENDED_2D = 3 }; // a bit of miscFlag, and a resourceDimension
    *dds = (struct dds){0};
    if (!scene_dds_size(bytes, size, &dds->width, &dds->height)) {
        return cut;
    }
    const unsigned char *const pixel_format = bytes + 76;
    const uint32_t flags = read_32(pixel_format + 4), kind = read_32(bytes + 112);
    const bool is_extended = (flags & HAS_CODE) != 0 && memcmp(pixel_format + 8, "DX10", 4) == 0;
    if (is_extended && size < EXTENDED) {
        return cut;
    }
    if ((kind & CUBE) != 0 || (is_extended && (read_32(bytes + 136) & EXTENDED_CUBE) != 0)) {
        return "a DDS file of a cube map";
    }
    if ((kind & VOLUME) != 0 || (is_extended && read_32(bytes + 132) != EXTENDED_2D)) {
        return "a DDS file of slices or of one dimension";
    }
    dds->data = bytes + (is_extended ? EXTENDED : HEADER);
    dds->size = size - (is_extended ? EXTENDED : HEADER);
    const bool known = is_extended               ? take_numbered(dds, read_32(bytes + 128))
                       : (flags & HAS_CODE) != 0 ? take_named(dds, pixel_format + 8)
                                                 : read_masks(dds, flags, pixel_format);
    return known ? NULL : unread;
}

// Words --------------------------------------------------------------------------------------------------

// The bits of a word that a channel has.
struct channel {
    uint32_t shift, most;
};

static struct channel channel_of(uint32_t mask)
{
    struct channel channel = {0, mask};
    while (channel.most != 0 && (channel.most & 1) == 0) {
        channel.most >>= 1;
        channel.shift++;
    }
    return channel;
}

static uint32_t read_word(const unsigned char *bytes, uint32_t length)
{
    uint32_t word = 0;
    for (uint32_t i = 0; i < length; i++) {
        word |= (uint32_t)bytes[i] << 8 * i;
    }
    return word;
}

// Return the value of a channel, rounded to 0..`full`.
static uint32_t value_of(uint32_t word, const struct channel *channel, uint32_t full)
{
    const uint64_t value = word >> channel->shift & channel->most;
    return (uint32_t)((value * full + channel->most / 2) / channel->most);
}

static const char *decode_words(const struct dds *dds, struct scene_image *image)
{
    const uint32_t length = dds->bits / 8;
    const size_t count = (size_t)dds->width * dds->height;
    struct channel channels[4];
    bool is_wide = false;
    if (dds->size / length < count) {
        return cut;
    }
    for (int c = 0; c < 4; c++) {
        channels[c] = channel_of(dds->masks[c]);
        is_wide = is_wide || channels[c].most > UINT8_MAX;
    }
    const uint32_t full = is_wide ? UINT16_MAX : UINT8_MAX;
    image->type = is_wide ? SCENE_IMAGE_RGBA16 : SCENE_IMAGE_RGBA8;
    image->size = count * (is_wide ? 8 : 4);
    image->texels = malloc(image->size);
    if (image->texels == NULL) {
        return "outofmem";
    }
    uint8_t *const bytes = image->texels;
    uint16_t *const words = image->texels;
    for (size_t i = 0; i < count; i++) {
        const uint32_t word = read_word(dds->data + i * length, length);
        for (int c = 0; c < 4; c++) {
            const uint32_t none = c == 3 ? full : 0;
            const uint32_t value = channels[c].most == 0 ? none : value_of(word, &channels[c], full);
            if (is_wide) {
                words[4 * i + (size_t)c] = (uint16_t)value;
            } else {
                bytes[4 * i + (size_t)c] = (uint8_t)value;
            }
        }
    }
    return NULL;
}

static const char *decode_palette(const struct dds *dds, struct scene_image *image)
{
    const size_t count = (size_t)dds->width * dds->height;
    if (dds->size < count) {
        return cut;
    }
    image->type = SCENE_IMAGE_RGBA8;
    image->size = count * 4;
    image->texels = malloc(image->size);
    if (image->texels == NULL) {
        return "outofmem";
    }
    for (size_t i = 0; i < count; i++) {
        memcpy((uint8_t *)image->texels + 4 * i, dds->palette + 4 * (size_t)dds->data[i], 4);
    }
    return NULL;
}

// Changes ------------------------------------------------------------------------------------------------

// Divide the colour of an RGBA8 texel by its alpha.
static void unmultiply(uint8_t texel[4])
{
    for (int c = 0; c < 3 && texel[3] > 0; c++) {
        const int straight = (texel[c] * UINT8_MAX + texel[3] / 2) / texel[3];
        texel[c] = (uint8_t)(straight < UINT8_MAX ? straight : UINT8_MAX);
    }
}

// Find the third component of a unit vector whose others are two numbers of 16 bits.
static uint16_t third_component(uint16_t red, uint16_t green)
{
    const float x = (float)red / 32767.5f - 1, y = (float)green / 32767.5f - 1, rest = 1 - x * x - y * y;
    return (uint16_t)((rest > 0 ? __builtin_sqrtf(rest) : 0) * 32767.5f + 32767.5f);
}

static void change_texels(enum change change, struct scene_image *image)
{
    const size_t count = (size_t)image->width * image->height;
    const size_t sample = image->type == SCENE_IMAGE_RGBA8 ? 1 : image->type == SCENE_IMAGE_RGBA16 ? 2 : 4;
    for (size_t i = 0; i < count && change != AS_IT_IS; i++) {
        uint8_t *const texel = (uint8_t *)image->texels + 4 * sample * i;
        if (change == GREY) {
            memcpy(texel + sample, texel, sample);
            memcpy(texel + 2 * sample, texel, sample);
        } else if (change == NORMAL && image->type == SCENE_IMAGE_RGBA16) {
            uint16_t *const words = (uint16_t *)image->texels + 4 * i;
            words[2] = third_component(words[0], words[1]);
        } else if (change == UNMULTIPLY) {
            unmultiply(texel);
        } else if (change == RED_IN_ALPHA) {
            texel[0] = texel[3];
            texel[3] = UINT8_MAX;
        }
    }
}

static const char *decode_known(const struct dds *dds, struct scene_image *image)
{
    const size_t size = scene_vulkan_size(dds->format, dds->width, dds->height);
    return size == 0 ? damaged : dds->size < size ? cut : scene_vulkan_decode(dds->format, dds->data, image);
}

const char *scene_image_decode_dds(const unsigned char *bytes, size_t size, struct scene_image *image)
{
    struct dds dds;
    const char *problem = open_file(bytes, size, &dds);
    if (problem != NULL) {
        return problem;
    }
    struct scene_image made = *image;
    made.width = dds.width;
    made.height = dds.height;
    problem = dds.palette != NULL ? decode_palette(&dds, &made)
              : dds.format != 0   ? decode_known(&dds, &made)
                                  : decode_words(&dds, &made);
    if (problem == NULL) {
        change_texels(dds.change, &made);
        *image = made;
    }
    return problem;
}
