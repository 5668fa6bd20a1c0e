// SPDX-License-Identifier: MIT
// A shaded vertex as the tiles read it. A pipeline knows the places of its numbers, and transform feedback copies them
// from there.
#ifndef RHW_SHADED_VERTEX_H
#define RHW_SHADED_VERTEX_H

#include <stdint.h>

// This is the header of a record. Behind it stand the varyings' components, and what else the front end needs of the
// vertex (struct rhw_pipeline_data has their places), padded to 32 bytes.
// All numbers of one vertex stand together because a triangle needs all of them at once.
struct rhw_vertex_record {
    int32_t x_24_8, y_24_8; // snapped; meaningless with RHW_VERTEX_UNSNAPPED
    float depth;            // after the viewport's depth range, rounded: for culling and clamping
    uint32_t flags;         // or-ed rhw_vertex_flag (draw/triangle.h)
    float position[4];      // homogeneous clip coordinates
    float varyings[];
};

// Floats per vertex record.
static inline int rhw_vertex_stride(int components)
{
    return (8 + components + 7) & ~7;
}

#endif
