// SPDX-License-Identifier: MIT
// With this header a plain number, or lanes without a change of their own, may stand where a function takes a dual:
// rhw_dual_max(a, 0.0f), rhw_dual_mul(v, a). They are constants there. rhw_dual_scale and rhw_dual_offset do less work
// if a factor or summand is constant. As in shader_scalar.h, C has macros and C++ has overloads; C++ also has the
// operators + − · /. shader_dual.h includes this header.
#ifndef RHW_SHADER_DUAL_SCALAR_H
#define RHW_SHADER_DUAL_SCALAR_H

#include "shader_dual_one.h"

#if RHW_HAS_LANES

RHW_QUIET_BEGIN

#if defined(__cplusplus)

extern "C++" {

// 8 lanes -------------------------------------------------------------------------------------------

static inline struct rhw_dual rhw_dual_from(struct rhw_dual dual)
{
    return dual;
}

template <class A> static inline struct rhw_dual rhw_dual_from(A value)
{
    return rhw_dual_constant(rhw_lanes_from(value));
}

template <class A, class B> static inline struct rhw_dual rhw_dual_add(A a, B b)
{
    return rhw_dual_add(rhw_dual_from(a), rhw_dual_from(b));
}

template <class A, class B> static inline struct rhw_dual rhw_dual_sub(A a, B b)
{
    return rhw_dual_sub(rhw_dual_from(a), rhw_dual_from(b));
}

template <class A, class B> static inline struct rhw_dual rhw_dual_mul(A a, B b)
{
    return rhw_dual_mul(rhw_dual_from(a), rhw_dual_from(b));
}

template <class A, class B> static inline struct rhw_dual rhw_dual_div(A a, B b)
{
    return rhw_dual_div(rhw_dual_from(a), rhw_dual_from(b));
}

template <class A, class B> static inline struct rhw_dual rhw_dual_select(rhw_int mask, A a, B b)
{
    return rhw_dual_select(mask, rhw_dual_from(a), rhw_dual_from(b));
}

template <class A, class B> static inline struct rhw_dual rhw_dual_min(A a, B b)
{
    return rhw_dual_min(rhw_dual_from(a), rhw_dual_from(b));
}

template <class A, class B> static inline struct rhw_dual rhw_dual_max(A a, B b)
{
    return rhw_dual_max(rhw_dual_from(a), rhw_dual_from(b));
}

template <class A, class B, class C> static inline struct rhw_dual rhw_dual_clamp(A a, B low, C high)
{
    return rhw_dual_clamp(rhw_dual_from(a), rhw_dual_from(low), rhw_dual_from(high));
}

template <class A, class B, class C> static inline struct rhw_dual rhw_dual_mix(A a, B b, C t)
{
    return rhw_dual_mix(rhw_dual_from(a), rhw_dual_from(b), rhw_dual_from(t));
}

template <class A, class B, class C> static inline struct rhw_dual rhw_dual_smoothstep(A edge0, B edge1, C a)
{
    return rhw_dual_smoothstep(rhw_dual_from(edge0), rhw_dual_from(edge1), rhw_dual_from(a));
}

template <class A, class B> static inline struct rhw_dual rhw_dual_pow(A a, B b)
{
    return rhw_dual_pow(rhw_dual_from(a), rhw_dual_from(b));
}

template <class A, class B> static inline struct rhw_dual rhw_dual_atan2(A y, B x)
{
    return rhw_dual_atan2(rhw_dual_from(y), rhw_dual_from(x));
}

template <class B> static inline struct rhw_dual rhw_dual_scale(struct rhw_dual a, B factor)
{
    return rhw_dual_scale(a, rhw_lanes_from(factor));
}

template <class B> static inline struct rhw_dual rhw_dual_offset(struct rhw_dual a, B offset)
{
    return rhw_dual_offset(a, rhw_lanes_from(offset));
}

static inline struct rhw_dual operator+(struct rhw_dual a, struct rhw_dual b)
{
    return rhw_dual_add(a, b);
}

template <class B> static inline struct rhw_dual operator+(struct rhw_dual a, B b)
{
    return rhw_dual_add(a, rhw_dual_from(b));
}

template <class A> static inline struct rhw_dual operator+(A a, struct rhw_dual b)
{
    return rhw_dual_add(rhw_dual_from(a), b);
}

static inline struct rhw_dual operator-(struct rhw_dual a, struct rhw_dual b)
{
    return rhw_dual_sub(a, b);
}

template <class B> static inline struct rhw_dual operator-(struct rhw_dual a, B b)
{
    return rhw_dual_sub(a, rhw_dual_from(b));
}

template <class A> static inline struct rhw_dual operator-(A a, struct rhw_dual b)
{
    return rhw_dual_sub(rhw_dual_from(a), b);
}

static inline struct rhw_dual operator*(struct rhw_dual a, struct rhw_dual b)
{
    return rhw_dual_mul(a, b);
}

template <class B> static inline struct rhw_dual operator*(struct rhw_dual a, B b)
{
    return rhw_dual_mul(a, rhw_dual_from(b));
}

template <class A> static inline struct rhw_dual operator*(A a, struct rhw_dual b)
{
    return rhw_dual_mul(rhw_dual_from(a), b);
}

static inline struct rhw_dual operator/(struct rhw_dual a, struct rhw_dual b)
{
    return rhw_dual_div(a, b);
}

template <class B> static inline struct rhw_dual operator/(struct rhw_dual a, B b)
{
    return rhw_dual_div(a, rhw_dual_from(b));
}

template <class A> static inline struct rhw_dual operator/(A a, struct rhw_dual b)
{
    return rhw_dual_div(rhw_dual_from(a), b);
}

static inline struct rhw_dual operator-(struct rhw_dual a)
{
    return rhw_dual_neg(a);
}

// One at a time -------------------------------------------------------------------------------------

static inline struct rhw_dual1 rhw_dual_from1(struct rhw_dual1 dual)
{
    return dual;
}

template <class A> static inline struct rhw_dual1 rhw_dual_from1(A value)
{
    return rhw_dual_constant1(static_cast<float>(value));
}

template <class A, class B> static inline struct rhw_dual1 rhw_dual_add1(A a, B b)
{
    return rhw_dual_add1(rhw_dual_from1(a), rhw_dual_from1(b));
}

template <class A, class B> static inline struct rhw_dual1 rhw_dual_sub1(A a, B b)
{
    return rhw_dual_sub1(rhw_dual_from1(a), rhw_dual_from1(b));
}

template <class A, class B> static inline struct rhw_dual1 rhw_dual_mul1(A a, B b)
{
    return rhw_dual_mul1(rhw_dual_from1(a), rhw_dual_from1(b));
}

template <class A, class B> static inline struct rhw_dual1 rhw_dual_div1(A a, B b)
{
    return rhw_dual_div1(rhw_dual_from1(a), rhw_dual_from1(b));
}

template <class A, class B> static inline struct rhw_dual1 rhw_dual_select1(bool mask, A a, B b)
{
    return rhw_dual_select1(mask, rhw_dual_from1(a), rhw_dual_from1(b));
}

template <class A, class B> static inline struct rhw_dual1 rhw_dual_min1(A a, B b)
{
    return rhw_dual_min1(rhw_dual_from1(a), rhw_dual_from1(b));
}

template <class A, class B> static inline struct rhw_dual1 rhw_dual_max1(A a, B b)
{
    return rhw_dual_max1(rhw_dual_from1(a), rhw_dual_from1(b));
}

template <class A, class B, class C> static inline struct rhw_dual1 rhw_dual_clamp1(A a, B low, C high)
{
    return rhw_dual_clamp1(rhw_dual_from1(a), rhw_dual_from1(low), rhw_dual_from1(high));
}

template <class A, class B, class C> static inline struct rhw_dual1 rhw_dual_mix1(A a, B b, C t)
{
    return rhw_dual_mix1(rhw_dual_from1(a), rhw_dual_from1(b), rhw_dual_from1(t));
}

template <class A, class B, class C>
static inline struct rhw_dual1 rhw_dual_smoothstep1(A edge0, B edge1, C a)
{
    return rhw_dual_smoothstep1(rhw_dual_from1(edge0), rhw_dual_from1(edge1), rhw_dual_from1(a));
}

template <class A, class B> static inline struct rhw_dual1 rhw_dual_pow1(A a, B b)
{
    return rhw_dual_pow1(rhw_dual_from1(a), rhw_dual_from1(b));
}

template <class A, class B> static inline struct rhw_dual1 rhw_dual_atan2_1(A y, B x)
{
    return rhw_dual_atan2_1(rhw_dual_from1(y), rhw_dual_from1(x));
}

static inline struct rhw_dual1 operator+(struct rhw_dual1 a, struct rhw_dual1 b)
{
    return rhw_dual_add1(a, b);
}

template <class B> static inline struct rhw_dual1 operator+(struct rhw_dual1 a, B b)
{
    return rhw_dual_add1(a, rhw_dual_from1(b));
}

template <class A> static inline struct rhw_dual1 operator+(A a, struct rhw_dual1 b)
{
    return rhw_dual_add1(rhw_dual_from1(a), b);
}

static inline struct rhw_dual1 operator-(struct rhw_dual1 a, struct rhw_dual1 b)
{
    return rhw_dual_sub1(a, b);
}

template <class B> static inline struct rhw_dual1 operator-(struct rhw_dual1 a, B b)
{
    return rhw_dual_sub1(a, rhw_dual_from1(b));
}

template <class A> static inline struct rhw_dual1 operator-(A a, struct rhw_dual1 b)
{
    return rhw_dual_sub1(rhw_dual_from1(a), b);
}

static inline struct rhw_dual1 operator*(struct rhw_dual1 a, struct rhw_dual1 b)
{
    return rhw_dual_mul1(a, b);
}

template <class B> static inline struct rhw_dual1 operator*(struct rhw_dual1 a, B b)
{
    return rhw_dual_mul1(a, rhw_dual_from1(b));
}

template <class A> static inline struct rhw_dual1 operator*(A a, struct rhw_dual1 b)
{
    return rhw_dual_mul1(rhw_dual_from1(a), b);
}

static inline struct rhw_dual1 operator/(struct rhw_dual1 a, struct rhw_dual1 b)
{
    return rhw_dual_div1(a, b);
}

template <class B> static inline struct rhw_dual1 operator/(struct rhw_dual1 a, B b)
{
    return rhw_dual_div1(a, rhw_dual_from1(b));
}

template <class A> static inline struct rhw_dual1 operator/(A a, struct rhw_dual1 b)
{
    return rhw_dual_div1(rhw_dual_from1(a), b);
}

static inline struct rhw_dual1 operator-(struct rhw_dual1 a)
{
    return rhw_dual_neg1(a);
}

} // extern "C++"

#else

// 8 lanes -------------------------------------------------------------------------------------------

static inline struct rhw_dual rhw_same_dual(struct rhw_dual dual)
{
    return dual;
}

static inline struct rhw_dual rhw_dual_constant_float(float value)
{
    return rhw_dual_constant(rhw_splat(value));
}

#define RHW_DUAL_FROM(a)                \
    _Generic((a),                       \
        struct rhw_dual: rhw_same_dual, \
        rhw_float: rhw_dual_constant,   \
        default: rhw_dual_constant_float)(a)

#define rhw_dual_add(a, b)           rhw_dual_add(RHW_DUAL_FROM(a), RHW_DUAL_FROM(b))
#define rhw_dual_sub(a, b)           rhw_dual_sub(RHW_DUAL_FROM(a), RHW_DUAL_FROM(b))
#define rhw_dual_mul(a, b)           rhw_dual_mul(RHW_DUAL_FROM(a), RHW_DUAL_FROM(b))
#define rhw_dual_div(a, b)           rhw_dual_div(RHW_DUAL_FROM(a), RHW_DUAL_FROM(b))
#define rhw_dual_select(mask, a, b)  rhw_dual_select(mask, RHW_DUAL_FROM(a), RHW_DUAL_FROM(b))
#define rhw_dual_min(a, b)           rhw_dual_min(RHW_DUAL_FROM(a), RHW_DUAL_FROM(b))
#define rhw_dual_max(a, b)           rhw_dual_max(RHW_DUAL_FROM(a), RHW_DUAL_FROM(b))
#define rhw_dual_clamp(a, low, high) rhw_dual_clamp(RHW_DUAL_FROM(a), RHW_DUAL_FROM(low), RHW_DUAL_FROM(high))
#define rhw_dual_mix(a, b, t)        rhw_dual_mix(RHW_DUAL_FROM(a), RHW_DUAL_FROM(b), RHW_DUAL_FROM(t))
#define rhw_dual_smoothstep(edge0, edge1, a) \
    rhw_dual_smoothstep(RHW_DUAL_FROM(edge0), RHW_DUAL_FROM(edge1), RHW_DUAL_FROM(a))
#define rhw_dual_pow(a, b)         rhw_dual_pow(RHW_DUAL_FROM(a), RHW_DUAL_FROM(b))
#define rhw_dual_atan2(y, x)       rhw_dual_atan2(RHW_DUAL_FROM(y), RHW_DUAL_FROM(x))
#define rhw_dual_scale(a, factor)  rhw_dual_scale(a, RHW_LANES_FROM(factor))
#define rhw_dual_offset(a, offset) rhw_dual_offset(a, RHW_LANES_FROM(offset))

// One at a time -------------------------------------------------------------------------------------

static inline struct rhw_dual1 rhw_same_dual1(struct rhw_dual1 dual)
{
    return dual;
}

#define RHW_DUAL1_FROM(a) _Generic((a), struct rhw_dual1: rhw_same_dual1, default: rhw_dual_constant1)(a)

#define rhw_dual_add1(a, b)          rhw_dual_add1(RHW_DUAL1_FROM(a), RHW_DUAL1_FROM(b))
#define rhw_dual_sub1(a, b)          rhw_dual_sub1(RHW_DUAL1_FROM(a), RHW_DUAL1_FROM(b))
#define rhw_dual_mul1(a, b)          rhw_dual_mul1(RHW_DUAL1_FROM(a), RHW_DUAL1_FROM(b))
#define rhw_dual_div1(a, b)          rhw_dual_div1(RHW_DUAL1_FROM(a), RHW_DUAL1_FROM(b))
#define rhw_dual_select1(mask, a, b) rhw_dual_select1(mask, RHW_DUAL1_FROM(a), RHW_DUAL1_FROM(b))
#define rhw_dual_min1(a, b)          rhw_dual_min1(RHW_DUAL1_FROM(a), RHW_DUAL1_FROM(b))
#define rhw_dual_max1(a, b)          rhw_dual_max1(RHW_DUAL1_FROM(a), RHW_DUAL1_FROM(b))
#define rhw_dual_clamp1(a, low, high) \
    rhw_dual_clamp1(RHW_DUAL1_FROM(a), RHW_DUAL1_FROM(low), RHW_DUAL1_FROM(high))
#define rhw_dual_mix1(a, b, t) rhw_dual_mix1(RHW_DUAL1_FROM(a), RHW_DUAL1_FROM(b), RHW_DUAL1_FROM(t))
#define rhw_dual_smoothstep1(edge0, edge1, a) \
    rhw_dual_smoothstep1(RHW_DUAL1_FROM(edge0), RHW_DUAL1_FROM(edge1), RHW_DUAL1_FROM(a))
#define rhw_dual_pow1(a, b)    rhw_dual_pow1(RHW_DUAL1_FROM(a), RHW_DUAL1_FROM(b))
#define rhw_dual_atan2_1(y, x) rhw_dual_atan2_1(RHW_DUAL1_FROM(y), RHW_DUAL1_FROM(x))

#endif

RHW_QUIET_END

#endif

#endif
