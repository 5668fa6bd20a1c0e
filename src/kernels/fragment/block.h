// SPDX-License-Identifier: MIT
// The paths of triangles hand a block of 8×8 pixels on, whose fragments are to be shaded.
#ifndef RHW_BLOCK_H
#define RHW_BLOCK_H

#include "kernels/raster/plane.h"

// The samples of a block that a triangle covers, and where in its pixels their fragments take their values.
struct block_samples {
    const uint64_t *mask;            // covered pixels of each sample
    const f32x8 (*depth)[RHW_BLOCK]; // depths of the rows of each sample, where depth is tested late
    int only;                        // the one sample that the fragments stand for; −1: all in `mask`
    float position[2];               // place of `only` in its pixel
    // The block at the centres of its pixels, where some values are taken there and others at centroids. Else NULL.
    const struct block *center;
};

// A block of the tile, and the fragments of a triangle in it.
struct block {
    int x, y; // pixels of the tile
    struct anchor_offset at;
    const f32x8 *z;                      // depths of the block's rows, where depth is kept
    bool leaves_triangle;                // true if some weights may be below 0: see plane_clipped.h
    const struct block_samples *samples; // NULL where pixels have one sample
};

#endif
