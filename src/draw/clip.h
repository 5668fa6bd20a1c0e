// SPDX-License-Identifier: MIT
// Homogeneous clipping, and the snapping of positions.
#ifndef RHW_CLIP_H
#define RHW_CLIP_H

#include <stdbool.h>

#include "triangle.h"

struct rhw_draw_state;

// Clips a triangle against near, far and the guard band and snaps what is left. False when nothing is.
// Only positions are clipped: values always come from the three original vertices, so clipping cannot show
// in them.
bool rhw_clip_triangle(const struct rhw_draw_state *state, const struct rhw_vertex_record *const vertices[3],
                       struct rhw_polygon *polygon);

// Clips a line against the same and finds the part that is left: from t[0] to t[1], 0 and 1 at its vertices, where
// positions are linear. False when nothing is.
bool rhw_clip_line(const struct rhw_draw_state *state, const struct rhw_vertex_record *const vertices[2],
                   double t[2]);

// Twice the signed area of a polygon in 1/65536 square pixels; exact.
int64_t rhw_polygon_area(const struct rhw_polygon *polygon);

// Whether every triangle of its fan has no area: it covers nothing. (A polygon that crosses itself may have none and
// cover samples.)
bool rhw_polygon_is_flat(const struct rhw_polygon *polygon);

#endif
