// SPDX-License-Identifier: MIT
// Integer sequences of ASTC: numbers below 2^n, 3·2^n or 5·2^n, whose thirds or fifths are packed for several at once
// (Khronos Data Format Specification, "Integer Sequence Encoding").
#ifndef RHW_ASTC_SEQUENCE_H
#define RHW_ASTC_SEQUENCE_H

#include <stdint.h>

#include "block_bits.h"

// Ranges of numbers, narrow ones first: an index into their table. Weights have the first twelve, endpoints those from
// 0..5 on.
enum {
    RHW_ASTC_WEIGHT_RANGES = 12,
    RHW_ASTC_LEAST_COLOR_RANGE = 4,
    RHW_ASTC_RANGES = 21,
    RHW_ASTC_MOST_WEIGHTS = 64,
    RHW_ASTC_MOST_COLORS = 18
};

// Bits that `count` numbers take.
int rhw_astc_sequence_bits(int range, int count);

// Endpoints as 0..255. The stream ends with the sequence.
void rhw_astc_take_colors(struct rhw_bit_stream stream, int range, int count, uint8_t *color);
// Weights as 0..64.
void rhw_astc_take_weights(struct rhw_bit_stream stream, int range, int count, uint8_t *weight);

#endif
