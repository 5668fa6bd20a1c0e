// SPDX-License-Identifier: MIT
// What equal bytes ask of the compiler's flags where shaders are compiled: IEEE 754 arithmetic, each operation rounded
// to its own type. Flags that the preprocessor sees are refused here; what it cannot see, rhw_pipeline_create probes.
// Included by shader.h.
#ifndef RHW_ARITHMETIC_H
#define RHW_ARITHMETIC_H

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

#endif
