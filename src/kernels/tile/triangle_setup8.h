// SPDX-License-Identifier: MIT
// The next 8 triangles of a bin are set up lane by lane: all triangles get the planes that every fragment needs, and
// small ones get their edges in 32 bits.
#ifndef RHW_TRIANGLE_SETUP8_H
#define RHW_TRIANGLE_SETUP8_H

#include "kernels/raster/coverage.h"
#include "kernels/raster/plane_setup.h"
#include "kernels/raster/sample_position.h"
#include "kernels/triangle_work.h"
#include "bin_reader.h"

enum {
    CELL = 4, // pixels of a cell, each way
    CELL_SAMPLES = 4,
    CELLS_X = 2, // most cells of a triangle, each way
    CELLS_Y = 4,
    MOST_CELLS = BATCH * CELLS_X * CELLS_Y
};

// What tiny triangles cover where pixels have 4 samples (sample_cells.h). Triangle i has cells first[i] .. first[i + 1]
// − 1. Lists have room for a vector that begins behind the last cell.
struct sample_cells {
    unsigned covers; // bit i: triangle i covers a sample
    int first[BATCH + 1];
    int32_t entry[MOST_CELLS + BATCH];
    int32_t x[MOST_CELLS + BATCH], y[MOST_CELLS + BATCH]; // first pixel of each cell, in the tile
    uint32_t low[MOST_CELLS + BATCH], high[MOST_CELLS + BATCH];
};

// The setup of 8 triangles. Edges and pixels are set for small triangles (RHW_TRIANGLE_SMALL) alone, planes for snapped
// ones. Edges have q, a, b as in coverage.h, with q at pixel (x, y0) of the tile. Vertices lie within 64 pixels of each
// other and within 72 of any pixel of a block that reaches into their rectangle, as edge_lanes asks. If pixels have
// several samples, q is taken at the pixel's top left corner, times 256: q of each sample follows from it.
struct triangle_setup8 {
    const struct bin_batch *read; // triangles that were read
    // The pixels of the tile that the triangles may cover: see struct tile_rect.
    int32_t x0[BATCH], y0[BATCH], x1[BATCH], y1[BATCH];
    int32_t x[BATCH];
    int32_t q[3][BATCH], a[3][BATCH], b[3][BATCH];
    struct quantity_planes quantities[BATCH];
    double inverse_area[BATCH];
    int32_t anchor_x[BATCH], anchor_y[BATCH]; // anchor of struct planes
    bool is_one_segment;                      // true if all triangles are of one segment, and so of one draw
    // Sets of triangles: bit i stands for triangle i.
    unsigned exact;  // triangles whose planes are PLANES_EXACT: slivers
    unsigned clamps; // triangles that may leave the range that depth is held to
    unsigned small;  // small triangles that are neither exact nor clamped, nor points with several samples
    unsigned tiny;   // small triangles that are tiny, where the draw of the first triangle draws tiny ones
    double depth_bias[BATCH]; // bias; set where the draw is biased and the vertices are snapped
    // Masks of what tiny triangles cover: tiny_mask where a pixel has one sample (triangle_tiny.h), and cells where it
    // has 4.
    uint32_t tiny_mask[BATCH];
    struct sample_cells cells;
};

// The words of 8 triangles.
struct triangle_words8 {
    i32x8 x[3], y[3], segment, flags, x0, y0, x1, y1;
};

RHW_INLINE struct triangle_words8 load_words8(const struct bin_batch *read, const struct tile_work *work)
{
    struct triangle_words8 words;
    f32x8 low[8], high[8];
    for (int i = 0; i < BATCH; i++) {
        low[i] = f32x8_load(read->triangle[i]);
        high[i] = f32x8_load((const unsigned char *)read->triangle[i] + sizeof low[i]);
    }
    f32x8_transpose(low);
    f32x8_transpose(high);
    for (int k = 0; k < 3; k++) {
        words.x[k] = (i32x8)low[k];
        words.y[k] = (i32x8)low[3 + k];
    }
    const i32x8 zero = i32x8_splat(0), end = i32x8_splat(RHW_TILE), x = i32x8_splat(work->x),
                y = i32x8_splat(work->y);
    words.segment = (i32x8)high[2];
    // In the words, x0 stands above the flags, y0 and x1 follow, then y1: see struct rhw_triangle.
    words.flags = (i32x8)high[4];
    words.x0 = i32x8_max(((i32x8)high[4] >> 16) - x, zero);
    words.y0 = i32x8_max(((i32x8)high[5] << 16 >> 16) - y, zero);
    words.x1 = i32x8_min(((i32x8)high[5] >> 16) - x, end);
    words.y1 = i32x8_min(((i32x8)high[6] << 16 >> 16) - y, end);
    return words;
}

RHW_INLINE void setup_edges8(struct triangle_setup8 *setup, const struct triangle_words8 *words,
                             const struct tile_work *work)
{
    // The 8 lanes from x on stay in the tile.
    const i32x8 x = i32x8_min(words->x0, i32x8_splat(RHW_TILE - RHW_BLOCK));
    const bool several = work->samples > 1;
    const i32x8 center = i32x8_splat(several ? SAMPLE_OFFSET_0_8 : 0);
    const i32x8 px = sample_of_pixel8(x + i32x8_splat(work->x)) - center,
                py = sample_of_pixel8(words->y0 + i32x8_splat(work->y)) - center;
    const int shift = several ? 0 : RHW_SUBPIXEL_BITS;
    const i32x8 negative = i32x8_splat(RHW_TRIANGLE_NEGATIVE);
    const i32x8 turn = rhw_equal_int(words->flags & negative, negative);
    for (int i = 0; i < 3; i++) {
        const struct edge_lanes edge = edge_lanes(words->x, words->y, i, turn, px, py);
        i32x8_store(setup->q[i], edge.e >> shift);
        i32x8_store(setup->a[i], edge.a);
        i32x8_store(setup->b[i], edge.b);
    }
    i32x8_store(setup->x, x);
    i32x8_store(setup->x0, words->x0);
    i32x8_store(setup->y0, words->y0);
    i32x8_store(setup->x1, words->x1);
    i32x8_store(setup->y1, words->y1);
}

// Set the planes of triangles i .. i + 3: what is made plane by plane becomes one vector over the quantities for each
// triangle.
RHW_INLINE void setup_planes_at(struct triangle_setup8 *setup, int i, const struct setup_input4 *input)
{
    struct setup_output4 out;
    setup_planes4(&out, input);
    f64x4 at[4], dx[4], dy[4];
    for (int q = 0; q < 4; q++) {
        at[q] = out.quantity[q].at;
        dx[q] = out.quantity[q].dx;
        dy[q] = out.quantity[q].dy;
    }
    f64x4_transpose(at);
    f64x4_transpose(dx);
    f64x4_transpose(dy);
    for (int lane = 0; lane < 4; lane++) {
        setup->quantities[i + lane] = (struct quantity_planes){at[lane], dx[lane], dy[lane]};
        setup->exact |= (unsigned)(out.is_exact[lane] & 1) << (i + lane);
    }
    memcpy(&setup->inverse_area[i], &out.inverse_area, sizeof out.inverse_area);
}

// Load the depth ranges of the triangles' draws.
RHW_INLINE void depth_ranges8(const struct bin_batch *read, i32x8 segment, const struct rhw_chunk *chunk,
                              f64x8 *low, f64x8 *span)
{
    const uint32_t first = read->triangle[0]->segment;
    if (i32x8_sign_bits(rhw_equal_int(segment, i32x8_splat((int32_t)first))) == 0xff) {
        const struct rhw_draw_state *const state = chunk->segments[first].draw->state;
        *low = f64x8_splat(state->depth_low);
        *span = f64x8_splat(state->depth_span);
        return;
    }
    double lows[BATCH], spans[BATCH];
    for (int i = 0; i < BATCH; i++) {
        const struct rhw_draw_state *const state = chunk->segments[read->triangle[i]->segment].draw->state;
        lows[i] = state->depth_low;
        spans[i] = state->depth_span;
    }
    memcpy(low, lows, sizeof lows);
    memcpy(span, spans, sizeof spans);
}

RHW_INLINE void setup_planes8(struct triangle_setup8 *setup, const struct triangle_words8 *words,
                              const struct rhw_chunk *chunk)
{
    const struct bin_batch *const read = setup->read;
    f32x8 position[3][4];
    for (int v = 0; v < 3; v++) {
        const void *place[BATCH];
        for (int i = 0; i < BATCH; i++) {
            place[i] = read->vertex[i][v]->position;
        }
        f32x8_load_columns(place, position[v]);
    }
    i32x8_store(setup->anchor_x, pixel_of_position8(words->x[0]));
    i32x8_store(setup->anchor_y, pixel_of_position8(words->y[0]));
    f64x8 low, span;
    depth_ranges8(read, words->segment, chunk, &low, &span);
    const f64x8 x1 = f64x8_from_i32x8(words->x[1] - words->x[0]),
                y1 = f64x8_from_i32x8(words->y[1] - words->y[0]),
                x2 = f64x8_from_i32x8(words->x[2] - words->x[0]),
                y2 = f64x8_from_i32x8(words->y[2] - words->y[0]),
                px = f64x8_from_i32x8(sample_from_position8(words->x[0])),
                py = f64x8_from_i32x8(sample_from_position8(words->y[0]));
    struct setup_input4
        first = {x1.lo, y1.lo, x2.lo, y2.lo, px.lo, py.lo, .depth_low = low.lo, .depth_span = span.lo},
        second = {x1.hi, y1.hi, x2.hi, y2.hi, px.hi, py.hi, .depth_low = low.hi, .depth_span = span.hi};
    for (int v = 0; v < 3; v++) {
        const f64x8 z = f64x8_from_f32x8(position[v][2]), w = f64x8_from_f32x8(position[v][3]);
        first.z[v] = z.lo;
        first.w[v] = w.lo;
        second.z[v] = z.hi;
        second.w[v] = w.hi;
    }
    setup->exact = 0;
    setup_planes_at(setup, 0, &first);
    setup_planes_at(setup, 4, &second);
}

// One triangle by itself ---------------------------------------------------------------------------------

// Return the input for one triangle in all lanes, without W and depth.
static inline struct setup_input4 setup_positions(const struct rhw_triangle *t)
{
    return (struct setup_input4){.x1 = f64x4_splat(t->x_24_8[1] - t->x_24_8[0]),
                                 .y1 = f64x4_splat(t->y_24_8[1] - t->y_24_8[0]),
                                 .x2 = f64x4_splat(t->x_24_8[2] - t->x_24_8[0]),
                                 .y2 = f64x4_splat(t->y_24_8[2] - t->y_24_8[0]),
                                 .px = f64x4_splat(sample_from_position(t->x_24_8[0])),
                                 .py = f64x4_splat(sample_from_position(t->y_24_8[0]))};
}

static inline struct setup_input4 setup_input(const struct triangle_work *triangle,
                                              const struct rhw_draw_state *state)
{
    struct setup_input4 input = setup_positions(triangle->t);
    input.depth_low = f64x4_splat(state->depth_low);
    input.depth_span = f64x4_splat(state->depth_span);
    for (int i = 0; i < 3; i++) {
        input.z[i] = f64x4_splat((double)triangle->v[i]->position[2]);
        input.w[i] = f64x4_splat((double)triangle->v[i]->position[3]);
    }
    return input;
}

// Set the planes of the weights on the screen.
static __attribute__((noinline)) void set_screen_planes(struct triangle_work *triangle)
{
    struct planes *const planes = &triangle->planes;
    const struct setup_input4 input = setup_positions(triangle->t);
    struct setup_output4 out;
    setup_edges4(&out, &input);
    planes->n1 = plane_scale(planes->inverse_area, plane_of_lane(&out.e1, 0));
    planes->n2 = plane_scale(planes->inverse_area, plane_of_lane(&out.e2, 0));
}

// Eight -------------------------------------------------------------------------------------------------

// Set what is known of the triangles without a look at their draws.
RHW_INLINE void setup_sets8(struct triangle_setup8 *setup, const struct triangle_words8 *words,
                            const struct tile_work *work)
{
    const i32x8 clamp = i32x8_splat(RHW_TRIANGLE_CLAMP), small = i32x8_splat(RHW_TRIANGLE_SMALL);
    const i32x8 asked = small | i32x8_splat(work->samples > 1 ? RHW_TRIANGLE_RECTANGLE : 0);
    const i32x8 first = i32x8_splat((int32_t)setup->read->triangle[0]->segment);
    setup->is_one_segment = i32x8_sign_bits(rhw_equal_int(words->segment, first)) == 0xff;
    setup->clamps = i32x8_sign_bits(rhw_equal_int(words->flags & clamp, clamp));
    setup->small = i32x8_sign_bits(rhw_equal_int(words->flags & asked, small)) & ~setup->exact;
    setup->tiny = 0;
}

// Set up the triangles that were read.
static void setup_triangles8(struct triangle_setup8 *setup, const struct tile_work *work,
                             const struct rhw_chunk *chunk, const struct bin_batch *read)
{
    const struct triangle_words8 words = load_words8(read, work);
    setup->read = read;
    setup_edges8(setup, &words, work);
    setup_planes8(setup, &words, chunk);
    setup_sets8(setup, &words, work);
}

#endif
