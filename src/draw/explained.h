// SPDX-License-Identifier: MIT
// A pass may be asked for the history of a sample (rhw/explain.h). This structure keeps it while the sample's tile
// draws a triangle. Tiles of other pixels know nothing of it.
#ifndef RHW_EXPLAINED_H
#define RHW_EXPLAINED_H

#include "base/constants.h"
#include "rhw/explain.h"

struct rhw_explained {
    struct rhw_explain ask; // ask.fragment NULL: nothing is asked
    int tile;               // number of the tile, as rhw_draw_tile counts
    int x, y;               // the pixel in its tile
    // The members from here on tell of the triangle under way.
    struct rhw_explained_fragment fragment;
    bool passed, discarded, written;
    float varyings[RHW_MAX_VARYING_COMPONENTS], ddx[RHW_MAX_VARYING_COMPONENTS],
        ddy[RHW_MAX_VARYING_COMPONENTS];
};

#endif
