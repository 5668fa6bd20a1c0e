// SPDX-License-Identifier: MIT
// Eight points are 24 floats, which fill three vectors: each lane of these has numbers of one axis.
#include "bounds.h"

#include <float.h>
#include <stdint.h>
#include <string.h>

#include "rhw/shader.h"

enum { VECTORS = 3, FLOATS = VECTORS * RHW_LANES, POINTS = FLOATS / 3 };

struct lanes {
    rhw_float low[VECTORS], high[VECTORS];
    rhw_int are_numbers;
};

static void add_points(struct lanes *lanes, const float (*points)[3], size_t count)
{
    for (size_t i = 0; i < count; i += POINTS) {
        for (size_t k = 0; k < VECTORS; k++) {
            rhw_float at;
            memcpy(&at, (const char *)points[i] + k * sizeof at, sizeof at);
            lanes->low[k] = rhw_select(rhw_less(at, lanes->low[k]), at, lanes->low[k]);
            lanes->high[k] = rhw_select(rhw_less(lanes->high[k], at), at, lanes->high[k]);
            lanes->are_numbers &= rhw_equal(at, at);
        }
    }
}

bool scene_import_bound(const float (*points)[3], size_t count, float low[3], float high[3])
{
    const size_t whole = count - count % POINTS;
    struct lanes lanes = {.are_numbers = rhw_splat_int(-1)};
    for (int k = 0; k < VECTORS; k++) {
        lanes.low[k] = rhw_splat(FLT_MAX);
        lanes.high[k] = rhw_splat(-FLT_MAX);
    }
    add_points(&lanes, points, whole);
    float least[FLOATS], most[FLOATS];
    memcpy(least, lanes.low, sizeof least);
    memcpy(most, lanes.high, sizeof most);
    bool are_numbers = rhw_all(lanes.are_numbers);
    for (int c = 0; c < 3; c++) {
        low[c] = FLT_MAX;
        high[c] = -FLT_MAX;
    }
    for (int i = 0; i < FLOATS; i++) {
        low[i % 3] = least[i] < low[i % 3] ? least[i] : low[i % 3];
        high[i % 3] = most[i] > high[i % 3] ? most[i] : high[i % 3];
    }
    for (size_t i = whole; i < count; i++) {
        for (int c = 0; c < 3; c++) {
            const float at = points[i][c];
            low[c] = at < low[c] ? at : low[c];
            high[c] = at > high[c] ? at : high[c];
            are_numbers &= at == at;
        }
    }
    return are_numbers;
}
