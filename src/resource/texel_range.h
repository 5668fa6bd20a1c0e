// SPDX-License-Identifier: MIT
// Layers of a level as a range of memory: what a texture and its views have in common lies in the same place.
#ifndef RHW_TEXEL_RANGE_H
#define RHW_TEXEL_RANGE_H

#include "texture.h"

struct rhw_texel_range {
    uintptr_t first, end;
};

// From the first layer's first byte to the last one's, which stand for all of theirs: textures on memory of the program
// may have rows side by side. Of several samples the first one's, which lie to each other as those of the others do.
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
