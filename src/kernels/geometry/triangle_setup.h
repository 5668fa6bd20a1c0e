// SPDX-License-Identifier: MIT
// From vertex indices to the triangles that tiles draw: 8 of a run at a time are culled, and what is left is written in
// submission order, with the tiles that each lies in.
#ifndef RHW_TRIANGLE_SETUP_H
#define RHW_TRIANGLE_SETUP_H

#include <stddef.h>

#include "clipped_setup.h"
#include "cull.h"
#include "geometry_scratch.h"

// These are 8 triangles of a run, one after another.
struct run_slice {
    uint32_t run;                 // its number in the scratch
    const uint32_t (*indices)[3]; // of their vertices and of one triangle more, which may be read
    uint32_t first_primitive;
    unsigned live; // bits of those that are there
};

// 8 struct rhw_triangle in two halves: first word by word, then triangle by triangle.
struct triangle_words {
    f8 low[8], high[8];
};

_Static_assert(offsetof(struct rhw_triangle, y_24_8) == 12 && offsetof(struct rhw_triangle, vertex) == 24 &&
                   offsetof(struct rhw_triangle, primitive) == 36 &&
                   offsetof(struct rhw_triangle, segment) == 40 &&
                   offsetof(struct rhw_triangle, polygon) == 44 &&
                   offsetof(struct rhw_triangle, flags) == 48 && offsetof(struct rhw_triangle, x0) == 50 &&
                   offsetof(struct rhw_triangle, y0) == 52 && offsetof(struct rhw_triangle, x1) == 54 &&
                   offsetof(struct rhw_triangle, y1) == 56 && sizeof(struct rhw_triangle) == 64,
               "fill_words writes struct rhw_triangle word by word");

// `flags` are those of the triangles.
RHW_INLINE void fill_words(struct triangle_words *words, const struct triangle8 *t,
                           const struct pixel_rect8 *pixels, i8 flags, const struct run_slice *slice,
                           uint32_t first_slot)
{
    const void *places[8];
    for (int lane = 0; lane < 8; lane++) {
        places[lane] = slice->indices[lane];
    }
    f8 vertex[4], *const low = words->low, *const high = words->high;
    f8_load_columns(places, vertex);
    for (int i = 0; i < 3; i++) {
        vertex[i] = (f8)((i8)vertex[i] - i8_splat((int32_t)first_slot));
        low[i] = (f8)t->x[i];
        low[3 + i] = (f8)t->y[i];
    }
    low[6] = vertex[0];
    low[7] = vertex[1];
    high[0] = vertex[2];
    high[1] = (f8)(i8_splat((int32_t)slice->first_primitive) + rhw_lane_index);
    high[2] = (f8)i8_splat((int32_t)slice->run);
    high[3] = high[7] = f8_splat(0);
    high[4] = (f8)(flags | pixels->x0 << 16); // little-endian, as every machine with these lanes is
    high[5] = (f8)(pixels->y0 | pixels->x1 << 16);
    high[6] = (f8)pixels->y1;
    f8_transpose(low);
    f8_transpose(high);
}

// Gives the flags of unclipped triangles.
RHW_INLINE i8 triangle_flags8(const struct triangle8 *t, const struct cull8 *cull,
                              const struct rhw_draw_state *state)
{
    // A rounding may carry interpolated depth past the viewport's range, where a vertex is next to its ends.
    const float margin = 0x1p-20f;
    const i8 clamp = rhw_less(t->depth_min, f8_splat(state->depth_least + margin)) |
                     rhw_less(f8_splat(state->depth_most - margin), t->depth_max);
    return (i8_from_bits(cull->back) & i8_splat(RHW_TRIANGLE_BACK)) |
           (i8_from_bits(cull->negative) & i8_splat(RHW_TRIANGLE_NEGATIVE)) |
           (clamp & i8_splat(RHW_TRIANGLE_CLAMP)) |
           (small_triangles8(t) & ~clamp & i8_splat(RHW_TRIANGLE_SMALL));
}

// Adds what culling leaves of 8 triangles to the list, in submission order.
static void setup8(struct rhw_geometry_scratch *scratch, const struct run_slice *slice,
                   struct rhw_triangle_list *list)
{
    const struct rhw_run *const run = &scratch->runs[slice->run];
    const struct rhw_segment *const segment = &scratch->segments[slice->run];
    const struct rhw_draw_state *const state = segment->draw->state;
    const struct triangle8 t = load_triangle8(run->vertices, run->first_slot, slice->indices);
    const struct cull8 cull = cull8(&t, state, slice->live, scratch->culls_uncovered);
    scratch->counters.culled += (unsigned)__builtin_popcount(cull.culled);
    if ((cull.drawn | cull.clipped) == 0) {
        return;
    }
    const i8 flags = triangle_flags8(&t, &cull, state);
    struct triangle_words words;
    fill_words(&words, &t, &cull.pixels, flags, slice, run->first_slot);
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

static void setup_run(struct rhw_geometry_scratch *scratch, uint32_t run_index,
                      struct rhw_triangle_list *list)
{
    const struct rhw_run *const run = &scratch->runs[run_index];
    uint32_t i = 0;
    for (; i + 8 < run->count; i += 8) {
        const struct run_slice slice = {run_index, run->indices + i, run->first_primitive + i, 0xff};
        setup8(scratch, &slice, list);
    }
    // The last ones are repeated, so that setup8 reads nothing else behind them.
    uint32_t indices[9][3];
    const uint32_t left = run->count - i;
    for (uint32_t lane = 0; lane < 9; lane++) {
        memcpy(indices[lane], run->indices[i + (lane < left ? lane : left - 1)], sizeof *indices);
    }
    const struct run_slice slice = {run_index, (const uint32_t(*)[3])indices, run->first_primitive + i,
                                    0xffu >> (8 - left)};
    setup8(scratch, &slice, list);
}

#endif
