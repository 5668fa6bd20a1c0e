// SPDX-License-Identifier: MIT
// The guide keeps two normals of a texel in four halves: the shading normal, and the normal of the facet. Each is
// folded onto an octahedron, whose faces unfold into a square (Q. Meyer, J. Süßmuth, G. Sußner, M. Stamminger, G.
// Greiner, "On floating-point normal vectors", 2010).
#ifndef SCENE_GUIDE_NORMAL_H
#define SCENE_GUIDE_NORMAL_H

#include "rhw/shader.h"

/// Find the place of a normal in the square −1..1. The normal need not be unit. Take (0, 0, 1) where it is 0 or NaN.
static inline void scene_normal_fold(const rhw_float n[3], rhw_float place[2])
{
    const rhw_float sum = rhw_abs(n[0]) + rhw_abs(n[1]) + rhw_abs(n[2]);
    const rhw_int some = rhw_less(1e-20f, sum);
    const rhw_float inverse = 1.0f / rhw_select(some, sum, 1.0f);
    const rhw_float x = rhw_select(some, n[0] * inverse, 0.0f), y = rhw_select(some, n[1] * inverse, 0.0f);
    const rhw_int below = rhw_less(n[2], 0.0f);
    place[0] = rhw_select(below, rhw_copysign(1.0f - rhw_abs(y), x), x);
    place[1] = rhw_select(below, rhw_copysign(1.0f - rhw_abs(x), y), y);
}

/// Find the unit normal of a place.
static inline void scene_normal_unfold(const rhw_float place[2], rhw_float n[3])
{
    n[2] = 1.0f - rhw_abs(place[0]) - rhw_abs(place[1]);
    const rhw_float beyond = rhw_max(-n[2], 0.0f);
    n[0] = place[0] - rhw_copysign(beyond, place[0]);
    n[1] = place[1] - rhw_copysign(beyond, place[1]);
    rhw_normalize3(n, n);
}

#endif
