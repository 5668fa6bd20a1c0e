// SPDX-License-Identifier: MIT
// Every shader header needs the 8-lane types of this header. Equal bytes also need IEEE 754 arithmetic wherever shaders
// are compiled, with each operation rounded to its own type. So this header refuses compiler flags that change the
// arithmetic, as far as the preprocessor can see them. rhw_pipeline_create computes values that show the others.
// shader.h includes this header.
#ifndef RHW_SHADER_LANES_H
#define RHW_SHADER_LANES_H

#include "base.h"

#if defined(__FAST_MATH__)
#error "rhw: shaders would draw other bytes under -ffast-math (part of -Ofast); compile this file without it"
#elif defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "rhw: shaders meet NaN and infinity; compile this file without -ffinite-math-only"
#elif defined(_M_FP_FAST) || defined(_M_FP_CONTRACT)
#error \
    "rhw: shaders would draw other bytes under /fp:fast and /fp:contract; compile this file with /fp:precise"
#elif defined(__GCC_IEC_559) && __GCC_IEC_559 == 0
#error \
    "rhw: shaders need IEEE 754 arithmetic; compile this file without flags such as -funsafe-math-optimizations"
#endif

#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0
#error "rhw: this target computes floats in a wider type; on 32-bit x86 compile with -msse2 -mfpmath=sse"
#endif

enum { RHW_LANES = 8 };

#if RHW_HAS_LANES

/// 8 floats. The operators + - * / < <= == work lane by lane. A comparison gives an rhw_int with −1 for true and 0 for
/// false.
typedef float rhw_float __attribute__((vector_size(32)));
/// 8 signed integers. The operators + - * / & | < <= == work lane by lane.
typedef int32_t rhw_int __attribute__((vector_size(32)));
/// 4 of the 8 floats: what one instruction works on where registers have 16 bytes.
typedef float rhw_float4 __attribute__((vector_size(16)));
/// 4 of the 8 signed integers: what one instruction works on where registers have 16 bytes.
typedef int32_t rhw_int4 __attribute__((vector_size(16)));
/// 8 unsigned integers, for sums of bit patterns, which may wrap.
typedef uint32_t rhw_uint __attribute__((vector_size(32)));

#endif

#endif
