// SPDX-License-Identifier: MIT
// Smooth lines (Vulkan 1.3 §28.10, smooth lines). A line is one triangle, the first one of its rectangle
// (line_rectangle.h), which gives the values and three of the corners. How much of each pixel the rectangle covers is
// found in the tile (raster/smooth_coverage.h).
#ifndef RHW_LINE_SMOOTH_H
#define RHW_LINE_SMOOTH_H

#include "pipeline/pipeline.h"
#include "lines8.h"
#include "triangle_words.h"

// Set the pixels from one end to the other, `beside` to each side, that are within the scissor.
static void set_touched8(const i32x8 ends[2], i32x8 side, int scissor, int size, i32x8 *first, i32x8 *past)
{
    const i32x8 beside = i32x8_max(side, -side);
    const i32x8 least = i32x8_min(ends[0], ends[1]) - beside, most = i32x8_max(ends[0], ends[1]) + beside;
    *first = i32x8_max(least >> RHW_SUBPIXEL_BITS, i32x8_splat(scissor));
    *past =
        i32x8_min((most + i32x8_splat(RHW_SUBPIXEL - 1)) >> RHW_SUBPIXEL_BITS, i32x8_splat(scissor + size));
}

// Add the lines of 8 that are `live` and touch a pixel. Return their bits.
static __attribute__((noinline)) unsigned add_smooth8(const struct rhw_draw_state *state,
                                                      const struct lines8 *l, unsigned live,
                                                      struct rhw_triangle_list *list)
{
    const struct rhw_rect *const scissor = &state->scissor;
    const struct line_sides8 n = line_sides8(l, state->half_width_24_8);
    const i32x8 *const x = l->x, *const y = l->y;
    const struct triangle8 t = {.x = {x[0] + n.x, x[0] - n.x, x[1] + n.x},
                                .y = {y[0] + n.y, y[0] - n.y, y[1] + n.y}};
    const struct triangle_names8 names = {.vertex = {l->vertex[0], l->vertex[0], l->vertex[1]},
                                          .primitive = l->primitive,
                                          .segment = l->segment};
    struct pixel_rect8 pixels;
    set_touched8(x, n.x, scissor->x, scissor->width, &pixels.x0, &pixels.x1);
    set_touched8(y, n.y, scissor->y, scissor->height, &pixels.y0, &pixels.y1);
    const unsigned drawn =
        live & n.nonzero &
        i32x8_sign_bits(rhw_less_int(pixels.x0, pixels.x1) & rhw_less_int(pixels.y0, pixels.y1));
    if (drawn == 0) {
        return 0;
    }
    // Centres of pixels may lie beyond the line's ends, where depth may leave the viewport's range.
    const i32x8 flags = l->flags | i32x8_splat(RHW_TRIANGLE_SMOOTH | RHW_TRIANGLE_CLAMP);
    struct triangle_words words;
    struct rhw_tile_range ranges[8];
    fill_words(&words, &t, &pixels, flags, &names);
    if (state->stipple.factor != 0) {
        set_phases(&words, l->phase);
    }
    tile_ranges8(ranges, pixels.x0, pixels.y0, pixels.x1, pixels.y1);
    for (unsigned left = drawn; left != 0; left &= left - 1) {
        add_words(list, &words, ranges, __builtin_ctz(left));
    }
    return drawn;
}

#endif
