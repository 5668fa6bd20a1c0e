// SPDX-License-Identifier: MIT
// A struct can name the varyings of a program, in place of numbers into varying[]. All members of the struct are
// rhw_float or arrays of rhw_float:
//
//     struct surface { rhw_float normal[3], uv[2]; };
//     static const struct rhw_varying surface_varyings[] = {RHW_VARYING(struct surface, normal, RHW_SMOOTH, false),
//                                                           RHW_VARYING(struct surface, uv, RHW_SMOOTH, true)};
//
// The vertex function writes the struct. The fragment function reads it, and its derivatives:
//
//     struct surface *out = RHW_VARYINGS_OUT(struct surface, v->varying);
//     const struct surface *in = RHW_VARYINGS(struct surface, f->varying);
//     const struct surface *ddx = RHW_VARYINGS(struct surface, f->ddx);
//
// Members that did not ask for derivatives are not set in `ddx`.
//
// rhw_pipeline_create reports members that are missing, out of order, or of a size that a varying cannot have.
// Functions for one vertex or fragment at a time take a struct of float with the same members. A program may mix both
// forms, because either struct describes the varyings. shader.h includes this header.
#ifndef RHW_SHADER_VARYING_H
#define RHW_SHADER_VARYING_H

#include "shader.h"

/// RHW_VARYING is the initializer, in braces, of a struct rhw_varying for `member` of `type`, a struct of rhw_float.
/// `qualifier` and `derivatives` are members of struct rhw_varying. A program sets the member `sampling` by itself.
#define RHW_VARYING(type, member, qualifier, derivatives) \
    RHW_VARYING_OF(type, member, qualifier, derivatives, sizeof(rhw_float))

/// RHW_VARYING1 is the initializer of a struct rhw_varying for `member` of `type`, a struct of float.
#define RHW_VARYING1(type, member, qualifier, derivatives) \
    RHW_VARYING_OF(type, member, qualifier, derivatives, sizeof(float))

#define RHW_VARYING_OF(type, member, qualifier, derivatives, lane)                      \
    {                                                                                   \
        sizeof(RHW_NOWHERE(type)->member) / (lane), qualifier, derivatives, #member,    \
            offsetof(type, member) / (lane), sizeof(type) / (lane), RHW_SAMPLING_CENTER \
    }

/// RHW_COMPONENT is the number of a member's first component in `varying[]`, which rhw_sample_groups and
/// rhw_dual_varying ask for. `type` is a struct of rhw_float.
#define RHW_COMPONENT(type, member) ((int)(offsetof(type, member) / sizeof(rhw_float)))

/// RHW_COMPONENT1 is the number of a member's first component in `varying[]`. `type` is a struct of float.
#define RHW_COMPONENT1(type, member) ((int)(offsetof(type, member) / sizeof(float)))

#if defined(__cplusplus)

#define RHW_NOWHERE(type)                  static_cast<type *>(0)
#define RHW_VARYINGS(type, components)     static_cast<const type *>(static_cast<const void *>(components))
#define RHW_VARYINGS_OUT(type, components) static_cast<type *>(static_cast<void *>(components))

#else

#define RHW_NOWHERE(type)                  ((type *)0)

/// RHW_VARYINGS casts the `varying`, `ddx` or `ddy` of a fragment to a pointer to a struct that the function reads. It
/// serves both forms of functions.
#define RHW_VARYINGS(type, components)     ((const type *)(const void *)(components))

/// RHW_VARYINGS_OUT casts the `varying` of a vertex to a pointer to a struct that the function writes.
#define RHW_VARYINGS_OUT(type, components) ((type *)(void *)(components))

#endif

// Varyings at another place -------------------------------------------------------------------------
// A smooth value is N/S, with N and S = 1/W linear on the screen. A fragment has the value q and W = w. At an offset of
// (x, y) the value is q + (q_x·x + q_y·y) · S/S', where S/S' = w / (w − (w_x·x + w_y·y)), because W is itself a smooth
// varying.

RHW_QUIET_BEGIN

#if RHW_HAS_LANES

/// Return the value of a component of `varying[]` at `offset` pixels to the right and down from the place where the
/// fragment takes its values (GLSL 4.60 §8.13.2, interpolateAtOffset; SPIR-V, InterpolateAtOffset). That place is the
/// pixel's centre, but for RHW_SAMPLING_CENTROID and RHW_SAMPLING_SAMPLE. A sample lies at rhw_sample_position − 0.5
/// from the centre. The varying must have derivatives.
///
/// `w` is needed for perspective. For a smooth varying it is the component of another smooth varying with derivatives,
/// which the vertex function sets to position[3]. It is −1 for RHW_NOPERSPECTIVE and if there is no perspective. A flat
/// varying is the same everywhere.
///
/// The value is the triangle's own value at that place, also outside of the triangle, up to rounding. Within the
/// triangle the error is at most 32 ULP (measured: 17, and 2 at 99 of 100 places) of the largest vertex value, or of a
/// derivative's share of the sum if that share is larger, as in slivers. For a smooth varying the error is multiplied
/// by the largest W of the vertices over the W at the place (docs/exactness.md).
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
