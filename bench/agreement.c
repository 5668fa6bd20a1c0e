// SPDX-License-Identifier: MIT
// See agreement.h.
#include "agreement.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void compare_colors(struct bench_agreement *result, const uint8_t *a, const uint8_t *b,
                           const struct bench_tolerance *tolerance)
{
    uint64_t sum = 0;
    for (uint64_t i = 0; i < result->pixels; i++, a += 4, b += 4) {
        if ((a[3] != 0) != (b[3] != 0)) {
            result->coverage++;
            continue;
        }
        bool is_outlier = false;
        for (int c = 0; c < 4; c++) {
            const int difference = abs(a[c] - b[c]), color = tolerance->color > 1 ? tolerance->color : 1;
            is_outlier =
                is_outlier || difference > (c == 3 && tolerance->alpha > color ? tolerance->alpha : color);
            result->color = difference > result->color ? difference : result->color;
            sum += (uint64_t)difference;
        }
        result->outliers += is_outlier ? 1 : 0;
    }
    result->mean = (double)sum / (4.0 * (double)result->pixels);
}

static void compare_depths(struct bench_agreement *result, const float *a, const float *b,
                           const struct bench_tolerance *tolerance)
{
    double sum = 0.0;
    for (uint64_t i = 0; i < result->pixels; i++) {
        if ((a[i] < 1.0f) != (b[i] < 1.0f)) {
            result->coverage++;
            continue;
        }
        const double difference = fabs((double)a[i] - (double)b[i]);
        result->depth = difference > result->depth ? difference : result->depth;
        result->outliers += difference <= tolerance->depth ? 0 : 1;
        sum += difference;
    }
    result->mean = sum / (double)result->pixels;
}

struct bench_agreement bench_agree(const struct bench_image *a, const struct bench_image *b,
                                   const struct bench_tolerance *tolerance)
{
    struct bench_agreement result = {.pixels = (uint64_t)a->width * (uint64_t)a->height};
    const size_t pixels = (size_t)result.pixels;
    result.is_equal = a->color ? memcmp(a->color, b->color, 4 * pixels) == 0
                               : memcmp(a->depth, b->depth, pixels * sizeof *a->depth) == 0;
    if (a->color) {
        compare_colors(&result, a->color, b->color, tolerance);
    } else {
        compare_depths(&result, a->depth, b->depth, tolerance);
    }
    // Rounded up: a share of a small picture would be no pixel at all.
    const double allowed = ceil(tolerance->outliers * (double)result.pixels);
    result.agrees = (double)(result.coverage + result.outliers) <= allowed;
    return result;
}
