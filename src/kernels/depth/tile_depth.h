// SPDX-License-Identifier: MIT
// What a tile knows of depth and stencil while it is drawn.
#ifndef RHW_TILE_DEPTH_H
#define RHW_TILE_DEPTH_H

#include <stdbool.h>
#include <stdint.h>

#include "base/constants.h"

struct rhw_depth_stencil_state;

enum { HIZ_BLOCKS = RHW_TILE / RHW_BLOCK }; // number of blocks of a tile, each way

struct tile_depth {
    float texels[RHW_TILE * RHW_TILE];     // depth of the pixels, row by row
    float bounds[HIZ_BLOCKS * HIZ_BLOCKS]; // a bound for each block: see hiz.h
    // The way in which depth moves: 1 down and −1 up. It is 0 if depth may move both ways: then there are no bounds.
    int direction;
    // The least and the largest depth of each block: see depth_range.h.
    float range_least[HIZ_BLOCKS * HIZ_BLOCKS], range_most[HIZ_BLOCKS * HIZ_BLOCKS];
    bool has_ranges;         // true if range_least and range_most hold
    int unranged;            // number of triangles that could have used ranges
    uint64_t open[RHW_TILE]; // a bit for each pixel, by row: see open_pixels.h
    int open_count;          // number of open pixels, when triangles are drawn backwards
    bool marked;             // true if a fragment opened its pixel since this was last cleared
    float least, most;       // range that depth is held to
    const struct rhw_depth_stencil_state *state;
    uint64_t passed; // number of fragments of draws that are counted, since this was last cleared
    uint8_t stencil[RHW_TILE * RHW_TILE]; // stencil of the pixels, row by row; set if the pass has one
};

#endif
