// SPDX-License-Identifier: MIT
// What BC6H and BC7 have in common: partitions of a block into subsets of texels, and weights between two endpoints.
#ifndef RHW_BLOCK_BPTC_H
#define RHW_BLOCK_BPTC_H

#include <stdint.h>

#include "block_bits.h"

enum { RHW_BPTC_TEXELS = 16 };

// Which subset each texel is in; `subsets` 1..3, `partition` 0..63.
void rhw_bptc_partition(int subsets, int partition, uint8_t subset[RHW_BPTC_TEXELS]);

// Reads `bits` (2..4) for each texel, one fewer for the first texel of each subset, the anchor, whose highest bit is 0;
// and turns them into weights of 0..64.
void rhw_bptc_take_weights(struct rhw_bit_stream *stream, int bits, int subsets, int partition,
                           uint8_t weight[RHW_BPTC_TEXELS]);

static inline int rhw_bptc_mix(int first, int second, int weight)
{
    return ((64 - weight) * first + weight * second + 32) >> 6;
}

#endif
