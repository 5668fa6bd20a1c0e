// SPDX-License-Identifier: MIT
// A small vector has one rhw_float for each component. A matrix is the same in all lanes. Sums are added from the first
// term to the last. NaN and infinity behave as in C's operators. shader.h includes this header.
#ifndef RHW_SHADER_LINEAR_H
#define RHW_SHADER_LINEAR_H

#include "shader_vector.h"

#if RHW_HAS_LANES

RHW_QUIET_BEGIN

// Lengths and products ------------------------------------------------------------------------------

/// Return the scalar product of two vectors. Either vector may also be plain floats that are the same in all lanes, for
/// example a uniform `float[2]`.
static inline rhw_float rhw_dot2(const rhw_float a[2], const rhw_float b[2])
{
    return a[0] * b[0] + a[1] * b[1];
}

/// Return the scalar product of two vectors. Either vector may also be plain floats that are the same in all lanes.
static inline rhw_float rhw_dot3(const rhw_float a[3], const rhw_float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Return the scalar product of two vectors. Either vector may also be plain floats that are the same in all lanes.
static inline rhw_float rhw_dot4(const rhw_float a[4], const rhw_float b[4])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/// Return the length, sqrt(a · a). It is infinity from 1.8e19 on, because the square is too large for a float.
static inline rhw_float rhw_length2(const rhw_float a[2])
{
    return rhw_sqrt(rhw_dot2(a, a));
}

/// Return the length, sqrt(a · a). It is infinity from 1.8e19 on, because the square is too large for a float.
static inline rhw_float rhw_length3(const rhw_float a[3])
{
    return rhw_sqrt(rhw_dot3(a, a));
}

/// Return the length, sqrt(a · a). It is infinity from 1.8e19 on, because the square is too large for a float.
static inline rhw_float rhw_length4(const rhw_float a[4])
{
    return rhw_sqrt(rhw_dot4(a, a));
}

/// Set `result` to the vector product of `a` and `b`. `result` must not be `a` or `b`.
static inline void rhw_cross(const rhw_float a[3], const rhw_float b[3], rhw_float result[3])
{
    result[0] = a[1] * b[2] - a[2] * b[1];
    result[1] = a[2] * b[0] - a[0] * b[2];
    result[2] = a[0] * b[1] - a[1] * b[0];
}

// Return the factor that gives a vector with this square the length 1. The root is taken of the smallest normal float
// in place of 0, because 0 · ∞ would be NaN.
static inline rhw_float rhw_normalizing(rhw_float square)
{
    return rhw_rsqrt(rhw_max(square, rhw_splat(1.17549435e-38f)));
}

/// Set `result` to the vector of length 1 along `a`. `result` may be `a`. If the length of `a` lies between 1.1e−19 and
/// 1.8e19, the length of the result is within 3 ULP of 1. The zero vector stays zero.
static inline void rhw_normalize2(const rhw_float a[2], rhw_float result[2])
{
    const rhw_float scale = rhw_normalizing(rhw_dot2(a, a));
    result[0] = a[0] * scale;
    result[1] = a[1] * scale;
}

/// Set `result` to the vector of length 1 along `a`. `result` may be `a`. If the length of `a` lies between 1.1e−19 and
/// 1.8e19, the length of the result is within 3 ULP of 1. The zero vector stays zero.
static inline void rhw_normalize3(const rhw_float a[3], rhw_float result[3])
{
    const rhw_float scale = rhw_normalizing(rhw_dot3(a, a));
    result[0] = a[0] * scale;
    result[1] = a[1] * scale;
    result[2] = a[2] * scale;
}

/// Set `result` to the vector of length 1 along `a`. `result` may be `a`. If the length of `a` lies between 1.1e−19 and
/// 1.8e19, the length of the result is within 3 ULP of 1. The zero vector stays zero.
static inline void rhw_normalize4(const rhw_float a[4], rhw_float result[4])
{
    const rhw_float scale = rhw_normalizing(rhw_dot4(a, a));
    result[0] = a[0] * scale;
    result[1] = a[1] * scale;
    result[2] = a[2] * scale;
    result[3] = a[3] * scale;
}

/// Set `result` to the direction `incident` reflected by a surface of unit normal `normal`: i − 2 (n·i) n. `result` may
/// be `incident`.
static inline void rhw_reflect2(const rhw_float incident[2], const rhw_float normal[2], rhw_float result[2])
{
    const rhw_float twice = 2.0f * rhw_dot2(normal, incident);
    result[0] = incident[0] - twice * normal[0];
    result[1] = incident[1] - twice * normal[1];
}

/// Set `result` to the direction `incident` reflected by a surface of unit normal `normal`: i − 2 (n·i) n. `result` may
/// be `incident`.
static inline void rhw_reflect3(const rhw_float incident[3], const rhw_float normal[3], rhw_float result[3])
{
    const rhw_float twice = 2.0f * rhw_dot3(normal, incident);
    result[0] = incident[0] - twice * normal[0];
    result[1] = incident[1] - twice * normal[1];
    result[2] = incident[2] - twice * normal[2];
}

// Matrices ------------------------------------------------------------------------------------------
// A matrix stands column by column, as in GLSL and in the uniforms of most programs: element (row, column) of a 4×4
// matrix is m[4 * column + row]. A matrix has plain floats, for example uniforms. `result` may be `v`; it must not
// overlap `v` in another way, and must not overlap `m`. For the product of two matrices, multiply the columns of the
// second one by the first one: call rhw_mat4_mul_vec4_1 four times, with results in a third matrix.

/// Set `result` to m · v.
static inline void rhw_mat4_mul_vec4(const float m[16], const rhw_float v[4], rhw_float result[4])
{
    const rhw_float x = v[0], y = v[1], z = v[2], w = v[3];
    for (int r = 0; r < 4; r++) {
        result[r] = m[r] * x + m[4 + r] * y + m[8 + r] * z + m[12 + r] * w;
    }
}

/// Set `result` to m · (x, y, z, 1), where v is a point. This maps, for example, a point to clip coordinates.
static inline void rhw_mat4_mul_point(const float m[16], const rhw_float v[3], rhw_float result[4])
{
    const rhw_float x = v[0], y = v[1], z = v[2];
    for (int r = 0; r < 4; r++) {
        result[r] = m[r] * x + m[4 + r] * y + m[8 + r] * z + m[12 + r];
    }
}

/// Set `result` to the first three components of m · (x, y, z, 0), where v is a direction, which the matrix does not
/// shift.
static inline void rhw_mat4_mul_direction(const float m[16], const rhw_float v[3], rhw_float result[3])
{
    const rhw_float x = v[0], y = v[1], z = v[2];
    for (int r = 0; r < 3; r++) {
        result[r] = m[r] * x + m[4 + r] * y + m[8 + r] * z;
    }
}

/// Set `result` to m · v for a 3×3 matrix. Normals are multiplied by the inverse transpose of a matrix.
static inline void rhw_mat3_mul_vec3(const float m[9], const rhw_float v[3], rhw_float result[3])
{
    const rhw_float x = v[0], y = v[1], z = v[2];
    for (int r = 0; r < 3; r++) {
        result[r] = m[r] * x + m[3 + r] * y + m[6 + r] * z;
    }
}

// Plain floats in place of lanes --------------------------------------------------------------------

static inline const rhw_float *rhw_vector_from_floats(const float *floats, rhw_float *room, int components)
{
    for (int i = 0; i < components; i++) {
        room[i] = rhw_splat(floats[i]);
    }
    return room;
}

#if defined(__cplusplus)

extern "C++" {

static inline rhw_float rhw_dot2(const float a[2], const rhw_float b[2])
{
    rhw_float room[2];
    return rhw_dot2(rhw_vector_from_floats(a, room, 2), b);
}

static inline rhw_float rhw_dot2(const rhw_float a[2], const float b[2])
{
    rhw_float room[2];
    return rhw_dot2(a, rhw_vector_from_floats(b, room, 2));
}

static inline rhw_float rhw_dot3(const float a[3], const rhw_float b[3])
{
    rhw_float room[3];
    return rhw_dot3(rhw_vector_from_floats(a, room, 3), b);
}

static inline rhw_float rhw_dot3(const rhw_float a[3], const float b[3])
{
    rhw_float room[3];
    return rhw_dot3(a, rhw_vector_from_floats(b, room, 3));
}

static inline rhw_float rhw_dot4(const float a[4], const rhw_float b[4])
{
    rhw_float room[4];
    return rhw_dot4(rhw_vector_from_floats(a, room, 4), b);
}

static inline rhw_float rhw_dot4(const rhw_float a[4], const float b[4])
{
    rhw_float room[4];
    return rhw_dot4(a, rhw_vector_from_floats(b, room, 4));
}

} // extern "C++"

#else

static inline const rhw_float *rhw_same_vector(const rhw_float *lanes, rhw_float *room, int components)
{
    (void)room;
    (void)components;
    return lanes;
}

#define RHW_VECTOR_FROM(a, components)         \
    _Generic(&(a)[0],                          \
        float *: rhw_vector_from_floats,       \
        const float *: rhw_vector_from_floats, \
        default: rhw_same_vector)((a), (rhw_float[components]){{0}}, (components))

#define rhw_dot2(a, b) rhw_dot2(RHW_VECTOR_FROM(a, 2), RHW_VECTOR_FROM(b, 2))
#define rhw_dot3(a, b) rhw_dot3(RHW_VECTOR_FROM(a, 3), RHW_VECTOR_FROM(b, 3))
#define rhw_dot4(a, b) rhw_dot4(RHW_VECTOR_FROM(a, 4), RHW_VECTOR_FROM(b, 4))

#endif

RHW_QUIET_END

#endif

#endif
