// SPDX-License-Identifier: MIT
// What a sampler that compares holds texels against.
#ifndef RHW_DEPTH_REFERENCE_H
#define RHW_DEPTH_REFERENCE_H

#include "format/format.h"
#include "base/simd.h"
#include "rhw/shader.h"

// Return the reference. Channels that hold 0..1, or −1..1, are compared with a number in this range (Vulkan 1.3
// §16.3.4).
static inline f32x8 reference_of(const struct rhw_format_info *format,
                                 const struct rhw_sample_request *request)
{
    const f32x8 reference = request->reference ? *request->reference : rhw_splat(0.0f);
    return rhw_format_is_normalized(format)
               ? rhw_clamp(reference, rhw_splat(rhw_format_least(format)), rhw_splat(1.0f))
               : reference;
}

#endif
