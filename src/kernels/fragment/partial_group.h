// SPDX-License-Identifier: MIT
// The makers of groups call these functions in the midst of their loops: they shade a queue that is full, add single
// fragments to the partial group (pack.h), and ask for fragments that wait in it.
#ifndef RHW_PARTIAL_GROUP_H
#define RHW_PARTIAL_GROUP_H

#include "kernels/depth/open_pixels.h"
#include "kernels/tile_units.h"
#include "interpolate.h"

// Shade the queue if the groups that were added have filled it.
RHW_INLINE void shade_if_full(struct tile_work *work)
{
    if (work->scratch->queue.count == RHW_FRAGMENT_GROUPS) {
        RHW_ISA_NAME(rhw_shade_queue)(work);
    }
}

// Return true if fragments wait in pixels of the block at (x, y) that are set in `mask`.
RHW_INLINE bool fragments_wait(const struct tile_work *work, int x, int y, uint64_t mask)
{
    const struct partial_group *const partial = &work->scratch->partial;
    return partial->count != 0 && block_bits(&partial->pixels[y], x) & mask;
}

// Queue the partial group if the block's fragments in `mask` would overtake some that wait in it.
RHW_INLINE void release_overtaken(struct tile_work *work, int x, int y, uint64_t mask)
{
    if (fragments_wait(work, x, y, mask)) {
        RHW_ISA_NAME(rhw_release_partial)(work);
    }
}

// Begin a triangle whose anchor is a pixel of the target. The result has all that smooth varyings need of the triangle,
// beside its planes.
RHW_INLINE struct packed_triangle *next_packed(struct tile_work *work,
                                               const struct rhw_vertex_record *const vertex[3], int anchor_x,
                                               int anchor_y)
{
    struct partial_group *const partial = &work->scratch->partial;
    struct packed_triangle *const to = &partial->triangles[partial->triangle_count++ % RHW_PACKED_TRIANGLES];
    to->anchor_x = anchor_x - work->x;
    to->anchor_y = anchor_y - work->y;
    to->clamps_depth = false;
    for (int i = 0; i < 3; i++) {
        to->varyings[i] = vertex[i]->varyings;
    }
    to->provoking = to->varyings[provoking_vertex(work->pipeline)];
    return to;
}

// Add the fragment at a texel, whose quantities have the given values. Return its place in the group.
RHW_INLINE int pack_values(struct partial_group *partial, const struct packed_triangle *packed, int texel,
                           f64x4 quantities)
{
    const int n = partial->count;
    partial->texel[n] = texel;
    partial->pixels[texel_row(texel)] |= (uint64_t)1 << texel_column(texel);
    partial->triangle[n] = packed;
    partial->quantities[n] = quantities;
    partial->count = n + 1;
    return n;
}

#endif
