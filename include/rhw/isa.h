// SPDX-License-Identifier: MIT
// Names for what is compiled once per instruction set, and tables of its copies: how shaders on 8 lanes get into
// rhw_program. A header of yours declares, the shader file defines, the program makes a table:
//
//     RHW_ISA_DECLARE(rhw_fragment_function, paint);
//     void RHW_ISA_NAME(paint)(struct rhw_fragment *groups, int count) { ... }
//     struct rhw_program program = {.fragment = RHW_ISA_TABLE(paint), ... };
//
// docs/shaders.md tells how the shader file is compiled. Which instruction sets there are follows from what the
// program is compiled for, so a copy that the build forgot is an error of the linker.
#ifndef RHW_ISA_H
#define RHW_ISA_H

#include "types.h"

#define RHW_ISA_PASTE(name, suffix)  name##_##suffix
#define RHW_ISA_EXPAND(name, suffix) RHW_ISA_PASTE(name, suffix)

/// The name of this copy, `name_avx2` for instance, in a file that is compiled once per instruction set. The build
/// defines RHW_ISA_SUFFIX as baseline, avx2, ...
#define RHW_ISA_NAME(name) RHW_ISA_EXPAND(name, RHW_ISA_SUFFIX)

#if defined(__x86_64__) && !defined(__ILP32__)

/// Declares every copy of `name`, a function or an object. `type` is rhw_vertex_function, rhw_fragment_function or
/// any other type that can stand before a name.
#define RHW_ISA_DECLARE(type, name)    \
    RHW_EXTERN_C type name##_baseline; \
    RHW_EXTERN_C type name##_avx2;     \
    RHW_EXTERN_C type name##_avx512

/// The initializer of an array [RHW_ISA_COUNT] with the copies of `name`; of `&name` where they are objects. An entry
/// is NULL where the architecture has no such instruction set.
#define RHW_ISA_TABLE(name)                          \
    {                                                \
        name##_baseline, name##_avx2, name##_avx512, \
    }

#else

#define RHW_ISA_DECLARE(type, name) RHW_EXTERN_C type name##_baseline
#define RHW_ISA_TABLE(name) \
    {                       \
        name##_baseline     \
    }

#endif

#endif
