// SPDX-License-Identifier: MIT
// A pixel is sampled at its centre, or where src/resource/sample_pattern.h says. Every stage that needs the position of
// a sample, or the pixels whose samples lie between two positions, asks here. Positions are snapped: 24.8 fixed point,
// 1/256 pixel, from the target's origin.
#ifndef RHW_SAMPLE_POSITION_H
#define RHW_SAMPLE_POSITION_H

#include "base/constants.h"
#include "base/simd.h"

enum { SAMPLE_OFFSET_0_8 = RHW_SUBPIXEL / 2 }; // offset of the sample in its pixel, each way

// Return the offset of the sample in its pixel, in pixels, as floating-point positions have it.
static inline double sample_offset(void)
{
    return (double)SAMPLE_OFFSET_0_8 / RHW_SUBPIXEL;
}

// Return the position of the sample of a pixel.
static inline int64_t sample_of_pixel(int pixel)
{
    return (int64_t)pixel * RHW_SUBPIXEL + SAMPLE_OFFSET_0_8;
}

// Return the positions of the samples of 8 pixels. They are computed unsigned, because lanes that hold rubbish may
// wrap.
RHW_INLINE i32x8 sample_of_pixel8(i32x8 pixel)
{
    return (i32x8)(((u32x8)pixel << RHW_SUBPIXEL_BITS) + (uint32_t)SAMPLE_OFFSET_0_8);
}

// Return the pixels that 8 positions lie in.
RHW_INLINE i32x8 pixel_of_position8(i32x8 position_24_8)
{
    return position_24_8 >> RHW_SUBPIXEL_BITS;
}

// Return the way from a position to the sample of the pixel it lies in.
static inline int sample_from_position(int32_t position_24_8)
{
    return SAMPLE_OFFSET_0_8 - (position_24_8 & (RHW_SUBPIXEL - 1));
}

RHW_INLINE i32x8 sample_from_position8(i32x8 position_24_8)
{
    return i32x8_splat(SAMPLE_OFFSET_0_8) - (position_24_8 & i32x8_splat(RHW_SUBPIXEL - 1));
}

// Return the way from the centre of a pixel to a sample, in pixels.
static inline double from_center(int32_t position_0_8)
{
    return (double)(position_0_8 - SAMPLE_OFFSET_0_8) / RHW_SUBPIXEL;
}

// Return a bound of the pixels that have a sample between two positions. With first_step of struct rhw_draw_state it is
// the first pixel at or behind the lower position. With past_step it is one past the last pixel before the upper.
static inline int pixel_of_step(int32_t position_24_8, int32_t step)
{
    return (position_24_8 + step) >> RHW_SUBPIXEL_BITS;
}

RHW_INLINE i32x8 pixel_of_step8(i32x8 position_24_8, i32x8 step)
{
    return (position_24_8 + step) >> RHW_SUBPIXEL_BITS;
}

#endif
