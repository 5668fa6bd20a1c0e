// SPDX-License-Identifier: MIT
// Open pixels of a tile still wait for the fragment that is seen there. Which fragment this is, two phases or the order
// of drawing decide (hidden_surface.h):
//
// If a run is drawn depth first, the first phase leaves the least depth of all triangles (with LESS; GREATER is its
// mirror image), and the second phase shades the fragments that have this depth. Of fragments with equal depth the
// first in submission order wins with LESS, the last with LESS_EQUAL. The last needs no care: each is shaded and
// overwrites the one before. For the first, a pixel is open from when the first phase writes it until its fragment is
// shaded. No fragment has to match depth that was there before, or that a fragment function which discards wrote.
//
// If a run is drawn backwards, no depth is tested and the last fragment is seen: a pixel is open until a fragment
// claims it. To claim a pixel is to take an open one and close it: of several fragments one alone gets it.
//
// A tile has a bit for each pixel: a word for each row of 64.
#ifndef RHW_OPEN_PIXELS_H
#define RHW_OPEN_PIXELS_H

#include "base/constants.h"
#include "base/simd.h"

// Return the bits of the block at x, bit 8·row + column, of 8 rows that have a bit for each pixel.
RHW_INLINE uint64_t block_bits(const uint64_t rows[RHW_BLOCK], int x)
{
    const u64x4 byte = {0xff, 0xff, 0xff, 0xff}, upper = {0, 8, 16, 24}, lower = {32, 40, 48, 56};
    const u64x4 bits = (u64x4_load(rows) >> x & byte) << upper | (u64x4_load(rows + 4) >> x & byte) << lower;
    return bits[0] | bits[1] | bits[2] | bits[3];
}

enum bit_change { BITS_SET, BITS_CLEARED };

// Set or clear, in 8 rows that have a bit for each pixel, the bits of the block at x.
RHW_INLINE void change_block(uint64_t rows[RHW_BLOCK], int x, uint64_t bits, enum bit_change change)
{
    const u64x4 byte = {0xff, 0xff, 0xff, 0xff}, upper = {0, 8, 16, 24}, lower = {32, 40, 48, 56};
    const u64x4 all = {bits, bits, bits, bits};
    const u64x4 first = (all >> upper & byte) << x, second = (all >> lower & byte) << x;
    const u64x4 old_first = u64x4_load(rows), old_second = u64x4_load(rows + 4);
    u64x4_store(rows, change == BITS_SET ? old_first | first : old_first & ~first);
    u64x4_store(rows + 4, change == BITS_SET ? old_second | second : old_second & ~second);
}

// Return the open pixels among those of a block that are set in `mask`, and close them.
static inline uint64_t claim_block(uint64_t rows[RHW_BLOCK], int x, uint64_t mask)
{
    const uint64_t claimed = mask & block_bits(rows, x);
    change_block(rows, x, claimed, BITS_CLEARED);
    return claimed;
}

#endif
