// SPDX-License-Identifier: MIT
// Matrices of cameras, column by column as rhw_mat4_mul_point takes them, and where a point lands in a picture. All by
// rhw's own square root and tangent: the same bits on every machine.
#ifndef MATRIX_H
#define MATRIX_H

#include <string.h>

#include <rhw/shader.h>

// result = a · b; it may be neither.
static inline void matrix_mul(const float a[16], const float b[16], float result[16])
{
    for (int column = 0; column < 4; column++) {
        rhw_mat4_mul_vec4_1(a, &b[4 * column], &result[4 * column]);
    }
}

// From `eye` towards `target`: x right, y up, −z ahead.
static inline void matrix_look_at(const float eye[3], const float target[3], const float up[3],
                                  float result[16])
{
    float axis[3][3];
    const float back[3] = {eye[0] - target[0], eye[1] - target[1], eye[2] - target[2]};
    rhw_normalize3_1(back, axis[2]);
    rhw_cross1(up, axis[2], axis[0]);
    rhw_normalize3_1(axis[0], axis[0]);
    rhw_cross1(axis[2], axis[0], axis[1]);
    memset(result, 0, 16 * sizeof(float));
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) {
            result[4 * column + row] = axis[row][column];
        }
        result[12 + row] = -rhw_dot3_1(axis[row], eye);
    }
    result[15] = 1;
}

// Depth 0..1 from near to far; `angle` is that of the height, in radians.
static inline void matrix_perspective(float angle, float aspect, float near, float far, float result[16])
{
    const float scale = 1 / rhw_tan1(angle / 2);
    memset(result, 0, 16 * sizeof(float));
    result[0] = scale / aspect;
    result[5] = scale;
    result[10] = far / (near - far);
    result[11] = -1;
    result[14] = near * far / (near - far);
}

// Where `point` lands: pixels from the top left, and depth.
static inline void matrix_land(const float clip[16], const float point[3], int width, int height,
                               float landed[3])
{
    float at[4];
    rhw_mat4_mul_point1(clip, point, at);
    landed[0] = (at[0] / at[3] + 1) / 2 * (float)width;
    landed[1] = (1 - at[1] / at[3]) / 2 * (float)height;
    landed[2] = at[2] / at[3];
}

#endif
