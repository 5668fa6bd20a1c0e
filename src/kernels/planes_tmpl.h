// SPDX-License-Identifier: MIT
// The quantities that are linear on the screen, and the weights made from them. Template: compiled once per
// instruction set.
//
// With the exact edge functions e_i of the snapped triangle, A their sum (twice the area) and w_i = 1/W_i:
//
//     S = 1/W = (e_0·w_0 + e_1·w_1 + e_2·w_2) / A,     b = (e_1·w_1 / A) / S,     c = (e_2·w_2 / A) / S,
//     s = e_1 / A,    t = e_2 / A,                     Z/W = d_0 + e_1·(d_1 − d_0)/A + e_2·(d_2 − d_0)/A.
//
// All in double, each rounded once to float at the end: b and c, the only weights that interpolation needs
// (an attribute is I_0 − (b·(I_0 − I_1) + c·(I_0 − I_2)), which keeps even a constant −0), carry half an ULP
// of float and nothing else worth counting. docs/exactness.md adds up what follows.
//
// A linear quantity is evaluated as column + row, relative to a pixel that moves with the triangle, so that
// moving it by whole pixels changes no bit. For slivers and extreme ratios of W those sums would cancel;
// such triangles (`exact`) take their e_i as exact integers per pixel and combine after that.

#include "scratch.h"
#include "raster/double_double.h"

struct plane {
    double at, dx, dy; // value at the anchor's centre; change per pixel
};

// The four that every fragment needs stand side by side in one vector, so that a triangle is set up once for all
// of them.
enum quantity { QUANTITY_S, QUANTITY_B, QUANTITY_C, QUANTITY_Z }; // 1/W; b·(1/W); c·(1/W); depth

struct linear {
    d4 at, dx, dy; // by quantity: value at the anchor's centre; change per pixel
};

// Of a snapped triangle: the four quantities are base + f1·e_1 + f2·e_2.
struct factors {
    struct plane e1, e2; // exact integers
    d4 base, f1, f2;
    double area, inverse_area; // the doubled, positive area
};

// A clipped triangle is cut and snapped anew, so its coverage may reach past the triangle by less than 1/256
// pixel. There a weight would be negative and, next to the horizon, 1/W zero: weights below 0 count as 0, and
// the others are divided by what is left. `a` and the vertices' W and depth·W are for these pixels alone. A clipped
// triangle without area has no weights at all: it takes the values of its vertex with the largest W.
struct planes {
    int anchor_x, anchor_y; // pixels
    bool exact;
    struct linear linear;
    struct plane n1, n2;      // weights on the screen of vertices 1 and 2
    struct factors factors;   // of snapped triangles
    struct plane a;           // (a·1/W), of clipped triangles
    double w[3], zw[3], a_e0; // of clipped triangles
    bool homogeneous;         // a vertex is not snapped
    bool wide;                // weights come from `edge` alone, in wide arithmetic
    struct dd_plane edge[3];
    double edge_scale;        // e_i·edge_scale = a, b, c over W
    struct rhw_slopes slopes; // of snapped triangles by planes_slopes, when they are asked for
};

static struct plane scale(double f, struct plane e)
{
    return (struct plane){f * e.at, f * e.dx, f * e.dy};
}

static double absolute(double v)
{
    return v < 0 ? -v : v;
}

// What only clipped triangles need.
static void planes_vertices(struct planes *p, const struct rhw_draw_state *state,
                            const struct rhw_vertex_record *const v[3])
{
    for (int i = 0; i < 3; i++) {
        p->w[i] = (double)v[i]->position[3];
        p->zw[i] = state->depth_low * p->w[i] + state->depth_span * (double)v[i]->position[2];
    }
}

static int nearest_vertex(const struct planes *p)
{
    return p->w[0] >= p->w[1] && p->w[0] >= p->w[2] ? 0 : p->w[1] >= p->w[2] ? 1 : 2;
}

// Of clipped triangles without area.
static void planes_without_area(struct planes *p)
{
    p->wide = true;
    p->edge_scale = 1 / p->w[nearest_vertex(p)];
    memset(p->edge, 0, sizeof p->edge);
    p->edge[nearest_vertex(p)].at.hi = 1;
    p->slopes = (struct rhw_slopes){d4_splat(0), d4_splat(0)};
}

RHW_INLINE struct plane linear_plane(const struct linear *linear, enum quantity q)
{
    return (struct plane){linear->at[q], linear->dx[q], linear->dy[q]};
}

static double least(double a, double b)
{
    return a < b ? a : b;
}

static double most(double a, double b)
{
    return a > b ? a : b;
}

// What every snapped triangle needs; false where its numbers must be made of exact integers, pixel by pixel. The anchor
// is the pixel of vertex 0.
RHW_INLINE bool planes_linear(struct planes *p, const struct rhw_draw_state *state,
                              const struct rhw_triangle *t, const struct rhw_vertex_record *const v[3])
{
    struct factors *const f = &p->factors;
    p->homogeneous = p->wide = false;
    p->anchor_x = t->x_24_8[0] >> RHW_SUBPIXEL_BITS;
    p->anchor_y = t->y_24_8[0] >> RHW_SUBPIXEL_BITS;
    const i4 x = i4_load(t->x_24_8), y = i4_load(t->y_24_8); // the fourth of each is another member
    const i4 corner = __builtin_shufflevector(x, y, 0, 0, 4, 4);
    const d4 turned = d4_from_i4(__builtin_shufflevector(x, y, 1, 2, 5, 6) - corner); // x1, x2, y1, y2
    const double signed_area = turned[0] * turned[3] - turned[1] * turned[2], sign = signed_area < 0 ? -1 : 1;
    const d4 side = turned * d4_splat(sign);
    f->area = sign * signed_area;
    // Edges 2 → 0 and 0 → 1 at the anchor's centre, seen from vertex 0; exact (constants.h).
    const double px = RHW_SUBPIXEL / 2 - (t->x_24_8[0] & (RHW_SUBPIXEL - 1));
    const double py = RHW_SUBPIXEL / 2 - (t->y_24_8[0] & (RHW_SUBPIXEL - 1));
    f->e1 = (struct plane){side[3] * px - side[1] * py, side[3] * RHW_SUBPIXEL, -side[1] * RHW_SUBPIXEL};
    f->e2 = (struct plane){side[0] * py - side[2] * px, -side[2] * RHW_SUBPIXEL, side[0] * RHW_SUBPIXEL};
    const d4 below = {(double)v[0]->position[3], (double)v[1]->position[3], (double)v[2]->position[3],
                      f->area};
    const d4 above = {(double)v[0]->position[2], (double)v[1]->position[2], (double)v[2]->position[2], 0};
    const d4 w = d4_splat(1) / below; // and one over the area
    const d4 d = d4_splat(state->depth_low) + d4_splat(state->depth_span) * (above / below);
    f->inverse_area = w[3];
    f->base = d4_keep(__builtin_shufflevector(w, d, 0, 0, 0, 4), (l4){-1, 0, 0, -1});
    f->f1 =
        (d4_keep(__builtin_shufflevector(w, d, 1, 1, 1, 5), (l4){-1, -1, 0, -1}) - f->base) * d4_splat(w[3]);
    f->f2 =
        (d4_keep(__builtin_shufflevector(w, d, 2, 2, 2, 6), (l4){-1, 0, -1, -1}) - f->base) * d4_splat(w[3]);
    p->linear.at = f->base + (f->f1 * d4_splat(f->e1.at) + f->f2 * d4_splat(f->e2.at));
    p->linear.dx = f->f1 * d4_splat(f->e1.dx) + f->f2 * d4_splat(f->e2.dx);
    p->linear.dy = f->f1 * d4_splat(f->e1.dy) + f->f2 * d4_splat(f->e2.dy);
    // Terms of the sums are below extent² · the largest w / A; the smallest S is the smallest w. Their ratio
    // is how many bits cancel; 53 − 20 are more than the 24 + 6 that the bound needs.
    const double width = absolute(side[0]) + absolute(side[1]),
                 height = absolute(side[2]) + absolute(side[3]);
    return (width + RHW_SUBPIXEL) * (height + RHW_SUBPIXEL) * w[3] * most(most(w[0], w[1]), w[2]) <=
           0x1p20 * least(least(w[0], w[1]), w[2]);
}

// The edge function of vertex 0: what the others leave of the area; exact.
static struct plane edge_0(const struct factors *f)
{
    return (struct plane){f->area - f->e1.at - f->e2.at, -(f->e1.dx + f->e2.dx), -(f->e1.dy + f->e2.dy)};
}

static void planes_snapped(struct planes *p, const struct rhw_draw_state *state, const struct rhw_triangle *t,
                           const struct rhw_vertex_record *const v[3])
{
    const struct factors *const f = &p->factors;
    p->exact = !planes_linear(p, state, t, v);
    p->n1 = scale(f->inverse_area, f->e1);
    p->n2 = scale(f->inverse_area, f->e2);
    if (t->flags & RHW_TRIANGLE_POLYGON) {
        planes_vertices(p, state, v);
        p->a_e0 = f->base[QUANTITY_S] * f->inverse_area;
        p->a = scale(p->a_e0, edge_0(f));
        if (f->area == 0) {
            planes_without_area(p);
        }
    }
}

// The four quantities from the weights over W.
static d4 linear_of(const struct planes *p, double a, double b, double c)
{
    return (d4){a + b + c, b, c, a * p->zw[0] + b * p->zw[1] + c * p->zw[2]};
}

// A vertex could not be snapped: the truth is the homogeneous triangle itself. With M whose columns are the
// vertices as (x, y, w), in pixels times W, (a, b, c)/W = M^-1 · (x_P, y_P, 1); rows of the adjugate of M are edges
// (Olano and Greer 1997, Triangle Scan Conversion using 2D Homogeneous Coordinates, §4).
static void planes_homogeneous(struct planes *p, const struct rhw_draw_state *state,
                               const struct rhw_vertex_record *const v[3])
{
    *p = (struct planes){.homogeneous = true};
    // Relative to the viewport's centre, where clip coordinates are as precise as they came.
    p->anchor_x = (int)state->center_x;
    p->anchor_y = (int)state->center_y;
    const double half_width = state->half_width, half_height = state->half_height;
    const double cx = state->center_x - (p->anchor_x + 0.5), cy = state->center_y - (p->anchor_y + 0.5);
    double corner[3][3], m[3][3]; // X, Y, W; x, y, w
    for (int i = 0; i < 3; i++) {
        corner[i][0] = (double)v[i]->position[0];
        corner[i][1] = (double)v[i]->position[1];
        corner[i][2] = m[i][2] = (double)v[i]->position[3];
        m[i][0] = corner[i][0] * half_width + m[i][2] * cx;
        m[i][1] = m[i][2] * cy - corner[i][1] * half_height;
    }
    planes_vertices(p, state, v);
    const struct dd determinant = dd_determinant(corner);
    if (determinant.hi == 0) {
        planes_without_area(p);
        return;
    }
    const double inverse =
        1 / (-(half_width * half_height) * determinant.hi); // the map to pixels turns y over
    struct plane row[3];
    double size = 0;
    for (int i = 0; i < 3; i++) {
        const struct dd_plane *const e = &p->edge[i];
        p->edge[i] =
            dd_edge(corner[i == 2 ? 0 : i + 1], corner[i == 0 ? 2 : i - 1], half_width, half_height, cx, cy);
        row[i] = scale(inverse, (struct plane){e->at.hi, e->dx.hi, e->dy.hi});
        size += absolute(row[i].at) + absolute(row[i].dx) * (half_width + 1) +
                absolute(row[i].dy) * (half_height + 1);
    }
    // Terms of the sums over the least 1/W: how much cancels, see planes_linear.
    p->wide = size * p->w[nearest_vertex(p)] > 0x1p22;
    p->edge_scale = inverse;
    p->a = row[0];
    p->linear = (struct linear){linear_of(p, row[0].at, row[1].at, row[2].at),
                                linear_of(p, row[0].dx, row[1].dx, row[2].dx),
                                linear_of(p, row[0].dy, row[1].dy, row[2].dy)};
    p->n1 = scale(p->w[1], row[1]);
    p->n2 = scale(p->w[2], row[2]);
    // q_x·S − q·S_x with q = b, S = a + b + c, where (b_x·a − b·a_x) and the like are vertices over the determinant.
    const d4 over = d4_splat(inverse);
    p->slopes.at = over * (d4){m[2][1] - m[0][1], m[0][0] - m[2][0], m[0][1] - m[1][1], m[1][0] - m[0][0]};
    p->slopes.step = over * (d4){m[0][2] - m[2][2], m[2][2] - m[0][2], m[1][2] - m[0][2], m[0][2] - m[1][2]};
}

// A plane over a block of 8×8 pixels: value = column + row. Made once per block, so that a row of 8 pixels
// costs one addition, and always by these operations, so that no bit depends on the road taken.
struct block_plane {
    d8 column;
    double row[RHW_BLOCK];
};

// Which block, relative to the anchor: dx of the columns, dy of the rows; pixels. Or which 8 pixels: dx and dy of each.
struct block_place {
    d8 dx, dy;
};

RHW_INLINE void plane_columns(struct block_plane *out, const struct plane *plane, d8 dx)
{
    out->column = d8_mul(d8_splat(plane->dx), dx);
}

RHW_INLINE void plane_rows(struct block_plane *out, const struct plane *plane, d8 dy)
{
    const d8 row = d8_add(d8_splat(plane->at), d8_mul(d8_splat(plane->dy), dy));
    memcpy(out->row, &row, sizeof out->row);
}

RHW_INLINE void plane_over(struct block_plane *out, const struct plane *plane, const struct block_place *at)
{
    plane_columns(out, plane, at->dx);
    plane_rows(out, plane, at->dy);
}

RHW_INLINE d8 plane_row(const struct block_plane *plane, int row)
{
    return d8_add(plane->column, d8_splat(plane->row[row]));
}

// The same for 8 pixels anywhere.
RHW_INLINE d8 plane_lanes(const struct linear *linear, enum quantity q, const struct block_place *at)
{
    const d8 row = d8_add(d8_splat(linear->at[q]), d8_mul(d8_splat(linear->dy[q]), at->dy));
    return d8_add(d8_mul(d8_splat(linear->dx[q]), at->dx), row);
}

RHW_INLINE d8 combine_rows(const struct planes *p, enum quantity q, d8 e1, d8 e2)
{
    return d8_add(d8_splat(p->factors.base[q]),
                  d8_add(d8_mul(d8_splat(p->factors.f1[q]), e1), d8_mul(d8_splat(p->factors.f2[q]), e2)));
}

// What a block needs of a triangle's planes. Which members are set: z by block_depth; s, b, c by block_weights, or by
// weight_rows and weight_columns; n1, n2 by block_screen_weights; e1, e2 instead of all of them when the planes are
// exact.
struct block_planes {
    struct block_plane z, s, b, c, n1, n2, e1, e2;
    double inverse_s[RHW_BLOCK]; // by row, with WEIGH_LEVEL
};

// How the weights of a row are found; a constant where a call names it.
enum weighing {
    WEIGH_LANES,  // a division in every lane
    WEIGH_LEVEL,  // 1/W is the same along a row, so that one division serves all its lanes with the same bits
    WEIGH_EXACTLY // from exact integers: the planes are `exact`
};

// A floor under a camera that is not rolled is level, and whatever is drawn without perspective.
RHW_INLINE enum weighing weighing_of(const struct planes *p)
{
    if (__builtin_expect(p->exact, 0)) {
        return WEIGH_EXACTLY;
    }
    return p->linear.dx[QUANTITY_S] == 0 ? WEIGH_LEVEL : WEIGH_LANES;
}

RHW_INLINE void block_depth(struct block_planes *block, const struct planes *p, const struct block_place *at)
{
    if (__builtin_expect(p->exact, 0)) {
        plane_over(&block->e1, &p->factors.e1, at);
        plane_over(&block->e2, &p->factors.e2, at);
    } else {
        const struct plane z = linear_plane(&p->linear, QUANTITY_Z);
        plane_over(&block->z, &z, at);
    }
}

// The parts of the three planes for the weights that depend on the row and on the column; not of `exact` ones.
RHW_INLINE void weight_rows(struct block_planes *block, const struct planes *p, d8 dy, enum weighing how)
{
    const struct plane s = linear_plane(&p->linear, QUANTITY_S), b = linear_plane(&p->linear, QUANTITY_B),
                       c = linear_plane(&p->linear, QUANTITY_C);
    plane_rows(&block->s, &s, dy);
    plane_rows(&block->b, &b, dy);
    plane_rows(&block->c, &c, dy);
    if (how == WEIGH_LEVEL) {
        d8 row;
        memcpy(&row, block->s.row, sizeof row);
        row = d8_div(d8_splat(1), row);
        memcpy(block->inverse_s, &row, sizeof row);
    }
}

RHW_INLINE void weight_columns(struct block_planes *block, const struct planes *p, d8 dx)
{
    const struct plane s = linear_plane(&p->linear, QUANTITY_S), b = linear_plane(&p->linear, QUANTITY_B),
                       c = linear_plane(&p->linear, QUANTITY_C);
    plane_columns(&block->s, &s, dx);
    plane_columns(&block->b, &b, dx);
    plane_columns(&block->c, &c, dx);
}

RHW_INLINE void block_weights(struct block_planes *block, const struct planes *p,
                              const struct block_place *at, enum weighing how)
{
    if (how == WEIGH_EXACTLY) {
        plane_over(&block->e1, &p->factors.e1, at);
        plane_over(&block->e2, &p->factors.e2, at);
    } else {
        weight_rows(block, p, at->dy, how);
        weight_columns(block, p, at->dx);
    }
}

RHW_INLINE void block_screen_weights(struct block_planes *block, const struct planes *p,
                                     const struct block_place *at)
{
    if (__builtin_expect(p->exact, 0)) {
        plane_over(&block->e1, &p->factors.e1, at);
        plane_over(&block->e2, &p->factors.e2, at);
    } else {
        plane_over(&block->n1, &p->n1, at);
        plane_over(&block->n2, &p->n2, at);
    }
}

RHW_INLINE f8 depth_row(const struct planes *p, const struct block_planes *block, int row)
{
    if (__builtin_expect(p->exact, 0)) {
        return f8_from_d8(
            combine_rows(p, QUANTITY_Z, plane_row(&block->e1, row), plane_row(&block->e2, row)));
    }
    return f8_from_d8(plane_row(&block->z, row));
}

// 1/W and the perspective weights of vertices 1 and 2.
struct weights {
    f8 b, c;
    d8 s, inverse_s;
};

RHW_INLINE struct weights weights_of(d8 s, d8 inverse, d8 b, d8 c)
{
    return (struct weights){f8_from_d8(d8_mul(b, inverse)), f8_from_d8(d8_mul(c, inverse)), s, inverse};
}

RHW_INLINE struct weights weights_row(const struct planes *p, const struct block_planes *block, int row,
                                      enum weighing how)
{
    d8 s, b, c;
    if (how == WEIGH_EXACTLY) {
        const d8 e1 = plane_row(&block->e1, row), e2 = plane_row(&block->e2, row);
        s = combine_rows(p, QUANTITY_S, e1, e2);
        b = d8_mul(d8_splat(p->factors.f1[QUANTITY_B]), e1);
        c = d8_mul(d8_splat(p->factors.f2[QUANTITY_C]), e2);
    } else {
        s = plane_row(&block->s, row);
        b = plane_row(&block->b, row);
        c = plane_row(&block->c, row);
    }
    const d8 inverse = how == WEIGH_LEVEL ? d8_splat(block->inverse_s[row]) : d8_div(d8_splat(1), s);
    return weights_of(s, inverse, b, c);
}

// The same for 8 pixels anywhere, of planes that are not `exact`.
RHW_INLINE struct weights weights_lanes(const struct linear *linear, const struct block_place *at)
{
    const d8 s = plane_lanes(linear, QUANTITY_S, at);
    return weights_of(s, d8_div(d8_splat(1), s), plane_lanes(linear, QUANTITY_B, at),
                      plane_lanes(linear, QUANTITY_C, at));
}

// Weights on the screen of vertices 1 and 2.
RHW_INLINE void screen_weights_row(const struct planes *p, const struct block_planes *block, int row, d8 *s,
                                   d8 *t)
{
    if (__builtin_expect(p->exact, 0)) {
        *s = d8_mul(d8_splat(p->factors.inverse_area), plane_row(&block->e1, row));
        *t = d8_mul(d8_splat(p->factors.inverse_area), plane_row(&block->e2, row));
        return;
    }
    *s = plane_row(&block->n1, row);
    *t = plane_row(&block->n2, row);
}

// Whether some pixel of a block of a clipped triangle may have a weight below 0: a plane is least in a corner.
static bool block_is_cut(const struct planes *p, const struct block_place *at)
{
    const struct plane planes[3] = {p->a, linear_plane(&p->linear, QUANTITY_B),
                                    linear_plane(&p->linear, QUANTITY_C)};
    bool cut = p->exact || p->wide;
    for (int i = 0; i < 3; i++) {
        const double corner = planes[i].at + planes[i].dx * at->dx.lo[0] + planes[i].dy * at->dy.lo[0];
        const double dx = planes[i].dx * (RHW_BLOCK - 1), dy = planes[i].dy * (RHW_BLOCK - 1);
        cut = cut || !(corner + (dx < 0 ? dx : 0) + (dy < 0 ? dy : 0) >= 0);
    }
    return cut;
}

// The values of a row in the lanes where a weight is below 0, and of `wide` planes in all; see struct planes.
struct cut_row {
    i8 lanes;
    f8 z;
    d8 n1, n2;
    struct weights weights;
};

// A weight of −0 becomes 0 as well: two of them would turn a constant −0 into 0.
static d8 at_least_zero(d8 v, l4 below[2])
{
    const d4 zero = d4_splat(0);
    below[0] |= d4_less(v.lo, zero);
    below[1] |= d4_less(v.hi, zero);
    return (d8){d4_keep(v.lo, d4_less(zero, v.lo)), d4_keep(v.hi, d4_less(zero, v.hi))};
}

static d8 weigh(const double f[3], d8 a, d8 b, d8 c)
{
    return d8_add(d8_add(d8_mul(d8_splat(f[0]), a), d8_mul(d8_splat(f[1]), b)), d8_mul(d8_splat(f[2]), c));
}

static d8 d8_where(const l4 mask[2], d8 a, d8 b)
{
    return (d8){d4_select(mask[0], a.lo, b.lo), d4_select(mask[1], a.hi, b.hi)};
}

// The first row of a block.
static d8 plane_at(struct plane plane, const struct block_place *at)
{
    struct block_plane over;
    plane_over(&over, &plane, at);
    return plane_row(&over, 0);
}

static __attribute__((noinline)) void cut_row(const struct planes *p, const struct block_place *place,
                                              int row, struct cut_row *out)
{
    double dy[RHW_BLOCK];
    memcpy(dy, &place->dy, sizeof dy);
    const struct block_place at = {place->dx, d8_splat(dy[row])};
    d8 a, b, c;
    l4 below[2] = {{0}, {0}};
    if (p->wide) {
        a = d8_mul(dd_row(&p->edge[0], at.dx, dy[row]), d8_splat(p->edge_scale));
        b = d8_mul(dd_row(&p->edge[1], at.dx, dy[row]), d8_splat(p->edge_scale));
        c = d8_mul(dd_row(&p->edge[2], at.dx, dy[row]), d8_splat(p->edge_scale));
        below[0] = below[1] = (l4){-1, -1, -1, -1};
    } else if (p->exact) { // integers: e_0 is what e_1 and e_2 leave of the area
        const d8 e1 = plane_at(p->factors.e1, &at), e2 = plane_at(p->factors.e2, &at);
        a = d8_mul(d8_splat(p->a_e0), d8_sub(d8_sub(d8_splat(p->factors.area), e1), e2));
        b = d8_mul(d8_splat(p->factors.f1[QUANTITY_B]), e1);
        c = d8_mul(d8_splat(p->factors.f2[QUANTITY_C]), e2);
    } else {
        a = plane_at(p->a, &at);
        b = plane_at(linear_plane(&p->linear, QUANTITY_B), &at);
        c = plane_at(linear_plane(&p->linear, QUANTITY_C), &at);
    }
    a = at_least_zero(a, below);
    b = at_least_zero(b, below);
    c = at_least_zero(c, below);
    const d8 sum = d8_add(d8_add(a, b), c), inverse = d8_div(d8_splat(1), sum);
    const d8 w = weigh(p->w, a, b, c), screen = d8_div(d8_splat(1), w);
    // The triangle's border may be at or behind the eye here (w <= 0; then the planes are homogeneous and not
    // `exact`): what is linear on the screen goes on linearly, 1/W down to the least that the triangle has.
    const l4 seen[2] = {d4_less(d4_splat(0), w.lo), d4_less(d4_splat(0), w.hi)};
    const d8 least =
        d8_clamp(plane_at(linear_plane(&p->linear, QUANTITY_S), &at), 1 / p->w[nearest_vertex(p)], 0x1p1000);
    out->lanes = (i8){(int32_t)below[0][0], (int32_t)below[0][1], (int32_t)below[0][2], (int32_t)below[0][3],
                      (int32_t)below[1][0], (int32_t)below[1][1], (int32_t)below[1][2], (int32_t)below[1][3]};
    out->z = f8_from_d8(d8_where(seen, d8_mul(weigh(p->zw, a, b, c), screen),
                                 plane_at(linear_plane(&p->linear, QUANTITY_Z), &at)));
    out->n1 = d8_where(seen, d8_mul(d8_mul(d8_splat(p->w[1]), b), screen), plane_at(p->n1, &at));
    out->n2 = d8_where(seen, d8_mul(d8_mul(d8_splat(p->w[2]), c), screen), plane_at(p->n2, &at));
    out->weights = (struct weights){f8_from_d8(d8_mul(b, inverse)), f8_from_d8(d8_mul(c, inverse)),
                                    d8_where(seen, d8_mul(sum, screen), least), inverse};
}

static d8 d8_select(i8 mask, d8 a, d8 b)
{
    for (int i = 0; i < 4; i++) {
        b.lo[i] = mask[i] ? a.lo[i] : b.lo[i];
        b.hi[i] = mask[i + 4] ? a.hi[i] : b.hi[i];
    }
    return b;
}

static struct weights cut_weights(const struct cut_row *cut, struct weights w)
{
    return (struct weights){f8_select(cut->lanes, cut->weights.b, w.b),
                            f8_select(cut->lanes, cut->weights.c, w.c),
                            d8_select(cut->lanes, cut->weights.s, w.s),
                            d8_select(cut->lanes, cut->weights.inverse_s, w.inverse_s)};
}

// Sets the slopes, which planes_homogeneous sets itself: the numerators of d(q/S)/dx = (q_x·S − q·S_x)/S² and
// d(q/S)/dy, which are linear; the one does not depend on x, the other not on y. No cancellation per pixel. With T =
// e_0·w_0 + e_1·w_1 + e_2·w_2, d(e_1·w_1/T)/dx = w_1·(Σ w_i·(a_1·e_i − a_i·e_1))/T²; a_1·e_0 − a_0·e_1 is 0 at vertex
// 2, does not depend on x, and changes by the area with y, and so on around the triangle: what is left are heights over
// vertices, which are exact.
static void planes_slopes(struct planes *p, const struct rhw_triangle *t,
                          const struct rhw_vertex_record *const v[3])
{
    if (p->homogeneous || p->wide) {
        return;
    }
    const d4 w = d4_splat(1) /
                 (d4){(double)v[0]->position[3], (double)v[1]->position[3], (double)v[2]->position[3], 1};
    const i4 x = i4_load(t->x_24_8), y = i4_load(t->y_24_8); // the fourth of each is another member
    const int32_t anchor_x = p->anchor_x * RHW_SUBPIXEL + RHW_SUBPIXEL / 2,
                  anchor_y = p->anchor_y * RHW_SUBPIXEL + RHW_SUBPIXEL / 2;
    const i4 anchor = {anchor_y, anchor_x, anchor_y, anchor_x};
    // Heights over one of the other two vertices, and over the other.
    const d4 one = d4_from_i4(anchor - __builtin_shufflevector(x, y, 4, 2, 5, 0));
    const d4 other = d4_from_i4(anchor - __builtin_shufflevector(x, y, 6, 0, 4, 1));
    const d4 side =
        d4_from_i4(__builtin_shufflevector(x, y, 1, 2, 5, 6) - __builtin_shufflevector(x, y, 0, 0, 4, 4));
    const double factor = side[0] * side[3] < side[1] * side[2]
                              ? -p->factors.inverse_area
                              : p->factors.inverse_area; // one over the signed area
    const d4 self = __builtin_shufflevector(w, w, 1, 1, 2, 2),
             first = __builtin_shufflevector(w, w, 2, 0, 0, 1),
             second = __builtin_shufflevector(w, w, 0, 2, 1, 0);
    const d4 f = d4_splat(factor) * self * d4_splat(RHW_SUBPIXEL);
    p->slopes.at = f * (first * one - second * other);
    p->slopes.step = f * (first - second) * d4_splat(RHW_SUBPIXEL);
}

// The numerators of smooth components, by the pairs of the pipeline, from those of b and c: a component is
// I_0 + b·(I_1 − I_0) + c·(I_2 − I_0).
RHW_INLINE void component_slopes(const struct rhw_pipeline_data *pipeline, const struct rhw_slopes *weights,
                                 const struct rhw_vertex_record *const v[3], struct rhw_slopes *out)
{
    const d4 at = weights->at, step = weights->step;
    const d4 b_at = __builtin_shufflevector(at, at, 0, 1, 0, 1),
             c_at = __builtin_shufflevector(at, at, 2, 3, 2, 3),
             b_step = __builtin_shufflevector(step, step, 0, 1, 0, 1),
             c_step = __builtin_shufflevector(step, step, 2, 3, 2, 3);
    for (int pair = 0; pair < pipeline->slope_pairs; pair++) {
        const int i = pipeline->slope_component[pair][0], k = pipeline->slope_component[pair][1];
        d4 value[3];
        for (int n = 0; n < 3; n++) {
            const double first = (double)v[n]->varyings[i], second = (double)v[n]->varyings[k];
            value[n] = (d4){first, first, second, second};
        }
        const d4 d1 = value[1] - value[0], d2 = value[2] - value[0];
        out[pair].at = b_at * d1 + c_at * d2;
        out[pair].step = b_step * d1 + c_step * d2;
    }
}

// Per pixel to the right (x) and down (y), of the first (`which` 0) or the second quantity; rounded once.
// `squared`: 1/S².
RHW_INLINE void slope_lanes(const struct rhw_slopes *slopes, int which, d8 dx, d8 dy, d8 squared, f8 *by_x,
                            f8 *by_y)
{
    const int x = 2 * which, y = x + 1;
    const d8 along_x = d8_add(d8_splat(slopes->at[x]), d8_mul(d8_splat(slopes->step[x]), dy));
    const d8 along_y = d8_add(d8_splat(slopes->at[y]), d8_mul(d8_splat(slopes->step[y]), dx));
    *by_x = f8_from_d8(d8_mul(along_x, squared));
    *by_y = f8_from_d8(d8_mul(along_y, squared));
}
