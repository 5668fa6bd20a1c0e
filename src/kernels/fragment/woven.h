// SPDX-License-Identifier: MIT
// The colours of a multisampled tile may be woven in expanded blocks (expand.h). If there are 4 samples with 4 bytes
// each, the samples of a pixel stand side by side, and a fragment changes what it covers in one step instead of in the
// tiles of 4 samples. Tiles whose samples are resolved and forgotten are woven. Where samples are loaded or stored,
// each keeps a tile of its own.
#ifndef RHW_WOVEN_H
#define RHW_WOVEN_H

#include "base/simd_layout.h"
#include "kernels/tile_work.h"

// Load the texels of 8 pixels, a vector for each sample.
RHW_INLINE void load_woven(struct rhw_tile_scratch *scratch, int target, const int32_t texel[8],
                           f32x8 sample[WOVEN_SAMPLES])
{
    const void *place[RHW_LANES];
    for (int i = 0; i < RHW_LANES; i++) {
        place[i] = woven_pixel(scratch, target, texel[i]);
    }
    f32x8_load_columns(place, sample);
}

// Load the samples of 8 pixels in a row, sample by sample.
RHW_INLINE void load_woven_row(struct rhw_tile_scratch *scratch, int target, int texel,
                               f32x8 sample[WOVEN_SAMPLES])
{
    int32_t texels[RHW_LANES];
    i32x8_store(texels, i32x8_splat(texel) + rhw_lane_index);
    load_woven(scratch, target, texels, sample);
}

// Store the samples of 8 pixels, one after the other, that are set in `samples`.
RHW_INLINE void store_woven(struct rhw_tile_scratch *scratch, int target, const int32_t texel[8],
                            const f32x4 pixel[8], i32x8 samples)
{
    unsigned char *const pixels = woven_pixel(scratch, target, 0);
    f32x8 by_sample[WOVEN_SAMPLES];
    f32x4 is_stored[RHW_LANES];
    for (int s = 0; s < WOVEN_SAMPLES; s++) {
        by_sample[s] = (f32x8)((i32x8)((u32x8)samples << (31 - s)) >> 31);
    }
    f32x4_rows(by_sample, is_stored);
    for (int i = 0; i < RHW_LANES; i++) {
        unsigned char *const to = pixels + (size_t)texel[i] * (WOVEN_SAMPLES * WOVEN_SIZE);
        f32x4 old;
        memcpy(&old, to, sizeof old);
        const f32x4 stored = f32x4_select((i32x4)is_stored[i], pixel[i], old);
        memcpy(to, &stored, sizeof stored);
    }
}

// Put words in the place of the samples in `samples` of 8 texels. Of several fragments of a sample the last is seen.
RHW_INLINE void replace_woven(struct rhw_tile_scratch *scratch, int target, const int32_t texel[8],
                              i32x8 words, i32x8 samples)
{
    float lanes[RHW_LANES];
    f32x4 pixel[RHW_LANES];
    f32x8_store(lanes, (f32x8)words);
    for (int i = 0; i < RHW_LANES; i++) {
        pixel[i] = (f32x4){lanes[i], lanes[i], lanes[i], lanes[i]};
    }
    store_woven(scratch, target, texel, pixel, samples);
}

#endif
