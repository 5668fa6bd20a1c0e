// SPDX-License-Identifier: MIT
// One level at all samples of an anisotropic footprint. The places of all samples are found before the first texel is
// loaded, and a loop that is chosen once filters them: no sample waits for the coordinates of its own or asks anew how
// its texels lie, so that the processor works on several at a time.
#ifndef RHW_AXIS_LEVEL_H
#define RHW_AXIS_LEVEL_H

#include "filter_fixed.h"
#include "resource/sampler.h"

enum { MOST_AXIS_SAMPLES = RHW_MOST_ANISOTROPY, LONG_ROW = 17 };

_Static_assert(RHW_TEXEL_PADDING >= (LONG_ROW - 2) * 4, "a long row ends within the padding");

// The footprints of the samples in a level.
struct axis_level {
    struct footprint at[MOST_AXIS_SAMPLES];
    i32x8 over;     // bits are set where a sample has texels across an edge
    i32x8 leftmost; // the lane that probably lies leftmost, 0 or 7, in all lanes
    i32x8 distance; // the distances of all samples from that lane, as of footprint.xy, joined by OR
};

// How the texels of a level are loaded.
enum axis_path {
    AXIS_IN_ROW,      // lanes stand in a row, at most 7 texels apart
    AXIS_IN_LONG_ROW, // lanes stand in a row, at most 15 texels apart
    AXIS_INTERIOR,    // no texel lies across an edge
    AXIS_WRAPPED
};

RHW_INLINE void start_axis_level(struct axis_level *level, i32x8 leftmost)
{
    level->over = level->distance = i32x8_splat(0);
    level->leftmost = leftmost;
}

// Set the footprint of sample n, at these coordinates.
RHW_INLINE void place_in_level(const struct rhw_mip *mip, int n, const f32x8 at[2], struct axis_level *level)
{
    const struct footprint footprint = footprint_at(mip, at[0], at[1]);
    level->at[n] = footprint;
    level->over |= i32x8_over_halves(footprint.xy, i32x8_load(mip->interior));
    if (I8_PERMUTES) {
        level->distance |= footprint.xy - i32x8_permute(footprint.xy, level->leftmost);
    }
}

RHW_INLINE enum axis_path axis_path_in(const struct rhw_mip *mip, const struct axis_level *level,
                                       enum rhw_texel_codec codec)
{
    if (mip->interior[0] < 0 || i32x8_any_bit(level->over)) {
        return AXIS_WRAPPED;
    }
    if (!I8_PERMUTES || codec != RHW_CODEC_UNORM8 || i32x8_any_of(level->distance, i32x8_splat(~0xf0000))) {
        return AXIS_INTERIOR;
    }
    return i32x8_any_of(level->distance, sample_constants()->not_in_row) ? AXIS_IN_LONG_ROW : AXIS_IN_ROW;
}

// Return the texels that lie `offset`, 0 .. 15, to the right of the first.
RHW_INLINE i32x8 pick_in_long_row(const unsigned char *texels, i32x8 offset)
{
    return i32x8_permute_two(i32x8_load(texels), i32x8_load(texels + sizeof(i32x8)), offset);
}

// Do what load_row_footprint does, of lanes at most 15 texels apart. The last texel loaded is the 17th from one that is
// not the last of its row: RHW_TEXEL_PADDING has room for what lies behind the last row.
RHW_INLINE void load_long_row_footprint(const struct rhw_mip *mip, uint32_t first, i32x8 offset,
                                        struct fixed_texels texel[4])
{
    const unsigned char *const above =
        mip->texels + (size_t)(first & 0xffff) * mip->row_pitch + 4 * (size_t)(first >> 16);
    const unsigned char *const below = above + mip->row_pitch;
    texel[0] = widen_texels(pick_in_long_row(above, offset));
    texel[1] = widen_texels(pick_in_long_row(above + 4, offset));
    texel[2] = widen_texels(pick_in_long_row(below, offset));
    texel[3] = widen_texels(pick_in_long_row(below + 4, offset));
}

// Filter the first `count` samples. This is no part of its callers, as it is long and they call it twice.
static __attribute__((noinline)) void filter_axis_level(const struct rhw_sampler_data *sampler,
                                                        const struct rhw_mip *mip,
                                                        const struct axis_level *level, int count,
                                                        enum rhw_texel_codec codec,
                                                        struct fixed_texels *sample)
{
    struct fixed_texels texel[4];
    const enum axis_path path = axis_path_in(mip, level, codec);
    const size_t leftmost = (size_t)level->leftmost[0] * sizeof(int32_t); // in bytes
    if (path == AXIS_IN_ROW) {
        for (int n = 0; n < count; n++) {
            const i32x8 xy = level->at[n].xy, first = i32x8_permute(xy, level->leftmost);
            load_row_footprint(mip, first, (xy - first) >> 16, texel);
            sample[n] = mix_footprint(texel, &level->at[n], RHW_CODEC_UNORM8);
        }
    } else if (path == AXIS_IN_LONG_ROW) {
        for (int n = 0; n < count; n++) {
            const i32x8 xy = level->at[n].xy;
            int32_t first; // from memory, which is sooner there than a lane of a register
            memcpy(&first, (const char *)&level->at[n].xy + leftmost, sizeof first);
            load_long_row_footprint(mip, (uint32_t)first, (xy - i32x8_splat(first)) >> 16, texel);
            sample[n] = mix_footprint(texel, &level->at[n], RHW_CODEC_UNORM8);
        }
    } else if (path == AXIS_INTERIOR) {
        for (int n = 0; n < count; n++) {
            load_interior_footprint(mip, level->at[n].xy, codec, texel);
            sample[n] = mix_footprint(texel, &level->at[n], codec);
        }
    } else {
        for (int n = 0; n < count; n++) {
            sample[n] = filter_footprint(sampler, mip, &level->at[n], codec, FOOTPRINTS_INTERIOR);
        }
    }
}

#endif
