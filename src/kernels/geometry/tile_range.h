// SPDX-License-Identifier: MIT
// The tiles that a triangle lies in.
#ifndef RHW_TILE_RANGE_H
#define RHW_TILE_RANGE_H

#include <string.h>

#include "base/constants.h"
#include "base/simd.h"

// The first and the last tile each way, both inclusive. A target has at most 256 tiles each way.
struct rhw_tile_range {
    uint8_t x0, y0, x1, y1;
};

_Static_assert(sizeof(struct rhw_tile_range) == sizeof(int32_t), "tile_ranges8 packs one into each lane");

// Return the tiles of the pixels x0 .. x1 − 1, y0 .. y1 − 1. There is at least one.
static inline struct rhw_tile_range tile_range(int x0, int y0, int x1, int y1)
{
    return (struct rhw_tile_range){(uint8_t)(x0 >> RHW_TILE_LOG2), (uint8_t)(y0 >> RHW_TILE_LOG2),
                                   (uint8_t)((x1 - 1) >> RHW_TILE_LOG2),
                                   (uint8_t)((y1 - 1) >> RHW_TILE_LOG2)};
}

// Set the tiles of 8 triangles. Triangles without a pixel get rubbish.
RHW_INLINE void tile_ranges8(struct rhw_tile_range ranges[8], i32x8 x0, i32x8 y0, i32x8 x1, i32x8 y1)
{
    const i32x8 one = i32x8_splat(1);
    // Lanes are little-endian, as fill_words says.
    i32x8_store(ranges, (x0 >> RHW_TILE_LOG2) | (y0 >> RHW_TILE_LOG2) << 8 |
                            ((x1 - one) >> RHW_TILE_LOG2) << 16 | ((y1 - one) >> RHW_TILE_LOG2) << 24);
}

static inline bool is_one_tile(const struct rhw_tile_range *range)
{
    uint16_t first, last;
    memcpy(&first, &range->x0, sizeof first);
    memcpy(&last, &range->x1, sizeof last);
    return first == last;
}

#endif
