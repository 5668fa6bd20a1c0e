// SPDX-License-Identifier: MIT
// EAC: the alpha of ETC2, and formats of one and two channels of 11 bits, which are decoded to floats.
#include "block_eac.h"

#include "block_bits.h"
#include "block_channel.h"
#include "block_decoders.h"

enum { SIDE = 4, TEXELS = SIDE * SIDE, MOST_UNORM = 2047, MOST_SNORM = 1023 };

static const int8_t modifiers[16][8] = {
    {-3, -6, -9, -15, 2, 5, 8, 14}, {-3, -7, -10, -13, 2, 6, 9, 12}, {-2, -5, -8, -13, 1, 4, 7, 12},
    {-2, -4, -6, -13, 1, 3, 5, 12}, {-3, -6, -8, -12, 2, 5, 7, 11},  {-3, -7, -9, -11, 2, 6, 8, 10},
    {-4, -7, -8, -11, 3, 6, 7, 10}, {-3, -5, -8, -11, 2, 4, 7, 10},  {-2, -6, -8, -10, 1, 5, 7, 9},
    {-2, -5, -8, -10, 1, 4, 7, 9},  {-2, -4, -8, -10, 1, 3, 7, 9},   {-2, -5, -7, -10, 1, 4, 6, 9},
    {-3, -4, -7, -10, 2, 3, 6, 9},  {-1, -2, -3, -10, 0, 1, 2, 9},   {-4, -6, -8, -9, 3, 5, 7, 8},
    {-3, -5, -7, -9, 2, 4, 6, 8},
};

struct rhw_eac_block rhw_eac_open(const unsigned char *block)
{
    const uint64_t bits = rhw_load_big(block);
    return (struct rhw_eac_block){bits, rhw_bits_of(bits, 56, 8), rhw_bits_of(bits, 52, 4)};
}

int rhw_eac_modifier(const struct rhw_eac_block *block, int texel)
{
    const int at = SIDE * (texel % SIDE) + texel / SIDE; // texels run down the columns
    return modifiers[rhw_bits_of(block->bits, 48, 4)][rhw_bits_of(block->bits, 45 - 3 * at, 3)];
}

static int clamp(int value, int least, int most)
{
    return value < least ? least : value > most ? most : value;
}

// Return eight times the modifier times the multiplier. A multiplier of 0 stands for an eighth.
static int offset_11(const struct rhw_eac_block *eac, int texel)
{
    return rhw_eac_modifier(eac, texel) * (eac->multiplier != 0 ? 8 * eac->multiplier : 1);
}

static void decode_unorm(const struct rhw_block_format *format, const unsigned char *block, int channel,
                         unsigned char *texels)
{
    const struct rhw_eac_block eac = rhw_eac_open(block);
    float value[TEXELS];
    for (int i = 0; i < TEXELS; i++) {
        const int code = clamp(8 * eac.base + 4 + offset_11(&eac, i), 0, MOST_UNORM);
        value[i] = (float)code / (float)MOST_UNORM;
    }
    rhw_store_channel(format, value, channel, texels);
}

// Decode a signed block. A base of −128 counts as −127.
static void decode_snorm(const struct rhw_block_format *format, const unsigned char *block, int channel,
                         unsigned char *texels)
{
    const struct rhw_eac_block eac = rhw_eac_open(block);
    const int base = clamp(rhw_sign_extend(eac.base, 8), -127, 127);
    float value[TEXELS];
    for (int i = 0; i < TEXELS; i++) {
        const int code = clamp(8 * base + offset_11(&eac, i), -MOST_SNORM, MOST_SNORM);
        value[i] = (float)code / (float)MOST_SNORM;
    }
    rhw_store_channel(format, value, channel, texels);
}

void rhw_decode_eac_r11_unorm(const struct rhw_block_format *format, const unsigned char *block,
                              unsigned char *texels)
{
    decode_unorm(format, block, 0, texels);
}

void rhw_decode_eac_r11_snorm(const struct rhw_block_format *format, const unsigned char *block,
                              unsigned char *texels)
{
    decode_snorm(format, block, 0, texels);
}

void rhw_decode_eac_rg11_unorm(const struct rhw_block_format *format, const unsigned char *block,
                               unsigned char *texels)
{
    rhw_store_blue_alpha(format, texels);
    decode_unorm(format, block, 0, texels);
    decode_unorm(format, block + 8, 1, texels);
}

void rhw_decode_eac_rg11_snorm(const struct rhw_block_format *format, const unsigned char *block,
                               unsigned char *texels)
{
    rhw_store_blue_alpha(format, texels);
    decode_snorm(format, block, 0, texels);
    decode_snorm(format, block + 8, 1, texels);
}
