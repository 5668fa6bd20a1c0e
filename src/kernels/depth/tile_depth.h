// SPDX-License-Identifier: MIT
// What a tile knows of depth and stencil while it is drawn.
#ifndef RHW_TILE_DEPTH_H
#define RHW_TILE_DEPTH_H

#include <stdbool.h>
#include <stdint.h>

#include "base/constants.h"

struct rhw_depth_stencil_state;

enum { HIZ_BLOCKS = RHW_TILE / RHW_BLOCK }; // blocks of a tile, each way

struct tile_depth {
    float texels[RHW_TILE * RHW_TILE];     // row by row
    float bounds[HIZ_BLOCKS * HIZ_BLOCKS]; // by block: see hiz.h
    int direction; // the way in which depth moves, 1 down and −1 up; 0 where it may move both ways: no bounds
    float range_least[HIZ_BLOCKS * HIZ_BLOCKS], range_most[HIZ_BLOCKS * HIZ_BLOCKS]; // see depth_range.h
    bool has_ranges;                                                                 // the ranges hold
    int unranged;            // triangles that could have used them
    uint64_t open[RHW_TILE]; // by row, a bit per pixel: see open_pixels.h
    int open_count;          // open pixels, drawn backwards
    bool marked;             // a fragment opened its pixel since this was last cleared
    float least, most;       // what depth is held to
    const struct rhw_depth_stencil_state *state;
    uint64_t passed;                      // fragments of draws that are counted, since this was last cleared
    uint8_t stencil[RHW_TILE * RHW_TILE]; // row by row; set where the pass has one
};

#endif
