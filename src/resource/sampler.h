// SPDX-License-Identifier: MIT
// A sampler's state, and what the sampling functions would otherwise work out again for every 8 fragments.
#ifndef RHW_SAMPLER_H
#define RHW_SAMPLER_H

#include "rhw/shader_lanes.h"
#include "rhw/types.h"

enum { RHW_MOST_ANISOTROPY = 16 }; // samples along the longer axis of a footprint

struct rhw_sampler_data {
    struct rhw_sampler_def def;
    // The filters are linear, and nothing else is asked for: see filter_half.h.
    bool filters_plainly;
    // Textures of 8 bits take the fixed-point path: see filter_fixed.h.
    bool filters_fixed;
    // Shadow maps of one level may take a path of their own: see filter_compare.h.
    bool filters_compared;
    // Only the general sampler does what it asks for: see filter_general.h.
    bool is_general;
    // The bias and limits of the level of detail, in all lanes. The bias for gradients is less by 16, as sizes are 2^16
    // too large (rhw_mip).
    _Alignas(32) float gradient_bias[RHW_LANES];
    float lod_least[RHW_LANES], lod_most[RHW_LANES];
};

// Make a sampler of a valid definition.
void rhw_sampler_data_init(struct rhw_sampler_data *sampler, const struct rhw_sampler_def *def);

#endif
