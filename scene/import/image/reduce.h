// SPDX-License-Identifier: MIT
// Images are made smaller while they are read: each texel is the mean of a box of texels that came in. Colours are
// averaged as light and data as it is, like the levels of a mip chain.
#ifndef SCENE_IMAGE_REDUCE_H
#define SCENE_IMAGE_REDUCE_H

#include "model.h"

/// Takes rows of RGBA8 texels from top to bottom.
struct scene_reducer {
    uint32_t width, height; ///< size of the image that comes in
    struct scene_image *image;
    bool is_color;
    uint32_t light[256]; ///< light of each code, with is_color
    uint32_t *columns;   ///< texel of the reduced row that takes each texel of a row
    uint32_t *counts;    ///< number of texels of a row that each reduced texel takes
    uint64_t *sums;      ///< four sums for each texel of the reduced row under way
    uint32_t row, rows_summed;
};

/// Return true if an image of this size is longer than `side` in any direction. Return false if `side` is 0.
bool scene_reduce_needed(uint32_t width, uint32_t height, uint32_t side);

/// Set type, size and texels (malloc) of `image`. Its width and height are halved until neither exceeds `side`. Return
/// false if there is no memory; nothing is left behind then.
bool scene_reducer_open(struct scene_reducer *reducer, uint32_t width, uint32_t height, uint32_t side,
                        bool is_color, struct scene_image *image);
void scene_reducer_add(struct scene_reducer *reducer, const uint8_t *row);
/// Free what the reducer has, after all rows. The image stays.
void scene_reducer_close(struct scene_reducer *reducer);

/// Reduce an image that is decoded already, and free its old texels. 16 bits become 8. Return false if there is no
/// memory; the image is as it was then.
bool scene_reduce_image(struct scene_image *image, uint32_t side, bool is_color);

#endif
