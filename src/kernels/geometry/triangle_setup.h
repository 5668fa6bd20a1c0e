// SPDX-License-Identifier: MIT
// The way from vertex indices to the triangles that tiles draw. 8 triangles of a run at a time are culled, and what is
// left is written in submission order, with the tiles that each lies in.
#ifndef RHW_TRIANGLE_SETUP_H
#define RHW_TRIANGLE_SETUP_H

#include "clipped_setup.h"
#include "cull.h"
#include "geometry_scratch.h"
#include "triangle_words.h"

// Return the flags of unclipped triangles.
RHW_INLINE i32x8 triangle_flags8(const struct triangle8 *t, const struct cull8 *cull,
                                 const struct rhw_draw_state *state)
{
    // A rounding may carry interpolated depth past the viewport's range, where a vertex is next to its ends.
    const float margin = 0x1p-20f;
    const i32x8 clamp = rhw_less(t->depth_min, f32x8_splat(state->depth_least + margin)) |
                        rhw_less(f32x8_splat(state->depth_most - margin), t->depth_max);
    const i32x8 sides = (i32x8_from_bits(cull->back) & i32x8_splat(RHW_TRIANGLE_BACK)) |
                        (i32x8_from_bits(cull->negative) & i32x8_splat(RHW_TRIANGLE_NEGATIVE));
    if (state->pipeline->is_conservative) { // triangles are drawn beyond their corners, too
        return sides | i32x8_splat(RHW_TRIANGLE_CONSERVATIVE | RHW_TRIANGLE_CLAMP);
    }
    return sides | (clamp & i32x8_splat(RHW_TRIANGLE_CLAMP)) |
           (small_triangles8(t) & ~clamp & i32x8_splat(RHW_TRIANGLE_SMALL));
}

// Add what culling leaves of 8 triangles to the list, in submission order.
static void setup8(struct rhw_geometry_scratch *scratch, const struct run_slice *slice,
                   struct rhw_triangle_list *list)
{
    const struct rhw_run *const run = &scratch->runs[slice->run];
    const struct rhw_segment *const segment = &scratch->segments[slice->run];
    const struct rhw_draw_state *const state = segment->draw->state;
    const struct triangle8 t = load_triangle8(run->vertices, run->first_slot, slice->indices);
    const struct cull8 cull =
        cull8(&t, state, slice->live, state->pipeline->is_conservative ? NULL : scratch->uncovered_pattern);
    scratch->counters.culled += (unsigned)__builtin_popcount(cull.culled);
    if ((cull.drawn | cull.clipped) == 0) {
        return;
    }
    const i32x8 flags = triangle_flags8(&t, &cull, state);
    const struct triangle_names8 names = names_of_slice(slice, run->first_slot);
    struct triangle_words words;
    fill_words(&words, &t, &cull.pixels, flags, &names);
    struct rhw_tile_range ranges[8];
    tile_ranges8(ranges, cull.pixels.x0, cull.pixels.y0, cull.pixels.x1, cull.pixels.y1);
    for (unsigned left = cull.drawn | cull.clipped; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        struct rhw_triangle *const out = &list->triangles[list->count];
        memcpy(out, &words.low[lane], 32);
        memcpy((unsigned char *)out + 32, &words.high[lane], 32);
        list->ranges[list->count] = ranges[lane];
        if (cull.clipped >> lane & 1) {
            if (!setup_clipped(scratch, segment, out)) {
                continue;
            }
            list->ranges[list->count] = tile_range(out->x0, out->y0, out->x1, out->y1);
        }
        list->count++;
    }
}

#endif
