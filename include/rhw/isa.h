// SPDX-License-Identifier: MIT
// These macros name functions and objects that a build compiles once per instruction set, and make tables of the
// copies. A program uses them to put shaders on 8 lanes into struct rhw_program. A header of the program declares the
// copies, the shader file defines them, and the program makes a table:
//
//     RHW_ISA_DECLARE(rhw_fragment_function, paint);
//     void RHW_ISA_NAME(paint)(struct rhw_fragment *groups, int count) { ... }
//     struct rhw_program program = {.fragment = RHW_ISA_TABLE(paint), ... };
//
// docs/shaders.md tells how to compile the shader file. The target of the compiler decides which instruction sets there
// are, so the linker reports a copy that the build forgot.
#ifndef RHW_ISA_H
#define RHW_ISA_H

#include "types.h"

#define RHW_ISA_PASTE(name, suffix)  name##_##suffix
#define RHW_ISA_EXPAND(name, suffix) RHW_ISA_PASTE(name, suffix)

/// RHW_ISA_NAME(name) is the name of the copy that is being compiled, for example name_avx2. The build compiles the
/// file once per instruction set and defines RHW_ISA_SUFFIX as baseline, avx2 or avx512.
#define RHW_ISA_NAME(name) RHW_ISA_EXPAND(name, RHW_ISA_SUFFIX)

#define RHW_ISA_FIRST_baseline 1
#define RHW_ISA_FIRST_avx2     0
#define RHW_ISA_FIRST_avx512   0

/// RHW_ISA_IS_FIRST is 1 in one of the copies, and 0 in the others. `#if RHW_ISA_IS_FIRST` encloses what a file defines
/// once however often it is compiled.
#define RHW_ISA_IS_FIRST RHW_ISA_EXPAND(RHW_ISA_FIRST, RHW_ISA_SUFFIX)

#if defined(__x86_64__) && !defined(__ILP32__)

/// RHW_ISA_DECLARE(type, name) declares every copy of the function or object `name`. `type` is rhw_vertex_function,
/// rhw_fragment_function or any other type that can stand before a name.
#define RHW_ISA_DECLARE(type, name)    \
    RHW_EXTERN_C type name##_baseline; \
    RHW_EXTERN_C type name##_avx2;     \
    RHW_EXTERN_C type name##_avx512

/// RHW_ISA_TABLE(name) is the initializer of an array [RHW_ISA_COUNT] that holds the copies of the function `name`. For
/// an object, write RHW_ISA_TABLE(&name). The entry of an instruction set that the architecture does not have is NULL.
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
