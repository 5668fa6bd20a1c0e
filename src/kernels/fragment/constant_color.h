// SPDX-License-Identifier: MIT
// The fragment function of some draws receives nothing that differs between fragments: no varyings, no builtins. It is
// a function of its inputs alone, so one call tells the colour of all, and the tile takes it at the speed of its
// memory.
#ifndef RHW_CONSTANT_COLOR_H
#define RHW_CONSTANT_COLOR_H

#include "kernels/tile_units.h"
#include "blend.h"
#include "expand.h"

// Put 8 texels of `size` bytes into `count` places that are `stride` bytes apart. They are loaded once: as far as a
// compiler knows, each store into the tile may change them.
RHW_INLINE void repeat_texels(unsigned char *texels, const unsigned char *constant, size_t size, int count,
                              size_t stride)
{
    const size_t bytes = RHW_LANES * size;
    const size_t part = bytes % sizeof(i32x8); // bytes that are no whole vector: 0, 8 or 16
    unsigned char small[16];
    i32x8 vector[RHW_LANES * RHW_TEXEL_BYTES / sizeof(i32x8)];
    memcpy(small, constant, part);
    for (size_t i = 0; i < bytes / sizeof *vector; i++) {
        vector[i] = i32x8_load(constant + i * sizeof *vector);
    }
    for (int n = 0; n < count; n++) {
        unsigned char *const to = texels + (size_t)n * stride;
        for (size_t i = 0; i < bytes / sizeof *vector; i++) {
            i32x8_store(to + i * sizeof *vector, vector[i]);
        }
        memcpy(to, small, part);
    }
}

// Put 8 texels of `size` bytes into each row of a block.
RHW_INLINE void fill_constant_block(unsigned char *texels, const unsigned char *constant, size_t size)
{
    repeat_texels(texels, constant, size, RHW_BLOCK, RHW_TILE * size);
}

// Put 8 texels of `size` bytes into all of a tile.
RHW_INLINE void fill_constant_tile(unsigned char *tile, const unsigned char *constant, size_t size)
{
    repeat_texels(tile, constant, size, RHW_TILE * RHW_TILE / RHW_LANES, RHW_LANES * size);
}

// Put 8 texels of `size` bytes into each row of a block, where `mask` is set.
RHW_INLINE void replace_block(unsigned char *texels, const unsigned char *constant, uint64_t mask,
                              size_t size)
{
    // If a draw is large, most of its blocks are covered all over.
    if (mask == ~(uint64_t)0) {
        fill_constant_block(texels, constant, size);
        return;
    }
    const size_t stride = RHW_TILE * size;
    struct raw_texels raw;
    load_texel_row(size, constant, &raw);
    for (int row = 0; row < RHW_BLOCK; row++) {
        store_texel_row(size, &raw, i32x8_from_bits((unsigned)(mask >> (8 * row)) & 0xff),
                        texels + (size_t)row * stride);
    }
}

// Do what replace_block does. A compiler that inlines it makes the masks of partly covered rows before it asks whether
// the block is covered all over, as the usual one of texels of 4 bytes is.
static __attribute__((noinline)) void replace_sized_block(unsigned char *texels,
                                                          const unsigned char *constant, uint64_t mask,
                                                          size_t size)
{
    switch (size) {
    case 1: replace_block(texels, constant, mask, 1); break;
    case 2: replace_block(texels, constant, mask, 2); break;
    case 4: replace_block(texels, constant, mask, 4); break;
    case 8: replace_block(texels, constant, mask, 8); break;
    default: replace_block(texels, constant, mask, RHW_TEXEL_BYTES); break;
    }
}

// Blend the pixels of the block at (x, y) whose bits are set in `mask`, in one sample.
RHW_INLINE void blend_constant_sample(struct tile_work *work, int sample, int x, int y, uint64_t mask)
{
    struct rhw_tile_scratch *const scratch = work->scratch;
    if (!work->constant_is_ready) {
        RHW_ISA_NAME(rhw_prepare_constant)(work);
    }
    for (int t = 0; t < work->target->color_count; t++) {
        const struct rhw_blend_state *const state = &work->state->blend[t];
        const size_t size = work->target->colors[t].texel_size;
        unsigned char *const texels = color_of_sample(scratch, t, sample) + (size_t)(y * RHW_TILE + x) * size;
        if (state->path == BLEND_RGBA8_REPLACE && mask == ~(uint64_t)0) {
            fill_constant_block(texels, scratch->constant[t], 4);
            continue;
        }
        if (replaces_texels(state)) {
            replace_sized_block(texels, scratch->constant[t], mask, size);
            continue;
        }
        RHW_ISA_NAME(rhw_blend_constant_block)(work, t, texels, mask);
    }
}

// Blend the pixels of the block at (x, y) whose bits are set in `mask`, where a pixel has one sample.
static void blend_constant(struct tile_work *work, int x, int y, uint64_t mask)
{
    blend_constant_sample(work, 0, x, y, mask);
}

// Do what fill_constant_tile does, whose size is a constant.
static __attribute__((noinline)) void fill_sized_tile(unsigned char *tile, const unsigned char *constant,
                                                      size_t size)
{
    switch (size) {
    case 1: fill_constant_tile(tile, constant, 1); break;
    case 2: fill_constant_tile(tile, constant, 2); break;
    case 4: fill_constant_tile(tile, constant, 4); break;
    case 8: fill_constant_tile(tile, constant, 8); break;
    default: fill_constant_tile(tile, constant, RHW_TEXEL_BYTES); break;
    }
}

// Blend all pixels of the tile, where a pixel has one sample.
static void blend_constant_tile(struct tile_work *work)
{
    struct rhw_tile_scratch *const scratch = work->scratch;
    if (!work->constant_is_ready) {
        RHW_ISA_NAME(rhw_prepare_constant)(work);
    }
    for (int t = 0; t < work->target->color_count; t++) {
        const size_t size = work->target->colors[t].texel_size;
        if (replaces_texels(&work->state->blend[t])) {
            fill_sized_tile(scratch->color[t], scratch->constant[t], size);
            continue;
        }
        for (int block = 0; block < HIZ_BLOCKS * HIZ_BLOCKS; block++) {
            const int x = block % HIZ_BLOCKS * RHW_BLOCK, y = block / HIZ_BLOCKS * RHW_BLOCK;
            RHW_ISA_NAME(rhw_blend_constant_block)
            (work, t, scratch->color[t] + (size_t)(y * RHW_TILE + x) * size, ~(uint64_t)0);
        }
    }
}

// Blend the samples in `mask` of the block at (x, y). x and y are multiples of 8.
static __attribute__((noinline)) void blend_constant_samples(struct tile_work *work, int x, int y,
                                                             const uint64_t mask[RHW_MAX_SAMPLES])
{
    const int block = block_of_texel(y * RHW_TILE + x);
    bool differ = false;
    for (int s = 1; s < work->samples; s++) {
        differ |= mask[s] != mask[0];
    }
    if (differ && !(work->scratch->expanded >> block & 1)) {
        expand_block(work, block);
    }
    const bool is_expanded = work->scratch->expanded >> block & 1;
    if (is_expanded && work->scratch->is_woven) {
        RHW_ISA_NAME(rhw_blend_constant_woven)(work, x, y, mask);
        return;
    }
    const int samples = is_expanded ? work->samples : 1;
    for (int s = 0; s < samples; s++) {
        blend_constant_sample(work, s, x, y, mask[s]);
    }
}

#endif
