// SPDX-License-Identifier: MIT
// What the headers need to know of the compiler; nowhere else do they ask for it. Included by base.h.
//
// Lanes are the vector types of gcc and clang, clang-cl among them. Another compiler, Microsoft's for one, reads the
// same headers without them: everything but the 8-lane form of shaders and duals, one-at-a-time functions included
// (shader_no_lanes.h).
#ifndef RHW_COMPILER_H
#define RHW_COMPILER_H

#ifdef __cplusplus
#define RHW_EXTERN_C extern "C"
#else
#define RHW_EXTERN_C extern
#endif

/// Before every function of the library. On Windows a program that links rhw as a DLL defines RHW_SHARED; the CMake
/// and pkg-config packages do. In the archive functions are hidden: a shared library that it is linked into does not show
/// them.
#if defined(_WIN32) && defined(RHW_BUILD_SHARED)
#define RHW_API RHW_EXTERN_C __declspec(dllexport)
#elif defined(_WIN32) && defined(RHW_SHARED)
#define RHW_API RHW_EXTERN_C __declspec(dllimport)
#elif defined(RHW_BUILD_SHARED)
#define RHW_API RHW_EXTERN_C __attribute__((visibility("default")))
#else
#define RHW_API RHW_EXTERN_C
#endif

/// Whether the 8-lane form of shaders is there. RHW_NO_LANES hides it, to see what a compiler without it sees.
#if (defined(__GNUC__) || defined(__clang__)) && !defined(RHW_NO_LANES)
#define RHW_HAS_LANES 1
#else
#define RHW_HAS_LANES 0
#endif

/// Around the inline functions of a header, whatever a program asks its compiler to warn of: lanes stay inside them, so
/// no ABI is crossed, and what C and C++ share has C's casts and NULL.
#if defined(__GNUC__) || defined(__clang__)
#if !defined(__cplusplus)
#define RHW_QUIET_CXX
#elif defined(__clang__)
#define RHW_QUIET_CXX                                      \
    _Pragma("GCC diagnostic ignored \"-Wold-style-cast\"") \
        _Pragma("GCC diagnostic ignored \"-Wzero-as-null-pointer-constant\"")
#else
#define RHW_QUIET_CXX                                                         \
    _Pragma("GCC diagnostic ignored \"-Wold-style-cast\"")                    \
        _Pragma("GCC diagnostic ignored \"-Wzero-as-null-pointer-constant\"") \
            _Pragma("GCC diagnostic ignored \"-Wuseless-cast\"")
#endif
#define RHW_QUIET_BEGIN \
    _Pragma("GCC diagnostic push") _Pragma("GCC diagnostic ignored \"-Wpsabi\"") RHW_QUIET_CXX
#define RHW_QUIET_END _Pragma("GCC diagnostic pop")
#else
#define RHW_QUIET_BEGIN
#define RHW_QUIET_END
#endif

#endif
