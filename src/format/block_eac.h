// SPDX-License-Identifier: MIT
// A block of EAC has one channel: a base, and for each texel a modifier from a table, times a multiplier.
#ifndef RHW_BLOCK_EAC_H
#define RHW_BLOCK_EAC_H

#include <stdint.h>

struct rhw_eac_block {
    uint64_t bits;
    int base;       // 0..255
    int multiplier; // 0..15
};

struct rhw_eac_block rhw_eac_open(const unsigned char *block);

// Return the modifier of a texel, 0..15, which are numbered row by row.
int rhw_eac_modifier(const struct rhw_eac_block *block, int texel);

#endif
