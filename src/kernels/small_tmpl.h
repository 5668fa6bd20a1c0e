// SPDX-License-Identifier: MIT
// Small triangles, at most 8×8 pixels: what meshes are made of. One step does coverage and depth of a row, in 8 lanes
// that start where the triangle does; its fragments are packed into groups with those of its neighbours.
// Template: compiled once per instruction set.

#include "block_tmpl.h"

// The edges at a row of 8 pixels: coverage_tmpl.h's q, and its change per row. Corners lie within 8 pixels of each
// other and of the row: |a|, |b| < 2^11 and differences of positions below 2^12, so |e| < 2^24.
struct small_edges {
    i8 q[3], step[3];
};

// `x`, `y`: pixel of the first row's first lane, in the target.
RHW_INLINE void small_edges(struct small_edges *edges, const struct rhw_triangle *t, int x, int y)
{
    const i4 x0 = i4_load(t->x_24_8),
             y0 = i4_load(t->y_24_8); // the fourth is another member, and is not used
    const i4 x1 = __builtin_shufflevector(x0, x0, 1, 2, 0, 3),
             y1 = __builtin_shufflevector(y0, y0, 1, 2, 0, 3);
    const i4 turn = i4_splat(t->flags & RHW_TRIANGLE_NEGATIVE ? -1 : 0);
    const i4 a = ((y0 - y1) ^ turn) - turn, b = ((x1 - x0) ^ turn) - turn;
    const i4 top_left = (a > 0) | ((a == 0) & (b > 0));
    const i4 px = i4_splat(x * RHW_SUBPIXEL + RHW_SUBPIXEL / 2),
             py = i4_splat(y * RHW_SUBPIXEL + RHW_SUBPIXEL / 2);
    const i4 e = a * (px - x0) + b * (py - y0);
    const i4 q = (e + ~top_left) >> RHW_SUBPIXEL_BITS; // −1 where it is neither top nor left
    for (int i = 0; i < 3; i++) {
        edges->q[i] = i8_splat(q[i]) + i8_splat(a[i]) * rhw_lane_index;
        edges->step[i] = i8_splat(b[i]);
    }
}

static void small_collect(struct tile_work *work, struct triangle_work *triangle, int x, int y, unsigned bits)
{
    work->counters->fragments += (unsigned)__builtin_popcount(bits);
    if (row_is_pending(work, x, y, bits)) {
        flush(work);
    }
    if (triangle->packed < 0) {
        if (work->pipeline->any_derivatives) {
            planes_slopes(&triangle->planes, triangle->t, triangle->v);
        }
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
// shading; `compare` and `write` are how, constants where a call names them.
RHW_INLINE bool small_rows(struct tile_work *work, struct triangle_work *triangle, struct small_place place,
                           bool tests, enum rhw_compare compare, bool write)
{
    struct planes *const planes = &triangle->planes;
    struct small_edges edges;
    small_edges(&edges, triangle->t, work->x + place.x, work->y + place.y0);
    d8 z_column = d8_splat(0);
    for (int y = place.y0; y < place.y1; y++) {
        unsigned bits = ~i8_sign_bits(edges.q[0] | edges.q[1] | edges.q[2]) & place.columns;
        for (int i = 0; i < 3; i++) {
            edges.q[i] += edges.step[i];
        }
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
            float *const texels = stored_depth(work, place.x, y);
            f8 stored = f8_load(texels);
            bits = i8_sign_bits(depth_test(compare, write, f8_from_d8(d8_add(z_column, d8_splat(row))),
                                           i8_from_bits(bits), &stored));
            if (write) {
                f8_store(texels, stored);
            }
        }
        if (bits != 0 && work->shades) {
            small_collect(work, triangle, place.x, y, bits);
        }
    }
    return true;
}

// False where draw_blocks must draw it.
static bool draw_small(struct tile_work *work, struct triangle_work *triangle)
{
    const struct rhw_triangle *const t = triangle->t;
    const struct rhw_pipeline_def *const def = &work->pipeline->def;
    const int x0 = max_int(t->x0 - work->x, 0), x1 = min_int(t->x1 - work->x, RHW_TILE);
    const int x = min_int(x0, RHW_TILE - RHW_BLOCK); // so that 8 lanes stay in the tile
    const struct small_place place = {x, max_int(t->y0 - work->y, 0), min_int(t->y1 - work->y, RHW_TILE),
                                      (0xffu << (x0 - x)) & (0xffu >> (RHW_BLOCK - (x1 - x)))};
    if (work->depth_mode == DEPTH_EARLY && def->depth_write && def->depth_compare == RHW_COMPARE_LESS) {
        return small_rows(work, triangle, place, true, RHW_COMPARE_LESS, true);
    }
    if (work->depth_mode == DEPTH_EARLY || work->depth_mode == DEPTH_EARLY_REJECT) {
        return small_rows(work, triangle, place, true, def->depth_compare,
                          work->depth_mode == DEPTH_EARLY && def->depth_write);
    }
    return small_rows(work, triangle, place, false, RHW_COMPARE_ALWAYS, false);
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
    if (t->flags & RHW_TRIANGLE_SMALL && (work->packs || !work->shades) && draw_small(work, &triangle)) {
        return;
    }
    triangle.planes_ready = false;
    draw_blocks(work, chunk, &triangle);
}
