// SPDX-License-Identifier: MIT
// This header has what every other public header needs: the macros that ask about the compiler, the version, the result
// codes and the hooks of a context. The other headers do not ask about the compiler themselves.
//
// Lanes are vector types of gcc and clang, and of clang-cl. Another compiler, for example Microsoft's, reads the same
// headers without the 8-lane form of shaders and without duals. That compiler has everything else, and calls the
// one-at-a-time functions of shader_no_lanes.h.
#ifndef RHW_BASE_H
#define RHW_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The compiler ----------------------------------------------------------------------------------------

#ifdef __cplusplus
#define RHW_EXTERN_C extern "C"
#else
#define RHW_EXTERN_C extern
#endif

/// RHW_API stands before every function of the library. On Windows a program that links rhw as a DLL defines
/// RHW_SHARED; the CMake and pkg-config packages define it. The static library hides its functions, so a shared library
/// that links the static library does not export them.
#if defined(_WIN32) && defined(RHW_BUILD_SHARED)
#define RHW_API RHW_EXTERN_C __declspec(dllexport)
#elif defined(_WIN32) && defined(RHW_SHARED)
#define RHW_API RHW_EXTERN_C __declspec(dllimport)
#elif defined(RHW_BUILD_SHARED)
#define RHW_API RHW_EXTERN_C __attribute__((visibility("default")))
#else
#define RHW_API RHW_EXTERN_C
#endif

/// RHW_HAS_LANES is 1 if the compiler has the 8-lane form of shaders, and 0 if not. A program that defines RHW_NO_LANES
/// sees the headers as a compiler without lanes does.
#if (defined(__GNUC__) || defined(__clang__)) && !defined(RHW_NO_LANES)
#define RHW_HAS_LANES 1
#else
#define RHW_HAS_LANES 0
#endif

/// RHW_MAY_ALIAS stands in the definition of a struct that the library reads as another one.
#if defined(__GNUC__) || defined(__clang__)
#define RHW_MAY_ALIAS __attribute__((may_alias))
#else
#define RHW_MAY_ALIAS
#endif

/// RHW_QUIET_BEGIN and RHW_QUIET_END enclose the inline functions of a header and switch off warnings there that a
/// program may have switched on. -Wpsabi does not apply, because the functions are inlined and lanes cross no ABI. The
/// C++ warnings do not apply, because code that C and C++ share uses C's casts and C's NULL.
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

// Version, results and hooks -------------------------------------------------------------------------

/// These three numbers are the semantic version of the library. CMake reads them from here.
#define RHW_VERSION_MAJOR 0
#define RHW_VERSION_MINOR 1
#define RHW_VERSION_PATCH 0

/// Return the version of the linked library as "major.minor.patch". The string is static. Any thread may call this.
RHW_API const char *rhw_version(void);

/// The result of a call tells what the environment did to it. A programmer's error is misuse. The library reports
/// misuse to the assert hook of the context. If the hook returns, the call does nothing; a call with a result returns
/// RHW_ERROR_MISUSE.
enum rhw_result {
    RHW_OK = 0,
    RHW_ERROR_OUT_OF_MEMORY, ///< the allocation hook returned NULL
    RHW_ERROR_UNSUPPORTED,   ///< this build or this CPU cannot do what was asked
    RHW_ERROR_THREAD,        ///< the operating system refused a thread
    RHW_ERROR_MISUSE,        ///< the assert hook got a message and returned
    RHW_ERROR_GIVEN_UP,      ///< the program gave the work up; see rhw_context_set_goes_on
};

/// Return one short English sentence without a full stop that describes the result. The string is static. Any thread
/// may call this.
RHW_API const char *rhw_result_string(enum rhw_result result);

/// A context takes all its memory from an allocator. The thread that calls the library and its worker threads call both
/// functions, possibly at the same time, so both functions must be thread-safe.
struct rhw_allocator {
    /// Return `size` bytes aligned to `alignment`, or NULL. `alignment` is a power of two and at most 4096.
    void *(*allocate)(void *user, size_t size, size_t alignment);
    /// Free memory that `allocate` returned. `size` is the size that `allocate` was called with.
    void (*release)(void *user, void *memory, size_t size);
    void *user; ///< the first argument of both functions
};

enum rhw_log_level { RHW_LOG_INFO, RHW_LOG_WARNING };

/// The library calls a log function on the thread that called the library. `message` is one line without a newline and
/// is valid until the function returns.
typedef void rhw_log_function(void *user, enum rhw_log_level level, const char *message);

/// The library calls an assert function on misuse, on the thread that called the library. `message` says what was wrong
/// and is valid until the function returns. While a pass is recorded, the message ends with the draw, its debug groups
/// and the pass, in brackets. Several threads may run the function at once: threads that use different contexts, and
/// two threads that misuse one context at the same time.
///
/// If the function returns, the call that found the misuse returns without doing anything. The function may also leave
/// by longjmp or by a C++ exception. It must not leave that way where a shader function called the library, because
/// frames of the library lie between. The function must not destroy the context. The default function prints the
/// message to stderr and aborts.
typedef void rhw_assert_function(void *user, const char *message);

#endif
