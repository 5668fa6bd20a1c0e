// SPDX-License-Identifier: MIT
// Culling decides which of 8 triangles are drawn. Triangles that are outside the view, have no area, face the wrong way
// or have no sample in their rectangle are culled, and triangles that a plane may cut are told apart.
#ifndef RHW_CULL_H
#define RHW_CULL_H

#include "cull_uncovered.h"
#include "facing.h"
#include "triangle8.h"

// Each mask has a bit for each of 8 triangles.
struct cull8 {
    unsigned drawn; // drawn as they are, unclipped
    // A plane may cut them, or a vertex cannot be snapped: clipped_setup.h decides.
    unsigned clipped;
    unsigned culled;           // culled among the unclipped ones
    unsigned back, negative;   // they face away; they turn the negative way
    struct pixel_rect8 pixels; // unset where no triangle is drawn or clipped
};

// Set the signs of twice the areas: bits of the negative and of the nonzero ones. Differences are below 2^24 and
// products below 2^48, which is exact in double.
RHW_INLINE void area_signs8(const struct triangle8 *t, unsigned *negative, unsigned *nonzero)
{
    const i32x8 ax = t->x[1] - t->x[0], ay = t->y[1] - t->y[0];
    const i32x8 bx = t->x[2] - t->x[0], by = t->y[2] - t->y[0];
    const f32x8 area = f32x8_from_f64x8(
        f64x8_sub(f64x8_mul(f64x8_from_i32x8(ax), f64x8_from_i32x8(by)),   //
                  f64x8_mul(f64x8_from_i32x8(bx), f64x8_from_i32x8(ay)))); // not 0 stays not 0
    *negative = i32x8_sign_bits(rhw_less(area, f32x8_splat(0)));
    *nonzero = ~i32x8_sign_bits(rhw_equal(area, f32x8_splat(0)));
}

// Cull 8 triangles. `live` has the bits of the lanes that are triangles. `pattern` is NULL where cull_uncovered.h has
// nothing to do.
RHW_INLINE struct cull8 cull8(const struct triangle8 *t, const struct rhw_draw_state *state, unsigned live,
                              const struct rhw_sample_pattern *pattern)
{
    const struct rhw_pipeline_def *const def = &state->pipeline->def;
    struct cull8 c;
    unsigned nonzero;
    area_signs8(t, &c.negative, &nonzero);
    c.back = facing_back(def, c.negative);
    c.clipped = live & flagged8(t->flags_any, RHW_VERTEX_CLIP | RHW_VERTEX_NOT_FINITE);
    const unsigned unclipped = live & ~c.clipped;
    c.drawn = unclipped & ~flagged8(t->flags_all, RHW_VERTEX_OUTSIDE) & nonzero & ~culled_facing(def, c.back);
    if ((c.drawn | c.clipped) != 0) {
        c.pixels = pixel_rect8_of(t, state);
        c.drawn &=
            i32x8_sign_bits(rhw_less_int(c.pixels.x0, c.pixels.x1) & rhw_less_int(c.pixels.y0, c.pixels.y1));
        if (c.drawn != 0 && pattern) {
            c.drawn &= ~uncovered8(t, &c.pixels, c.negative, pattern);
        }
    }
    c.culled = unclipped & ~c.drawn;
    return c;
}

#endif
