// SPDX-License-Identifier: MIT
// Rectangular lines (Vulkan 1.3 §28.9), 8 at a time, are drawn as the rectangles around them. From the snapped ends a
// and b, the vector n leads across by half the width, and is snapped too. The corners a ± n, b ± n are those of a
// parallelogram, exactly, which two triangles make up:
//
//     a + n ──────────────── b + n        (a + n, a − n, b + n) with vertices a, a, b
//       │        ╲             │          (a − n, b − n, b + n) with vertices a, b, b
//     a − n ──────────────── b − n
//
// So coverage is that of triangles. What varies along the line is linear from a to b and constant across it. The first
// vertex of both triangles is a, and the last one is b, for flat values.
#ifndef RHW_LINE_RECTANGLE_H
#define RHW_LINE_RECTANGLE_H

#include "cull_uncovered.h"
#include "line_bresenham.h"
#include "line_smooth.h"

// 8 of the triangles that lines are made of, without those that cover nothing.
struct line_half8 {
    struct triangle_words words;
    struct rhw_tile_range ranges[8];
    unsigned drawn;
};

static void set_half8(struct line_half8 *half, const struct rhw_draw_state *state, const struct lines8 *l,
                      const struct triangle8 *t, i32x8 middle, unsigned live,
                      const struct rhw_sample_pattern *pattern)
{
    const struct pixel_rect8 pixels = pixel_rect8_of(t, state);
    const i32x8 plain =
        rhw_equal_int(l->flags & i32x8_splat(RHW_TRIANGLE_CLAMP | RHW_TRIANGLE_STIPPLE), i32x8_splat(0));
    const i32x8 flags = l->flags | (small_triangles8(t) & plain & i32x8_splat(RHW_TRIANGLE_SMALL));
    const struct triangle_names8 names = {
        .vertex = {l->vertex[0], middle, l->vertex[1]}, .primitive = l->primitive, .segment = l->segment};
    half->drawn =
        live & i32x8_sign_bits(rhw_less_int(pixels.x0, pixels.x1) & rhw_less_int(pixels.y0, pixels.y1));
    if (half->drawn != 0 && pattern) {
        half->drawn &= ~uncovered8(t, &pixels, 0, pattern);
    }
    if (half->drawn != 0) {
        fill_words(&half->words, t, &pixels, flags, &names);
        if (state->stipple.factor != 0) {
            set_phases(&half->words, l->phase);
        }
        tile_ranges8(half->ranges, pixels.x0, pixels.y0, pixels.x1, pixels.y1);
    }
}

// Add the lines of 8 that are `live` and cover something. Return their bits.
static unsigned add_rectangles8(struct rhw_geometry_scratch *scratch, const struct rhw_draw_state *state,
                                const struct lines8 *l, unsigned live, struct rhw_triangle_list *list)
{
    const struct line_sides8 n = line_sides8(l, state->half_width_24_8);
    const i32x8 *const x = l->x, *const y = l->y;
    const struct triangle8 first = {.x = {x[0] + n.x, x[0] - n.x, x[1] + n.x},
                                    .y = {y[0] + n.y, y[0] - n.y, y[1] + n.y}};
    const struct triangle8 second = {.x = {x[0] - n.x, x[1] - n.x, x[1] + n.x},
                                     .y = {y[0] - n.y, y[1] - n.y, y[1] + n.y}};
    struct line_half8 halves[2];
    set_half8(&halves[0], state, l, &first, l->vertex[0], live & n.nonzero, scratch->uncovered_pattern);
    set_half8(&halves[1], state, l, &second, l->vertex[1], live & n.nonzero, scratch->uncovered_pattern);
    const unsigned drawn = halves[0].drawn | halves[1].drawn;
    for (unsigned left = drawn; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        for (int h = 0; h < 2; h++) {
            if (halves[h].drawn >> lane & 1) {
                add_words(list, &halves[h].words, halves[h].ranges, lane);
            }
        }
    }
    return drawn;
}

// Add lines of any mode.
static unsigned add_lines8(struct rhw_geometry_scratch *scratch, const struct rhw_draw_state *state,
                           const struct lines8 *l, unsigned live, struct rhw_triangle_list *list)
{
    return state->pipeline->def.line_mode == RHW_LINE_BRESENHAM ? add_bresenham8(state, l, live, list)
           : state->pipeline->is_smooth                         ? add_smooth8(state, l, live, list)
                                        : add_rectangles8(scratch, state, l, live, list);
}

#endif
