// SPDX-License-Identifier: MIT
// The front end makes these: shaded and snapped vertices, triangles, and the polygons that clipping leaves.
#ifndef RHW_TRIANGLE_H
#define RHW_TRIANGLE_H

#include <stdint.h>

#include "pipeline/shaded_vertex.h"
#include "rhw/types.h"

// Flags tell which sides of the view volume a vertex lies outside of, and why its triangles take the clipper.
enum rhw_vertex_flag {
    RHW_VERTEX_LEFT = 1,
    RHW_VERTEX_RIGHT = 2,
    RHW_VERTEX_BOTTOM = 4,
    RHW_VERTEX_TOP = 8,
    RHW_VERTEX_NEAR = 16,
    RHW_VERTEX_FAR = 32,
    RHW_VERTEX_UNSNAPPED = 64, // W <= 0 or beyond the guard band
    RHW_VERTEX_NOT_FINITE = 128,
    RHW_VERTEX_CLIP_DISTANCE = 1 << 8,  // clip distance i is below 0: shifted left by i
    RHW_VERTEX_CULL_DISTANCE = 1 << 16, // cull distance i is below 0: shifted left by i
    RHW_VERTEX_CUT = 0xff00,            // any clip distance is below 0
    RHW_VERTEX_OUTSIDE = 63 | RHW_VERTEX_CUT | 0xff0000,
    RHW_VERTEX_CLIP = RHW_VERTEX_NEAR | RHW_VERTEX_FAR | RHW_VERTEX_UNSNAPPED | RHW_VERTEX_CUT
};

// Culling and setup read this much of a vertex: the first 16 bytes of its record, next to those of other vertices.
struct rhw_snapped_vertex {
    int32_t x_24_8, y_24_8;
    float depth;
    uint32_t flags;
};

enum rhw_triangle_flag {
    RHW_TRIANGLE_BACK = 1,      // faces away
    RHW_TRIANGLE_NEGATIVE = 2,  // the vertices turn the other way on the screen
    RHW_TRIANGLE_POLYGON = 4,   // clipped: `polygon` has the coverage
    RHW_TRIANGLE_UNSNAPPED = 8, // values come from the homogeneous triangle
    RHW_TRIANGLE_CLAMP = 16,    // depth is clamped: rounding may lead it out of the viewport's range
    // The triangle is less than RHW_TILE pixels wide and high, and has no other flags but BACK and NEGATIVE.
    RHW_TRIANGLE_SMALL = 32,
    RHW_TRIANGLE_RECTANGLE = 64, // a point: it is drawn in the pixels x0, y0, x1, y1 of its coverage alone
    // A Bresenham line: the line from vertex 0 to vertex 2 is drawn, and not the area that the triangle covers.
    RHW_TRIANGLE_LINE = 128,
    RHW_TRIANGLE_CONSERVATIVE = 256, // the pixels that the triangle touches or contains are drawn
    // A smooth line: the vertices are three corners of a rectangle, which covers pixels in part.
    RHW_TRIANGLE_SMOOTH = 1024,
    RHW_TRIANGLE_STIPPLE = 512 // a line with a stipple: `phase` says where in the pattern it begins
};

// A triangle takes one cache line. Its vertices stay in submission order.
struct rhw_triangle {
    _Alignas(64) int32_t x_24_8[3];
    int32_t y_24_8[3];
    uint32_t vertex[3]; // slots in the segment's vertices
    uint32_t primitive; // number in its draw, counted on through the instances of the segment
    uint32_t segment;   // number of its segment in the chunk
    union {
        uint32_t polygon; // number in the chunk, with RHW_TRIANGLE_POLYGON
        int32_t phase;    // place in the pattern, with RHW_TRIANGLE_STIPPLE (raster/stipple_mask.h)
    };
    uint16_t flags;
    int16_t x0, y0, x1, y1; // pixels it may cover, within the scissor; x1 and y1 exclusive
    uint16_t layer;         // layer of the pass
};

// A clipped triangle has at most its own 3 vertices and one more for each of 6 planes and 8 clip distances.
enum { RHW_POLYGON_VERTICES = 3 + 6 + RHW_MAX_CLIP_DISTANCES };

// The coverage of a clipped triangle is the parity of the fan of triangles (0, i, i + 1). The parity counts each sample
// exactly once, even where snapping made the polygon slightly concave.
struct rhw_polygon {
    int32_t count;
    int32_t x_24_8[RHW_POLYGON_VERTICES], y_24_8[RHW_POLYGON_VERTICES];
};

#endif
