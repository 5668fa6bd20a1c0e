// SPDX-License-Identifier: MIT
// Integer sequences of ASTC have numbers below 2^n, 3·2^n or 5·2^n. The thirds or fifths of several numbers are packed
// together (Khronos Data Format Specification, "Integer Sequence Encoding").
#ifndef RHW_ASTC_SEQUENCE_H
#define RHW_ASTC_SEQUENCE_H

#include <stdint.h>

#include "block_bits.h"

// Ranges of numbers, narrow ones first. A range is an index into the table of ranges. Weights have the first twelve,
// endpoints have those from 0..5 on.
enum {
    RHW_ASTC_WEIGHT_RANGES = 12,
    RHW_ASTC_LEAST_COLOR_RANGE = 4,
    RHW_ASTC_RANGES = 21,
    RHW_ASTC_MOST_WEIGHTS = 64,
    RHW_ASTC_MOST_COLORS = 18
};

// Return the bits that `count` numbers take.
int rhw_astc_sequence_bits(int range, int count);

// Take endpoints as 0..255. The stream ends with the sequence.
void rhw_astc_take_colors(struct rhw_bit_stream stream, int range, int count, uint8_t *color);
// Take weights as 0..64.
void rhw_astc_take_weights(struct rhw_bit_stream stream, int range, int count, uint8_t *weight);

#endif
