// SPDX-License-Identifier: MIT
// Bresenham lines (Vulkan 1.3 §28.10.1): of each column that an x-major line passes one pixel, of each row that a y-major
// one passes. A pixel is drawn where the line leaves the diamond |x − x_c| + |y − y_c| < 1/2 around its centre, both ends
// being moved by (−ε, −ε²), so that no end lies on a diamond's border and no line on the border of two pixels.
//
// What is found here is which columns: those whose centre the line passes; besides that of the beginning, where it begins
// within the diamond and beyond its centre; but that in whose diamond it ends. Which pixel of a column is found in the tile
// (tile/triangle_line.h). Wide lines repeat each pixel across.
#ifndef RHW_LINE_BRESENHAM_H
#define RHW_LINE_BRESENHAM_H

#include "../../pipeline.h"
#include "lines8.h"
#include "triangle_words.h"

// A line by its major and its minor axis, 24.8.
struct line_ends {
    int32_t major[2], minor[2];
    bool is_y_major;
};

// The pixel in which a coordinate lies that is moved by less than nothing: on the border of two, the lower.
static inline int32_t pixel_below(int32_t at)
{
    return ((at + RHW_SUBPIXEL - 1) >> RHW_SUBPIXEL_BITS) - 1;
}

// The first pixel whose centre is not before a coordinate.
static inline int32_t center_from(int32_t at)
{
    return (at + RHW_SUBPIXEL / 2 - 1) >> RHW_SUBPIXEL_BITS;
}

// Whether an end, moved by (−ε, −ε²), lies in the diamond of its pixel. On the border −ε decides: it leads inwards from the
// right half; where x is the centre's, there is no border but at the top, and outwards it leads.
static bool is_in_diamond(const struct line_ends *line, int end)
{
    const int32_t center = RHW_SUBPIXEL / 2;
    const int32_t u = line->major[end] - (pixel_below(line->major[end]) * RHW_SUBPIXEL + center);
    const int32_t v = line->minor[end] - (pixel_below(line->minor[end]) * RHW_SUBPIXEL + center);
    const int32_t x = line->is_y_major ? v : u, distance = (u < 0 ? -u : u) + (v < 0 ? -v : v);
    return distance < center || (distance == center && x > 0);
}

struct pixel_range {
    int32_t first, end;
};

// The columns, or rows, of which a line has a pixel.
static struct pixel_range major_pixels(const struct line_ends *line)
{
    const int forth = line->major[1] > line->major[0];
    struct pixel_range range = {center_from(line->major[!forth]), center_from(line->major[forth])};
    const int32_t begin = pixel_below(line->major[0]), end = pixel_below(line->major[1]);
    if (is_in_diamond(line, 0)) {
        range.first = begin < range.first ? begin : range.first;
        range.end = begin >= range.end ? begin + 1 : range.end;
    }
    if (is_in_diamond(line, 1) && forth) {
        range.end = end < range.end ? end : range.end;
    } else if (is_in_diamond(line, 1)) {
        range.first = end >= range.first ? end + 1 : range.first;
    }
    return range;
}

// Those across that the line may have a pixel in.
static struct pixel_range minor_pixels(const struct line_ends *line, int width)
{
    const bool rises = line->minor[1] > line->minor[0];
    return (struct pixel_range){(line->minor[!rises] >> RHW_SUBPIXEL_BITS) - 1,
                                (line->minor[rises] >> RHW_SUBPIXEL_BITS) + 1 + width};
}

// Of a wide line its first pixels across.
static struct line_ends ends_of(const struct lines8 *l, int lane, int width)
{
    const int32_t half = (width - 1) * (RHW_SUBPIXEL / 2);
    const int32_t dx = l->x[1][lane] - l->x[0][lane], dy = l->y[1][lane] - l->y[0][lane];
    const bool is_y_major = (dy < 0 ? -dy : dy) > (dx < 0 ? -dx : dx);
    const i8 *const major = is_y_major ? l->y : l->x, *const minor = is_y_major ? l->x : l->y;
    return (struct line_ends){
        {major[0][lane], major[1][lane]}, {minor[0][lane] - half, minor[1][lane] - half}, is_y_major};
}

// Sets the pixels of a line, within the scissor.
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

// Adds those of 8 lines that are `live` and have a pixel; returns their bits. Values come from a triangle with the ends and
// what lies straight beside the first: they are those of the point of the line that is nearest.
static unsigned add_bresenham8(const struct rhw_draw_state *state, const struct lines8 *l, unsigned live,
                               struct rhw_triangle_list *list)
{
    enum { BESIDE = 16 * RHW_SUBPIXEL }; // so far that rounding turns it by less than 2^−13
    const struct line_sides8 n = line_sides8(l, BESIDE);
    const i8 *const x = l->x, *const y = l->y;
    const struct triangle8 t = {.x = {x[0], x[0] - n.x, x[1]}, .y = {y[0], y[0] - n.y, y[1]}};
    const struct triangle_names8 names = {.vertex = {l->vertex[0], l->vertex[0], l->vertex[1]},
                                          .primitive = l->primitive,
                                          .segment = l->segment};
    const int width = state->pipeline->line_pixels;
    struct pixel_rect8 pixels = {i8_splat(0), i8_splat(0), i8_splat(0), i8_splat(0)};
    for (unsigned left = live & n.nonzero; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const struct line_ends line = ends_of(l, lane, width);
        set_pixels(&pixels, lane, &line, width, &state->scissor);
    }
    const unsigned drawn =
        live & n.nonzero &
        i8_sign_bits(rhw_less_int(pixels.x0, pixels.x1) & rhw_less_int(pixels.y0, pixels.y1));
    if (drawn == 0) {
        return 0;
    }
    // Beyond an end by half a pixel depth may leave the viewport's range.
    const i8 flags = l->flags | i8_splat(RHW_TRIANGLE_LINE | RHW_TRIANGLE_CLAMP);
    struct triangle_words words;
    struct rhw_tile_range ranges[8];
    fill_words(&words, &t, &pixels, flags, &names);
    tile_ranges8(ranges, pixels.x0, pixels.y0, pixels.x1, pixels.y1);
    for (unsigned left = drawn; left != 0; left &= left - 1) {
        add_words(list, &words, ranges, __builtin_ctz(left));
    }
    return drawn;
}

#endif
