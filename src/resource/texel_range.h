// SPDX-License-Identifier: MIT
// Layers of a level as a range of memory. Texels that a texture and its views have in common lie in one place, so
// ranges tell.
#ifndef RHW_TEXEL_RANGE_H
#define RHW_TEXEL_RANGE_H

#include "texture.h"

struct rhw_texel_range {
    uintptr_t first, end;
};

// Return the range from the first layer's first byte to the last layer's. Each first byte stands for all bytes of its
// layer, because textures on memory of the program may have rows side by side. Of several samples the range is the
// first one's; the samples of other ranges lie to each other alike.
static inline struct rhw_texel_range rhw_texel_range_of(const struct rhw_mip *mip, int layer, int layers)
{
    return (struct rhw_texel_range){(uintptr_t)rhw_mip_slice(mip, layer),
                                    (uintptr_t)rhw_mip_slice(mip, layer + layers - 1) + 1};
}

static inline bool rhw_texel_ranges_overlap(struct rhw_texel_range a, struct rhw_texel_range b)
{
    return a.first < b.end && b.first < a.end;
}

#endif
