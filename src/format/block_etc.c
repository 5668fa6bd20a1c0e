// SPDX-License-Identifier: MIT
// ETC2 has colours in five modes. A bit chooses between the two modes of ETC1. The three new modes hide where the
// differences of ETC1 leave 0..31, in red, green or blue. Bits are counted from the end of the block, and texels run
// down the columns.
#include <string.h>

#include "block_bits.h"
#include "block_decoders.h"
#include "block_eac.h"

enum { SIDE = 4, TEXELS = SIDE * SIDE, RGBA = 4 };

// Each table has a small and a large step, which are added to a base colour.
static const uint8_t steps[8][2] = {{2, 8},   {5, 17},  {9, 29},   {13, 42},
                                    {18, 60}, {24, 80}, {33, 106}, {47, 183}};
static const uint8_t distances[8] = {3, 6, 11, 16, 23, 32, 41, 64};

// Widen a number of `bits` to 8 bits by repeating the highest ones.
static int widen(int value, int bits)
{
    const int high = value << (8 - bits);
    return high | high >> bits;
}

static unsigned char clamp_code(int value)
{
    return (unsigned char)(value < 0 ? 0 : value > 255 ? 255 : value);
}

static void add_to_color(const int base[3], int step, unsigned char texel[RGBA])
{
    for (int c = 0; c < 3; c++) {
        texel[c] = clamp_code(base[c] + step);
    }
    texel[3] = 255;
}

// Return the index of a texel. The texel at column x, row y, has bit 4x + y of both halves of the lower word.
static int index_of(uint64_t bits, int texel)
{
    const int at = SIDE * (texel % SIDE) + texel / SIDE;
    return rhw_bits_of(bits, 16 + at, 1) << 1 | rhw_bits_of(bits, at, 1);
}

// Decode two halves of a block, each with a base colour and a table of steps. Where the block is not opaque the small
// steps are 0, and index 2 is transparent black.
static void decode_halves(uint64_t bits, int base[2][3], bool opaque, unsigned char *texels)
{
    const bool one_above_other = rhw_bits_of(bits, 32, 1) != 0;
    for (int i = 0; i < TEXELS; i++) {
        const int half = (one_above_other ? i / SIDE : i % SIDE) / 2;
        const uint8_t *const step = steps[rhw_bits_of(bits, half == 0 ? 37 : 34, 3)];
        const int index = index_of(bits, i);
        const int size = index & 1 ? step[1] : opaque ? step[0] : 0;
        add_to_color(base[half], index & 2 ? -size : size, texels + RGBA * i);
        if (!opaque && index == 2) {
            memset(texels + RGBA * i, 0, RGBA);
        }
    }
}

static void decode_individual(uint64_t bits, unsigned char *texels)
{
    int base[2][3];
    for (int c = 0; c < 3; c++) {
        base[0][c] = widen(rhw_bits_of(bits, 60 - 8 * c, 4), 4);
        base[1][c] = widen(rhw_bits_of(bits, 56 - 8 * c, 4), 4);
    }
    decode_halves(bits, base, true, texels);
}

// Paint texels with four colours, one for each index.
static void paint(uint64_t bits, unsigned char palette[4][RGBA], bool opaque, unsigned char *texels)
{
    if (!opaque) {
        memset(palette[2], 0, RGBA);
    }
    for (int i = 0; i < TEXELS; i++) {
        memcpy(texels + RGBA * i, palette[index_of(bits, i)], RGBA);
    }
}

static void decode_t(uint64_t bits, bool opaque, unsigned char *texels)
{
    const int first[3] = {widen(rhw_bits_of(bits, 59, 2) << 2 | rhw_bits_of(bits, 56, 2), 4),
                          widen(rhw_bits_of(bits, 52, 4), 4), widen(rhw_bits_of(bits, 48, 4), 4)};
    const int second[3] = {widen(rhw_bits_of(bits, 44, 4), 4), widen(rhw_bits_of(bits, 40, 4), 4),
                           widen(rhw_bits_of(bits, 36, 4), 4)};
    const int distance = distances[rhw_bits_of(bits, 34, 2) << 1 | rhw_bits_of(bits, 32, 1)];
    unsigned char palette[4][RGBA];
    add_to_color(first, 0, palette[0]);
    add_to_color(second, distance, palette[1]);
    add_to_color(second, 0, palette[2]);
    add_to_color(second, -distance, palette[3]);
    paint(bits, palette, opaque, texels);
}

static void decode_h(uint64_t bits, bool opaque, unsigned char *texels)
{
    const int first[3] = {widen(rhw_bits_of(bits, 59, 4), 4),
                          widen(rhw_bits_of(bits, 56, 3) << 1 | rhw_bits_of(bits, 52, 1), 4),
                          widen(rhw_bits_of(bits, 51, 1) << 3 | rhw_bits_of(bits, 47, 3), 4)};
    const int second[3] = {widen(rhw_bits_of(bits, 43, 4), 4), widen(rhw_bits_of(bits, 39, 4), 4),
                           widen(rhw_bits_of(bits, 35, 4), 4)};
    // The order of the colours is a bit of the distance.
    const bool is_greater =
        (first[0] << 16 | first[1] << 8 | first[2]) >= (second[0] << 16 | second[1] << 8 | second[2]);
    const int distance =
        distances[rhw_bits_of(bits, 34, 1) << 2 | rhw_bits_of(bits, 32, 1) << 1 | is_greater];
    unsigned char palette[4][RGBA];
    add_to_color(first, distance, palette[0]);
    add_to_color(first, -distance, palette[1]);
    add_to_color(second, distance, palette[2]);
    add_to_color(second, -distance, palette[3]);
    paint(bits, palette, opaque, texels);
}

// Decode a plane through three colours: of the first texel, of the texel one block to the right, and of the texel one
// block down.
static void decode_planar(uint64_t bits, unsigned char *texels)
{
    const int origin[3] = {
        widen(rhw_bits_of(bits, 57, 6), 6),
        widen(rhw_bits_of(bits, 56, 1) << 6 | rhw_bits_of(bits, 49, 6), 7),
        widen(rhw_bits_of(bits, 48, 1) << 5 | rhw_bits_of(bits, 43, 2) << 3 | rhw_bits_of(bits, 39, 3), 6)};
    const int right[3] = {widen(rhw_bits_of(bits, 34, 5) << 1 | rhw_bits_of(bits, 32, 1), 6),
                          widen(rhw_bits_of(bits, 25, 7), 7), widen(rhw_bits_of(bits, 19, 6), 6)};
    const int down[3] = {widen(rhw_bits_of(bits, 13, 6), 6), widen(rhw_bits_of(bits, 6, 7), 7),
                         widen(rhw_bits_of(bits, 0, 6), 6)};
    for (int i = 0; i < TEXELS; i++) {
        const int x = i % SIDE, y = i / SIDE;
        for (int c = 0; c < 3; c++) {
            const int quadruple = x * (right[c] - origin[c]) + y * (down[c] - origin[c]) + 4 * origin[c];
            texels[RGBA * i + c] = clamp_code((quadruple + 2) >> 2);
        }
        texels[RGBA * i + 3] = 255;
    }
}

// Decode a block whose first base colour has 5 bits, and the second one a difference of 3 bits from it.
static void decode_differential(uint64_t bits, bool opaque, unsigned char *texels)
{
    int base[2][3];
    bool inside[3];
    for (int c = 0; c < 3; c++) {
        const int first = rhw_bits_of(bits, 59 - 8 * c, 5);
        const int second = first + rhw_sign_extend(rhw_bits_of(bits, 56 - 8 * c, 3), 3);
        inside[c] = second >= 0 && second <= 31;
        base[0][c] = widen(first, 5);
        base[1][c] = inside[c] ? widen(second, 5) : 0;
    }
    if (!inside[0]) {
        decode_t(bits, opaque, texels);
    } else if (!inside[1]) {
        decode_h(bits, opaque, texels);
    } else if (!inside[2]) {
        decode_planar(bits, texels);
    } else {
        decode_halves(bits, base, opaque, texels);
    }
}

void rhw_decode_etc2_rgb8(const struct rhw_block_format *format, const unsigned char *block,
                          unsigned char *texels)
{
    (void)format;
    const uint64_t bits = rhw_load_big(block);
    if (rhw_bits_of(bits, 33, 1) != 0) {
        decode_differential(bits, true, texels);
    } else {
        decode_individual(bits, texels);
    }
}

// Decode a block with punch-through alpha. The bit that would choose individual colours says whether the block is
// opaque.
void rhw_decode_etc2_rgb8a1(const struct rhw_block_format *format, const unsigned char *block,
                            unsigned char *texels)
{
    (void)format;
    const uint64_t bits = rhw_load_big(block);
    decode_differential(bits, rhw_bits_of(bits, 33, 1) != 0, texels);
}

void rhw_decode_etc2_rgba8(const struct rhw_block_format *format, const unsigned char *block,
                           unsigned char *texels)
{
    rhw_decode_etc2_rgb8(format, block + 8, texels);
    const struct rhw_eac_block alpha = rhw_eac_open(block);
    for (int i = 0; i < TEXELS; i++) {
        texels[RGBA * i + 3] = clamp_code(alpha.base + rhw_eac_modifier(&alpha, i) * alpha.multiplier);
    }
}
