// SPDX-License-Identifier: MIT
// Varyings by name: a struct instead of numbers into varying[]. All its members are rhw_float or arrays of them:
//
//     struct surface { rhw_float normal[3], uv[2]; };
//     static const struct rhw_varying surface_varyings[] = {RHW_VARYING(struct surface, normal, RHW_SMOOTH, false),
//                                                           RHW_VARYING(struct surface, uv, RHW_SMOOTH, true)};
//
// The vertex function writes it, the fragment function reads it and its derivatives:
//
//     struct surface *out = RHW_VARYINGS_OUT(struct surface, v->varying);
//     const struct surface *in = RHW_VARYINGS(struct surface, f->varying);
//     const struct surface *ddx = RHW_VARYINGS(struct surface, f->ddx);
//
// Of the derivatives, members that did not ask for them are not filled in.
//
// rhw_pipeline_create tells members that are missing, out of order, or of a size that a varying cannot have. One vertex
// or fragment at a time has a struct of float with the same members; the functions of a program may mix both forms, as
// either struct describes the varyings. Included by shader.h.
#ifndef RHW_SHADER_VARYING_H
#define RHW_SHADER_VARYING_H

#include "shader.h"

/// The initializer of a struct rhw_varying for `member` of `type`, a struct of rhw_float, in braces. `qualifier` and
/// `derivatives` are those of struct rhw_varying; its `sampling` is set apart.
#define RHW_VARYING(type, member, qualifier, derivatives) \
    RHW_VARYING_OF(type, member, qualifier, derivatives, sizeof(rhw_float))

/// The same for a struct of float.
#define RHW_VARYING1(type, member, qualifier, derivatives) \
    RHW_VARYING_OF(type, member, qualifier, derivatives, sizeof(float))

#define RHW_VARYING_OF(type, member, qualifier, derivatives, lane)                      \
    {                                                                                   \
        sizeof(RHW_NOWHERE(type)->member) / (lane), qualifier, derivatives, #member,    \
            offsetof(type, member) / (lane), sizeof(type) / (lane), RHW_SAMPLING_CENTER \
    }

/// The number of a member's first component in `varying[]`, as rhw_sample_groups and rhw_dual_varying ask for; of a struct
/// of rhw_float.
#define RHW_COMPONENT(type, member) ((int)(offsetof(type, member) / sizeof(rhw_float)))

/// The same for a struct of float.
#define RHW_COMPONENT1(type, member) ((int)(offsetof(type, member) / sizeof(float)))

#if defined(__cplusplus)

#define RHW_NOWHERE(type)                  static_cast<type *>(0)
#define RHW_VARYINGS(type, components)     static_cast<const type *>(static_cast<const void *>(components))
#define RHW_VARYINGS_OUT(type, components) static_cast<type *>(static_cast<void *>(components))

#else

#define RHW_NOWHERE(type)                  ((type *)0)

/// What a fragment function reads as a struct: its `varying`, `ddx` or `ddy`, in either form.
#define RHW_VARYINGS(type, components)     ((const type *)(const void *)(components))

/// What a vertex function writes as a struct: its `varying`.
#define RHW_VARYINGS_OUT(type, components) ((type *)(void *)(components))

#endif

// Varyings at another place
//
// A smooth value is N/S, both linear on the screen, with S = 1/W. At a fragment with value q and W = w, moved by (x, y):
// q + (q_x·x + q_y·y) · S/S', and S/S' = w / (w − (w_x·x + w_y·y)), as W itself is a smooth varying.

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
