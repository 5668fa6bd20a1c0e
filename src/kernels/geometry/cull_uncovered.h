// SPDX-License-Identifier: MIT
// A special path culls triangles of the size of pixels that cover no sample by their edges, 8 at a time, instead of
// drawing them to no effect. The general path draws them, and passes with more than 4 samples a pixel draw them too.
//
// One of nine triangles covers no sample in a grid of a million. A frame takes fewer instructions: the scanned dragon
// of 871,000 triangles 20 % at 640×480, 9 % at 1024×1024, 6 % at 1920×1080; the horse of 97,000 5 % and Lucy 4 % at
// 640×480. It costs the bunny of 69,000 0.4 % at 640×480, and horse, Lucy and bunny 0.2 % at 1024×1024. With 4 samples
// a pixel 13 % of the triangles of sphere_1m at 960×540 cover no sample. A function of its own for several samples
// costs passes of one sample 3 %.
#ifndef RHW_CULL_UNCOVERED_H
#define RHW_CULL_UNCOVERED_H

#include "resource/sample_pattern.h"
#include "kernels/raster/coverage.h"
#include "triangle8.h"

enum { MOST_CULLED_SAMPLES = 4 }; // samples of a pixel, in passes that take this path

// The edges of 8 triangles at the first pixels of their rectangles, and what the edges change by to the next pixels.
struct corner_edges8 {
    u32x8 e[3], right[3], down[3];
};

// Return lanes that are negative where all of `most` × `most` pixels from the first on are outside, at samples of a
// kind.
RHW_INLINE i32x8 outside8(const struct corner_edges8 *at, int most)
{
    u32x8 row[3] = {at->e[0], at->e[1], at->e[2]};
    i32x8 outside = i32x8_splat(-1);
    for (int dy = 0; dy < most; dy++) {
        u32x8 e[3] = {row[0], row[1], row[2]};
        for (int dx = 0; dx < most; dx++) {
            outside &= (i32x8)(e[0] | e[1] | e[2]);
            for (int i = 0; i < 3; i++) {
                e[i] += at->right[i];
            }
        }
        for (int i = 0; i < 3; i++) {
            row[i] += at->down[i];
        }
    }
    return outside;
}

// Return the bits of the triangles that cover none of the few samples in their rectangle. Rectangles of more than 3×3
// pixels, or of more than 2×2 where pixels have several samples, are not looked at. `negative` has the bits of the
// triangles that turn the negative way. The numbers are unsigned; edge_lanes says why.
RHW_INLINE unsigned uncovered8(const struct triangle8 *t, const struct pixel_rect8 *pixels, unsigned negative,
                               const struct rhw_sample_pattern *pattern)
{
    enum { MOST = 3, MOST_OF_SEVERAL = 2 };
    const i32x8 most = i32x8_splat(pattern->count == 1 ? MOST : MOST_OF_SEVERAL);
    const i32x8 width = pixels->x1 - pixels->x0, height = pixels->y1 - pixels->y0;
    const unsigned few =
        ~i32x8_sign_bits(rhw_less_int(most, width) | rhw_less_int(most, height) | ~small_triangles8(t));
    if ((few & 0xff) == 0) {
        return 0;
    }
    const i32x8 turn = i32x8_from_bits(negative);
    const i32x8 x = sample_of_pixel8(pixels->x0), y = sample_of_pixel8(pixels->y0);
    struct edge_lanes edge[3];
    struct corner_edges8 at;
    for (int i = 0; i < 3; i++) {
        edge[i] = edge_lanes(t->x, t->y, i, turn, x, y);
        at.e[i] = (u32x8)edge[i].e;
        at.right[i] = (u32x8)edge[i].a << RHW_SUBPIXEL_BITS;
        at.down[i] = (u32x8)edge[i].b << RHW_SUBPIXEL_BITS;
    }
    if (pattern->count == 1) {
        return few & i32x8_sign_bits(outside8(&at, MOST));
    }
    i32x8 outside = i32x8_splat(-1);
    for (int s = 0; s < pattern->count; s++) {
        const u32x8 dx = (u32x8)i32x8_splat(pattern->x_0_8[s] - SAMPLE_OFFSET_0_8),
                    dy = (u32x8)i32x8_splat(pattern->y_0_8[s] - SAMPLE_OFFSET_0_8);
        for (int i = 0; i < 3; i++) {
            at.e[i] = (u32x8)edge[i].e + (u32x8)edge[i].a * dx + (u32x8)edge[i].b * dy;
        }
        outside &= outside8(&at, MOST_OF_SEVERAL);
    }
    return few & i32x8_sign_bits(outside);
}

#endif
