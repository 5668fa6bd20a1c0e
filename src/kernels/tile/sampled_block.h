// SPDX-License-Identifier: MIT
// A triangle covers samples of a block, where pixels have several.
#ifndef RHW_SAMPLED_BLOCK_H
#define RHW_SAMPLED_BLOCK_H

#include "base/constants.h"
#include "base/simd.h"
#include "rhw/limits.h"

// A block of 8×8 pixels, with a mask for each sample.
struct sampled_block {
    int x, y;
    uint64_t mask[RHW_MAX_SAMPLES];
    uint64_t covered[RHW_MAX_SAMPLES]; // covered pixels before any test: set for centroids alone
    f32x8 z[RHW_MAX_SAMPLES][RHW_BLOCK];
};

#endif
