// SPDX-License-Identifier: MIT
// BC6H: blocks of halves. It has 14 modes, whose endpoints are stored in scattered pieces. All modes but two store the
// other endpoints as differences from the first. Halves are mixed as the whole numbers that their bits are.
#include <string.h>

#include "block_bptc.h"
#include "block_decoders.h"

enum { R0, G0, B0, R1, G1, B1, R2, G2, B2, R3, G3, B3, VALUES };

// A run is the next `count` bits of the block, which belong to a value from its bit `low` upwards. A count of 0 ends
// the list.
struct run {
    uint8_t value, low, count;
};

// This is the table "Block descriptions for BC6H block modes".
// clang-format off
static const struct run layout_0[] = {
    {G2, 4, 1}, {B2, 4, 1}, {B3, 4, 1}, {R0, 0, 10}, {G0, 0, 10}, {B0, 0, 10}, {R1, 0, 5}, {G3, 4, 1},
    {G2, 0, 4}, {G1, 0, 5}, {B3, 0, 1}, {G3, 0, 4}, {B1, 0, 5}, {B3, 1, 1}, {B2, 0, 4}, {R2, 0, 5},
    {B3, 2, 1}, {R3, 0, 5}, {B3, 3, 1}, {0},
};
static const struct run layout_1[] = {
    {G2, 5, 1}, {G3, 4, 1}, {G3, 5, 1}, {R0, 0, 7}, {B3, 0, 1}, {B3, 1, 1}, {B2, 4, 1}, {G0, 0, 7},
    {B2, 5, 1}, {B3, 2, 1}, {G2, 4, 1}, {B0, 0, 7}, {B3, 3, 1}, {B3, 5, 1}, {B3, 4, 1}, {R1, 0, 6},
    {G2, 0, 4}, {G1, 0, 6}, {G3, 0, 4}, {B1, 0, 6}, {B2, 0, 4}, {R2, 0, 6}, {R3, 0, 6}, {0},
};
static const struct run layout_2[] = {
    {R0, 0, 10}, {G0, 0, 10}, {B0, 0, 10}, {R1, 0, 5}, {R0, 10, 1}, {G2, 0, 4}, {G1, 0, 4}, {G0, 10, 1},
    {B3, 0, 1}, {G3, 0, 4}, {B1, 0, 4}, {B0, 10, 1}, {B3, 1, 1}, {B2, 0, 4}, {R2, 0, 5}, {B3, 2, 1},
    {R3, 0, 5}, {B3, 3, 1}, {0},
};
static const struct run layout_6[] = {
    {R0, 0, 10}, {G0, 0, 10}, {B0, 0, 10}, {R1, 0, 4}, {R0, 10, 1}, {G3, 4, 1}, {G2, 0, 4}, {G1, 0, 5},
    {G0, 10, 1}, {G3, 0, 4}, {B1, 0, 4}, {B0, 10, 1}, {B3, 1, 1}, {B2, 0, 4}, {R2, 0, 4}, {B3, 0, 1},
    {B3, 2, 1}, {R3, 0, 4}, {G2, 4, 1}, {B3, 3, 1}, {0},
};
static const struct run layout_10[] = {
    {R0, 0, 10}, {G0, 0, 10}, {B0, 0, 10}, {R1, 0, 4}, {R0, 10, 1}, {B2, 4, 1}, {G2, 0, 4}, {G1, 0, 4},
    {G0, 10, 1}, {B3, 0, 1}, {G3, 0, 4}, {B1, 0, 5}, {B0, 10, 1}, {B2, 0, 4}, {R2, 0, 4}, {B3, 1, 1},
    {B3, 2, 1}, {R3, 0, 4}, {B3, 4, 1}, {B3, 3, 1}, {0},
};
static const struct run layout_14[] = {
    {R0, 0, 9}, {B2, 4, 1}, {G0, 0, 9}, {G2, 4, 1}, {B0, 0, 9}, {B3, 4, 1}, {R1, 0, 5}, {G3, 4, 1},
    {G2, 0, 4}, {G1, 0, 5}, {B3, 0, 1}, {G3, 0, 4}, {B1, 0, 5}, {B3, 1, 1}, {B2, 0, 4}, {R2, 0, 5},
    {B3, 2, 1}, {R3, 0, 5}, {B3, 3, 1}, {0},
};
static const struct run layout_18[] = {
    {R0, 0, 8}, {G3, 4, 1}, {B2, 4, 1}, {G0, 0, 8}, {B3, 2, 1}, {G2, 4, 1}, {B0, 0, 8}, {B3, 3, 1},
    {B3, 4, 1}, {R1, 0, 6}, {G2, 0, 4}, {G1, 0, 5}, {B3, 0, 1}, {G3, 0, 4}, {B1, 0, 5}, {B3, 1, 1},
    {B2, 0, 4}, {R2, 0, 6}, {R3, 0, 6}, {0},
};
static const struct run layout_22[] = {
    {R0, 0, 8}, {B3, 0, 1}, {B2, 4, 1}, {G0, 0, 8}, {G2, 5, 1}, {G2, 4, 1}, {B0, 0, 8}, {G3, 5, 1},
    {B3, 4, 1}, {R1, 0, 5}, {G3, 4, 1}, {G2, 0, 4}, {G1, 0, 6}, {G3, 0, 4}, {B1, 0, 5}, {B3, 1, 1},
    {B2, 0, 4}, {R2, 0, 5}, {B3, 2, 1}, {R3, 0, 5}, {B3, 3, 1}, {0},
};
static const struct run layout_26[] = {
    {R0, 0, 8}, {B3, 1, 1}, {B2, 4, 1}, {G0, 0, 8}, {B2, 5, 1}, {G2, 4, 1}, {B0, 0, 8}, {B3, 5, 1},
    {B3, 4, 1}, {R1, 0, 5}, {G3, 4, 1}, {G2, 0, 4}, {G1, 0, 5}, {B3, 0, 1}, {G3, 0, 4}, {B1, 0, 6},
    {B2, 0, 4}, {R2, 0, 5}, {B3, 2, 1}, {R3, 0, 5}, {B3, 3, 1}, {0},
};
static const struct run layout_30[] = {
    {R0, 0, 6}, {G3, 4, 1}, {B3, 0, 1}, {B3, 1, 1}, {B2, 4, 1}, {G0, 0, 6}, {G2, 5, 1}, {B2, 5, 1},
    {B3, 2, 1}, {G2, 4, 1}, {B0, 0, 6}, {G3, 5, 1}, {B3, 3, 1}, {B3, 5, 1}, {B3, 4, 1}, {R1, 0, 6},
    {G2, 0, 4}, {G1, 0, 6}, {G3, 0, 4}, {B1, 0, 6}, {B2, 0, 4}, {R2, 0, 6}, {R3, 0, 6}, {0},
};
static const struct run layout_3[] = {
    {R0, 0, 10}, {G0, 0, 10}, {B0, 0, 10}, {R1, 0, 10}, {G1, 0, 10}, {B1, 0, 10}, {0},
};
static const struct run layout_7[] = {
    {R0, 0, 10}, {G0, 0, 10}, {B0, 0, 10}, {R1, 0, 9}, {R0, 10, 1}, {G1, 0, 9}, {G0, 10, 1}, {B1, 0, 9},
    {B0, 10, 1}, {0},
};
static const struct run layout_11[] = {
    {R0, 0, 10}, {G0, 0, 10}, {B0, 0, 10}, {R1, 0, 8}, {R0, 11, 1}, {R0, 10, 1}, {G1, 0, 8}, {G0, 11, 1},
    {G0, 10, 1}, {B1, 0, 8}, {B0, 11, 1}, {B0, 10, 1}, {0},
};
static const struct run layout_15[] = {
    {R0, 0, 10}, {G0, 0, 10}, {B0, 0, 10}, {R1, 0, 4}, {R0, 15, 1}, {R0, 14, 1}, {R0, 13, 1}, {R0, 12, 1},
    {R0, 11, 1}, {R0, 10, 1}, {G1, 0, 4}, {G0, 15, 1}, {G0, 14, 1}, {G0, 13, 1}, {G0, 12, 1}, {G0, 11, 1},
    {G0, 10, 1}, {B1, 0, 4}, {B0, 15, 1}, {B0, 14, 1}, {B0, 13, 1}, {B0, 12, 1}, {B0, 11, 1}, {B0, 10, 1},
    {0},
};
// clang-format on

struct mode {
    const struct run *layout; // NULL: the mode is reserved
    bool differences;         // the others are differences from the first endpoint
    uint8_t partition_bits;   // 0: one subset
    uint8_t bits;             // bits of the endpoints
    // Bits of red, green and blue of all endpoints but the first.
    uint8_t stored_bits[3];
};

static const struct mode modes[32] = {
    [0] = {layout_0, true, 5, 10, {5, 5, 5}},   [1] = {layout_1, true, 5, 7, {6, 6, 6}},
    [2] = {layout_2, true, 5, 11, {5, 4, 4}},   [3] = {layout_3, false, 0, 10, {10, 10, 10}},
    [6] = {layout_6, true, 5, 11, {4, 5, 4}},   [7] = {layout_7, true, 0, 11, {9, 9, 9}},
    [10] = {layout_10, true, 5, 11, {4, 4, 5}}, [11] = {layout_11, true, 0, 12, {8, 8, 8}},
    [14] = {layout_14, true, 5, 9, {5, 5, 5}},  [15] = {layout_15, true, 0, 16, {4, 4, 4}},
    [18] = {layout_18, true, 5, 8, {6, 5, 5}},  [22] = {layout_22, true, 5, 8, {5, 6, 5}},
    [26] = {layout_26, true, 5, 8, {5, 5, 6}},  [30] = {layout_30, false, 5, 6, {6, 6, 6}},
};

static void take_values(struct rhw_bit_stream *stream, const struct run *run, int value[VALUES])
{
    memset(value, 0, VALUES * sizeof *value);
    for (; run->count != 0; run++) {
        value[run->value] |= rhw_stream_take(stream, run->count) << run->low;
    }
}

// Complete the endpoints as numbers of `mode->bits`.
static void complete_values(const struct mode *mode, bool is_signed, int value[VALUES])
{
    for (int i = 0; i < VALUES; i++) {
        if (i < 3 ? is_signed : is_signed || mode->differences) {
            value[i] = rhw_sign_extend(value[i], i < 3 ? mode->bits : mode->stored_bits[i % 3]);
        }
        if (i >= 3 && mode->differences) {
            const int sum = (value[i % 3] + value[i]) & ((1 << mode->bits) - 1);
            value[i] = is_signed ? rhw_sign_extend(sum, mode->bits) : sum;
        }
    }
}

static int unquantize(int value, int bits)
{
    return bits >= 15                 ? value
           : value == 0               ? 0
           : value == (1 << bits) - 1 ? 0xffff
                                      : ((value << 15) + 0x4000) >> (bits - 1);
}

static int unquantize_signed(int value, int bits)
{
    if (bits >= 16) {
        return value;
    }
    const int size = value < 0 ? -value : value;
    const int wide = size == 0                       ? 0
                     : size >= (1 << (bits - 1)) - 1 ? 0x7fff
                                                     : ((size << 15) + 0x4000) >> (bits - 1);
    return value < 0 ? -wide : wide;
}

// Return the bits of a half.
static uint16_t finish(int value, bool is_signed)
{
    if (!is_signed) {
        return (uint16_t)(value * 31 >> 6);
    }
    return (uint16_t)(value < 0 ? (-value * 31 >> 5) | 0x8000 : value * 31 >> 5);
}

static void decode(const unsigned char *block, bool is_signed, unsigned char *texels)
{
    enum { RGBA = 4, ONE = 0x3c00 };
    struct rhw_bit_stream stream = rhw_stream_open(block);
    const int number = (block[0] & 3) < 2 ? block[0] & 3 : block[0] & 31;
    const struct mode *const mode = &modes[number];
    int value[VALUES] = {0};
    uint8_t weight[RHW_BPTC_TEXELS] = {0}, subset[RHW_BPTC_TEXELS] = {0};
    if (mode->layout) {
        rhw_stream_skip(&stream, number < 2 ? 2 : 5);
        take_values(&stream, mode->layout, value);
        complete_values(mode, is_signed, value);
        const int subsets = mode->partition_bits != 0 ? 2 : 1;
        const int partition = rhw_stream_take(&stream, mode->partition_bits);
        rhw_bptc_partition(subsets, partition, subset);
        rhw_bptc_take_weights(&stream, subsets == 2 ? 3 : 4, subsets, partition, weight);
    }
    for (int i = 0; i < VALUES && mode->layout; i++) {
        value[i] = is_signed ? unquantize_signed(value[i], mode->bits) : unquantize(value[i], mode->bits);
    }
    for (int i = 0; i < RHW_BPTC_TEXELS; i++) {
        const int *const first = value + 6 * subset[i], *const second = first + 3;
        uint16_t texel[RGBA] = {[3] = ONE};
        for (int c = 0; c < 3; c++) {
            texel[c] = finish(rhw_bptc_mix(first[c], second[c], weight[i]), is_signed);
        }
        memcpy(texels + sizeof texel * (size_t)i, texel, sizeof texel);
    }
}

void rhw_decode_bc6h_ufloat(const struct rhw_block_format *format, const unsigned char *block,
                            unsigned char *texels)
{
    (void)format;
    decode(block, false, texels);
}

void rhw_decode_bc6h_sfloat(const struct rhw_block_format *format, const unsigned char *block,
                            unsigned char *texels)
{
    (void)format;
    decode(block, true, texels);
}
