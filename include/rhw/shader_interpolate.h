// SPDX-License-Identifier: MIT
// Varyings at another place than the fragment's. Included by shader.h.
//
// A smooth value is N/S, both linear on the screen, with S = 1/W. At a fragment with value q and W = w, moved by (x, y):
// q + (q_x·x + q_y·y) · S/S', and S/S' = w / (w − (w_x·x + w_y·y)), as W itself is a smooth varying.
#ifndef RHW_SHADER_INTERPOLATE_H
#define RHW_SHADER_INTERPOLATE_H

#include "shader.h"

RHW_QUIET_BEGIN

#if RHW_HAS_LANES

/// The value of a component of `varying[]` at `offset` pixels to the right and down from where the fragment has its values,
/// the pixel's centre but for RHW_SAMPLING_CENTROID and SAMPLE (GLSL 4.60 §8.13.2, interpolateAtOffset; SPIR-V,
/// InterpolateAtOffset). That is the triangle's own value there, also outside of it, but for rounding: within the triangle at
/// most 32 ULP (measured: 17, and 2 at 99 places of 100) of its largest vertex value, or of a derivative's share in what is
/// added where that is more (slivers); of a smooth one as many times that as the vertices' largest W is of the W there
/// (docs/exactness.md). Derivatives are asked for with the varying. For a smooth one `w` is the component of another that has
/// derivatives too: of a smooth varying that the vertex function sets to position[3]. Without perspective, and for
/// RHW_NOPERSPECTIVE, it is −1. A flat varying is the same everywhere. Samples lie at rhw_sample_position − 0.5 from the
/// centre.
static inline rhw_float rhw_interpolate_at(const struct rhw_fragment *fragment, int component, int w,
                                           const rhw_float offset[2])
{
    const rhw_float change = fragment->ddx[component] * offset[0] + fragment->ddy[component] * offset[1];
    if (w < 0) {
        return fragment->varying[component] + change;
    }
    const rhw_float here = fragment->varying[w];
    const rhw_float there = here - (fragment->ddx[w] * offset[0] + fragment->ddy[w] * offset[1]);
    return fragment->varying[component] + change * (here / there);
}

#endif

static inline float rhw_interpolate_at1(const struct rhw_fragment1 *fragment, int component, int w,
                                        const float offset[2])
{
    const float change = fragment->ddx[component] * offset[0] + fragment->ddy[component] * offset[1];
    if (w < 0) {
        return fragment->varying[component] + change;
    }
    const float here = fragment->varying[w];
    const float there = here - (fragment->ddx[w] * offset[0] + fragment->ddy[w] * offset[1]);
    return fragment->varying[component] + change * (here / there);
}

RHW_QUIET_END

#endif
