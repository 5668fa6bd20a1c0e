// SPDX-License-Identifier: MIT
// With this header a plain number may stand where a function takes 8 lanes: rhw_max(v, 0.0f), rhw_mix(v, w, 0.5f),
// rhw_less_int(i, 3). The number stands for 8 equal lanes. rhw_splat serves for lanes that are stored. Lanes of the
// wrong kind, for example rhw_int in place of rhw_float, are an error, because only the author knows whether a
// conversion or a cast of bits is meant. shader.h includes this header.
//
// C has macros with the names of the functions, so a program can still take the address of a function. A literal with
// commas, (rhw_float){1, 2, ..}, needs another pair of brackets around it. C++ has overloads.
#ifndef RHW_SHADER_SCALAR_H
#define RHW_SHADER_SCALAR_H

#include "shader_hyperbolic.h"
#include "shader_integer.h"
#include "shader_pack.h"

#if RHW_HAS_LANES

RHW_QUIET_BEGIN

#if defined(__cplusplus)

extern "C++" {

static inline rhw_float rhw_lanes_from(rhw_float lanes)
{
    return lanes;
}

// This overload takes any type of number.
template <class A> static inline rhw_float rhw_lanes_from(A value)
{
    return rhw_splat(static_cast<float>(value));
}

// This overload is deleted, because clang would take the bits of the integers for floats.
rhw_float rhw_lanes_from(rhw_int lanes) = delete;

static inline rhw_int rhw_int_lanes_from(rhw_int lanes)
{
    return lanes;
}

// This overload takes any type of number, and leaves warnings of a conversion to the compiler.
template <class A> static inline rhw_int rhw_int_lanes_from(A value)
{
    return rhw_splat_int(value);
}

// This overload takes the bits of an unsigned number, because lanes may count as unsigned.
static inline rhw_int rhw_int_lanes_from(uint32_t value)
{
    return rhw_splat_int(static_cast<int32_t>(value));
}

rhw_int rhw_int_lanes_from(rhw_float lanes) = delete;

template <class A, class B> static inline rhw_int rhw_less(A a, B b)
{
    return rhw_less(rhw_lanes_from(a), rhw_lanes_from(b));
}

template <class A, class B> static inline rhw_int rhw_less_equal(A a, B b)
{
    return rhw_less_equal(rhw_lanes_from(a), rhw_lanes_from(b));
}

template <class A, class B> static inline rhw_int rhw_equal(A a, B b)
{
    return rhw_equal(rhw_lanes_from(a), rhw_lanes_from(b));
}

template <class A, class B> static inline rhw_int rhw_greater(A a, B b)
{
    return rhw_greater(rhw_lanes_from(a), rhw_lanes_from(b));
}

template <class A, class B> static inline rhw_int rhw_greater_equal(A a, B b)
{
    return rhw_greater_equal(rhw_lanes_from(a), rhw_lanes_from(b));
}

template <class A, class B> static inline rhw_int rhw_not_equal(A a, B b)
{
    return rhw_not_equal(rhw_lanes_from(a), rhw_lanes_from(b));
}

template <class A, class B> static inline rhw_int rhw_less_int(A a, B b)
{
    return rhw_less_int(rhw_int_lanes_from(a), rhw_int_lanes_from(b));
}

template <class A, class B> static inline rhw_int rhw_equal_int(A a, B b)
{
    return rhw_equal_int(rhw_int_lanes_from(a), rhw_int_lanes_from(b));
}

template <class A, class B> static inline rhw_float rhw_select(rhw_int mask, A a, B b)
{
    return rhw_select(mask, rhw_lanes_from(a), rhw_lanes_from(b));
}

template <class A, class B> static inline rhw_int rhw_select_int(rhw_int mask, A a, B b)
{
    return rhw_select_int(mask, rhw_int_lanes_from(a), rhw_int_lanes_from(b));
}

template <class A, class B> static inline rhw_float rhw_min(A a, B b)
{
    return rhw_min(rhw_lanes_from(a), rhw_lanes_from(b));
}

template <class A, class B> static inline rhw_float rhw_max(A a, B b)
{
    return rhw_max(rhw_lanes_from(a), rhw_lanes_from(b));
}

template <class A, class B> static inline rhw_int rhw_min_int(A a, B b)
{
    return rhw_min_int(rhw_int_lanes_from(a), rhw_int_lanes_from(b));
}

template <class A, class B> static inline rhw_int rhw_max_int(A a, B b)
{
    return rhw_max_int(rhw_int_lanes_from(a), rhw_int_lanes_from(b));
}

template <class A, class B, class C> static inline rhw_float rhw_clamp(A a, B low, C high)
{
    return rhw_clamp(rhw_lanes_from(a), rhw_lanes_from(low), rhw_lanes_from(high));
}

template <class A, class B> static inline rhw_float rhw_copysign(A a, B sign)
{
    return rhw_copysign(rhw_lanes_from(a), rhw_lanes_from(sign));
}

template <class A, class B, class C> static inline rhw_float rhw_mix(A a, B b, C t)
{
    return rhw_mix(rhw_lanes_from(a), rhw_lanes_from(b), rhw_lanes_from(t));
}

template <class A, class B, class C> static inline rhw_float rhw_smoothstep(A edge0, B edge1, C a)
{
    return rhw_smoothstep(rhw_lanes_from(edge0), rhw_lanes_from(edge1), rhw_lanes_from(a));
}

template <class A, class B> static inline rhw_float rhw_pow(A a, B b)
{
    return rhw_pow(rhw_lanes_from(a), rhw_lanes_from(b));
}

template <class A, class B> static inline rhw_float rhw_atan2(A y, B x)
{
    return rhw_atan2(rhw_lanes_from(y), rhw_lanes_from(x));
}

template <class A, class B> static inline rhw_int rhw_divide_int(A a, B b)
{
    return rhw_divide_int(rhw_int_lanes_from(a), rhw_int_lanes_from(b));
}

template <class A, class B> static inline rhw_int rhw_remainder_int(A a, B b)
{
    return rhw_remainder_int(rhw_int_lanes_from(a), rhw_int_lanes_from(b));
}

template <class A, class B> static inline rhw_int rhw_divide_uint(A a, B b)
{
    return rhw_divide_uint(rhw_int_lanes_from(a), rhw_int_lanes_from(b));
}

template <class A, class B> static inline rhw_int rhw_remainder_uint(A a, B b)
{
    return rhw_remainder_uint(rhw_int_lanes_from(a), rhw_int_lanes_from(b));
}

template <class A, class B> static inline rhw_float rhw_ldexp(A a, B n)
{
    return rhw_ldexp(rhw_lanes_from(a), rhw_int_lanes_from(n));
}

} // extern "C++"

#else

static inline rhw_float rhw_same(rhw_float lanes)
{
    return lanes;
}

static inline rhw_int rhw_same_int(rhw_int lanes)
{
    return lanes;
}

#define RHW_LANES_FROM(a)     _Generic((a), rhw_float: rhw_same, default: rhw_splat)(a)
#define RHW_INT_LANES_FROM(a) _Generic((a), rhw_int: rhw_same_int, default: rhw_splat_int)(a)

#define rhw_less(a, b)             rhw_less(RHW_LANES_FROM(a), RHW_LANES_FROM(b))
#define rhw_less_equal(a, b)       rhw_less_equal(RHW_LANES_FROM(a), RHW_LANES_FROM(b))
#define rhw_equal(a, b)            rhw_equal(RHW_LANES_FROM(a), RHW_LANES_FROM(b))
#define rhw_greater(a, b)          rhw_greater(RHW_LANES_FROM(a), RHW_LANES_FROM(b))
#define rhw_greater_equal(a, b)    rhw_greater_equal(RHW_LANES_FROM(a), RHW_LANES_FROM(b))
#define rhw_not_equal(a, b)        rhw_not_equal(RHW_LANES_FROM(a), RHW_LANES_FROM(b))
#define rhw_less_int(a, b)         rhw_less_int(RHW_INT_LANES_FROM(a), RHW_INT_LANES_FROM(b))
#define rhw_equal_int(a, b)        rhw_equal_int(RHW_INT_LANES_FROM(a), RHW_INT_LANES_FROM(b))
#define rhw_select(mask, a, b)     rhw_select(mask, RHW_LANES_FROM(a), RHW_LANES_FROM(b))
#define rhw_select_int(mask, a, b) rhw_select_int(mask, RHW_INT_LANES_FROM(a), RHW_INT_LANES_FROM(b))
#define rhw_min(a, b)              rhw_min(RHW_LANES_FROM(a), RHW_LANES_FROM(b))
#define rhw_max(a, b)              rhw_max(RHW_LANES_FROM(a), RHW_LANES_FROM(b))
#define rhw_min_int(a, b)          rhw_min_int(RHW_INT_LANES_FROM(a), RHW_INT_LANES_FROM(b))
#define rhw_max_int(a, b)          rhw_max_int(RHW_INT_LANES_FROM(a), RHW_INT_LANES_FROM(b))
#define rhw_clamp(a, low, high)    rhw_clamp(RHW_LANES_FROM(a), RHW_LANES_FROM(low), RHW_LANES_FROM(high))
#define rhw_copysign(a, sign)      rhw_copysign(RHW_LANES_FROM(a), RHW_LANES_FROM(sign))
#define rhw_mix(a, b, t)           rhw_mix(RHW_LANES_FROM(a), RHW_LANES_FROM(b), RHW_LANES_FROM(t))
#define rhw_smoothstep(edge0, edge1, a) \
    rhw_smoothstep(RHW_LANES_FROM(edge0), RHW_LANES_FROM(edge1), RHW_LANES_FROM(a))
#define rhw_pow(a, b)            rhw_pow(RHW_LANES_FROM(a), RHW_LANES_FROM(b))
#define rhw_atan2(y, x)          rhw_atan2(RHW_LANES_FROM(y), RHW_LANES_FROM(x))
#define rhw_divide_int(a, b)     rhw_divide_int(RHW_INT_LANES_FROM(a), RHW_INT_LANES_FROM(b))
#define rhw_remainder_int(a, b)  rhw_remainder_int(RHW_INT_LANES_FROM(a), RHW_INT_LANES_FROM(b))
#define rhw_divide_uint(a, b)    rhw_divide_uint(RHW_INT_LANES_FROM(a), RHW_INT_LANES_FROM(b))
#define rhw_remainder_uint(a, b) rhw_remainder_uint(RHW_INT_LANES_FROM(a), RHW_INT_LANES_FROM(b))
#define rhw_ldexp(a, n)          rhw_ldexp(RHW_LANES_FROM(a), RHW_INT_LANES_FROM(n))

#endif

RHW_QUIET_END

#endif

#endif
