// SPDX-License-Identifier: MIT
// The ambient occlusion of a fragment, looked up in the guide.
#ifndef SCENE_SHADE_GUIDE_H
#define SCENE_SHADE_GUIDE_H

#include "rhw/shader.h"
#include "scene_shaders.h"

/// Return how open the surroundings are at pixel coordinates of the picture, 0..1. It is a mean of the four texels
/// around. The nearer the distance of a texel is to `distance`, the more the texel counts, so that a surface takes
/// nothing from what stands before or behind it.
static inline rhw_float scene_guide_open(const struct scene_guide_lookup *guide, rhw_float x, rhw_float y,
                                         rhw_float distance)
{
    const int32_t count = guide->pitch * guide->height;
    const rhw_float left = rhw_clamp(x * guide->scale - 0.5f, 0.0f, (float)guide->width - 1.0f);
    const rhw_float top = rhw_clamp(y * guide->scale - 0.5f, 0.0f, (float)guide->height - 1.0f);
    const rhw_float column = rhw_floor(left), row = rhw_floor(top);
    const rhw_float right = left - column, below = top - row;
    const rhw_int corner =
        rhw_int_from_float_unchecked(row) * guide->pitch + rhw_int_from_float_unchecked(column);
    // There is no step beyond the last column and row.
    const rhw_int step_x = rhw_less(column, (float)guide->width - 1.0f) & 1;
    const rhw_int step_y = rhw_less(row, (float)guide->height - 1.0f) & guide->pitch;
    const rhw_float inverse = 1.0f / distance;
    rhw_float sum = rhw_splat(0.0f), weights = rhw_splat(0.0f);
    for (int i = 0; i < 4; i++) {
        const rhw_int at = corner + (i & 1 ? step_x : rhw_splat_int(0)) + (i & 2 ? step_y : rhw_splat_int(0));
        const rhw_float there = rhw_gather(guide->distance, count, at);
        const rhw_float share = (i & 1 ? right : 1.0f - right) * (i & 2 ? below : 1.0f - below);
        const rhw_float weight = (share + 1e-4f) / (1e-3f + rhw_abs(there * inverse - 1.0f));
        const rhw_int some = rhw_less(there, 1e30f);
        weights += rhw_select(some, weight, 0.0f);
        sum += rhw_select(some, weight * rhw_gather(guide->occlusion, count, at), 0.0f);
    }
    return rhw_select(rhw_less(0.0f, weights), sum / weights, 1.0f);
}

#endif
