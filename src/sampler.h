// SPDX-License-Identifier: MIT
// A sampler's state, and what the sampling functions would otherwise work out again for every 8 fragments.
#ifndef RHW_SAMPLER_H
#define RHW_SAMPLER_H

#include "rhw/shader_lanes.h"
#include "rhw/types.h"

struct rhw_sampler_data {
    struct rhw_sampler_def def;
    bool takes_codes; // textures of 8 bits are filtered on the fixed-point road: see codes_tmpl.h
    // Of the level of detail, in all lanes. The bias for slopes is less by 16, as sizes are 2^16 too large (rhw_mip).
    _Alignas(32) float slope_bias[RHW_LANES];
    float detail_min[RHW_LANES], detail_max[RHW_LANES];
};

#endif
