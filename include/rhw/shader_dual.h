// SPDX-License-Identifier: MIT
// Derivatives of what a fragment function computes, by forward mode: a dual is a value with its change per pixel to the
// right and down. It begins as a varying that asked for derivatives, and every function here carries value and change
// on, by the rules of calculus: exact up to rounding, in branches and loops too, where differences of neighbouring
// pixels are neither. What it is for: the gradient that a texture is sampled with at coordinates that are computed, and
// edges that are a pixel wide.
//
//     struct rhw_dual uv[2] = {rhw_dual_varying(f, 0), rhw_dual_varying(f, 1)};
//     uv[0] = rhw_dual_add(uv[0], rhw_dual_scale(rhw_dual_sin(uv[1]), 0.1f));
//     rhw_sample_dual(f->textures, 0, uv, texel);
//
// rhw_dual_name has the value of rhw_name, bit for bit, with its errors and special cases. Where a function has a corner
// the change is that of the side it takes its value from; where its slope is infinite, as that of sqrt at 0, or NaN, so
// is the change, and 0 · ∞ is NaN. Compare values: rhw_less(a.value, b.value). Operands may be plain numbers or lanes
// where they need no change of their own: rhw_dual_max(a, 0.0f). Not part of shader.h: include it where it is wanted.
#ifndef RHW_SHADER_DUAL_H
#define RHW_SHADER_DUAL_H

#include "shader_dual_lanes.h"
#include "shader_dual_one.h"
#include "shader_dual_scalar.h"

#endif
