// SPDX-License-Identifier: MIT
// Boxes along the axes, in double.
#ifndef SCENE_BOX_H
#define SCENE_BOX_H

#include <stdbool.h>

struct scene_box {
    double low[3], high[3];
};

/// Return a box that holds nothing: what it is extended by is its first content.
static inline struct scene_box scene_box_empty(void)
{
    return (struct scene_box){{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}};
}

static inline struct scene_box scene_box_of(const float low[3], const float high[3])
{
    struct scene_box box;
    for (int c = 0; c < 3; c++) {
        box.low[c] = (double)low[c];
        box.high[c] = (double)high[c];
    }
    return box;
}

static inline void scene_box_extend(struct scene_box *box, const struct scene_box *by)
{
    for (int c = 0; c < 3; c++) {
        box->low[c] = by->low[c] < box->low[c] ? by->low[c] : box->low[c];
        box->high[c] = by->high[c] > box->high[c] ? by->high[c] : box->high[c];
    }
}

static inline void scene_box_extend_to(struct scene_box *box, const double point[3])
{
    for (int c = 0; c < 3; c++) {
        box->low[c] = point[c] < box->low[c] ? point[c] : box->low[c];
        box->high[c] = point[c] > box->high[c] ? point[c] : box->high[c];
    }
}

/// Return a box whose sides lie `room` further out.
static inline struct scene_box scene_box_grown(const struct scene_box *box, double room)
{
    struct scene_box grown = *box;
    for (int c = 0; c < 3; c++) {
        grown.low[c] -= room;
        grown.high[c] += room;
    }
    return grown;
}

/// Write one of the eight corners.
static inline void scene_box_corner(const struct scene_box *box, int number, double corner[3])
{
    for (int c = 0; c < 3; c++) {
        corner[c] = number >> c & 1 ? box->high[c] : box->low[c];
    }
}

static inline double scene_box_longest(const struct scene_box *box)
{
    double longest = 0.0;
    for (int c = 0; c < 3; c++) {
        const double side = box->high[c] - box->low[c];
        longest = side > longest ? side : longest;
    }
    return longest;
}

static inline double scene_box_diagonal(const struct scene_box *box)
{
    double square = 0.0;
    for (int c = 0; c < 3; c++) {
        const double side = box->high[c] - box->low[c];
        square += side * side;
    }
    return __builtin_sqrt(square);
}

static inline bool scene_box_overlaps(const struct scene_box *a, const struct scene_box *b)
{
    bool meets = true;
    for (int c = 0; c < 3; c++) {
        meets = meets && a->low[c] <= b->high[c] && a->high[c] >= b->low[c];
    }
    return meets;
}

static inline bool scene_box_has(const struct scene_box *box, const double point[3])
{
    bool inside = true;
    for (int c = 0; c < 3; c++) {
        inside = inside && point[c] >= box->low[c] && point[c] <= box->high[c];
    }
    return inside;
}

/// Return true if a point lies within the box and not on its sides.
static inline bool scene_box_surrounds(const struct scene_box *box, const double point[3])
{
    bool inside = true;
    for (int c = 0; c < 3; c++) {
        inside = inside && point[c] > box->low[c] && point[c] < box->high[c];
    }
    return inside;
}

static inline bool scene_box_holds(const struct scene_box *box, const struct scene_box *inner)
{
    bool inside = true;
    for (int c = 0; c < 3; c++) {
        inside = inside && inner->low[c] >= box->low[c] && inner->high[c] <= box->high[c];
    }
    return inside;
}

#endif
