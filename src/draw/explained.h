// SPDX-License-Identifier: MIT
// What is kept of a sample whose history a pass is asked for (rhw/explain.h), while its tile draws a triangle. Tiles of other
// pixels know nothing of it.
#ifndef RHW_EXPLAINED_H
#define RHW_EXPLAINED_H

#include "base/constants.h"
#include "rhw/explain.h"

struct rhw_explained {
    struct rhw_explain ask; // ask.fragment NULL: nothing is asked
    int tile;               // its number, as rhw_draw_tile counts them
    int x, y;               // the pixel in its tile
    // Of the triangle under way:
    struct rhw_explained_fragment fragment;
    bool passed, discarded, written;
    float varyings[RHW_MAX_VARYING_COMPONENTS], ddx[RHW_MAX_VARYING_COMPONENTS],
        ddy[RHW_MAX_VARYING_COMPONENTS];
};

#endif
