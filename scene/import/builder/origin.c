// SPDX-License-Identifier: MIT
// The middle is a median and the size a distance between quartiles: files have vertices that stand at 0 for no reason,
// and a box around all would hide that the others are far.
#include "origin.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLE = 4096 }; // points that are looked at

// The numbers along the three axes of a sample of points.
struct sample {
    uint64_t values[3][SAMPLE]; // doubles as whole numbers of the same order
    size_t count;
};

static uint64_t key_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits >> 63 != 0 ? ~bits : bits | (uint64_t)1 << 63;
}

static double value_of(uint64_t key)
{
    const uint64_t bits = key >> 63 != 0 ? key & ~((uint64_t)1 << 63) : ~key;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

// Sort keys byte by byte, from the lowest to the highest.
static void sort_keys(uint64_t keys[SAMPLE], size_t count)
{
    uint64_t moved[SAMPLE];
    for (unsigned shift = 0; shift < 64; shift += 8) {
        size_t places[257] = {0};
        for (size_t i = 0; i < count; i++) {
            places[(keys[i] >> shift & 255) + 1]++;
        }
        for (size_t byte = 0; byte < 256; byte++) {
            places[byte + 1] += places[byte];
        }
        for (size_t i = 0; i < count; i++) {
            moved[places[keys[i] >> shift & 255]++] = keys[i];
        }
        memcpy(keys, moved, count * sizeof *keys);
    }
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

static void add_point(struct sample *sample, const double point[3])
{
    if (sample->count < SAMPLE && is_finite(point)) {
        for (int c = 0; c < 3; c++) {
            sample->values[c][sample->count] = key_of(point[c]);
        }
        sample->count++;
    }
}

static struct scene_import_spread spread_of(struct sample *sample)
{
    struct scene_import_spread spread = {.size = 0.0};
    const size_t taken = sample->count;
    double whole = 0.0;
    for (int c = 0; c < 3 && taken > 0; c++) {
        const uint64_t *const keys = sample->values[c];
        sort_keys(sample->values[c], taken);
        spread.middle[c] = value_of(keys[taken / 2]);
        spread.size = fmax(spread.size, value_of(keys[taken - 1 - taken / 4]) - value_of(keys[taken / 4]));
        spread.distance = fmax(spread.distance, fabs(spread.middle[c]));
        whole = fmax(whole, value_of(keys[taken - 1]) - value_of(keys[0]));
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

struct scene_import_spread scene_import_spread_find(struct scene_import *import, const double (*points)[3],
                                                    size_t count)
{
    struct sample *const sample = scene_import_allocate(import, 1, sizeof *sample);
    for (size_t i = 0; i < count; i += count / SAMPLE + 1) {
        add_point(sample, points[i]);
    }
    const struct scene_import_spread spread = spread_of(sample);
    free(sample);
    return spread;
}

bool scene_import_are_far(struct scene_import *import, const float (*points)[3], size_t count)
{
    struct sample *const sample = scene_import_allocate(import, 1, sizeof *sample);
    for (size_t i = 0; i < count; i += count / SAMPLE + 1) {
        const double point[3] = {(double)points[i][0], (double)points[i][1], (double)points[i][2]};
        add_point(sample, point);
    }
    const struct scene_import_spread spread = spread_of(sample);
    free(sample);
    return spread.is_far;
}

// Make floats of `count` doubles in their own memory, less `origin`, which has a number for each of the three axes.
static void narrow(char *bytes, size_t count, const double origin[3])
{
    enum { SOME = 192 }; // a multiple of 3
    // The doubles of a part are read before floats are written, which may take the place of those of this part alone.
    for (size_t i = 0; i < count; i += SOME) {
        const size_t part = count - i < SOME ? count - i : SOME;
        double values[SOME];
        float narrowed[SOME];
        memcpy(values, bytes + i * sizeof *values, part * sizeof *values);
        for (size_t k = 0; k < part; k++) {
            narrowed[k] = (float)(values[k] - origin[k % 3]);
        }
        memcpy(bytes + i * sizeof *narrowed, narrowed, part * sizeof *narrowed);
    }
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
    narrow((char *)points, 3 * count, origin);
    void *const smaller = realloc(points, (count > 0 ? 3 * count : 1) * sizeof(float));
    return smaller != NULL ? smaller : (void *)points;
}
