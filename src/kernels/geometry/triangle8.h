// SPDX-License-Identifier: MIT
// 8 snapped triangles side by side, and the pixels that they may cover.
#ifndef RHW_TRIANGLE8_H
#define RHW_TRIANGLE8_H

#include "draw/draw_list.h"
#include "base/simd_layout.h"
#include "kernels/raster/sample_position.h"

struct triangle8 {
    i32x8 x[3], y[3]; // 24.8
    i32x8 flags_any, flags_all;
    f32x8 depth_min, depth_max;
};

// The pixels lie within the scissor; x1 and y1 are exclusive.
struct pixel_rect8 {
    i32x8 x0, y0, x1, y1;
};

// Load 8 triangles. `indices` are those of 8 triangles and of one more, which may be read. `first_slot` is the index of
// vertices[0].
RHW_INLINE struct triangle8 load_triangle8(const struct rhw_snapped_vertex *vertices, uint32_t first_slot,
                                           const uint32_t (*indices)[3])
{
    struct triangle8 t;
    for (int i = 0; i < 3; i++) {
        const void *places[8];
        f32x8 column[4];
        for (int lane = 0; lane < 8; lane++) {
            places[lane] = &vertices[indices[lane][i] - first_slot];
        }
        f32x8_load_columns(places, column);
        t.x[i] = (i32x8)column[0];
        t.y[i] = (i32x8)column[1];
        const i32x8 flags = (i32x8)column[3];
        t.flags_any = i == 0 ? flags : t.flags_any | flags;
        t.flags_all = i == 0 ? flags : t.flags_all & flags;
        t.depth_min = i == 0 ? column[2] : f32x8_min(t.depth_min, column[2]);
        t.depth_max = i == 0 ? column[2] : f32x8_max(t.depth_max, column[2]);
    }
    return t;
}

// Return the bits of the lanes that have one of the flags.
RHW_INLINE unsigned flagged8(i32x8 flags, int32_t which)
{
    return ~i32x8_sign_bits(rhw_equal_int(flags & i32x8_splat(which), i32x8_splat(0)));
}

RHW_INLINE i32x8 i32x8_min3(const i32x8 v[3])
{
    return i32x8_min(i32x8_min(v[0], v[1]), v[2]);
}

RHW_INLINE i32x8 i32x8_max3(const i32x8 v[3])
{
    return i32x8_max(i32x8_max(v[0], v[1]), v[2]);
}

// Return the lanes of the triangles that are RHW_TRIANGLE_SMALL by their size.
RHW_INLINE i32x8 small_triangles8(const struct triangle8 *t)
{
    const i32x8 size = i32x8_splat(RHW_TILE * RHW_SUBPIXEL);
    return (i32x8_max3(t->x) - i32x8_min3(t->x) < size) & (i32x8_max3(t->y) - i32x8_min3(t->y) < size);
}

RHW_INLINE struct pixel_rect8 pixel_rect8_of(const struct triangle8 *t, const struct rhw_draw_state *state)
{
    const struct rhw_rect *const scissor = &state->scissor;
    const i32x8 first = i32x8_splat(state->first_step), past = i32x8_splat(state->past_step);
    return (struct pixel_rect8){
        i32x8_max(pixel_of_step8(i32x8_min3(t->x), first), i32x8_splat(scissor->x)),
        i32x8_max(pixel_of_step8(i32x8_min3(t->y), first), i32x8_splat(scissor->y)),
        i32x8_min(pixel_of_step8(i32x8_max3(t->x), past), i32x8_splat(scissor->x + scissor->width)),
        i32x8_min(pixel_of_step8(i32x8_max3(t->y), past), i32x8_splat(scissor->y + scissor->height))};
}

#endif
