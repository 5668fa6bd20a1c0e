// SPDX-License-Identifier: MIT
// 8 struct rhw_triangle, written from lanes.
#ifndef RHW_TRIANGLE_WORDS_H
#define RHW_TRIANGLE_WORDS_H

#include <stddef.h>

#include "geometry_scratch.h"
#include "triangle8.h"

// A slice is 8 triangles of a run, one after another.
struct run_slice {
    uint32_t run; // number of the run in the scratch
    // Indices of the triangles' vertices, and of the vertices of one triangle more, which may be read.
    const uint32_t (*indices)[3];
    uint32_t first_primitive;
    unsigned live; // bits of the triangles that are there
};

// What 8 triangles are made of and belong to.
struct triangle_names8 {
    i32x8 vertex[3]; // slots of the vertices
    i32x8 primitive, segment;
};

RHW_INLINE struct triangle_names8 names_of_slice(const struct run_slice *slice, uint32_t first_slot)
{
    const void *places[8];
    for (int lane = 0; lane < 8; lane++) {
        places[lane] = slice->indices[lane];
    }
    f32x8 column[4];
    f32x8_load_columns(places, column);
    struct triangle_names8 names;
    for (int i = 0; i < 3; i++) {
        names.vertex[i] = (i32x8)((u32x8)column[i] - (u32x8)i32x8_splat((int32_t)first_slot));
    }
    names.primitive = (i32x8)((u32x8)i32x8_splat((int32_t)slice->first_primitive) + (u32x8)rhw_lane_index);
    names.segment = i32x8_splat((int32_t)slice->run);
    return names;
}

// 8 triangles in two halves: first word by word, then triangle by triangle.
struct triangle_words {
    f32x8 low[8], high[8];
};

_Static_assert(offsetof(struct rhw_triangle, y_24_8) == 12 && offsetof(struct rhw_triangle, vertex) == 24 &&
                   offsetof(struct rhw_triangle, primitive) == 36 &&
                   offsetof(struct rhw_triangle, segment) == 40 &&
                   offsetof(struct rhw_triangle, polygon) == 44 &&
                   offsetof(struct rhw_triangle, flags) == 48 && offsetof(struct rhw_triangle, x0) == 50 &&
                   offsetof(struct rhw_triangle, y0) == 52 && offsetof(struct rhw_triangle, x1) == 54 &&
                   offsetof(struct rhw_triangle, y1) == 56 && sizeof(struct rhw_triangle) == 64,
               "fill_words writes struct rhw_triangle word by word");

// Fill the words. `flags` are those of the triangles.
RHW_INLINE void fill_words(struct triangle_words *words, const struct triangle8 *t,
                           const struct pixel_rect8 *pixels, i32x8 flags, const struct triangle_names8 *names)
{
    f32x8 *const low = words->low, *const high = words->high;
    for (int i = 0; i < 3; i++) {
        low[i] = (f32x8)t->x[i];
        low[3 + i] = (f32x8)t->y[i];
    }
    low[6] = (f32x8)names->vertex[0];
    low[7] = (f32x8)names->vertex[1];
    high[0] = (f32x8)names->vertex[2];
    high[1] = (f32x8)names->primitive;
    high[2] = (f32x8)names->segment;
    high[3] = high[7] = f32x8_splat(0);
    // Lanes are little-endian, as every machine with these lanes is.
    high[4] = (f32x8)(flags | pixels->x0 << 16);
    high[5] = (f32x8)(pixels->y0 | pixels->x1 << 16);
    high[6] = (f32x8)pixels->y1;
    f32x8_transpose(low);
    f32x8_transpose(high);
}

// Give 8 triangles their phases, in the place of the polygon's number.
RHW_INLINE void set_phases(struct triangle_words *words, i32x8 phase)
{
    for (int lane = 0; lane < 8; lane++) {
        i32x8 high = (i32x8)words->high[lane];
        high[3] = phase[lane];
        words->high[lane] = (f32x8)high;
    }
}

// Add triangle `lane` to the list.
RHW_INLINE void add_words(struct rhw_triangle_list *list, const struct triangle_words *words,
                          const struct rhw_tile_range ranges[8], int lane)
{
    struct rhw_triangle *const out = &list->triangles[list->count];
    memcpy(out, &words->low[lane], 32);
    memcpy((unsigned char *)out + 32, &words->high[lane], 32);
    list->ranges[list->count++] = ranges[lane];
}

// Return the flags by which depth is clamped that lies between two values: a rounding may carry it past the viewport's
// range where it changes next to the range's ends.
RHW_INLINE i32x8 clamp_flags8(const struct rhw_draw_state *state, f32x8 least, f32x8 most)
{
    const float margin = 0x1p-20f;
    const f32x8 low = f32x8_splat(state->depth_least), high = f32x8_splat(state->depth_most);
    const i32x8 inside = rhw_equal(least, most) & rhw_less_equal(low, least) & rhw_less_equal(most, high);
    const i32x8 clamp =
        rhw_less(least, low + f32x8_splat(margin)) | rhw_less(high - f32x8_splat(margin), most);
    return clamp & ~inside & i32x8_splat(RHW_TRIANGLE_CLAMP);
}

#endif
