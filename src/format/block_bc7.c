// SPDX-License-Identifier: MIT
// BC7: eight modes, which divide 128 bits between subsets of texels, the precision of their endpoints and the precision
// of the weights between them.
#include <string.h>

#include "block_bptc.h"
#include "block_decoders.h"

struct mode {
    uint8_t subsets;
    uint8_t partition_bits, rotation_bits, selector_bits;
    uint8_t color_bits, alpha_bits; // bits of a channel of an endpoint
    // P-bits: one more low bit of all channels, of each endpoint or of each subset.
    uint8_t endpoint_bits, shared_bits;
    // Where second_bits is not 0, colour and alpha have weights of their own.
    uint8_t weight_bits, second_bits;
};

static const struct mode modes[8] = {
    {3, 4, 0, 0, 4, 0, 1, 0, 3, 0}, {2, 6, 0, 0, 6, 0, 0, 1, 3, 0}, {3, 6, 0, 0, 5, 0, 0, 0, 2, 0},
    {2, 6, 0, 0, 7, 0, 1, 0, 2, 0}, {1, 0, 2, 1, 5, 6, 0, 0, 2, 3}, {1, 0, 2, 0, 7, 8, 0, 0, 2, 2},
    {1, 0, 0, 0, 7, 7, 1, 0, 4, 0}, {2, 6, 0, 0, 5, 5, 1, 0, 2, 0},
};

enum { RGBA = 4, MOST_ENDPOINTS = 6 };

// Widen a number of `bits` (4..8) to 8 bits by repeating the highest ones.
static uint8_t widen(int value, int bits)
{
    const int high = value << (8 - bits);
    return (uint8_t)(high | high >> bits);
}

static void take_endpoints(struct rhw_bit_stream *stream, const struct mode *mode,
                           uint8_t endpoint[MOST_ENDPOINTS][RGBA])
{
    const int count = 2 * mode->subsets;
    const int low_bits = mode->endpoint_bits + mode->shared_bits;
    int value[MOST_ENDPOINTS][RGBA] = {{0}};
    for (int c = 0; c < RGBA; c++) {
        for (int i = 0; i < count; i++) {
            value[i][c] = rhw_stream_take(stream, c < 3 ? mode->color_bits : mode->alpha_bits) << low_bits;
        }
    }
    for (int i = 0; i < count && low_bits != 0; i += 1 + mode->shared_bits) {
        const int bit = rhw_stream_take(stream, 1);
        for (int c = 0; c < RGBA; c++) {
            value[i][c] |= bit;
            value[i + mode->shared_bits][c] |= bit;
        }
    }
    for (int i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++) {
            endpoint[i][c] = widen(value[i][c], mode->color_bits + low_bits);
        }
        endpoint[i][3] = mode->alpha_bits != 0 ? widen(value[i][3], mode->alpha_bits + low_bits) : 255;
    }
}

void rhw_decode_bc7(const struct rhw_block_format *format, const unsigned char *block, unsigned char *texels)
{
    (void)format;
    if (block[0] == 0) { // this mode is reserved
        memset(texels, 0, RHW_BPTC_TEXELS * RGBA);
        return;
    }
    struct rhw_bit_stream stream = rhw_stream_open(block);
    const int number = __builtin_ctz(block[0]);
    const struct mode *const mode = &modes[number];
    rhw_stream_skip(&stream, number + 1);
    const int partition = rhw_stream_take(&stream, mode->partition_bits);
    const int rotation = rhw_stream_take(&stream, mode->rotation_bits);
    const int selector = rhw_stream_take(&stream, mode->selector_bits);
    uint8_t endpoint[MOST_ENDPOINTS][RGBA], subset[RHW_BPTC_TEXELS];
    take_endpoints(&stream, mode, endpoint);
    rhw_bptc_partition(mode->subsets, partition, subset);
    uint8_t weight[2][RHW_BPTC_TEXELS];
    rhw_bptc_take_weights(&stream, mode->weight_bits, mode->subsets, partition, weight[0]);
    if (mode->second_bits != 0) {
        rhw_bptc_take_weights(&stream, mode->second_bits, mode->subsets, partition, weight[1]);
    }
    const uint8_t *const of_color = weight[selector];
    const uint8_t *const of_alpha = weight[mode->second_bits != 0 ? 1 - selector : 0];
    for (int i = 0; i < RHW_BPTC_TEXELS; i++) {
        unsigned char *const texel = texels + RGBA * i;
        const uint8_t *const first = endpoint[2 * subset[i]], *const second = endpoint[2 * subset[i] + 1];
        for (int c = 0; c < RGBA; c++) {
            texel[c] = (unsigned char)rhw_bptc_mix(first[c], second[c], c < 3 ? of_color[i] : of_alpha[i]);
        }
        if (rotation != 0) { // alpha was stored in place of red, green or blue
            const unsigned char alpha = texel[3];
            texel[3] = texel[rotation - 1];
            texel[rotation - 1] = alpha;
        }
    }
}
