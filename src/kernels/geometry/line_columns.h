// SPDX-License-Identifier: MIT
// The columns of a Bresenham line, or its rows where it is steep, in whole numbers. geometry/line_bresenham.h has the
// rule.
#ifndef RHW_LINE_COLUMNS_H
#define RHW_LINE_COLUMNS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/constants.h"

// A line by its major and its minor axis, 24.8.
struct line_ends {
    int32_t major[2], minor[2];
    bool is_y_major;
};

// Return the ends of a line from its ends on the screen. Of a wide line they are those of the first pixels across.
static inline struct line_ends line_ends_of(const int32_t x[2], const int32_t y[2], int width)
{
    const int32_t half = (width - 1) * (RHW_SUBPIXEL / 2);
    const int32_t dx = x[1] - x[0], dy = y[1] - y[0];
    const bool is_y_major = (dy < 0 ? -dy : dy) > (dx < 0 ? -dx : dx);
    const int32_t *const major = is_y_major ? y : x, *const minor = is_y_major ? x : y;
    return (struct line_ends){{major[0], major[1]}, {minor[0] - half, minor[1] - half}, is_y_major};
}

// Return the pixel in which a coordinate lies that is moved down by an infinitely small step: on the border of two
// pixels, the lower one.
static inline int32_t pixel_below(int32_t at)
{
    return ((at + RHW_SUBPIXEL - 1) >> RHW_SUBPIXEL_BITS) - 1;
}

// Return the first pixel whose centre is not before a coordinate.
static inline int32_t center_from(int32_t at)
{
    return (at + RHW_SUBPIXEL / 2 - 1) >> RHW_SUBPIXEL_BITS;
}

// Return true if an end, moved by (−ε, −ε²), lies in the diamond of its pixel. On the border −ε decides: it leads
// inwards from the right half. Where x is the centre's, the border has the top corner alone, and there the move leads
// outwards.
static inline bool is_in_diamond(const struct line_ends *line, int end)
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

// Return the columns, or rows, of which a line has a pixel.
static inline struct pixel_range major_pixels(const struct line_ends *line)
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

#endif
