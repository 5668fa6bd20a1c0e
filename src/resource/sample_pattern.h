// SPDX-License-Identifier: MIT
// Where the samples of a pixel lie: the standard positions of Vulkan and Direct3D.
#ifndef RHW_SAMPLE_PATTERN_H
#define RHW_SAMPLE_PATTERN_H

#include <stdbool.h>
#include <stdint.h>

#include "rhw/types.h"

struct rhw_sample_pattern {
    int count;
    int32_t x_0_8[RHW_MAX_SAMPLES], y_0_8[RHW_MAX_SAMPLES]; // 1/256 pixel from the top left of the pixel
    int32_t least_0_8, most_0_8;                            // least and most of all positions, each way
};

// Return the pattern of 1, 2, 4, 8 or 16 samples.
const struct rhw_sample_pattern *rhw_sample_pattern_of(int samples);

static inline bool rhw_sample_count_valid(int samples)
{
    return samples >= 1 && samples <= RHW_MAX_SAMPLES && (samples & (samples - 1)) == 0;
}

#endif
