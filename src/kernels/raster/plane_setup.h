// SPDX-License-Identifier: MIT
// The planes of snapped triangles are made here, four triangles at a time, lane by lane: by itself a triangle spends
// most of its setup waiting for divisions, of which there are seven. A caller that needs the planes of one triangle
// alone gives it to all lanes.
#ifndef RHW_PLANE_SETUP_H
#define RHW_PLANE_SETUP_H

#include "plane.h"

// Four snapped triangles.
struct setup_input4 {
    f64x4 x1, y1, x2, y2; // vertices 1 and 2, seen from vertex 0, in 1/256 pixel
    f64x4 px, py;         // sample of the anchor, the pixel of vertex 0, seen from vertex 0, in 1/256 pixel
    f64x4 w[3], z[3];     // W and depth of the three vertices
    f64x4 depth_low, depth_span;
};

// One plane of each of four triangles.
struct plane4 {
    f64x4 at, dx, dy;
};

struct setup_output4 {
    struct plane4 e1, e2; // exact integers
    f64x4 area, inverse_area;
    f64x4 base[4], f1[4], f2[4]; // vectors by quantity: a quantity is base + f1·e_1 + f2·e_2
    struct plane4 quantity[4];   // planes by quantity
    i64x4 is_exact; // −1 in a lane whose numbers must be made of exact integers, pixel by pixel
};

RHW_INLINE struct plane4 combine_planes4(f64x4 base, f64x4 f1, f64x4 f2, struct plane4 e1, struct plane4 e2)
{
    return (struct plane4){base + (f1 * e1.at + f2 * e2.at), f1 * e1.dx + f2 * e2.dx,
                           f1 * e1.dy + f2 * e2.dy};
}

// Make the edges 2 → 0 and 0 → 1 at the anchor's sample, seen from vertex 0. They are exact (constants.h).
RHW_INLINE void setup_edges4(struct setup_output4 *out, const struct setup_input4 *t)
{
    const f64x4 pixel = f64x4_splat(RHW_SUBPIXEL);
    const f64x4 signed_area = t->x1 * t->y2 - t->x2 * t->y1;
    const f64x4 sign = f64x4_select(f64x4_less(signed_area, f64x4_splat(0)), f64x4_splat(-1), f64x4_splat(1));
    const f64x4 x1 = t->x1 * sign, x2 = t->x2 * sign, y1 = t->y1 * sign, y2 = t->y2 * sign;
    out->e1 = (struct plane4){y2 * t->px - x2 * t->py, y2 * pixel, -x2 * pixel};
    out->e2 = (struct plane4){x1 * t->py - y1 * t->px, -y1 * pixel, x1 * pixel};
    out->area = sign * signed_area;
    out->inverse_area = f64x4_splat(1) / out->area;
}

RHW_INLINE void setup_planes4(struct setup_output4 *out, const struct setup_input4 *t)
{
    const f64x4 zero = f64x4_splat(0), one = f64x4_splat(1), pixel = f64x4_splat(RHW_SUBPIXEL);
    setup_edges4(out, t);
    f64x4 w[3], d[3];
    for (int v = 0; v < 3; v++) {
        w[v] = one / t->w[v];
        d[v] = t->depth_low + t->depth_span * (t->z[v] / t->w[v]);
    }
    // Terms that are 0 are kept: they may turn the sign of a zero.
    const f64x4 base[4] = {w[0], zero, zero, d[0]};
    const f64x4 f1[4] = {w[1] - w[0], w[1], zero, d[1] - d[0]},
                f2[4] = {w[2] - w[0], zero, w[2], d[2] - d[0]};
    for (int q = 0; q < 4; q++) {
        out->base[q] = base[q];
        out->f1[q] = f1[q] * out->inverse_area;
        out->f2[q] = f2[q] * out->inverse_area;
        out->quantity[q] = combine_planes4(base[q], out->f1[q], out->f2[q], out->e1, out->e2);
    }
    // Terms of the sums are below extent² · the largest w / A, and the smallest S is the smallest w. The ratio of the
    // two is how many bits cancel; 53 − 20 are more than the 24 + 6 that the bound needs.
    const f64x4 width = f64x4_abs(t->x1) + f64x4_abs(t->x2), height = f64x4_abs(t->y1) + f64x4_abs(t->y2);
    const f64x4 most = f64x4_max(f64x4_max(w[0], w[1]), w[2]), least = f64x4_min(f64x4_min(w[0], w[1]), w[2]);
    out->is_exact = f64x4_less(f64x4_splat(0x1p20) * least,
                               (width + pixel) * (height + pixel) * out->inverse_area * most);
}

RHW_INLINE struct plane plane_of_lane(const struct plane4 *p, int lane)
{
    return (struct plane){p->at[lane], p->dx[lane], p->dy[lane]};
}

// Make the factors of one triangle that stands in all lanes.
static __attribute__((noinline)) void setup_factors(struct edge_factors *f, const struct setup_input4 *t)
{
    struct setup_output4 out;
    setup_planes4(&out, t);
    f->e1 = plane_of_lane(&out.e1, 0);
    f->e2 = plane_of_lane(&out.e2, 0);
    for (int q = 0; q < 4; q++) {
        f->base[q] = out.base[q][0];
        f->f1[q] = out.f1[q][0];
        f->f2[q] = out.f2[q][0];
    }
    f->area = out.area[0];
    f->inverse_area = out.inverse_area[0];
}

#endif
