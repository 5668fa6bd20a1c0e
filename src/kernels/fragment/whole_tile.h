// SPDX-License-Identifier: MIT
// A triangle that covers a tile all over has groups of its own: what the blocks of a tile share is done once.
#ifndef RHW_WHOLE_TILE_H
#define RHW_WHOLE_TILE_H

#include "row_groups.h"

RHW_INLINE void fill_whole_tile(struct tile_work *work, const struct triangle_work *triangle,
                                enum derivatives derivatives, enum weight_path path)
{
    const struct planes *const planes = &triangle->planes;
    struct fragment_queue *const queue = &work->scratch->queue;
    for (int y = 0; y < RHW_TILE; y += RHW_BLOCK) {
        struct block_planes over;
        const f64x8 dy = block_offset(work, planes, 0, y).dy;
        block_weight_rows(&over, planes, dy, path);
        for (int x = 0; x < RHW_TILE; x += RHW_BLOCK) {
            const struct anchor_offset at = {block_offset(work, planes, x, y).dx, dy};
            block_weight_columns(&over, planes, at.dx);
            place_rows(queue, &all_rows, x, y);
            fill_steps(work, triangle, &over, &at, &all_rows, derivatives, path);
            queue->count += RHW_BLOCK;
            shade_if_full(work);
        }
    }
}

// Queue and shade all blocks of a tile. The queue is empty, so that the groups fill it without a rest.
static void queue_tile(struct tile_work *work, struct triangle_work *triangle)
{
    set_inputs(work, triangle);
    const bool derivatives = work->pipeline->any_derivatives;
    const bool per_row = weight_path_of(&triangle->planes) == WEIGHTS_PER_ROW;
    if (derivatives && per_row) {
        fill_whole_tile(work, triangle, DERIVATIVES, WEIGHTS_PER_ROW);
    } else if (derivatives) {
        fill_whole_tile(work, triangle, DERIVATIVES, WEIGHTS_PER_PIXEL);
    } else if (per_row) {
        fill_whole_tile(work, triangle, NO_DERIVATIVES, WEIGHTS_PER_ROW);
    } else {
        fill_whole_tile(work, triangle, NO_DERIVATIVES, WEIGHTS_PER_PIXEL);
    }
}

#endif
