// SPDX-License-Identifier: MIT
// The clipper cuts triangles and lines in homogeneous coordinates, and snaps the positions that it finds.
#ifndef RHW_CLIP_H
#define RHW_CLIP_H

#include <stdbool.h>

#include "triangle.h"

struct rhw_draw_state;

// Clip a triangle against near, far and the guard band, and snap what is left. Return false if nothing is left. Only
// positions are clipped: values always come from the three original vertices, so clipping cannot show in them.
bool rhw_clip_triangle(const struct rhw_draw_state *state, const struct rhw_vertex_record *const vertices[3],
                       struct rhw_polygon *polygon);

// Clip a line against near, far, the guard band and the clip distances. The part that is left lies between t[0] and
// t[1], which are linear in the position: 0 at the first vertex and 1 at the second. Return false if nothing is left.
bool rhw_clip_line(const struct rhw_draw_state *state, const struct rhw_vertex_record *const vertices[2],
                   double t[2]);

// Return twice the signed area of a polygon in 1/65536 square pixels. It is exact.
int64_t rhw_polygon_area(const struct rhw_polygon *polygon);

// Return true if no triangle of the polygon's fan has an area, so that the polygon covers nothing. (A polygon that
// crosses itself may have no area as a whole and still cover samples.)
bool rhw_polygon_is_flat(const struct rhw_polygon *polygon);

#endif
