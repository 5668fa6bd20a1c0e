// SPDX-License-Identifier: MIT
// Triangles that are small beside a tile: what meshes are made of. Their edges fit into 32 bits, and their blocks of
// 8×8 pixels start where the triangle does instead of at multiples of 8, so that few of them are mostly empty.
// Template: compiled once per instruction set.

#include "block_tmpl.h"

// The edges of a triangle with RHW_TRIANGLE_SMALL, lane by lane; the fourth lane is of no edge. q, a, b are those of
// coverage_tmpl.h, q at pixel (x, y) of the tile. Corners lie within 64 pixels of each other and within 72 of any pixel
// of a block that reaches into their rectangle: |a|, |b| < 2^14, |e| < 2·2^14·72·256 < 2^30.
struct small_edges {
    int x, y;
    i4 q, a, b;
};

RHW_INLINE struct small_edges small_edges_at(const struct tile_work *work, const struct rhw_triangle *t,
                                             int x, int y)
{
    const i4 x0 = i4_load(t->x_24_8),
             y0 = i4_load(t->y_24_8); // the fourth is another member, and is not used
    const i4 x1 = __builtin_shufflevector(x0, x0, 1, 2, 0, 3),
             y1 = __builtin_shufflevector(y0, y0, 1, 2, 0, 3);
    const i4 turn = i4_splat(t->flags & RHW_TRIANGLE_NEGATIVE ? -1 : 0);
    const i4 a = ((y0 - y1) ^ turn) - turn, b = ((x1 - x0) ^ turn) - turn;
    const i4 top_left = (a > 0) | ((a == 0) & (b > 0));
    const i4 px = i4_splat((work->x + x) * RHW_SUBPIXEL + RHW_SUBPIXEL / 2),
             py = i4_splat((work->y + y) * RHW_SUBPIXEL + RHW_SUBPIXEL / 2);
    const i4 e = a * (px - x0) + b * (py - y0);
    return (struct small_edges){x, y, (e + ~top_left) >> RHW_SUBPIXEL_BITS, a, b}; // −1: neither top nor left
}

// A row of 8 pixels, edge by edge.
struct small_row {
    i8 q[3], step[3];
};

RHW_INLINE struct small_row small_row_at(i4 q, i4 a, i4 b)
{
    struct small_row row;
    for (int i = 0; i < 3; i++) {
        row.q[i] = i8_splat(q[i]) + i8_splat(a[i]) * rhw_lane_index;
        row.step[i] = i8_splat(b[i]);
    }
    return row;
}

// The lanes that are covered; goes on to the next row.
RHW_INLINE unsigned small_row_next(struct small_row *row)
{
    const unsigned outside = i8_sign_bits(row->q[0] | row->q[1] | row->q[2]);
    for (int i = 0; i < 3; i++) {
        row->q[i] += row->step[i];
    }
    return ~outside;
}

// Bit 8·row + column of the block whose first pixel is (x, y) in the tile.
RHW_INLINE uint64_t small_mask(const struct small_edges *edges, int x, int y)
{
    const i4 q = edges->q + edges->a * i4_splat(x - edges->x) + edges->b * i4_splat(y - edges->y);
    const i4 last = i4_splat(RHW_BLOCK - 1), zero = i4_splat(0);
    const i4 most = q + (i4_max(edges->a, zero) + i4_max(edges->b, zero)) * last;
    if (i4_sign_bits(most) & 7) {
        return 0;
    }
    struct small_row row = small_row_at(q, edges->a, edges->b);
    uint64_t mask = 0;
    for (int i = 0; i < RHW_BLOCK; i++) {
        mask |= (uint64_t)(small_row_next(&row) & 0xff) << (8 * i);
    }
    return mask;
}

static void small_collect(struct tile_work *work, struct triangle_work *triangle, int x, int y, unsigned bits)
{
    work->counters->fragments += (unsigned)__builtin_popcount(bits);
    if (row_is_pending(work, x, y, bits)) {
        flush(work);
    }
    if (triangle->packed < 0) {
        pack_triangle(work, triangle);
    }
    pack_row(work, triangle, x, y, bits);
}

// Where the rows of a small triangle stand in the tile: x of lane 0, rows y0 .. y1 − 1, the lanes it may cover.
struct small_place {
    int x, y0, y1;
    unsigned columns;
};

// False, with nothing drawn, where its numbers must be exact integers: a sliver. `tests`: depth is tested before
// shading; `rule` is how, a constant where a call names it.
RHW_INLINE bool small_rows(struct tile_work *work, struct triangle_work *triangle, struct small_place place,
                           bool tests, const struct depth_rule rule)
{
    struct planes *const planes = &triangle->planes;
    const struct small_edges edges = small_edges_at(work, triangle->t, place.x, place.y0);
    struct small_row row_edges = small_row_at(edges.q, edges.a, edges.b);
    d8 z_column = d8_splat(0);
    for (int y = place.y0; y < place.y1; y++) {
        unsigned bits = small_row_next(&row_edges) & place.columns;
        if (bits == 0) {
            continue;
        }
        if (!triangle->planes_ready) {
            load_vertices(triangle);
            struct factors factors;
            if (!planes_linear(planes, &factors, work->state, triangle->t, triangle->v)) {
                return false;
            }
            planes->factors.inverse_area = factors.inverse_area; // for planes_slopes
            triangle->planes_ready = true;
            z_column = d8_mul(d8_splat(planes->linear.dx[QUANTITY_Z]),
                              d8_from_i8(i8_splat(work->x + place.x - planes->anchor_x) + rhw_lane_index));
        }
        if (tests) {
            const double row = planes->linear.at[QUANTITY_Z] +
                               planes->linear.dy[QUANTITY_Z] * (double)(work->y + y - planes->anchor_y);
            const f8 z = f8_from_d8(d8_add(z_column, d8_splat(row)));
            bits = test_row(work, place.x, y, z, bits, rule);
        }
        if (bits != 0 && work->shades) {
            small_collect(work, triangle, place.x, y, bits);
        }
    }
    return true;
}

// Those of one block. False where draw_small_blocks must draw it.
static bool draw_smallest(struct tile_work *work, struct triangle_work *triangle, struct tile_rect rect)
{
    const int x = min_int(rect.x0, RHW_TILE - RHW_BLOCK); // so that 8 lanes stay in the tile
    const struct small_place place = {x, rect.y0, rect.y1,
                                      (0xffu << (rect.x0 - x)) & (0xffu >> (RHW_BLOCK - (rect.x1 - x)))};
    if (!tests_early(work)) {
        return small_rows(work, triangle, place, false, work->early);
    }
    if (is_plain_less(work->early)) {
        return small_rows(work, triangle, place, true, plain_less);
    }
    return small_rows(work, triangle, place, true, work->early);
}

static void draw_small_blocks(struct tile_work *work, struct triangle_work *triangle, struct tile_rect rect)
{
    const struct small_edges edges = small_edges_at(work, triangle->t, rect.x0, rect.y0);
    for (int y0 = rect.y0; y0 < rect.y1; y0 += RHW_BLOCK) {
        const int y = min_int(y0, RHW_TILE - RHW_BLOCK); // so that the block stays in the tile
        for (int x0 = rect.x0; x0 < rect.x1; x0 += RHW_BLOCK) {
            const int x = min_int(x0, RHW_TILE - RHW_BLOCK);
            uint64_t mask = small_mask(&edges, x, y);
            if (work->scissored || x != x0 || y != y0) {
                mask &= rect_mask(x, y, x0, y0, rect.x1, rect.y1);
            }
            if (mask != 0) {
                draw_block(work, triangle, x, y, mask);
            }
        }
    }
}

static void draw_small(struct tile_work *work, struct triangle_work *triangle, struct tile_rect rect)
{
    if (rect.x1 - rect.x0 <= RHW_BLOCK && rect.y1 - rect.y0 <= RHW_BLOCK && (work->packs || !work->shades)) {
        if (draw_smallest(work, triangle, rect)) {
            return;
        }
        triangle->planes_ready = false;
    }
    draw_small_blocks(work, triangle, rect);
}

static void draw_triangle(struct tile_work *work, const struct rhw_chunk *chunk, const struct rhw_triangle *t)
{
    struct triangle_work triangle;
    triangle.segment = &chunk->segments[t->segment];
    triangle.t = t;
    triangle.planes_ready = triangle.ready = false;
    triangle.packed = -1;
    triangle.provoking = NULL;
    if (triangle.segment->draw != work->draw) {
        set_draw(work, triangle.segment->draw);
    }
    if (work->skips) {
        return;
    }
    const struct tile_rect rect = rect_of(work, t);
    if (t->flags & RHW_TRIANGLE_SMALL) {
        draw_small(work, &triangle, rect);
    } else {
        draw_blocks(work, chunk, &triangle, rect);
    }
}
