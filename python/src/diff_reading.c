// SPDX-License-Identifier: MIT
#include "diff_reading.h"

#include "rhw/shader.h"

#include <math.h>
#include <string.h>

size_t diff_level_width(const struct diff_shape *shape, int level)
{
    const size_t width = shape->width >> level;
    return width ? width : 1;
}

size_t diff_level_height(const struct diff_shape *shape, int level)
{
    const size_t height = shape->height >> level;
    return height ? height : 1;
}

// Cubes (Vulkan 1.3, "Cube Map Face Selection") ------------------------------------------------------

enum { A, B, M };

static const struct {
    int axis[3];
    double sign[3];
} faces[6] = {{{2, 1, 0}, {-1, -1, 1}}, {{2, 1, 0}, {1, -1, -1}}, {{0, 2, 1}, {1, 1, 1}},
              {{0, 2, 1}, {1, -1, -1}}, {{0, 1, 2}, {1, -1, 1}},  {{0, 1, 2}, {-1, -1, -1}}};

// The face that a direction meets, and where. False for 0 and what is not finite.
static bool meet_cube(const double direction[3], size_t *face, double st[2], struct diff_reading *reading)
{
    const double x = fabs(direction[0]), y = fabs(direction[1]), z = fabs(direction[2]);
    const int major = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    *face = 2 * (size_t)major + (direction[major] < 0);
    memcpy(reading->axis, faces[*face].axis, sizeof reading->axis);
    memcpy(reading->sign, faces[*face].sign, sizeof reading->sign);
    reading->a = reading->sign[A] * direction[reading->axis[A]];
    reading->b = reading->sign[B] * direction[reading->axis[B]];
    reading->m = fabs(direction[major]);
    if (!(x + y + z > 0) || !isfinite(x + y + z)) {
        return false;
    }
    st[0] = (reading->a / reading->m + 1) / 2;
    st[1] = (reading->b / reading->m + 1) / 2;
    return true;
}

// A texel beside a face is one of the face next to it; beyond a corner there is none.
static bool fold_cube(size_t face, long x, long y, long size, size_t *row, size_t *column)
{
    const bool x_outside = x < 0 || x >= size, y_outside = y < 0 || y >= size;
    if (x_outside && y_outside) {
        return false;
    }
    if (x_outside || y_outside) {
        double direction[3], st[2];
        struct diff_reading other;
        direction[faces[face].axis[A]] = faces[face].sign[A] * ((double)(2 * x + 1) / (double)size - 1);
        direction[faces[face].axis[B]] = faces[face].sign[B] * ((double)(2 * y + 1) / (double)size - 1);
        direction[faces[face].axis[M]] = faces[face].sign[M];
        meet_cube(direction, &face, st, &other);
        x = (long)(st[0] * (double)size);
        y = (long)(st[1] * (double)size);
    }
    *row = face * (size_t)size + (size_t)y;
    *column = (size_t)x;
    return true;
}

// Texels of a level ----------------------------------------------------------------------------------

struct level {
    const struct diff_shape *shape;
    size_t face;
    long width, height;
};

static void place_tap(const struct level *level, long x, long y, struct diff_tap *tap)
{
    const enum diff_boundary boundary = level->shape->boundary;
    if (boundary == DIFF_CUBE) {
        tap->is_there = fold_cube(level->face, x, y, level->width, &tap->row, &tap->column);
        return;
    }
    if (boundary == DIFF_WRAP) {
        x = (x + level->width) % level->width;
        y = (y + level->height) % level->height;
    } else if (boundary == DIFF_CLAMP) {
        x = x < 0 ? 0 : x < level->width ? x : level->width - 1;
        y = y < 0 ? 0 : y < level->height ? y : level->height - 1;
    }
    tap->is_there = x >= 0 && x < level->width && y >= 0 && y < level->height;
    tap->row = tap->is_there ? (size_t)y : 0;
    tap->column = tap->is_there ? (size_t)x : 0;
}

// The missing texel of a cube's corner is the mean of the three that are there.
static void share_corner(struct diff_tap tap[DIFF_TAPS])
{
    for (int missing = 0; missing < DIFF_TAPS; missing++) {
        for (int i = 0; !tap[missing].is_there && i < DIFF_TAPS; i++) {
            if (i != missing) {
                tap[i].weight += tap[missing].weight / 3;
                tap[i].along_s += tap[missing].along_s / 3;
                tap[i].along_t += tap[missing].along_t / 3;
            }
        }
    }
}

static double hold(double value, double most)
{
    return value < 0 ? 0 : value > most ? most : value;
}

// Of coordinates within what place_tap takes: up to one texel outside of the level.
static void take_nearest(const struct level *level, const double st[2], struct diff_tap tap[DIFF_TAPS])
{
    const double width = (double)level->width, height = (double)level->height;
    double x = floor(st[0] * width), y = floor(st[1] * height);
    if (level->shape->boundary != DIFF_ZERO) { // 1 belongs to the last texel
        x = hold(x, width - 1);
        y = hold(y, height - 1);
    }
    tap[0].weight = 1;
    place_tap(level, (long)x, (long)y, &tap[0]);
}

static void take_linear(const struct level *level, const double st[2], struct diff_tap tap[DIFF_TAPS])
{
    double x = st[0] * (double)level->width - 0.5, y = st[1] * (double)level->height - 0.5;
    double x_slope = (double)level->width, y_slope = (double)level->height;
    if (level->shape->boundary == DIFF_CLAMP) {
        const double held_x = hold(x, x_slope - 1), held_y = hold(y, y_slope - 1);
        x_slope = held_x == x ? x_slope : 0;
        y_slope = held_y == y ? y_slope : 0;
        x = held_x;
        y = held_y;
    }
    const double left = floor(x), low = floor(y), fx = x - left, fy = y - low;
    for (int i = 0; i < DIFF_TAPS; i++) {
        const double wx = i % 2 ? fx : 1 - fx, wy = i / 2 ? fy : 1 - fy;
        tap[i].weight = wx * wy;
        tap[i].along_s = (i % 2 ? x_slope : -x_slope) * wy;
        tap[i].along_t = (i / 2 ? y_slope : -y_slope) * wx;
        place_tap(level, (long)left + i % 2, (long)low + i / 2, &tap[i]);
    }
    if (level->shape->boundary == DIFF_CUBE) {
        share_corner(tap);
    }
}

// Levels ---------------------------------------------------------------------------------------------

// Slopes of s and t per pixel: along X, along Y.
static void find_footprint(const struct diff_shape *shape, const struct diff_reading *reading,
                           const float *uv_da, double footprint[4])
{
    for (int i = 0; i < 4; i++) {
        footprint[i] = uv_da[i];
    }
    for (int k = 0; shape->boundary == DIFF_CUBE && k < 2; k++) {
        const double to_m = reading->sign[M] * uv_da[2 * reading->axis[M] + k];
        const double to_a = reading->sign[A] * uv_da[2 * reading->axis[A] + k];
        const double to_b = reading->sign[B] * uv_da[2 * reading->axis[B] + k];
        footprint[k] = (to_a - reading->a / reading->m * to_m) / (2 * reading->m);
        footprint[2 + k] = (to_b - reading->b / reading->m * to_m) / (2 * reading->m);
    }
}

// The level at which the longer axis of the footprint, which is an ellipse around the pixel, has the length of a texel:
// half the binary logarithm of the greater eigenvalue of J·Jᵀ, J being the footprint in texels.
static double find_level(const struct diff_shape *shape, const double footprint[4], double along[4])
{
    const double scale[4] = {(double)shape->width, (double)shape->width, (double)shape->height,
                             (double)shape->height};
    double j[4];
    for (int i = 0; i < 4; i++) {
        j[i] = footprint[i] * scale[i];
    }
    const double x = j[0] * j[0] + j[2] * j[2], y = j[1] * j[1] + j[3] * j[3], xy = j[0] * j[1] + j[2] * j[3];
    const double half = (x - y) / 2, root = sqrt(half * half + xy * xy), square = (x + y) / 2 + root;
    if (!(square > 1e-30) || !(square < 1e30)) {
        return square > 1 ? 64 : -64; // beyond all levels, which the caller holds it to
    }
    const double by_log = 0.5 / (0.69314718055994531 * square);
    const double by_x = 0.5 + (root > 0 ? half / (2 * root) : 0), by_y = 1 - by_x;
    const double by_xy = root > 0 ? xy / root : 0;
    for (int i = 0; i < 4; i++) { // i and i ^ 1 are along X and Y, or Y and X
        along[i] = by_log * (2 * (i % 2 ? by_y : by_x) * j[i] + by_xy * j[i ^ 1]) * scale[i];
    }
    return 0.5 * (double)rhw_log2_1((float)square);
}

static void choose_levels(const struct diff_shape *shape, double level, struct diff_reading *reading)
{
    const double most = shape->levels - 1;
    reading->count = 1;
    reading->part[0] = 1;
    if (shape->filter < DIFF_MIP_NEAREST) {
        return;
    }
    const double held = hold(level, most);
    if (shape->filter == DIFF_MIP_NEAREST) {
        reading->level[0] = (int)floor(held + 0.5);
        return;
    }
    reading->level[0] = held >= most ? shape->levels - 1 : (int)held;
    if (held > 0 && held < most) {
        reading->count = 2;
        reading->level[1] = reading->level[0] + 1;
        reading->part[1] = held - reading->level[0];
        reading->part[0] = 1 - reading->part[1];
        reading->level_moves = true;
    }
}

// Coordinates that are finite and, as far as it matters, near the texture.
static bool find_place(const struct diff_shape *shape, const float *uv, size_t *face, double st[2],
                       struct diff_reading *reading)
{
    if (shape->boundary == DIFF_CUBE) {
        const double direction[3] = {uv[0], uv[1], uv[2]};
        return meet_cube(direction, face, st, reading);
    }
    for (int i = 0; i < 2; i++) {
        st[i] = uv[i];
        if (!isfinite(uv[i]) || (shape->boundary == DIFF_ZERO && fabs(st[i]) > 2)) {
            return false;
        }
        st[i] = shape->boundary == DIFF_WRAP ? st[i] - floor(st[i]) : st[i];
    }
    return true;
}

void diff_read(const struct diff_shape *shape, const float *uv, const float *uv_da, float bias,
               struct diff_reading *reading)
{
    *reading = (struct diff_reading){0};
    struct level level = {.shape = shape};
    double st[2], footprint[4], detail = bias;
    if (!find_place(shape, uv, &level.face, st, reading) || !isfinite(bias)) {
        return;
    }
    if (uv_da && shape->filter >= DIFF_MIP_NEAREST) {
        find_footprint(shape, reading, uv_da, footprint);
        detail += find_level(shape, footprint, reading->level_along);
    }
    choose_levels(shape, detail, reading);
    for (int i = 0; i < reading->count; i++) {
        level.width = (long)diff_level_width(shape, reading->level[i]);
        level.height = (long)diff_level_height(shape, reading->level[i]);
        (shape->filter == DIFF_NEAREST ? take_nearest : take_linear)(&level, st, reading->tap[i]);
    }
}

// Whether the level follows the footprint: not beyond all levels, and not where slopes are not finite.
static bool follows_footprint(const struct diff_reading *reading)
{
    bool follows = false;
    for (int i = 0; i < 4; i++) {
        follows |= reading->level_along[i] != 0;
    }
    return follows;
}

static void put(const struct diff_reading *reading, int which, double value, int stride, float *to)
{
    to[reading->axis[which] * stride] += (float)(reading->sign[which] * value);
}

static void read_cube_back(const struct diff_reading *reading, const float *uv_da, const double to_st[2],
                           double to_level, float *to_uv, float *to_uv_da)
{
    const double m = reading->m, over[2] = {reading->a / m, reading->b / m};
    double to[3] = {to_st[0] / (2 * m), to_st[1] / (2 * m), 0}; // of a, b, m
    to[M] = -over[0] * to[A] - over[1] * to[B];
    for (int k = 0; uv_da && to_uv_da && follows_footprint(reading) && k < 2; k++) {
        const double m_slope = reading->sign[M] * uv_da[2 * reading->axis[M] + k];
        double to_m_slope = 0;
        for (int i = A; i <= B; i++) { // footprint = (slope − over · m_slope) / 2m
            const double slope = reading->sign[i] * uv_da[2 * reading->axis[i] + k];
            const double to_footprint = to_level * reading->level_along[2 * i + k] / (2 * m);
            put(reading, i, to_footprint, 2, to_uv_da + k);
            to_m_slope -= over[i] * to_footprint;
            to[i] -= m_slope / m * to_footprint;
            to[M] += (2 * over[i] * m_slope - slope) / m * to_footprint;
        }
        put(reading, M, to_m_slope, 2, to_uv_da + k);
    }
    for (int i = A; i <= M; i++) {
        put(reading, i, to[i], 1, to_uv);
    }
}

void diff_read_back(const struct diff_shape *shape, const struct diff_reading *reading, const float *uv_da,
                    const double to_st[2], double to_level, float *to_uv, float *to_uv_da)
{
    const int dimensions = shape->boundary == DIFF_CUBE ? 3 : 2;
    memset(to_uv, 0, (size_t)dimensions * sizeof *to_uv);
    if (to_uv_da) {
        memset(to_uv_da, 0, 2 * (size_t)dimensions * sizeof *to_uv_da);
    }
    if (!reading->count) {
        return;
    }
    if (dimensions == 3) {
        read_cube_back(reading, uv_da, to_st, to_level, to_uv, to_uv_da);
        return;
    }
    to_uv[0] = (float)to_st[0];
    to_uv[1] = (float)to_st[1];
    for (int i = 0; to_uv_da && i < 4; i++) {
        to_uv_da[i] = (float)(to_level * reading->level_along[i]);
    }
}
