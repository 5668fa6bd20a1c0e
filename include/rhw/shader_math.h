// SPDX-License-Identifier: MIT
// Vector maths for shader functions. Included by shader.h.
#ifndef RHW_SHADER_MATH_H
#define RHW_SHADER_MATH_H

/// All 8 lanes equal.
static inline rhw_float rhw_splat(float value)
{
    return (rhw_float){value, value, value, value, value, value, value, value};
}

static inline rhw_int rhw_splat_int(int32_t value)
{
    return (rhw_int){value, value, value, value, value, value, value, value};
}

/// Lane by lane: a where mask is −1, b where it is 0.
static inline rhw_float rhw_select(rhw_int mask, rhw_float a, rhw_float b)
{
    return (rhw_float)((mask & (rhw_int)a) | (~mask & (rhw_int)b));
}

#endif
