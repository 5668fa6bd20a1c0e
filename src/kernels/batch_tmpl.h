// SPDX-License-Identifier: MIT
// Setup of the next 8 triangles of a bin, lane by lane: of each the edges, and the planes that every fragment needs.
// One at a time, small triangles spend most of their time waiting for the divisions of planes_tmpl.h; here 8 wait at
// once. The operations are those of planes_linear, so it changes no bit which of the two made a plane. Template:
// compiled once per instruction set.

#include "bin_tmpl.h"

// Meaningful for triangles with RHW_TRIANGLE_SMALL alone. Edges: q, a, b are those of coverage_tmpl.h, q at pixel (x,
// y0) of the tile. Corners lie within 64 pixels of each other and within 72 of any pixel of a block that reaches into
// their rectangle, as edge_lanes asks.
struct batch {
    const struct bin_batch *read; // the triangles
    // What they may cover of the tile: see struct tile_rect.
    int32_t x0[BATCH], y0[BATCH], x1[BATCH], y1[BATCH];
    int32_t x[BATCH];
    int32_t q[3][BATCH], a[3][BATCH], b[3][BATCH];
    struct linear linear[BATCH];
    double inverse_area[BATCH];
    int32_t anchor_x[BATCH], anchor_y[BATCH]; // as in struct planes
    unsigned inexact; // bit i: the numbers of triangle i must be exact integers, pixel by pixel: a sliver
};

// The words of 8 triangles.
struct batch_words {
    i8 x[3], y[3], flags, x0, y0, x1, y1;
};

RHW_INLINE void batch_words(struct batch_words *words, const struct batch *batch,
                            const struct tile_work *work)
{
    f8 low[8], high[8];
    for (int i = 0; i < BATCH; i++) {
        low[i] = f8_load(batch->read->triangle[i]);
        high[i] = f8_load((const unsigned char *)batch->read->triangle[i] + sizeof low[i]);
    }
    f8_transpose(low);
    f8_transpose(high);
    for (int k = 0; k < 3; k++) {
        words->x[k] = (i8)low[k];
        words->y[k] = (i8)low[3 + k];
    }
    const i8 zero = i8_splat(0), end = i8_splat(RHW_TILE), x = i8_splat(work->x), y = i8_splat(work->y);
    words->flags = (i8)high[4]; // and above them x0; then y0 and x1, and y1: fill_words in front_tmpl.h
    words->x0 = i8_max(((i8)high[4] >> 16) - x, zero);
    words->y0 = i8_max(((i8)high[5] << 16 >> 16) - y, zero);
    words->x1 = i8_min(((i8)high[5] >> 16) - x, end);
    words->y1 = i8_min(((i8)high[6] << 16 >> 16) - y, end);
}

RHW_INLINE void batch_edges(struct batch *batch, const struct batch_words *words,
                            const struct tile_work *work)
{
    const i8 x = i8_min(words->x0, i8_splat(RHW_TILE - RHW_BLOCK)); // so that 8 lanes stay in the tile
    const i8 half = i8_splat(RHW_SUBPIXEL / 2);
    const i8 px = ((x + i8_splat(work->x)) << RHW_SUBPIXEL_BITS) + half,
             py = ((words->y0 + i8_splat(work->y)) << RHW_SUBPIXEL_BITS) + half;
    const i8 negative = i8_splat(RHW_TRIANGLE_NEGATIVE);
    const i8 turn = rhw_equal_int(words->flags & negative, negative);
    for (int i = 0; i < 3; i++) {
        const struct edge_lanes edge = edge_lanes(words->x, words->y, i, turn, px, py);
        i8_store(batch->q[i], edge.e >> RHW_SUBPIXEL_BITS);
        i8_store(batch->a[i], edge.a);
        i8_store(batch->b[i], edge.b);
    }
    i8_store(batch->x, x);
    i8_store(batch->x0, words->x0);
    i8_store(batch->y0, words->y0);
    i8_store(batch->x1, words->x1);
    i8_store(batch->y1, words->y1);
}

// Four triangles, lane by lane.
struct batch_quad {
    d4 x1, y1, x2, y2; // corners 1 and 2, seen from corner 0, in 1/256 pixel
    d4 px, py;         // the anchor's centre, likewise
    d4 w[3], z[3];     // of the vertices
    d4 depth_low, depth_span;
};

// One quantity over four triangles.
struct quad_plane {
    d4 at, dx, dy;
};

RHW_INLINE struct quad_plane quad_combine(d4 base, d4 f1, d4 f2, struct quad_plane e1, struct quad_plane e2)
{
    return (struct quad_plane){base + (f1 * e1.at + f2 * e2.at), f1 * e1.dx + f2 * e2.dx,
                               f1 * e1.dy + f2 * e2.dy};
}

// To one vector over the quantities for each triangle.
RHW_INLINE void quad_store(struct batch *batch, int i, struct quad_plane plane[4])
{
    d4 at[4], dx[4], dy[4];
    for (int q = 0; q < 4; q++) {
        at[q] = plane[q].at;
        dx[q] = plane[q].dx;
        dy[q] = plane[q].dy;
    }
    d4_transpose(at);
    d4_transpose(dx);
    d4_transpose(dy);
    for (int lane = 0; lane < 4; lane++) {
        batch->linear[i + lane] = (struct linear){at[lane], dx[lane], dy[lane]};
    }
}

// planes_linear, four times: of triangles i .. i + 3.
RHW_INLINE void batch_planes(struct batch *batch, int i, const struct batch_quad *t)
{
    const d4 zero = d4_splat(0), one = d4_splat(1), pixel = d4_splat(RHW_SUBPIXEL);
    const d4 signed_area = t->x1 * t->y2 - t->x2 * t->y1;
    const d4 sign = d4_select(d4_less(signed_area, zero), d4_splat(-1), one);
    const d4 x1 = t->x1 * sign, x2 = t->x2 * sign, y1 = t->y1 * sign, y2 = t->y2 * sign;
    const struct quad_plane e1 = {y2 * t->px - x2 * t->py, y2 * pixel, -x2 * pixel},
                            e2 = {x1 * t->py - y1 * t->px, -y1 * pixel, x1 * pixel};
    const d4 inverse_area = one / (sign * signed_area);
    d4 w[3], d[3];
    for (int v = 0; v < 3; v++) {
        w[v] = one / t->w[v];
        d[v] = t->depth_low + t->depth_span * (t->z[v] / t->w[v]);
    }
    // Products with 0 are kept: they may turn the sign of a zero.
    struct quad_plane plane[4];
    plane[QUANTITY_S] =
        quad_combine(w[0], (w[1] - w[0]) * inverse_area, (w[2] - w[0]) * inverse_area, e1, e2);
    plane[QUANTITY_B] = quad_combine(zero, w[1] * inverse_area, zero * inverse_area, e1, e2);
    plane[QUANTITY_C] = quad_combine(zero, zero * inverse_area, w[2] * inverse_area, e1, e2);
    plane[QUANTITY_Z] =
        quad_combine(d[0], (d[1] - d[0]) * inverse_area, (d[2] - d[0]) * inverse_area, e1, e2);
    quad_store(batch, i, plane);
    memcpy(&batch->inverse_area[i], &inverse_area, sizeof inverse_area);
    const d4 width = d4_abs(x1) + d4_abs(x2), height = d4_abs(y1) + d4_abs(y2);
    const d4 most = d4_max(d4_max(w[0], w[1]), w[2]), least = d4_min(d4_min(w[0], w[1]), w[2]);
    const l4 inexact =
        d4_less(d4_splat(0x1p20) * least, (width + pixel) * (height + pixel) * inverse_area * most);
    for (int lane = 0; lane < 4; lane++) {
        batch->inexact |= (unsigned)(inexact[lane] & 1) << (i + lane);
    }
}

// Depth ranges of the triangles' draws.
RHW_INLINE void batch_depth_range(const struct rhw_segment *const segment[BATCH], d8 *low, d8 *span)
{
    double lows[BATCH], spans[BATCH];
    for (int i = 0; i < BATCH; i++) {
        lows[i] = segment[i]->draw->state->depth_low;
        spans[i] = segment[i]->draw->state->depth_span;
    }
    memcpy(low, lows, sizeof lows);
    memcpy(span, spans, sizeof spans);
}

// Of `batch->read`.
static void batch_setup(const struct tile_work *work, const struct rhw_chunk *chunk, struct batch *batch)
{
    struct batch_words words;
    batch_words(&words, batch, work);
    batch_edges(batch, &words, work);
    const struct rhw_segment *segment[BATCH];
    f8 position[3][4];
    for (int i = 0; i < BATCH; i++) {
        segment[i] = &chunk->segments[batch->read->triangle[i]->segment];
    }
    for (int v = 0; v < 3; v++) {
        const void *place[BATCH];
        for (int i = 0; i < BATCH; i++) {
            place[i] = batch->read->vertex[i][v]->position;
        }
        f8_load_columns(place, position[v]);
    }
    i8_store(batch->anchor_x, words.x[0] >> RHW_SUBPIXEL_BITS);
    i8_store(batch->anchor_y, words.y[0] >> RHW_SUBPIXEL_BITS);
    d8 low, span;
    batch_depth_range(segment, &low, &span);
    const i8 center = i8_splat(RHW_SUBPIXEL / 2), fraction = i8_splat(RHW_SUBPIXEL - 1);
    const d8 x1 = d8_from_i8(words.x[1] - words.x[0]), y1 = d8_from_i8(words.y[1] - words.y[0]),
             x2 = d8_from_i8(words.x[2] - words.x[0]), y2 = d8_from_i8(words.y[2] - words.y[0]),
             px = d8_from_i8(center - (words.x[0] & fraction)),
             py = d8_from_i8(center - (words.y[0] & fraction));
    struct batch_quad
        first = {x1.lo, y1.lo, x2.lo, y2.lo, px.lo, py.lo, .depth_low = low.lo, .depth_span = span.lo},
        second = {x1.hi, y1.hi, x2.hi, y2.hi, px.hi, py.hi, .depth_low = low.hi, .depth_span = span.hi};
    for (int v = 0; v < 3; v++) {
        const d8 z = d8_from_f8(position[v][2]), w = d8_from_f8(position[v][3]);
        first.z[v] = z.lo;
        first.w[v] = w.lo;
        second.z[v] = z.hi;
        second.w[v] = w.hi;
    }
    batch->inexact = 0;
    batch_planes(batch, 0, &first);
    batch_planes(batch, 4, &second);
}
