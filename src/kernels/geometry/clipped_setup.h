// SPDX-License-Identifier: MIT
// Setup of a triangle that a plane may cut, or that has a vertex that cannot be snapped. What clipping leaves of the
// triangle tells where it is drawn; its values stay those of its own three vertices.
#ifndef RHW_CLIPPED_SETUP_H
#define RHW_CLIPPED_SETUP_H

#include "draw/clip.h"
#include "kernels/integer.h"
#include "kernels/raster/sample_position.h"
#include "kernels/raster/vertex_record.h"
#include "facing.h"
#include "geometry_scratch.h"

// Return true if the triangle turns the negative way on the screen before it is snapped. The determinant of the
// vertices' (X, Y, W) is above 0 where they turn counter-clockwise with y up.
static bool homogeneous_turns_negative(const struct rhw_draw_state *state,
                                       const struct rhw_vertex_record *const v[3])
{
    const float *const a = v[0]->position, *const b = v[1]->position, *const c = v[2]->position;
    const double turn = (double)a[3] * ((double)b[0] * (double)c[1] - (double)b[1] * (double)c[0]) +
                        (double)b[3] * ((double)c[0] * (double)a[1] - (double)c[1] * (double)a[0]) +
                        (double)c[3] * ((double)a[0] * (double)b[1] - (double)a[1] * (double)b[0]);
    return state->half_height < 0 ? turn < 0 : turn > 0;
}

// Return true if the triangle turns the negative way on the screen. Vertices that the clipper makes are snapped on
// their own: a triangle without area may leave a polygon with area, and a thin polygon may cross itself, so that its
// halves turn opposite ways and their areas add up to nothing. So the triangle is asked first, then the polygon, then
// the triangle before it was snapped.
static bool turns_negative(const struct rhw_draw_state *state, const struct rhw_vertex_record *const v[3],
                           bool snapped, const struct rhw_polygon *polygon)
{
    const int64_t x1 = v[1]->x_24_8 - v[0]->x_24_8, y1 = v[1]->y_24_8 - v[0]->y_24_8;
    const int64_t x2 = v[2]->x_24_8 - v[0]->x_24_8, y2 = v[2]->y_24_8 - v[0]->y_24_8;
    int64_t area = snapped ? x1 * y2 - x2 * y1 : 0;
    if (area == 0) {
        area = rhw_polygon_area(polygon);
    }
    return area != 0 ? area < 0 : homogeneous_turns_negative(state, v);
}

// Set the pixels that the polygon may cover, within the state's scissor. Return false where there is none.
static bool bound_polygon(struct rhw_triangle *triangle, const struct rhw_polygon *polygon,
                          const struct rhw_draw_state *state)
{
    const struct rhw_rect *const scissor = &state->scissor;
    const int32_t first = state->first_step, past = state->past_step;
    int32_t low_x = polygon->x_24_8[0], high_x = low_x, low_y = polygon->y_24_8[0], high_y = low_y;
    for (int i = 1; i < polygon->count; i++) {
        low_x = min_int(low_x, polygon->x_24_8[i]);
        high_x = max_int(high_x, polygon->x_24_8[i]);
        low_y = min_int(low_y, polygon->y_24_8[i]);
        high_y = max_int(high_y, polygon->y_24_8[i]);
    }
    const int x0 = max_int(pixel_of_step(low_x, first), scissor->x);
    const int y0 = max_int(pixel_of_step(low_y, first), scissor->y);
    const int x1 = min_int(pixel_of_step(high_x, past), scissor->x + scissor->width);
    const int y1 = min_int(pixel_of_step(high_y, past), scissor->y + scissor->height);
    triangle->x0 = (int16_t)x0;
    triangle->y0 = (int16_t)y0;
    triangle->x1 = (int16_t)x1;
    triangle->y1 = (int16_t)y1;
    return x0 < x1 && y0 < y1;
}

// Clip the triangle, whose vertices are set, and set the rest. Return false where nothing is left to draw, and count
// the triangle.
static bool setup_clipped(struct rhw_geometry_scratch *scratch, const struct rhw_segment *segment,
                          struct rhw_triangle *triangle)
{
    const struct rhw_draw_state *const state = segment->draw->state;
    const struct rhw_pipeline_def *const def = &state->pipeline->def;
    const struct rhw_vertex_record *v[3];
    uint32_t any = 0, all = ~0u;
    for (int i = 0; i < 3; i++) {
        v[i] = record_at(segment, triangle->vertex[i]);
        any |= v[i]->flags;
        all &= v[i]->flags;
    }
    if (any & RHW_VERTEX_NOT_FINITE) {
        scratch->counters.dropped++;
        return false;
    }
    struct rhw_polygon *const polygon = &scratch->polygons[scratch->polygon_count];
    if ((all & RHW_VERTEX_OUTSIDE) || !rhw_clip_triangle(state, v, polygon)) {
        scratch->counters.culled++;
        return false;
    }
    scratch->counters.clipped++;
    const unsigned negative = turns_negative(state, v, !(any & RHW_VERTEX_UNSNAPPED), polygon);
    const unsigned back = facing_back(def, negative) & 1;
    if (rhw_polygon_is_flat(polygon) || (culled_facing(def, back) & 1) ||
        !bound_polygon(triangle, polygon, state)) {
        scratch->counters.culled++;
        return false;
    }
    triangle->flags = (uint16_t)(RHW_TRIANGLE_POLYGON | RHW_TRIANGLE_CLAMP | (back ? RHW_TRIANGLE_BACK : 0) |
                                 (negative ? RHW_TRIANGLE_NEGATIVE : 0) |
                                 (any & RHW_VERTEX_UNSNAPPED ? RHW_TRIANGLE_UNSNAPPED : 0) |
                                 (state->pipeline->is_conservative ? RHW_TRIANGLE_CONSERVATIVE : 0));
    triangle->polygon = (uint32_t)scratch->polygon_count++;
    return true;
}

#endif
