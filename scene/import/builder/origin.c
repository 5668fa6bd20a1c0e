// SPDX-License-Identifier: MIT
// The middle is a median and the size a distance between quartiles: files have vertices that stand at 0 for no reason,
// and a box around all would hide that the others are far.
#include "origin.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLE = 4096 }; // points that are looked at

static int compare(const void *left, const void *right)
{
    const double a = *(const double *)left, b = *(const double *)right;
    return a < b ? -1 : a > b;
}

// Return the smallest power of two that is not below `size`.
static double power_above(double size)
{
    int exponent;
    const double part = frexp(size, &exponent); // 0.5 <= part < 1
    return ldexp(1.0, part > 0.5 ? exponent : exponent - 1);
}

static bool is_finite(const double point[3])
{
    return point[0] - point[0] == 0.0 && point[1] - point[1] == 0.0 && point[2] - point[2] == 0.0;
}

struct scene_import_spread scene_import_spread_find(struct scene_import *import, const double (*points)[3],
                                                    size_t count)
{
    struct scene_import_spread spread = {.size = 0.0};
    const size_t step = count / SAMPLE + 1;
    double *values[3];
    size_t taken = 0;
    for (int c = 0; c < 3; c++) {
        values[c] = scene_import_allocate(import, SAMPLE, sizeof *values[c]);
    }
    for (size_t i = 0; i < count && taken < SAMPLE; i += step) {
        for (int c = 0; c < 3 && is_finite(points[i]); c++) {
            values[c][taken] = points[i][c];
        }
        taken += is_finite(points[i]);
    }
    double whole = 0.0;
    for (int c = 0; c < 3 && taken > 0; c++) {
        qsort(values[c], taken, sizeof *values[c], compare);
        spread.middle[c] = values[c][taken / 2];
        spread.size = fmax(spread.size, values[c][taken - 1 - taken / 4] - values[c][taken / 4]);
        spread.distance = fmax(spread.distance, fabs(spread.middle[c]));
        whole = fmax(whole, values[c][taken - 1] - values[c][0]);
    }
    for (int c = 0; c < 3; c++) {
        free(values[c]);
    }
    spread.size = spread.size > 0.0 ? spread.size : whole;
    // A single point has no size that could be lost.
    spread.is_far =
        spread.size > 0.0 && spread.size <= DBL_MAX / 2 && spread.distance > SCENE_IMPORT_FAR * spread.size;
    const double unit = spread.is_far ? power_above(spread.size) : 0.0;
    for (int c = 0; c < 3 && spread.is_far; c++) {
        spread.middle[c] = floor(spread.middle[c] / unit + 0.5) * unit;
    }
    return spread;
}

float (*scene_import_settle(struct scene_import *import, double (*points)[3], size_t count,
                            double origin[3]))[3]
{
    const struct scene_import_spread spread =
        scene_import_spread_find(import, (const double(*)[3])points, count);
    memset(origin, 0, 3 * sizeof *origin);
    if (spread.is_far) {
        memcpy(origin, spread.middle, sizeof spread.middle);
    }
    // A float is written before the doubles that its bytes were part of are read no more.
    char *const bytes = (char *)points;
    for (size_t i = 0; i < 3 * count; i++) {
        double value;
        memcpy(&value, bytes + i * sizeof value, sizeof value);
        const float narrow = (float)(value - origin[i % 3]);
        memcpy(bytes + i * sizeof narrow, &narrow, sizeof narrow);
    }
    void *const smaller = realloc(points, (count > 0 ? 3 * count : 1) * sizeof(float));
    return smaller != NULL ? smaller : (void *)points;
}
