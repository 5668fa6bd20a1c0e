// SPDX-License-Identifier: MIT
// This file owns planes: quantities that are linear on the screen, their values at pixels, and the weights made from
// them.
//
// With the exact edge functions e_i of the snapped triangle, A their sum (twice the area) and w_i = 1/W_i:
//
//     S = 1/W = (e_0·w_0 + e_1·w_1 + e_2·w_2) / A,     b = (e_1·w_1 / A) / S,     c = (e_2·w_2 / A) / S,
//     s = e_1 / A,    t = e_2 / A,                     Z/W = d_0 + e_1·(d_1 − d_0)/A + e_2·(d_2 − d_0)/A.
//
// All of it is computed in double, and each is rounded once to float at the end: b and c, the only weights that
// interpolation needs, carry half an ULP of float and nothing else worth counting. docs/exactness.md adds up what
// follows.
//
// A plane has one formula: value = column + row with column = dx·Δx and row = at + dy·Δy, where (Δx, Δy) are pixels
// from the anchor. The anchor is a pixel that moves with the triangle, so that moving the triangle by whole pixels
// changes no bit. Every caller that needs a value, for one pixel, for 8, or for four quantities at once, takes it from
// the functions below; thus no bit depends on the path that a fragment takes. For slivers and extreme ratios of W these
// sums would cancel. Triangles of these kinds (PLANES_EXACT) take their e_i as exact integers per pixel and combine
// after that.
#ifndef RHW_PLANE_H
#define RHW_PLANE_H

#include "base/constants.h"
#include "base/simd.h"

struct plane {
    double at, dx, dy; // value at the anchor's centre; change per pixel
};

// The four quantities that every fragment needs stand side by side in one vector.
enum quantity { QUANTITY_S, QUANTITY_B, QUANTITY_C, QUANTITY_Z }; // 1/W; b·(1/W); c·(1/W); depth

struct quantity_planes {
    f64x4 at, dx, dy; // vectors by quantity, with the members of struct plane
};

RHW_INLINE struct plane plane_of(const struct quantity_planes *planes, enum quantity q)
{
    return (struct plane){planes->at[q], planes->dx[q], planes->dy[q]};
}

static inline struct plane plane_scale(double f, struct plane p)
{
    return (struct plane){f * p.at, f * p.dx, f * p.dy};
}

// Values: the formula ----------------------------------------------------------------------------------

RHW_INLINE f64x8 plane_column(struct plane p, f64x8 dx)
{
    return f64x8_mul(f64x8_splat(p.dx), dx);
}

RHW_INLINE f64x8 plane_row(struct plane p, f64x8 dy)
{
    return f64x8_add(f64x8_splat(p.at), f64x8_mul(f64x8_splat(p.dy), dy));
}

// Return the value at 8 pixels.
RHW_INLINE f64x8 plane_value8(struct plane p, f64x8 dx, f64x8 dy)
{
    return f64x8_add(plane_column(p, dx), plane_row(p, dy));
}

// Return true if a plane has one value along a row. A sum with a product that is 0 is then the row's part, bit for bit:
// that is no −0, as `at` is none.
RHW_INLINE bool plane_is_level(struct plane p)
{
    return p.dx == 0 && !__builtin_signbit(p.at);
}

// Set the values of the rows of a level plane, rounded.
RHW_INLINE void plane_level_rows(struct plane p, f64x8 dy, float by_row[RHW_BLOCK])
{
    f32x8_store(by_row, f32x8_from_f64x8(plane_row(p, dy)));
}

// Return the value at one pixel.
RHW_INLINE double plane_value(struct plane p, double dx, double dy)
{
    return p.dx * dx + (p.at + p.dy * dy);
}

// Return the value at 4 places.
RHW_INLINE f64x4 plane_value4(struct plane p, f64x4 dx, f64x4 dy)
{
    return f64x4_splat(p.dx) * dx + (f64x4_splat(p.at) + f64x4_splat(p.dy) * dy);
}

// Return the values of the four quantities at one place.
RHW_INLINE f64x4 quantity_values(const struct quantity_planes *p, double dx, double dy)
{
    return p->dx * f64x4_splat(dx) + (p->at + p->dy * f64x4_splat(dy));
}

// Blocks -----------------------------------------------------------------------------------------------

// The distance from the anchor of a block of 8×8 pixels or of 8 pixels anywhere. A block has dx of its columns and dy
// of its rows. 8 pixels have dx and dy of each pixel.
struct anchor_offset {
    f64x8 dx, dy;
};

// A plane over a block. It is made once for the block, so that a row of 8 pixels costs one addition.
struct block_plane {
    f64x8 column;
    double row[RHW_BLOCK];
};

RHW_INLINE void block_plane_column(struct block_plane *out, struct plane plane, f64x8 dx)
{
    out->column = plane_column(plane, dx);
}

RHW_INLINE void block_plane_rows(struct block_plane *out, struct plane plane, f64x8 dy)
{
    const f64x8 row = plane_row(plane, dy);
    memcpy(out->row, &row, sizeof out->row);
}

RHW_INLINE void block_plane_set(struct block_plane *out, struct plane plane, const struct anchor_offset *at)
{
    block_plane_column(out, plane, at->dx);
    block_plane_rows(out, plane, at->dy);
}

RHW_INLINE f64x8 block_plane_value(const struct block_plane *plane, int row)
{
    return f64x8_add(plane->column, f64x8_splat(plane->row[row]));
}

// Triangles --------------------------------------------------------------------------------------------

enum plane_kind {
    PLANES_LINEAR, // planes of the four quantities
    PLANES_EXACT,  // exact edge values, made pixel by pixel: for a sliver, or an extreme ratio of W
    // A clipped triangle has this kind if its weights survive in double-double only: plane_clipped.h.
    PLANES_DOUBLE_DOUBLE
};

// The four quantities of a snapped triangle: each is base + f1·e_1 + f2·e_2.
struct edge_factors {
    struct plane e1, e2; // exact integers
    f64x4 base, f1, f2;
    double area, inverse_area; // the doubled, positive area
};

// Numerators of the derivatives of two quantities: by x and by y for the first, by x and by y for the second. See
// derivative.h.
struct derivative_pair {
    f64x4 at, step; // value at the anchor's centre; change per pixel down, to the right, down, to the right
};

struct planes {
    int anchor_x, anchor_y; // pixels
    enum plane_kind kind;
    bool is_homogeneous; // true if a vertex is not snapped; then `factors` are not set
    struct quantity_planes quantities;
    double inverse_area; // one over the doubled area; snapped triangles have it
    // Exact and clipped triangles have factors, and so have triangles whose screen weights are wanted.
    struct edge_factors factors;
    struct plane n1, n2;            // weights on the screen of vertices 1 and 2, where they are wanted
    struct derivative_pair weights; // derivatives of b and c, where they are asked for
};

// Return a quantity made from exact edge values.
RHW_INLINE f64x8 combine_edges(const struct edge_factors *f, enum quantity q, f64x8 e1, f64x8 e2)
{
    return f64x8_add(f64x8_splat(f->base[q]),
                     f64x8_add(f64x8_mul(f64x8_splat(f->f1[q]), e1), f64x8_mul(f64x8_splat(f->f2[q]), e2)));
}

// What a block needs of a triangle's planes. block_depth sets z. block_weights, or block_weight_rows and
// block_weight_columns together, set s, b, c. block_screen_weights sets n1, n2. If the planes are exact, e1, e2 are set
// instead of all of them.
struct block_planes {
    struct block_plane z, s, b, c, n1, n2, e1, e2;
    double inverse_s[RHW_BLOCK]; // one number per row, with WEIGHTS_PER_ROW
};

static void block_edges(struct block_planes *block, const struct planes *p, const struct anchor_offset *at)
{
    block_plane_set(&block->e1, p->factors.e1, at);
    block_plane_set(&block->e2, p->factors.e2, at);
}

// Depth ------------------------------------------------------------------------------------------------

RHW_INLINE void block_depth(struct block_planes *block, const struct planes *p,
                            const struct anchor_offset *at)
{
    if (__builtin_expect(p->kind == PLANES_EXACT, 0)) {
        block_edges(block, p, at);
    } else {
        block_plane_set(&block->z, plane_of(&p->quantities, QUANTITY_Z), at);
    }
}

RHW_INLINE f32x8 depth_of_row(const struct planes *p, const struct block_planes *block, int row)
{
    if (__builtin_expect(p->kind == PLANES_EXACT, 0)) {
        return f32x8_from_f64x8(combine_edges(&p->factors, QUANTITY_Z, block_plane_value(&block->e1, row),
                                              block_plane_value(&block->e2, row)));
    }
    return f32x8_from_f64x8(block_plane_value(&block->z, row));
}

// Weights in space -------------------------------------------------------------------------------------

// How the weights of a row are found. It is a constant where a call names it. One division for a row takes 5 % of
// fill_color's instructions away, and 15 % of its time.
enum weight_path {
    WEIGHTS_PER_PIXEL, // a division in every lane
    // 1/W has one value along a row, so that one division serves all its lanes with the bits that each would get.
    WEIGHTS_PER_ROW,
    WEIGHTS_EXACT // weights from exact integers: PLANES_EXACT
};

// Return the weight path of a triangle. 1/W is constant along a row for a floor under a camera that is not rolled, and
// for whatever is drawn without perspective.
RHW_INLINE enum weight_path weight_path_of(const struct planes *p)
{
    if (__builtin_expect(p->kind == PLANES_EXACT, 0)) {
        return WEIGHTS_EXACT;
    }
    return p->quantities.dx[QUANTITY_S] == 0 ? WEIGHTS_PER_ROW : WEIGHTS_PER_PIXEL;
}

// Set the parts of the three weight planes that depend on the row and on the column. Exact planes have none.
RHW_INLINE void block_weight_rows(struct block_planes *block, const struct planes *p, f64x8 dy,
                                  enum weight_path path)
{
    block_plane_rows(&block->s, plane_of(&p->quantities, QUANTITY_S), dy);
    block_plane_rows(&block->b, plane_of(&p->quantities, QUANTITY_B), dy);
    block_plane_rows(&block->c, plane_of(&p->quantities, QUANTITY_C), dy);
    if (path == WEIGHTS_PER_ROW) {
        f64x8 row;
        memcpy(&row, block->s.row, sizeof row);
        row = f64x8_div(f64x8_splat(1), row);
        memcpy(block->inverse_s, &row, sizeof row);
    }
}

RHW_INLINE void block_weight_columns(struct block_planes *block, const struct planes *p, f64x8 dx)
{
    block_plane_column(&block->s, plane_of(&p->quantities, QUANTITY_S), dx);
    block_plane_column(&block->b, plane_of(&p->quantities, QUANTITY_B), dx);
    block_plane_column(&block->c, plane_of(&p->quantities, QUANTITY_C), dx);
}

RHW_INLINE void block_weights(struct block_planes *block, const struct planes *p,
                              const struct anchor_offset *at, enum weight_path path)
{
    if (path == WEIGHTS_EXACT) {
        block_edges(block, p, at);
    } else {
        block_weight_rows(block, p, at->dy, path);
        block_weight_columns(block, p, at->dx);
    }
}

// The perspective weights of vertices 1 and 2.
struct weights {
    f32x8 b, c;
    f64x8 s, inverse_s;
};

RHW_INLINE struct weights weights_of(f64x8 s, f64x8 inverse_s, f64x8 b, f64x8 c)
{
    return (struct weights){f32x8_from_f64x8(f64x8_mul(b, inverse_s)),
                            f32x8_from_f64x8(f64x8_mul(c, inverse_s)), s, inverse_s};
}

// Return 1/W of a row.
RHW_INLINE f64x8 inverse_w_of_row(const struct planes *p, const struct block_planes *block, int row)
{
    return p->kind == PLANES_EXACT
               ? combine_edges(&p->factors, QUANTITY_S, block_plane_value(&block->e1, row),
                               block_plane_value(&block->e2, row))
               : block_plane_value(&block->s, row);
}

RHW_INLINE struct weights weights_of_row(const struct planes *p, const struct block_planes *block, int row,
                                         enum weight_path path)
{
    f64x8 s, b, c;
    if (path == WEIGHTS_EXACT) {
        const f64x8 e1 = block_plane_value(&block->e1, row), e2 = block_plane_value(&block->e2, row);
        s = combine_edges(&p->factors, QUANTITY_S, e1, e2);
        b = f64x8_mul(f64x8_splat(p->factors.f1[QUANTITY_B]), e1);
        c = f64x8_mul(f64x8_splat(p->factors.f2[QUANTITY_C]), e2);
    } else {
        s = block_plane_value(&block->s, row);
        b = block_plane_value(&block->b, row);
        c = block_plane_value(&block->c, row);
    }
    const f64x8 inverse_s =
        path == WEIGHTS_PER_ROW ? f64x8_splat(block->inverse_s[row]) : f64x8_div(f64x8_splat(1), s);
    return weights_of(s, inverse_s, b, c);
}

// Return the weights of 8 pixels anywhere. The planes are not exact.
RHW_INLINE struct weights weights_of_pixels(const struct quantity_planes *p, const struct anchor_offset *at)
{
    const f64x8 s = plane_value8(plane_of(p, QUANTITY_S), at->dx, at->dy);
    return weights_of(s, f64x8_div(f64x8_splat(1), s), plane_value8(plane_of(p, QUANTITY_B), at->dx, at->dy),
                      plane_value8(plane_of(p, QUANTITY_C), at->dx, at->dy));
}

// Weights on the screen --------------------------------------------------------------------------------

RHW_INLINE void block_screen_weights(struct block_planes *block, const struct planes *p,
                                     const struct anchor_offset *at)
{
    if (p->kind == PLANES_EXACT) {
        block_edges(block, p, at);
    } else {
        block_plane_set(&block->n1, p->n1, at);
        block_plane_set(&block->n2, p->n2, at);
    }
}

// The weights on the screen of vertices 1 and 2.
struct screen_weights {
    f64x8 s, t;
};

RHW_INLINE struct screen_weights screen_weights_of_row(const struct planes *p,
                                                       const struct block_planes *block, int row)
{
    if (p->kind == PLANES_EXACT) {
        const f64x8 inverse_area = f64x8_splat(p->factors.inverse_area);
        return (struct screen_weights){f64x8_mul(inverse_area, block_plane_value(&block->e1, row)),
                                       f64x8_mul(inverse_area, block_plane_value(&block->e2, row))};
    }
    return (struct screen_weights){block_plane_value(&block->n1, row), block_plane_value(&block->n2, row)};
}

#endif
