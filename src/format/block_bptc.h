// SPDX-License-Identifier: MIT
// BC6H and BC7 have in common: partitions of a block into subsets of texels, and weights between two endpoints.
#ifndef RHW_BLOCK_BPTC_H
#define RHW_BLOCK_BPTC_H

#include <stdint.h>

#include "block_bits.h"

enum { RHW_BPTC_TEXELS = 16 };

// Set which subset each texel is in. `subsets` is 1..3 and `partition` 0..63.
void rhw_bptc_partition(int subsets, int partition, uint8_t subset[RHW_BPTC_TEXELS]);

// Read weights of `bits` (2..4) for each texel and turn them into 0..64. The first texel of each subset is its anchor,
// whose highest bit is 0 and is not stored.
void rhw_bptc_take_weights(struct rhw_bit_stream *stream, int bits, int subsets, int partition,
                           uint8_t weight[RHW_BPTC_TEXELS]);

static inline int rhw_bptc_mix(int first, int second, int weight)
{
    return ((64 - weight) * first + weight * second + 32) >> 6;
}

#endif
