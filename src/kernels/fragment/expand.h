// SPDX-License-Identifier: MIT
// The colours of a multisampled tile are stored once for a block of 8×8 pixels if all its samples agree: in the tile of
// the first sample. A fragment that covers a pixel in part expands the block: from then on each sample has colours of
// its own, in a tile of the sample or woven.
#ifndef RHW_EXPAND_H
#define RHW_EXPAND_H

#include "kernels/tile_work.h"

// Return the block of a texel of the tile.
RHW_INLINE int block_of_texel(int texel)
{
    const unsigned at = (unsigned)texel;
    return (int)(at / RHW_TILE / RHW_BLOCK * HIZ_BLOCKS + at % RHW_TILE / RHW_BLOCK);
}

// Return the lanes whose texels lie in blocks that are expanded.
RHW_INLINE unsigned expanded_texels(uint64_t expanded, const int32_t texel[8])
{
    const i32x8 at = i32x8_load(texel);
    const i32x8 block = (at >> (RHW_TILE_LOG2 + RHW_BLOCK_LOG2) << RHW_BLOCK_LOG2) +
                        ((at >> RHW_BLOCK_LOG2) & i32x8_splat(HIZ_BLOCKS - 1));
    const i32x8 in_low = rhw_less_int(block, i32x8_splat(32));
    const i32x8 word = rhw_select_int(in_low, i32x8_splat((int32_t)(uint32_t)expanded),
                                      i32x8_splat((int32_t)(expanded >> 32)));
    return i32x8_sign_bits((i32x8)((u32x8)word << (u32x8)(i32x8_splat(31) - (block & i32x8_splat(31)))));
}

// Copy a row of a block. Rows are short, and most of them whole vectors.
RHW_INLINE void copy_texels(unsigned char *to, const unsigned char *from, size_t bytes)
{
    if (bytes % 32 != 0) {
        memcpy(to, from, bytes);
        return;
    }
    for (size_t i = 0; i < bytes; i += 32) {
        i32x8_store(to + i, i32x8_load(from + i));
    }
}

// Set all samples of a pixel to the texel that the first sample has.
RHW_INLINE void weave_pixel(struct rhw_tile_scratch *scratch, int target, int texel)
{
    int32_t word;
    memcpy(&word, scratch->color[target] + (size_t)texel * WOVEN_SIZE, sizeof word);
    const i32x4 samples = {word, word, word, word};
    memcpy(woven_pixel(scratch, target, texel), &samples, sizeof samples);
}

static void expand_woven_block(const struct tile_work *work, int x, int y)
{
    for (int t = 0; t < work->target->color_count; t++) {
        for (int row = y; row < y + RHW_BLOCK; row++) {
            for (int i = 0; i < RHW_BLOCK; i++) {
                weave_pixel(work->scratch, t, row * RHW_TILE + x + i);
            }
        }
    }
}

static __attribute__((noinline)) void expand_block(const struct tile_work *work, int block)
{
    struct rhw_tile_scratch *const scratch = work->scratch;
    const int x = block % HIZ_BLOCKS * RHW_BLOCK, y = block / HIZ_BLOCKS * RHW_BLOCK;
    scratch->expanded |= (uint64_t)1 << block;
    if (scratch->is_woven) {
        expand_woven_block(work, x, y);
        return;
    }
    for (int t = 0; t < work->target->color_count; t++) {
        const size_t size = work->target->colors[t].texel_size;
        for (int row = 0; row < RHW_BLOCK; row++) {
            const size_t at = (size_t)((y + row) * RHW_TILE + x) * size;
            for (int s = 1; s < work->samples; s++) {
                copy_texels(color_of_sample(scratch, t, s) + at, scratch->color[t] + at, RHW_BLOCK * size);
            }
        }
    }
}

#endif
