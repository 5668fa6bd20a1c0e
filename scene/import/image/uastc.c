// SPDX-License-Identifier: MIT
// UASTC LDR 4×4, written from the Khronos Data Format Specification 1.4, chapter "Universal ASTC Compressed Texture
// Images". A block of 128 bits, lowest first, has one of 18 layouts or is one colour. It consists of hints for programs
// that make other formats of it, which are skipped here, of endpoints of one to three subsets of texels, and of weights
// between them. Endpoints are widened to 16 bits by repetition, even where texels are sRGB, as decoders to RGBA8 do.
#include "uastc.h"

#include <stdbool.h>
#include <string.h>

enum {
    TEXELS = 16,
    RGBA = 4,
    MOST_SUBSETS = 3,
    MOST_VALUES = 18, // most numbers of endpoints in a block
    ONE_COLOR = 8,    // mode of blocks of one colour
    RESERVED = 19,
    LUMINANCE_ALPHA = 2, // channels of a mode with luminance and alpha
    NEVER = -1
};

struct bits {
    uint64_t low, high;
};

static uint64_t load(const uint8_t *bytes)
{
    uint64_t value = 0;
    for (int i = 7; i >= 0; i--) {
        value = value << 8 | bytes[i];
    }
    return value;
}

// Take the next `count` bits, 0..31. Zeros follow behind the end.
static int take(struct bits *bits, int count)
{
    const int value = (int)(bits->low & ((1u << count) - 1));
    if (count > 0) {
        bits->low = bits->low >> count | bits->high << (64 - count);
        bits->high >>= count;
    }
    return value;
}

// Modes --------------------------------------------------------------------------------------------------

// The prefix that blocks of each mode begin with ("UASTC Mode Index encoding").
static const struct {
    uint8_t value, length;
} prefixes[] = {
    {0x01, 4}, {0x35, 6}, {0x1d, 5}, {0x03, 5}, {0x13, 5}, {0x0b, 5}, {0x1b, 5},
    {0x07, 5}, {0x17, 5}, {0x0f, 5}, {0x02, 3}, {0x00, 2}, {0x06, 3}, {0x1f, 5},
    {0x0d, 5}, {0x05, 7}, {0x15, 6}, {0x25, 6}, {0x09, 4},
};

struct mode {
    uint8_t hints; // number of bits that are skipped
    uint8_t subsets;
    uint8_t channels;      // 2 for luminance and alpha, 3 for opaque colours, 4 for all
    bool planes;           // each texel has two weights, and one channel has the second
    uint8_t base;          // base of the digits of endpoints: 3 (trits), 5 (quints), 1 (none)
    uint8_t endpoint_bits; // bits below the digit of an endpoint
    uint8_t weight_bits;
};

static const struct mode modes[] = {
    {15, 1, 3, false, 3, 6, 4}, {15, 1, 3, false, 1, 8, 2}, {15, 2, 3, false, 1, 4, 3},
    {15, 3, 3, false, 3, 2, 2}, {15, 2, 3, false, 5, 3, 2}, {15, 1, 3, false, 1, 8, 3},
    {15, 1, 3, true, 5, 5, 2},  {15, 2, 3, false, 5, 3, 2}, {0, 0, 0, false, 0, 0, 0},
    {23, 2, 4, false, 1, 4, 2}, {17, 1, 4, false, 3, 4, 4}, {17, 1, 4, true, 3, 4, 2},
    {17, 1, 4, false, 3, 6, 3}, {23, 1, 4, true, 1, 8, 1},  {23, 1, 4, false, 1, 8, 2},
    {23, 1, 2, false, 1, 8, 4}, {23, 2, 2, false, 1, 8, 2}, {23, 1, 2, true, 1, 8, 2},
    {15, 1, 3, false, 1, 5, 5},
};

static int take_mode(struct bits *bits)
{
    for (int mode = 0; mode < RESERVED; mode++) {
        const int length = prefixes[mode].length;
        if ((bits->low & ((1u << length) - 1)) == prefixes[mode].value) {
            take(bits, length);
            return mode;
        }
    }
    return RESERVED;
}

// Subsets ------------------------------------------------------------------------------------------------

// A bit for each texel, row by row ("Partition table for 2-subset Mode Indices 2, 4, 9, and 16"). Mode 7 has a table of
// its own, and mode 3 has two bits for each texel.
static const uint16_t two_subsets[30] = {
    0xcccc, 0x8888, 0x1111, 0xecc8, 0x377f, 0xfeec, 0x0137, 0x137f, 0xc800, 0x0013,
    0xfe80, 0x17ff, 0x0017, 0x00ff, 0xfff0, 0x0fff, 0xff71, 0x8eff, 0x08ce, 0x008c,
    0x7310, 0xceff, 0x7331, 0x088c, 0xceef, 0x6666, 0xf00f, 0x5555, 0x0f0f, 0x36c9,
};
static const uint16_t two_subsets_of_7[19] = {
    0x00f0, 0x4444, 0x0133, 0xcc80, 0xf0ff, 0x2222, 0xffc8, 0xccce, 0x3c03, 0x00ee,
    0x7700, 0x3003, 0x00ce, 0xff80, 0x6fff, 0x1333, 0x11ff, 0x136c, 0x00ef,
};
static const uint32_t three_subsets[11] = {
    0xa5a50000, 0xaa005555, 0xaa000055, 0x0000aa55, 0x25252525, 0x94949494,
    0x58585858, 0x56560202, 0x92929292, 0x55aa0055, 0xa05050a0,
};

// Read which pattern of subsets a block has, and set the subset of each texel. Return false if there is no pattern of
// this number.
static bool take_pattern(struct bits *bits, int mode, uint8_t subset[TEXELS])
{
    const int subsets = modes[mode].subsets;
    const int most = mode == 3 ? 11 : mode == 7 ? 19 : 30;
    const int pattern = subsets == 1 ? 0 : take(bits, mode == 3 ? 4 : 5);
    if (pattern >= most) {
        return false;
    }
    for (int i = 0; i < TEXELS; i++) {
        const uint32_t value = subsets == 1 ? 0
                               : mode == 3  ? three_subsets[pattern] >> 2 * i & 3
                               : mode == 7  ? (uint32_t)two_subsets_of_7[pattern] >> i & 1
                                            : (uint32_t)two_subsets[pattern] >> i & 1;
        subset[i] = (uint8_t)value;
    }
    return true;
}

// Endpoints ----------------------------------------------------------------------------------------------

// Widen an endpoint to 0..255, as ASTC does ("ASTC color unquantization parameters"): the lowest bit mirrors, the other
// bits and the digit add.
static uint8_t widen_endpoint(const struct mode *mode, int digit, int value)
{
    const int upper = value >> 1;
    int factor = 0, spread = 0;
    switch (10 * mode->base + mode->endpoint_bits) {
    case 32:
        factor = 93;
        spread = upper << 8 | upper << 4 | upper << 2 | upper << 1;
        break;
    case 34:
        factor = 22;
        spread = upper << 6 | upper;
        break;
    case 36:
        factor = 5;
        spread = upper << 4 | upper >> 4;
        break;
    case 53:
        factor = 26;
        spread = upper << 7 | upper << 1 | upper >> 1;
        break;
    case 55:
        factor = 6;
        spread = upper << 5 | upper >> 3;
        break;
    case 14: return (uint8_t)(value << 4 | value);
    case 15: return (uint8_t)(value << 3 | value >> 2);
    default: return (uint8_t)value;
    }
    const int mirror = value & 1 ? 0x1ff : 0;
    const int wide = (digit * factor + spread) ^ mirror;
    return (uint8_t)((mirror & 0x80) | wide >> 2);
}

// Take the digits of all values. 5 trits take 8 bits and 3 quints take 7. Fewer digits take fewer bits.
static void take_digits(struct bits *bits, int base, int count, uint8_t digit[MOST_VALUES])
{
    static const uint8_t lengths[2][6] = {{0, 2, 4, 5, 7, 8}, {0, 3, 5, 7}};
    const int group = base == 3 ? 5 : 3;
    for (int i = 0; i < count; i += group) {
        const int numbers = count - i < group ? count - i : group;
        int packed = take(bits, lengths[base == 5][numbers]);
        for (int k = 0; k < numbers; k++) {
            digit[i + k] = (uint8_t)(packed % base);
            packed /= base;
        }
    }
}

struct endpoints {
    uint8_t color[MOST_SUBSETS][2][RGBA];
};

static void take_endpoints(struct bits *bits, const struct mode *mode, struct endpoints *endpoints)
{
    const int channels = mode->channels, count = 2 * channels * mode->subsets;
    uint8_t digit[MOST_VALUES] = {0};
    if (mode->base > 1) {
        take_digits(bits, mode->base, count, digit);
    }
    memset(endpoints, UINT8_MAX, sizeof *endpoints);
    for (int i = 0; i < count; i++) {
        const uint8_t value = widen_endpoint(mode, digit[i], take(bits, mode->endpoint_bits));
        const int channel = i / 2 % channels;
        uint8_t *const color = endpoints->color[i / (2 * channels)][i % 2];
        if (channels != LUMINANCE_ALPHA) {
            color[channel] = value;
        } else if (channel == 0) {
            memset(color, value, 3);
        } else {
            color[3] = value;
        }
    }
}

// Weights ------------------------------------------------------------------------------------------------

// Widen a weight to 0..64.
static uint8_t widen_weight(int weight, int bits)
{
    int wide = 0;
    for (int at = 6 - bits; at > -bits; at -= bits) {
        wide |= at >= 0 ? weight << at : weight >> -at;
    }
    return (uint8_t)(wide + (wide > 32));
}

// Take the weights. The first texel of each subset is its anchor: the highest bit of the anchor's weights is 0 and not
// stored.
static void take_weights(struct bits *bits, const struct mode *mode, const uint8_t subset[TEXELS],
                         uint8_t weight[TEXELS][2])
{
    bool known[MOST_SUBSETS] = {false};
    for (int i = 0; i < TEXELS; i++) {
        const int length = mode->weight_bits - !known[subset[i]];
        known[subset[i]] = true;
        for (int plane = 0; plane < 1 + mode->planes; plane++) {
            weight[i][plane] = widen_weight(take(bits, length), mode->weight_bits);
        }
    }
}

// Texels -------------------------------------------------------------------------------------------------

static void fill(uint8_t texels[TEXELS][RGBA], const uint8_t color[RGBA])
{
    for (int i = 0; i < TEXELS; i++) {
        memcpy(texels[i], color, RGBA);
    }
}

// Mix two endpoints. They are widened to 16 bits, and the upper byte of what lies between them is the result.
static uint8_t mix(int first, int second, int weight)
{
    return (uint8_t)((first * 257 * (64 - weight) + second * 257 * weight + 32) >> 6 >> 8);
}

void scene_uastc_decode(const uint8_t block[SCENE_UASTC_BLOCK], uint8_t texels[TEXELS][RGBA])
{
    static const uint8_t error_color[RGBA] = {255, 0, 255, 255};
    struct bits bits = {load(block), load(block + 8)};
    const int number = take_mode(&bits);
    if (number == ONE_COLOR) {
        uint8_t color[RGBA];
        for (int c = 0; c < RGBA; c++) {
            color[c] = (uint8_t)take(&bits, 8);
        }
        fill(texels, color);
        return;
    }
    uint8_t subset[TEXELS];
    if (number != RESERVED) {
        take(&bits, modes[number].hints);
    }
    if (number == RESERVED || !take_pattern(&bits, number, subset)) {
        fill(texels, error_color);
        return;
    }
    const struct mode *const mode = &modes[number];
    int channel = NEVER; // channel that the second plane of weights is for
    if (mode->planes) {
        channel = mode->channels == LUMINANCE_ALPHA ? 3 : take(&bits, 2);
    }
    struct endpoints endpoints;
    take_endpoints(&bits, mode, &endpoints);
    uint8_t weight[TEXELS][2];
    take_weights(&bits, mode, subset, weight);
    for (int i = 0; i < TEXELS; i++) {
        const uint8_t *const first = endpoints.color[subset[i]][0], *const second =
                                                                        endpoints.color[subset[i]][1];
        for (int c = 0; c < RGBA; c++) {
            texels[i][c] = mix(first[c], second[c], weight[i][c == channel]);
        }
    }
}
