// SPDX-License-Identifier: MIT
// The 8-lane types every shader header rests on. Included by shader.h.
#ifndef RHW_SHADER_LANES_H
#define RHW_SHADER_LANES_H

#include "arithmetic.h"
#include "compiler.h"

#include <stdint.h>

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
