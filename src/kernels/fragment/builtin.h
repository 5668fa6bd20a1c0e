// SPDX-License-Identifier: MIT
// A fragment function receives facing, ids, coordinates and barycentric weights beside varyings.
#ifndef RHW_BUILTIN_H
#define RHW_BUILTIN_H

#include "kernels/raster/sample_position.h"
#include "kernels/tile_work.h"
#include "kernels/triangle_work.h"

struct identity {
    int32_t front_facing, primitive, instance, draw; // members of struct rhw_fragment
};

static inline struct identity identity_of(const struct triangle_work *triangle)
{
    const struct rhw_draw *const draw = triangle->segment->draw;
    const struct rhw_primitive_id id = rhw_primitive_id_of(triangle->segment, triangle->t->primitive);
    return (struct identity){.front_facing = triangle->t->flags & RHW_TRIANGLE_BACK ? 0 : -1,
                             .primitive = (int32_t)id.primitive,
                             .instance = (int32_t)(draw->first_instance + id.instance),
                             .draw = (int32_t)draw->index};
}

// Set what all fragments of a triangle share.
RHW_INLINE void fill_identity(struct rhw_fragment *group, uint32_t uses, const struct triangle_work *triangle)
{
    const struct identity identity = identity_of(triangle);
    if (uses & RHW_USE_FACING) {
        group->front_facing = i32x8_splat(identity.front_facing);
    }
    if (uses & RHW_USE_IDS) {
        group->primitive = i32x8_splat(identity.primitive);
        group->instance = i32x8_splat(identity.instance);
        group->draw = i32x8_splat(identity.draw);
    }
}

// Return a coordinate of 8 pixels side by side, or one below the other, at a position in them.
RHW_INLINE f32x8 coordinate_of_pixels(int first, float position)
{
    return rhw_float_from_int(i32x8_splat(first) + rhw_lane_index) + f32x8_splat(position);
}

// Set the coordinates of 8 texels of the tile, at a position in their pixels. The group has their depth already.
static void fill_coordinates(const struct tile_work *work, struct rhw_fragment *group, i32x8 texels,
                             const float position[2], f64x8 inverse_w)
{
    const i32x8 x = texels & i32x8_splat(RHW_TILE - 1), y = texels >> RHW_TILE_LOG2;
    group->coord[0] = rhw_float_from_int(x + i32x8_splat(work->x)) + f32x8_splat(position[0]);
    group->coord[1] = rhw_float_from_int(y + i32x8_splat(work->y)) + f32x8_splat(position[1]);
    group->coord[2] = group->depth;
    group->coord[3] = f32x8_from_f64x8(inverse_w);
}

// Set the coordinates in a point. A point is half of the triangle that stands for it, each way
// (geometry/point_setup.h): its coordinates are twice the weights on the screen of vertices 1 and 2.
static void fill_point_coord(struct rhw_fragment *group, f32x8 s, f32x8 t)
{
    group->point_coord[0] = s + s;
    group->point_coord[1] = t + t;
}

// Set what a fragment function is told of samples if a pixel has one.
static void fill_one_sample(struct rhw_fragment *group)
{
    group->sample_mask = i32x8_splat(1);
    group->sample_id = i32x8_splat(0);
    group->sample_position[0] = group->sample_position[1] = f32x8_splat((float)sample_offset());
}

// Set the weights of three vertices, of which two are known. `sum` is 1 for weights, and 0 for their derivatives.
static void fill_barycentrics(f32x8 out[3], float sum, f32x8 b, f32x8 c)
{
    out[0] = (f32x8_splat(sum) - b) - c;
    out[1] = b;
    out[2] = c;
}

#endif
