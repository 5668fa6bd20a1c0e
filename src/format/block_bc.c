// SPDX-License-Identifier: MIT
// BC1 to BC5 (S3TC and RGTC). The specification gives their values as fractions, of 5 and 6 bits or of bytes, mixed in
// halves, thirds, fifths or sevenths. Here they are computed as whole numbers over the common denominator and rounded
// once, to the nearest code or float. (Decoders that widen 5 bits to 8 first, and then cut thirds off, are up to a code
// away.)
#include <string.h>

#include "block_bits.h"
#include "block_channel.h"
#include "block_decoders.h"

enum { SIDE = 4, TEXELS = SIDE * SIDE, RGBA = 4 };

// Return the code of 8 bits nearest to a / b, which is 0..1, and the greater code where two are equally near.
static unsigned char nearest_code(int a, int b)
{
    return (unsigned char)((2 * 255 * a + b) / (2 * b));
}

// Colours ----------------------------------------------------------------------------------------------

// Mix the palette of a colour block. It has two colours of 565 bits and two between them. Where the first is not the
// greater number and `blends_half` is true, it has one colour between them, and black.
static void mix_colors(const unsigned char *block, bool blends_half, unsigned char palette[4][3])
{
    const int color[2] = {block[0] | block[1] << 8, block[2] | block[3] << 8};
    const bool half = blends_half && color[0] <= color[1];
    static const int shift[3] = {11, 5, 0}, most[3] = {31, 63, 31};
    for (int c = 0; c < 3; c++) {
        const int a = color[0] >> shift[c] & most[c];
        const int b = color[1] >> shift[c] & most[c];
        palette[0][c] = nearest_code(a, most[c]);
        palette[1][c] = nearest_code(b, most[c]);
        palette[2][c] = half ? nearest_code(a + b, 2 * most[c]) : nearest_code(2 * a + b, 3 * most[c]);
        palette[3][c] = half ? 0 : nearest_code(a + 2 * b, 3 * most[c]);
    }
}

// Decode colours. Index 3 has alpha 0 where it stands for black and `clears` is true.
static void decode_colors(const unsigned char *block, bool blends_half, bool clears, unsigned char *texels)
{
    unsigned char palette[4][3];
    mix_colors(block, blends_half, palette);
    const bool half = (block[0] | block[1] << 8) <= (block[2] | block[3] << 8);
    for (int i = 0; i < TEXELS; i++) {
        const int index = block[4 + i / 4] >> 2 * (i % 4) & 3;
        memcpy(texels + RGBA * i, palette[index], 3);
        texels[RGBA * i + 3] = clears && half && index == 3 ? 0 : 255;
    }
}

void rhw_decode_bc1_rgb(const struct rhw_block_format *format, const unsigned char *block,
                        unsigned char *texels)
{
    (void)format;
    decode_colors(block, true, false, texels);
}

void rhw_decode_bc1_rgba(const struct rhw_block_format *format, const unsigned char *block,
                         unsigned char *texels)
{
    (void)format;
    decode_colors(block, true, true, texels);
}

void rhw_decode_bc2(const struct rhw_block_format *format, const unsigned char *block, unsigned char *texels)
{
    (void)format;
    decode_colors(block + 8, false, false, texels);
    for (int i = 0; i < TEXELS; i++) {
        texels[RGBA * i + 3] = (unsigned char)(17 * (block[i / 2] >> 4 * (i % 2) & 15));
    }
}

// Channels ---------------------------------------------------------------------------------------------

// A channel is a palette of whole numbers over one denominator.
struct channel {
    int value[8], denominator;
};

// Mix the palette of a channel. It has two ends and six steps between them. Where the first end is not the greater one,
// it has four steps, and the least and the greatest number there is.
static struct channel mix_channel(int first, int second, bool by_sevenths, int least, int most)
{
    struct channel channel = {.denominator = by_sevenths ? 7 * most : 5 * most};
    const int steps = by_sevenths ? 7 : 5;
    channel.value[0] = steps * first;
    channel.value[1] = steps * second;
    for (int i = 1; i < steps; i++) {
        channel.value[i + 1] = (steps - i) * first + i * second;
    }
    if (!by_sevenths) {
        channel.value[6] = steps * least;
        channel.value[7] = steps * most;
    }
    return channel;
}

static struct channel mix_unorm(const unsigned char *block)
{
    return mix_channel(block[0], block[1], block[0] > block[1], 0, 255);
}

// Mix a signed palette. −128 counts as −127, except where the ends are compared.
static struct channel mix_snorm(const unsigned char *block)
{
    const int first = rhw_sign_extend(block[0], 8), second = rhw_sign_extend(block[1], 8);
    return mix_channel(first < -127 ? -127 : first, second < -127 ? -127 : second, first > second, -127, 127);
}

static int channel_index(const unsigned char *block, int texel)
{
    return rhw_bits_of(rhw_load_little(block), 16 + 3 * texel, 3);
}

void rhw_decode_bc3(const struct rhw_block_format *format, const unsigned char *block, unsigned char *texels)
{
    (void)format;
    decode_colors(block + 8, false, false, texels);
    const struct channel alpha = mix_unorm(block);
    for (int i = 0; i < TEXELS; i++) {
        texels[RGBA * i + 3] = nearest_code(alpha.value[channel_index(block, i)], alpha.denominator);
    }
}

static void store_channel(const struct rhw_block_format *format, const unsigned char *block,
                          const struct channel *channel, int c, unsigned char *texels)
{
    float palette[8], value[TEXELS];
    for (int i = 0; i < 8; i++) {
        palette[i] = (float)channel->value[i] / (float)channel->denominator;
    }
    for (int i = 0; i < TEXELS; i++) {
        value[i] = palette[channel_index(block, i)];
    }
    rhw_store_channel(format, value, c, texels);
}

void rhw_decode_bc4_unorm(const struct rhw_block_format *format, const unsigned char *block,
                          unsigned char *texels)
{
    const struct channel red = mix_unorm(block);
    store_channel(format, block, &red, 0, texels);
}

void rhw_decode_bc4_snorm(const struct rhw_block_format *format, const unsigned char *block,
                          unsigned char *texels)
{
    const struct channel red = mix_snorm(block);
    store_channel(format, block, &red, 0, texels);
}

void rhw_decode_bc5_unorm(const struct rhw_block_format *format, const unsigned char *block,
                          unsigned char *texels)
{
    const struct channel red = mix_unorm(block), green = mix_unorm(block + 8);
    rhw_store_blue_alpha(format, texels);
    store_channel(format, block, &red, 0, texels);
    store_channel(format, block + 8, &green, 1, texels);
}

void rhw_decode_bc5_snorm(const struct rhw_block_format *format, const unsigned char *block,
                          unsigned char *texels)
{
    const struct channel red = mix_snorm(block), green = mix_snorm(block + 8);
    rhw_store_blue_alpha(format, texels);
    store_channel(format, block, &red, 0, texels);
    store_channel(format, block + 8, &green, 1, texels);
}
