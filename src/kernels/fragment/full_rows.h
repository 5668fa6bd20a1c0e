// SPDX-License-Identifier: MIT
// Groups that are rows whose pixels are all live are blended without masks, by one call for several of them where the
// target has a format of any kind.
#ifndef RHW_FULL_ROWS_H
#define RHW_FULL_ROWS_H

#include "kernels/tile_work.h"
#include "blend.h"

// Blend the groups from `first` on below `end`, rows that are live all over, into the texels of target t that begin at
// `texels`. `path` is the target's, and `size` is the size of its texels in bytes; both are constants where a call
// names them.
RHW_INLINE void blend_full_rows(const struct tile_work *work, int t, enum rhw_blend_path path, size_t size,
                                int first, int end, unsigned char *texels)
{
    struct rhw_blend_state state = work->state->blend[t];
    state.path = path;
    const struct fragment_queue *const queue = &work->scratch->queue;
    if (path == BLEND_REPLACE || path == BLEND_OVER || path == BLEND_GENERAL) {
        const struct texel_rows rows = {.count = end - first,
                                        .color = queue->colors[first][t],
                                        .stride = sizeof queue->colors[0] / sizeof queue->colors[0][t][0],
                                        .texels = texels,
                                        .at = queue->row_at + first};
        act_on_rows(&state, &rows);
        return;
    }
    const bool is_common = path == BLEND_RGBA8_REPLACE || path == BLEND_RGBA8_OVER;
    if (is_common && state.texel_mask[0] == UINT32_MAX) {
        // The compiler knows the mask from here on.
        state.texel_mask[0] = UINT32_MAX;
        for (int g = first; g < end; g++) {
            blend_group(&state, queue->colors[g][t], i32x8_splat(-1),
                        texels + (size_t)queue->row_at[g] * size);
        }
        return;
    }
    for (int g = first; g < end; g++) {
        blend_group(&state, queue->colors[g][t], i32x8_splat(-1), texels + (size_t)queue->row_at[g] * size);
    }
}

#endif
