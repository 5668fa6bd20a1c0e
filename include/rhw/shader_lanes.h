// SPDX-License-Identifier: MIT
// The 8-lane types every shader header rests on. Included by shader.h.
#ifndef RHW_SHADER_LANES_H
#define RHW_SHADER_LANES_H

#include "base.h"

// Flags of the compiler

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

// Lanes

enum { RHW_LANES = 8 };

#if RHW_HAS_LANES

/// 8 lanes. `+ - * / < <= == & |` work lane by lane; a comparison gives an rhw_int of −1 (true) and 0.
typedef float rhw_float __attribute__((vector_size(32)));
typedef int32_t rhw_int __attribute__((vector_size(32)));
/// Half of them: what an instruction works on where registers have 16 bytes.
typedef float rhw_float4 __attribute__((vector_size(16)));
typedef int32_t rhw_int4 __attribute__((vector_size(16)));
/// For sums of bit patterns, which may wrap.
typedef uint32_t rhw_uint __attribute__((vector_size(32)));

#endif

#endif
