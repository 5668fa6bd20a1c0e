// SPDX-License-Identifier: MIT
// The smallest triangles where pixels have 4 samples: those of a few columns, as in meshes that are finer than the
// picture. The lanes of a vector are the 4 samples of 2 pixels side by side, so that coverage and the early depth test
// of a triangle of two columns are one step for each of its rows, and its fragments are listed as they are found.
#ifndef RHW_TRIANGLE_TINY_SAMPLES_H
#define RHW_TRIANGLE_TINY_SAMPLES_H

#include "../fragment/gather.h"
#include "triangle_planes.h"

enum {
    TINY_SAMPLES = 4,
    TINY_PIXELS = RHW_LANES / TINY_SAMPLES, // of a vector; lane 2·s + p: sample s of pixel p
    TINY_COLUMNS = 6,
    TINY_ROWS = 16 // with as many columns no more fragments than can be gathered
};

_Static_assert(TINY_ROWS *(TINY_COLUMNS + TINY_PIXELS) <= RHW_GATHERED_FRAGMENTS,
               "the fragments of a triangle are listed without a look at their number");

// Where the samples of the lanes lie, for all triangles of a tile.
static struct tiny_lanes tiny_lanes_of(const struct rhw_sample_pattern *pattern)
{
    const i8 sample = rhw_lane_index >> 1, pixel = rhw_lane_index & i8_splat(1);
    const i8 x = i8_permute(i8_load(pattern->x_0_8), sample) + (pixel << RHW_SUBPIXEL_BITS),
             y = i8_permute(i8_load(pattern->y_0_8), sample);
    const d8 scale = d8_splat(1.0 / RHW_SUBPIXEL);
    return (struct tiny_lanes){x, y, d8_mul(d8_from_i8(x - SAMPLE_OFFSET_0_8), scale),
                               d8_mul(d8_from_i8(y - SAMPLE_OFFSET_0_8), scale)};
}

// Two columns of a triangle, or the last of a tile, of which a column may have been drawn.
struct tiny_columns {
    int x;
    i8 q[3], step[3]; // edges, and what they change by to the next row
    i8 sides;         // negative in lanes that are not drawn
    d8 column, dy;    // of depth: what depends on the column, and the rows of the lanes from the anchor
};

RHW_INLINE void tiny_columns_set(struct tiny_columns *columns, const struct tile_work *work,
                                 const struct triangle_work *triangle, int from)
{
    const struct tiny_lanes *const lanes = &work->tiny_lanes;
    const struct triangle_setup8 *const setup = triangle->setup;
    const int i = triangle->lane, x = min_int(from, RHW_TILE - TINY_PIXELS);
    const i8 dx = lanes->x + i8_splat((x - setup->x[i]) * RHW_SUBPIXEL);
    for (int e = 0; e < 3; e++) {
        const i8 a = i8_splat(setup->a[e][i]), b = i8_splat(setup->b[e][i]);
        columns->q[e] = i8_splat(setup->q[e][i]) + a * dx + b * lanes->y;
        columns->step[e] = b << RHW_SUBPIXEL_BITS;
    }
    const i8 pixel = i8_splat(x) + (rhw_lane_index & i8_splat(1));
    columns->x = x;
    columns->sides = (pixel - i8_splat(from)) | (i8_splat(setup->x1[i] - 1) - pixel);
    const uint32_t drawn = work->pipeline->def.sample_mask;
    if ((~drawn & ((1u << TINY_SAMPLES) - 1)) != 0) {
        columns->sides |= (i8)((u8)i8_splat((int32_t)~drawn) >> (u8)(rhw_lane_index >> 1)) << 31;
    }
    if (work->plan.tests_early) {
        const struct plane z = plane_of(&setup->quantities[i], QUANTITY_Z);
        const double right = work->x + x - setup->anchor_x[i],
                     down = work->y + setup->y0[i] - setup->anchor_y[i];
        columns->column = plane_column(z, d8_add(lanes->dx, d8_splat(right)));
        columns->dy = d8_add(lanes->dy, d8_splat(down));
    }
}

// What is drawn.
struct tiny_test {
    struct tile_work *work;
    const struct triangle_work *triangle;
};

// The depth of two pixels in four planes.
RHW_INLINE f8 tiny_depth(float *const texels[TINY_SAMPLES], int at)
{
    ul4 pairs;
    for (int s = 0; s < TINY_SAMPLES; s++) {
        uint64_t pair;
        memcpy(&pair, &texels[s][at], sizeof pair);
        pairs[s] = pair;
    }
    return (f8)pairs;
}

RHW_INLINE void tiny_depth_store(float *const texels[TINY_SAMPLES], int at, f8 depth)
{
    const ul4 pairs = (ul4)depth;
    for (int s = 0; s < TINY_SAMPLES; s++) {
        const uint64_t pair = pairs[s];
        memcpy(&texels[s][at], &pair, sizeof pair);
    }
}

// Open pixels of a row, lane by lane, where a test has to know them.
RHW_INLINE unsigned tiny_open(const struct tile_work *work, int x, int y, const struct rhw_depth_rule rule)
{
    unsigned open = 0;
    for (int s = 0; s < TINY_SAMPLES && rule.open >= RHW_OPEN_CLAIM; s++) {
        open |= (unsigned)(depth_plane(work->scratch, s)->open[y] >> x & 3) << (TINY_PIXELS * s);
    }
    return open;
}

// As settle_block does for the lanes of a row that passed.
RHW_INLINE i8 tiny_settle(const struct tile_work *work, int x, int y, i8 pass, unsigned open,
                          const struct rhw_depth_rule rule)
{
    if (rule.open != RHW_OPEN_CLAIM && rule.open != RHW_OPEN_MARK) {
        return pass;
    }
    unsigned bits = i8_sign_bits(pass);
    bits &= rule.open == RHW_OPEN_CLAIM ? open : 0xff;
    for (int s = 0; s < TINY_SAMPLES; s++) {
        uint64_t *const row = &depth_plane(work->scratch, s)->open[y];
        const uint64_t pixels = (uint64_t)(bits >> (TINY_PIXELS * s) & 3) << x;
        *row = rule.open == RHW_OPEN_CLAIM ? *row & ~pixels : *row | pixels;
    }
    if (rule.open == RHW_OPEN_MARK && bits != 0) {
        work->scratch->depth.marked = true;
    }
    return rule.open == RHW_OPEN_CLAIM ? i8_from_bits(bits) : pass;
}

// Lists the fragments of two pixels. `passed`: their samples, 4 bits of the one and 4 of the other.
RHW_INLINE void tiny_gather(struct gathered_fragments *gathered, int texel, unsigned passed)
{
    const int count = gathered->count, next = count + ((passed & 0xf) != 0);
    gathered->texel[count] = texel;
    gathered->samples[count] = (int32_t)(passed & 0xf);
    gathered->texel[next] = texel + 1;
    gathered->samples[next] = (int32_t)(passed >> TINY_SAMPLES);
    gathered->count = next + (passed >> TINY_SAMPLES != 0);
}

// Draws the triangle by a depth rule. Gives the pixels of its fragments, of all rows in one, where others wait.
RHW_INLINE uint64_t draw_tiny(const void *what, const struct rhw_depth_rule rule)
{
    const struct tiny_test *const test = what;
    struct tile_work *const work = test->work;
    const struct triangle_setup8 *const setup = test->triangle->setup;
    struct rhw_tile_scratch *const scratch = work->scratch;
    const int i = test->triangle->lane, y0 = setup->y0[i], y1 = setup->y1[i], x1 = setup->x1[i];
    const struct plane z = plane_of(&setup->quantities[i], QUANTITY_Z);
    const i8 by_pixel = {0, 2, 4, 6, 1, 3, 5, 7};
    const bool tests = work->plan.tests_early;
    float *texels[TINY_SAMPLES];
    for (int s = 0; s < TINY_SAMPLES; s++) {
        texels[s] = depth_plane(scratch, s)->texels;
    }
    uint64_t waiting = 0;
    for (int x = setup->x0[i]; x < x1; x += TINY_PIXELS) {
        struct tiny_columns columns;
        tiny_columns_set(&columns, work, test->triangle, x);
        for (int y = y0; y < y1; y++) {
            const int at = y * RHW_TILE + columns.x;
            i8 pass = ~((columns.q[0] | columns.q[1] | columns.q[2] | columns.sides) >> 31);
            for (int e = 0; e < 3; e++) {
                columns.q[e] += columns.step[e];
            }
            const d8 dy = columns.dy;
            columns.dy = d8_add(dy, d8_splat(1));
            if (i8_sign_bits(pass) == 0) {
                continue;
            }
            if (tests) {
                const f8 depth = f8_from_d8(d8_add(columns.column, plane_row(z, dy)));
                const f8 stored = tiny_depth(texels, at);
                const unsigned open = tiny_open(work, columns.x, y, rule);
                pass &= rule_passes(rule, depth, stored, open);
                if (rule.write) {
                    tiny_depth_store(texels, at, f8_select(pass, depth, stored));
                }
                pass = tiny_settle(work, columns.x, y, pass, open, rule);
            }
            const unsigned passed = i8_sign_bits(i8_permute(pass, by_pixel));
            if (passed != 0) {
                const uint64_t pixels = ((passed & 0xf) != 0) | (uint64_t)(passed >> TINY_SAMPLES != 0) << 1;
                waiting |= scratch->partial.pixels[y] & pixels << columns.x;
                tiny_gather(&scratch->gathered, at, passed);
            }
        }
    }
    return waiting;
}

// Whether a small triangle takes this path.
RHW_INLINE bool takes_tiny_samples(const struct tile_work *work, const struct triangle_work *triangle)
{
    const struct triangle_setup8 *const setup = triangle->setup;
    const int i = triangle->lane;
    return work->samples == TINY_SAMPLES && setup->x1[i] - setup->x0[i] <= TINY_COLUMNS &&
           setup->y1[i] - setup->y0[i] <= TINY_ROWS;
}

static __attribute__((noinline)) void draw_tiny_samples(struct tile_work *work,
                                                        struct triangle_work *triangle)
{
    struct gathered_fragments *const gathered = &work->scratch->gathered;
    const struct tiny_test test = {work, triangle};
    const uint64_t waiting = test_early(&work->plan, draw_tiny, &test);
    if (gathered->count == 0) {
        return;
    }
    if (work->plan.shading == RHW_SHADING_NONE) {
        gathered->count = 0;
        return;
    }
    work->counters->fragments += (uint64_t)gathered->count;
    copy_planes(work, triangle);
    gathered->overtakes = waiting != 0;
    finish_gathered(work, triangle);
}

#endif
