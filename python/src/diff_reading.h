// SPDX-License-Identifier: MIT
// Where a texture is read for a pixel of rhw.diff: which texels of which levels, with what weights, and how these
// change with the coordinates. Values and gradients of texture come from the same answer.
#ifndef PYTHON_DIFF_READING_H
#define PYTHON_DIFF_READING_H

#include <stdbool.h>
#include <stddef.h>

enum { DIFF_MAX_LEVELS = 15, DIFF_TAPS = 4 };
enum diff_filter { DIFF_NEAREST, DIFF_LINEAR, DIFF_MIP_NEAREST, DIFF_MIP_LINEAR };
enum diff_boundary { DIFF_CUBE, DIFF_WRAP, DIFF_CLAMP, DIFF_ZERO };

struct diff_shape {
    size_t height, width; ///< of level 0; level l has half as many, l times, and at least 1
    int levels;           ///< 1..DIFF_MAX_LEVELS
    enum diff_filter filter;
    enum diff_boundary boundary;
};

struct diff_tap {
    bool is_there;
    size_t row, column;              ///< of the level; the rows of a cube's faces follow each other
    double weight, along_s, along_t; ///< and its slopes, s and t from 0 to 1 across the level
};

struct diff_reading {
    int count; ///< of levels; 0: outside of everything, or not finite
    int level[2];
    double part[2];
    struct diff_tap tap[2][DIFF_TAPS];
    double level_along[4]; ///< slopes of the level by ds/dX, ds/dY, dt/dX, dt/dY
    bool level_moves;      ///< whether part[1] grows with the level
    // Of a cube: s = (a/m + 1)/2, t = (b/m + 1)/2 with a, b and m of these axes.
    int axis[3];
    double sign[3], a, b, m;
};

size_t diff_level_width(const struct diff_shape *shape, int level);
size_t diff_level_height(const struct diff_shape *shape, int level); ///< of a face

/// `uv`: 2 coordinates, of a cube 3; `uv_da`: twice as many slopes, or NULL; `bias`: of the level, or alone the level.
/// Slopes that are no numbers choose level 0, infinite ones the last; neither have a gradient, nor `uv` one through
/// them.
void diff_read(const struct diff_shape *shape, const float *uv, const float *uv_da, float bias,
               struct diff_reading *reading);

/// From gradients of s, t and the level to those of uv and, where `to_uv_da` is no NULL, of uv_da.
void diff_read_back(const struct diff_shape *shape, const struct diff_reading *reading, const float *uv_da,
                    const double to_st[2], double to_level, float *to_uv, float *to_uv_da);

#endif
