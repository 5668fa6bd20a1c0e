// SPDX-License-Identifier: MIT
// The triangle that a tile draws, and what is made of it when its first fragments survive.
#ifndef RHW_TRIANGLE_WORK_H
#define RHW_TRIANGLE_WORK_H

#include "draw/draw_list.h"
#include "kernels/raster/plane.h"

struct clipped_planes;
struct rhw_chunk;
struct triangle_setup8;

struct triangle_work {
    const struct rhw_chunk *chunk;
    const struct rhw_segment *segment;
    const struct rhw_triangle *t;
    const struct triangle_setup8 *setup; // what was made of it and of 7 others
    int lane;                            // in them
    bool clamps_depth;                   // it may leave the range that depth is held to
    double depth_bias;                   // 0 where there is none
    bool has_planes, has_values;         // `planes` and `v` are set; what stands below them is
    struct clipped_planes
        *clipped; // room for them, on the path of large triangles; NULL where it is not clipped
    // Of a triangle drawn conservatively: pixels of the block under way whose squares it contains, where they are wanted.
    uint64_t contained;
    const f32x8 *coverage; // of a smooth line: how much of the pixels of that block it covers, by row
    struct planes planes;
    const struct rhw_vertex_record *const *v; // its three
    const float *provoking;
    float i0[RHW_MAX_VARYING_COMPONENTS], d1[RHW_MAX_VARYING_COMPONENTS], d2[RHW_MAX_VARYING_COMPONENTS];
    struct derivative_pair derivatives[RHW_MAX_VARYING_COMPONENTS / 2]; // where they are wanted
};

#endif
