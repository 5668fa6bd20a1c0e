// SPDX-License-Identifier: MIT
// Cubes: the way from a direction to a face and coordinates on it, what gradients become there, and the texels across a
// face's edges (Vulkan 1.3, "Cube Map Face Selection", "Cube Map Coordinate Transformation", "Cube Map Derivative
// Transformation", "Cube Map Edge Handling").
#ifndef RHW_CUBE_H
#define RHW_CUBE_H

#include "base/simd.h"

// Axes of a vector with respect to a face: along its s and t, and along its normal, positive on the face.
struct face_axes {
    f32x8 s, t, major;
};

struct cube_face {
    i32x8 number;      // 0..5: +x, −x, +y, −y, +z, −z
    i32x8 is_x, is_y;  // masks; neither is set for z
    i32x8 is_negative; // mask
};

// Return the face that a direction goes through. Of equal components z wins over y, and y over x.
static inline struct cube_face face_of(const f32x8 direction[3])
{
    const f32x8 x = rhw_abs(direction[0]), y = rhw_abs(direction[1]), z = rhw_abs(direction[2]);
    const i32x8 is_z = rhw_less_equal(x, z) & rhw_less_equal(y, z);
    const i32x8 is_y = ~is_z & rhw_less_equal(x, y);
    const i32x8 is_x = ~is_z & ~is_y;
    const f32x8 major = rhw_select(is_x, direction[0], rhw_select(is_y, direction[1], direction[2]));
    const i32x8 is_negative = rhw_less(major, rhw_splat(0.0f));
    return (struct cube_face){.number = (is_y & 2) + (is_z & 4) - is_negative,
                              .is_x = is_x,
                              .is_y = is_y,
                              .is_negative = is_negative};
}

static inline f32x8 negated_where(i32x8 mask, f32x8 v)
{
    return (f32x8)((i32x8)v ^ (mask & INT32_MIN));
}

static inline struct face_axes on_face(const struct cube_face *face, const f32x8 v[3])
{
    const i32x8 plus = ~face->is_negative;
    return (struct face_axes){
        .s = rhw_select(face->is_x, negated_where(plus, v[2]),
                        negated_where(face->is_negative & ~face->is_y, v[0])),
        .t = rhw_select(face->is_y, negated_where(face->is_negative, v[2]), -v[1]),
        .major = negated_where(face->is_negative,
                               rhw_select(face->is_x, v[0], rhw_select(face->is_y, v[1], v[2])))};
}

// Set coordinates on the face, which are 0..1 except for rounding. They are NaN where the direction has no face.
static inline void face_coordinates(const struct face_axes *axes, f32x8 st[2])
{
    st[0] = 0.5f * (axes->s / axes->major) + 0.5f;
    st[1] = 0.5f * (axes->t / axes->major) + 0.5f;
}

// Set what a change of direction per pixel is in coordinates on the face.
static inline void face_gradient(const struct cube_face *face, const struct face_axes *axes,
                                 const f32x8 change[3], f32x8 st[2])
{
    const struct face_axes d = on_face(face, change);
    const f32x8 square = axes->major * axes->major;
    st[0] = 0.5f * ((axes->major * d.s - axes->s * d.major) / square);
    st[1] = 0.5f * ((axes->major * d.t - axes->t * d.major) / square);
}

// Move texel (x, y) of a face, of which one coordinate lies one outside it, to the face across that edge. The move is
// in whole numbers, twice the distance from the face's middle, so that every texel's centre is exact. `size` is that of
// the face.
static inline void cross_edge(i32x8 size, i32x8 *x, i32x8 *y, i32x8 *number)
{
    const i32x8 across_x = (*x >> 31) | ~rhw_less_int(*x, size),
                across_y = (*y >> 31) | ~rhw_less_int(*y, size);
    const i32x8 crosses = across_x | across_y, last = size - 1;
    // The face's edge is `size` away from its middle, and its first and last texels are `last` away.
    const i32x8 s = rhw_max_int(rhw_min_int(2 * *x - last, size), -size);
    const i32x8 t = rhw_max_int(rhw_min_int(2 * *y - last, size), -size);
    const i32x8 axis = *number >> 1, negative = -(*number & 1), inwards = (last ^ negative) - negative;
    const i32x8 turned_s = (s ^ negative) - negative, turned_t = (t ^ negative) - negative;
    const i32x8 is_x = rhw_equal_int(axis, i32x8_splat(0)), is_y = rhw_equal_int(axis, i32x8_splat(1));
    const i32x8 v[3] = {rhw_select_int(is_x, inwards, rhw_select_int(is_y, s, turned_s)),
                        rhw_select_int(is_y, inwards, -t),
                        rhw_select_int(is_x, -turned_s, rhw_select_int(is_y, turned_t, inwards))};
    const f32x8 direction[3] = {rhw_float_from_int(v[0]), rhw_float_from_int(v[1]), rhw_float_from_int(v[2])};
    const struct cube_face face = face_of(direction);
    const struct face_axes there = on_face(&face, direction);
    const i32x8 to_x = (rhw_int_from_float_unchecked(there.s) + last) >> 1;
    const i32x8 to_y = (rhw_int_from_float_unchecked(there.t) + last) >> 1;
    *x = rhw_select_int(crosses, rhw_max_int(to_x, i32x8_splat(0)),
                        *x); // a corner has no texel: stay inside
    *y = rhw_select_int(crosses, rhw_max_int(to_y, i32x8_splat(0)), *y);
    *number = rhw_select_int(crosses, face.number, *number);
}

#endif
