// SPDX-License-Identifier: MIT
// Images made smaller while they are read: each texel is the mean of a box of those that came in. What is colour is
// averaged as light, what is data as it is, like the levels of a mip chain.
#ifndef SCENE_IMAGE_REDUCE_H
#define SCENE_IMAGE_REDUCE_H

#include "model.h"

/// Takes rows of RGBA8 texels from top to bottom.
struct scene_reducer {
    uint32_t width, height; ///< of what comes in
    struct scene_image *image;
    bool is_color;
    uint32_t light[256]; ///< of each code, with is_color
    uint32_t *columns;   ///< the texel that takes each one of a row
    uint32_t *counts;    ///< how many each takes of a row
    uint64_t *sums;      ///< four of each texel of the row under way
    uint32_t row, rows_summed;
};

/// Whether an image of this size is longer than `side` in any direction; with side 0 none is.
bool scene_reduce_needed(uint32_t width, uint32_t height, uint32_t side);

/// Sets type, size and texels (malloc) of `image`: width and height halved until neither exceeds `side`. False: no
/// memory, and nothing is left behind.
bool scene_reducer_open(struct scene_reducer *reducer, uint32_t width, uint32_t height, uint32_t side,
                        bool is_color, struct scene_image *image);
void scene_reducer_add(struct scene_reducer *reducer, const uint8_t *row);
/// After all rows. The image stays.
void scene_reducer_close(struct scene_reducer *reducer);

/// Reduces an image that is decoded already and frees its texels; 16 bits become 8. False: no memory, the image is as
/// it was.
bool scene_reduce_image(struct scene_image *image, uint32_t side, bool is_color);

#endif
