// SPDX-License-Identifier: MIT
// Bresenham lines (Vulkan 1.3 §28.10.1) have one pixel of each column that an x-major line passes, and of each row that
// a y-major line passes. A pixel is drawn where the line leaves the diamond |x − x_c| + |y − y_c| < 1/2 around its
// centre. Both ends are moved by (−ε, −ε²), so that no end lies on a diamond's border and no line on the border of two
// pixels.
//
// The columns are found here. They are the columns whose centre the line passes, with two exceptions. The column of the
// beginning is added where the line begins within the diamond and beyond its centre. The column in whose diamond the
// line ends is left out. The pixel of a column is found in the tile (raster/line_pixels.h). Wide lines repeat each
// pixel across.
#ifndef RHW_LINE_BRESENHAM_H
#define RHW_LINE_BRESENHAM_H

#include "pipeline/pipeline.h"
#include "line_columns.h"
#include "lines8.h"
#include "triangle_words.h"

// Return the pixels across in which the line may have a pixel.
static struct pixel_range minor_pixels(const struct line_ends *line, int width)
{
    const bool rises = line->minor[1] > line->minor[0];
    return (struct pixel_range){(line->minor[!rises] >> RHW_SUBPIXEL_BITS) - 1,
                                (line->minor[rises] >> RHW_SUBPIXEL_BITS) + 1 + width};
}

static struct line_ends ends_of(const struct lines8 *l, int lane, int width)
{
    const int32_t x[2] = {l->x[0][lane], l->x[1][lane]}, y[2] = {l->y[0][lane], l->y[1][lane]};
    return line_ends_of(x, y, width);
}

// Give 8 lines the phase of column 0, or of row 0, from the phase of their first one.
static __attribute__((noinline)) void set_column_phases(struct triangle_words *words, const struct lines8 *l,
                                                        unsigned drawn, int width)
{
    i32x8 phase = i32x8_splat(0);
    for (unsigned left = drawn; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const struct line_ends line = ends_of(l, lane, width);
        const struct pixel_range along = major_pixels(&line);
        phase[lane] = l->phase[lane] + (line.major[1] > line.major[0] ? -along.first : along.end - 1);
    }
    set_phases(words, phase);
}

// Set the pixels of a line, within the scissor.
static void set_pixels(struct pixel_rect8 *pixels, int lane, const struct line_ends *line, int width,
                       const struct rhw_rect *scissor)
{
    const struct pixel_range along = major_pixels(line), across = minor_pixels(line, width);
    const struct pixel_range x = line->is_y_major ? across : along, y = line->is_y_major ? along : across;
    const int32_t right = scissor->x + scissor->width, bottom = scissor->y + scissor->height;
    pixels->x0[lane] = x.first > scissor->x ? x.first : scissor->x;
    pixels->y0[lane] = y.first > scissor->y ? y.first : scissor->y;
    pixels->x1[lane] = x.end < right ? x.end : right;
    pixels->y1[lane] = y.end < bottom ? y.end : bottom;
}

// Add the lines of 8 that are `live` and have a pixel. Return their bits. Values come from a triangle with the ends and
// a point straight beside the first end: they are the values of the point of the line that is nearest.
static unsigned add_bresenham8(const struct rhw_draw_state *state, const struct lines8 *l, unsigned live,
                               struct rhw_triangle_list *list)
{
    // The distance of the third point. It is so far that rounding turns the triangle by less than 2^−13.
    enum { BESIDE = 16 * RHW_SUBPIXEL };
    const struct line_sides8 n = line_sides8(l, BESIDE);
    const i32x8 *const x = l->x, *const y = l->y;
    const struct triangle8 t = {.x = {x[0], x[0] - n.x, x[1]}, .y = {y[0], y[0] - n.y, y[1]}};
    const struct triangle_names8 names = {.vertex = {l->vertex[0], l->vertex[0], l->vertex[1]},
                                          .primitive = l->primitive,
                                          .segment = l->segment};
    const int width = state->line_pixels;
    struct pixel_rect8 pixels = {i32x8_splat(0), i32x8_splat(0), i32x8_splat(0), i32x8_splat(0)};
    for (unsigned left = live & n.nonzero; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const struct line_ends line = ends_of(l, lane, width);
        set_pixels(&pixels, lane, &line, width, &state->scissor);
    }
    const unsigned drawn =
        live & n.nonzero &
        i32x8_sign_bits(rhw_less_int(pixels.x0, pixels.x1) & rhw_less_int(pixels.y0, pixels.y1));
    if (drawn == 0) {
        return 0;
    }
    // Beyond an end by half a pixel depth may leave the viewport's range.
    const i32x8 flags = l->flags | i32x8_splat(RHW_TRIANGLE_LINE | RHW_TRIANGLE_CLAMP);
    struct triangle_words words;
    struct rhw_tile_range ranges[8];
    fill_words(&words, &t, &pixels, flags, &names);
    if (state->stipple.factor != 0) {
        set_column_phases(&words, l, drawn, width);
    }
    tile_ranges8(ranges, pixels.x0, pixels.y0, pixels.x1, pixels.y1);
    for (unsigned left = drawn; left != 0; left &= left - 1) {
        add_words(list, &words, ranges, __builtin_ctz(left));
    }
    return drawn;
}

#endif
