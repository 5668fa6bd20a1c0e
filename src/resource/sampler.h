// SPDX-License-Identifier: MIT
// A sampler's state, and what the sampling functions would otherwise work out again for every 8 fragments.
#ifndef RHW_SAMPLER_H
#define RHW_SAMPLER_H

#include "rhw/shader_lanes.h"
#include "rhw/types.h"

struct rhw_sampler_data {
    struct rhw_sampler_def def;
    bool filters_plainly;  // by linear filters, with nothing else to ask for: see filter_half.h
    bool filters_fixed;    // textures of 8 bits take the fixed-point path: see filter_fixed.h
    bool filters_compared; // shadow maps of one level may take a path of their own: see filter_compare.h
    bool is_general;       // only the general sampler does what it asks for: see filter_general.h
    // Of the level of detail, in all lanes. The bias for gradients is less by 16, as sizes are 2^16 too large
    // (rhw_mip).
    _Alignas(32) float gradient_bias[RHW_LANES];
    float lod_least[RHW_LANES], lod_most[RHW_LANES];
};

// `def` is valid.
void rhw_sampler_data_init(struct rhw_sampler_data *sampler, const struct rhw_sampler_def *def);

#endif
