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

#include "shader_lanes.h"
#include "types.h"

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

#endif
