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
    int lane;                            // the triangle's lane in `setup`
    bool clamps_depth;                   // its depth may leave the range that depth is held to
    double depth_bias;                   // 0 where there is none
    // has_planes: `planes` is set. has_values: `v` and what stands below it are set.
    bool has_planes, has_values;
    // Room for the planes of a clipped triangle, on the path of large triangles. NULL where the triangle is not
    // clipped.
    struct clipped_planes *clipped;
    // Of a triangle drawn conservatively: pixels of the block under way whose squares it contains, where they are
    // wanted.
    uint64_t contained;
    // How much of the pixels of the block under way a smooth line covers, by row.
    const f32x8 *coverage;
    struct planes planes;
    const struct rhw_vertex_record *const *v; // the triangle's three vertices
    const float *provoking;
    float i0[RHW_MAX_VARYING_COMPONENTS], d1[RHW_MAX_VARYING_COMPONENTS], d2[RHW_MAX_VARYING_COMPONENTS];
    struct derivative_pair derivatives[RHW_MAX_VARYING_COMPONENTS / 2]; // set where they are wanted
};

#endif
