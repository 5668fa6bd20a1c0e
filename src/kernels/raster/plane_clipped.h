// SPDX-License-Identifier: MIT
// Planes of clipped triangles. A clipped triangle keeps its three vertices: its values are the values of the whole
// triangle.
//
// A clipped triangle is cut and snapped anew, so its coverage may reach past the triangle by less than 1/256 pixel.
// There a weight would be negative and, next to the horizon, 1/W zero: weights below 0 count as 0, and the others are
// divided by what is left. A clipped triangle without area has no weights at all: it takes the values of its vertex
// with the largest W.
//
// If a vertex could not be snapped, the truth is the homogeneous triangle itself. M is the matrix whose columns are the
// vertices as (x, y, w), in pixels times W. With it (a, b, c)/W = M^-1 · (x_P, y_P, 1), and the rows of the adjugate of
// M are edges (Olano and Greer 1997, Triangle Scan Conversion using 2D Homogeneous Coordinates, §4).
#ifndef RHW_PLANE_CLIPPED_H
#define RHW_PLANE_CLIPPED_H

#include "draw/draw_list.h"
#include "double_double.h"
#include "plane.h"
#include "sample_position.h"

struct clipped_planes {
    struct plane a;     // a·(1/W)
    double w[3], zw[3]; // W of the vertices, and their depth times W
    double a_e0;        // factor of exact planes: a·(1/W) is a_e0·e_0
    // PLANES_DOUBLE_DOUBLE has edges: edge_scale·edge[i] are a, b, c over W.
    struct dd_plane edge[3];
    double edge_scale;
};

static void clipped_vertices(struct clipped_planes *c, const struct rhw_draw_state *state,
                             const struct rhw_vertex_record *const v[3])
{
    for (int i = 0; i < 3; i++) {
        c->w[i] = (double)v[i]->position[3];
        c->zw[i] = state->depth_low * c->w[i] + state->depth_span * (double)v[i]->position[2];
    }
}

static int nearest_vertex(const struct clipped_planes *c)
{
    return c->w[0] >= c->w[1] && c->w[0] >= c->w[2] ? 0 : c->w[1] >= c->w[2] ? 1 : 2;
}

static void planes_without_area(struct planes *p, struct clipped_planes *c)
{
    const int nearest = nearest_vertex(c);
    p->kind = PLANES_DOUBLE_DOUBLE;
    p->weights = (struct derivative_pair){f64x4_splat(0), f64x4_splat(0)};
    c->edge_scale = 1 / c->w[nearest];
    memset(c->edge, 0, sizeof c->edge);
    c->edge[nearest].at.hi = 1;
}

// Set what clipping adds to the planes of a snapped triangle, whose `factors` are set.
static void planes_clipped_snapped(struct planes *p, struct clipped_planes *c,
                                   const struct rhw_draw_state *state,
                                   const struct rhw_vertex_record *const v[3])
{
    const struct edge_factors *const f = &p->factors;
    // The edge function of vertex 0 is what the other two leave of the area; it is exact.
    const struct plane e0 = {f->area - f->e1.at - f->e2.at, -(f->e1.dx + f->e2.dx), -(f->e1.dy + f->e2.dy)};
    clipped_vertices(c, state, v);
    c->a_e0 = f->base[QUANTITY_S] * f->inverse_area;
    c->a = plane_scale(c->a_e0, e0);
    if (f->area == 0) {
        planes_without_area(p, c);
    }
}

// Return the four quantities made from the weights over W.
static f64x4 quantities_of(const struct clipped_planes *v, double a, double b, double c)
{
    return (f64x4){a + b + c, b, c, a * v->zw[0] + b * v->zw[1] + c * v->zw[2]};
}

static double magnitude(double v)
{
    return v < 0 ? -v : v;
}

// Set the planes of a triangle with a vertex that could not be snapped.
static void planes_homogeneous(struct planes *p, struct clipped_planes *c, const struct rhw_draw_state *state,
                               const struct rhw_vertex_record *const v[3])
{
    *p = (struct planes){.is_homogeneous = true};
    *c = (struct clipped_planes){0};
    // The anchor is the viewport's centre, where clip coordinates are as precise as they came.
    p->anchor_x = (int)state->center_x;
    p->anchor_y = (int)state->center_y;
    const double half_width = state->half_width, half_height = state->half_height;
    const double cx = state->center_x - (p->anchor_x + sample_offset()),
                 cy = state->center_y - (p->anchor_y + sample_offset());
    double vertex[3][3], m[3][3]; // rows of X, Y, W; rows of x, y, w
    for (int i = 0; i < 3; i++) {
        vertex[i][0] = (double)v[i]->position[0];
        vertex[i][1] = (double)v[i]->position[1];
        vertex[i][2] = m[i][2] = (double)v[i]->position[3];
        m[i][0] = vertex[i][0] * half_width + m[i][2] * cx;
        m[i][1] = m[i][2] * cy - vertex[i][1] * half_height;
    }
    clipped_vertices(c, state, v);
    const struct dd determinant = dd_determinant(vertex);
    if (determinant.hi == 0) {
        planes_without_area(p, c);
        return;
    }
    // The map to pixels turns y over. With a negative height it does not.
    const double inverse = 1 / (-(half_width * half_height) * determinant.hi);
    struct plane row[3];
    double size = 0;
    for (int i = 0; i < 3; i++) {
        const struct dd_plane *const e = &c->edge[i];
        c->edge[i] =
            dd_edge(vertex[i == 2 ? 0 : i + 1], vertex[i == 0 ? 2 : i - 1], half_width, half_height, cx, cy);
        row[i] = plane_scale(inverse, (struct plane){e->at.hi, e->dx.hi, e->dy.hi});
        size += magnitude(row[i].at) + magnitude(row[i].dx) * (half_width + 1) +
                magnitude(row[i].dy) * (magnitude(half_height) + 1);
    }
    // Terms of the sums over the least 1/W tell how much cancels: see setup_planes4.
    p->kind = size * c->w[nearest_vertex(c)] > 0x1p22 ? PLANES_DOUBLE_DOUBLE : PLANES_LINEAR;
    c->edge_scale = inverse;
    c->a = row[0];
    p->quantities = (struct quantity_planes){quantities_of(c, row[0].at, row[1].at, row[2].at),
                                             quantities_of(c, row[0].dx, row[1].dx, row[2].dx),
                                             quantities_of(c, row[0].dy, row[1].dy, row[2].dy)};
    p->n1 = plane_scale(c->w[1], row[1]);
    p->n2 = plane_scale(c->w[2], row[2]);
    // The numerators are q_x·S − q·S_x with q = b and S = a + b + c, where (b_x·a − b·a_x) and its like are vertices
    // over the determinant.
    const f64x4 over = f64x4_splat(inverse);
    p->weights.at =
        over * (f64x4){m[2][1] - m[0][1], m[0][0] - m[2][0], m[0][1] - m[1][1], m[1][0] - m[0][0]};
    p->weights.step =
        over * (f64x4){m[0][2] - m[2][2], m[2][2] - m[0][2], m[1][2] - m[0][2], m[0][2] - m[1][2]};
}

// Return true if some pixel of a block may have a weight below 0. A plane is least in a corner, and its rounded values
// nowhere fall below the rounded value in that corner.
static bool block_leaves_triangle(const struct planes *p, const struct clipped_planes *c,
                                  const struct anchor_offset *at)
{
    const struct plane planes[3] = {c->a, plane_of(&p->quantities, QUANTITY_B),
                                    plane_of(&p->quantities, QUANTITY_C)};
    bool leaves = p->kind != PLANES_LINEAR;
    for (int i = 0; i < 3; i++) {
        const double dx = planes[i].dx < 0 ? at->dx.hi[3] : at->dx.lo[0];
        const double dy = planes[i].dy < 0 ? at->dy.hi[3] : at->dy.lo[0];
        leaves = leaves || !(plane_value(planes[i], dx, dy) >= 0);
    }
    return leaves;
}

// The values of a row in the lanes where a weight is below 0. With PLANES_DOUBLE_DOUBLE all lanes have them.
struct clipped_row {
    i32x8 lanes;
    f32x8 z;
    struct screen_weights screen;
    struct weights weights;
};

// Return the weights with 0 in place of those below 0; `below` collects where they were. −0 becomes 0 as well: two of
// them would turn a constant −0 into 0.
static f64x8 at_least_zero(f64x8 v, i64x4 below[2])
{
    const f64x4 zero = f64x4_splat(0);
    below[0] |= f64x4_less(v.lo, zero);
    below[1] |= f64x4_less(v.hi, zero);
    return (f64x8){f64x4_keep(v.lo, f64x4_less(zero, v.lo)), f64x4_keep(v.hi, f64x4_less(zero, v.hi))};
}

static f64x8 weigh(const double f[3], const f64x8 over_w[3])
{
    return f64x8_add(
        f64x8_add(f64x8_mul(f64x8_splat(f[0]), over_w[0]), f64x8_mul(f64x8_splat(f[1]), over_w[1])),
        f64x8_mul(f64x8_splat(f[2]), over_w[2]));
}

static f64x8 f64x8_where(const i64x4 mask[2], f64x8 a, f64x8 b)
{
    return (f64x8){f64x4_select(mask[0], a.lo, b.lo), f64x4_select(mask[1], a.hi, b.hi)};
}

// Set the weights over W of a row, negative ones included.
static void weights_over_w(const struct planes *p, const struct clipped_planes *c, f64x8 dx, double dy,
                           f64x8 over_w[3])
{
    const f64x8 row = f64x8_splat(dy);
    if (p->kind == PLANES_DOUBLE_DOUBLE) {
        for (int i = 0; i < 3; i++) {
            over_w[i] = f64x8_mul(dd_row(&c->edge[i], dx, dy), f64x8_splat(c->edge_scale));
        }
    } else if (p->kind == PLANES_EXACT) { // exact integers: e_0 is what e_1 and e_2 leave of the area
        const struct edge_factors *const f = &p->factors;
        const f64x8 e1 = plane_value8(f->e1, dx, row), e2 = plane_value8(f->e2, dx, row);
        over_w[0] = f64x8_mul(f64x8_splat(c->a_e0), f64x8_sub(f64x8_sub(f64x8_splat(f->area), e1), e2));
        over_w[1] = f64x8_mul(f64x8_splat(f->f1[QUANTITY_B]), e1);
        over_w[2] = f64x8_mul(f64x8_splat(f->f2[QUANTITY_C]), e2);
    } else {
        over_w[0] = plane_value8(c->a, dx, row);
        over_w[1] = plane_value8(plane_of(&p->quantities, QUANTITY_B), dx, row);
        over_w[2] = plane_value8(plane_of(&p->quantities, QUANTITY_C), dx, row);
    }
}

// Return true if a row has values of its own in a lane whose bit is set: a weight there is below 0, or −0.
static bool row_leaves_triangle(const struct planes *p, const struct clipped_planes *c,
                                const struct anchor_offset *block, int row, unsigned bits)
{
    double rows[RHW_BLOCK];
    f64x8 over_w[3];
    if (p->kind == PLANES_DOUBLE_DOUBLE) {
        return bits != 0;
    }
    memcpy(rows, &block->dy, sizeof rows);
    weights_over_w(p, c, block->dx, rows[row], over_w);
    const i32x8 signs = (i32x8)f32x8_from_f64x8(over_w[0]) | (i32x8)f32x8_from_f64x8(over_w[1]) |
                        (i32x8)f32x8_from_f64x8(over_w[2]);
    return (i32x8_sign_bits(signs) & bits) != 0;
}

static __attribute__((noinline)) void clipped_row_set(struct clipped_row *out, const struct planes *p,
                                                      const struct clipped_planes *c,
                                                      const struct anchor_offset *block, int row)
{
    double rows[RHW_BLOCK];
    memcpy(rows, &block->dy, sizeof rows);
    const f64x8 dx = block->dx, dy = f64x8_splat(rows[row]);
    i64x4 below[2] = {{0}, {0}};
    f64x8 over_w[3];
    weights_over_w(p, c, dx, rows[row], over_w);
    if (p->kind == PLANES_DOUBLE_DOUBLE) {
        below[0] = below[1] = (i64x4){-1, -1, -1, -1};
    }
    for (int i = 0; i < 3; i++) {
        over_w[i] = at_least_zero(over_w[i], below);
    }
    const f64x8 sum = f64x8_add(f64x8_add(over_w[0], over_w[1]), over_w[2]),
                inverse = f64x8_div(f64x8_splat(1), sum);
    const f64x8 w = weigh(c->w, over_w), screen = f64x8_div(f64x8_splat(1), w);
    // The triangle's border may be at or behind the eye here (w <= 0; then the planes are homogeneous and not exact):
    // what is linear on the screen goes on linearly, and 1/W goes down to the least that the triangle has.
    const i64x4 seen[2] = {f64x4_less(f64x4_splat(0), w.lo), f64x4_less(f64x4_splat(0), w.hi)};
    const f64x8 least = f64x8_clamp(plane_value8(plane_of(&p->quantities, QUANTITY_S), dx, dy),
                                    1 / c->w[nearest_vertex(c)], 0x1p1000);
    const f64x8 b = f64x8_mul(f64x8_splat(c->w[1]), over_w[1]),
                t = f64x8_mul(f64x8_splat(c->w[2]), over_w[2]);
    out->lanes =
        (i32x8){(int32_t)below[0][0], (int32_t)below[0][1], (int32_t)below[0][2], (int32_t)below[0][3],
                (int32_t)below[1][0], (int32_t)below[1][1], (int32_t)below[1][2], (int32_t)below[1][3]};
    out->z = f32x8_from_f64x8(f64x8_where(seen, f64x8_mul(weigh(c->zw, over_w), screen),
                                          plane_value8(plane_of(&p->quantities, QUANTITY_Z), dx, dy)));
    out->screen.s = f64x8_where(seen, f64x8_mul(b, screen), plane_value8(p->n1, dx, dy));
    out->screen.t = f64x8_where(seen, f64x8_mul(t, screen), plane_value8(p->n2, dx, dy));
    out->weights =
        weights_of(f64x8_where(seen, f64x8_mul(sum, screen), least), inverse, over_w[1], over_w[2]);
}

static f64x8 f64x8_select(i32x8 mask, f64x8 a, f64x8 b)
{
    for (int i = 0; i < 4; i++) {
        b.lo[i] = mask[i] ? a.lo[i] : b.lo[i];
        b.hi[i] = mask[i + 4] ? a.hi[i] : b.hi[i];
    }
    return b;
}

// Replace `weights` and `screen` by what the row has, in the lanes that it has.
static void clipped_row_replace(const struct clipped_row *row, struct weights *weights,
                                struct screen_weights *screen)
{
    weights->b = f32x8_select(row->lanes, row->weights.b, weights->b);
    weights->c = f32x8_select(row->lanes, row->weights.c, weights->c);
    weights->s = f64x8_select(row->lanes, row->weights.s, weights->s);
    weights->inverse_s = f64x8_select(row->lanes, row->weights.inverse_s, weights->inverse_s);
    screen->s = f64x8_select(row->lanes, row->screen.s, screen->s);
    screen->t = f64x8_select(row->lanes, row->screen.t, screen->t);
}

#endif
