// SPDX-License-Identifier: MIT
// What every other header rests on: export, version, result codes and the hooks of a context.
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

// Version, results and hooks -------------------------------------------------------------------------

/// Semantic version of the library; CMake reads these three lines.
#define RHW_VERSION_MAJOR 0
#define RHW_VERSION_MINOR 1
#define RHW_VERSION_PATCH 0

/// The version of the library that is linked, as "major.minor.patch".
RHW_API const char *rhw_version(void);

/// What the environment did to a call. Misuse (a programmer's error) is no result: it goes to the
/// assert hook, and the call then does nothing.
enum rhw_result {
    RHW_OK = 0,
    RHW_ERROR_OUT_OF_MEMORY, ///< the allocation hook returned NULL
    RHW_ERROR_UNSUPPORTED,   ///< this build or this CPU cannot do what was asked
    RHW_ERROR_THREAD,        ///< the operating system refused a thread
    RHW_ERROR_MISUSE,        ///< the assert hook returned; the message went there
    RHW_ERROR_GIVEN_UP,      ///< the program wanted it no longer; see rhw_context_set_goes_on
};

/// One short English sentence without a full stop; static storage.
RHW_API const char *rhw_result_string(enum rhw_result result);

/// Memory of a context. `allocate` returns `size` bytes aligned to `alignment` (a power of two, at most
/// 4096) or NULL. Both functions are called by the thread that calls the library and by its workers, at the same
/// time: they must be thread-safe. `size` of release is that of allocate.
struct rhw_allocator {
    void *(*allocate)(void *user, size_t size, size_t alignment);
    void (*release)(void *user, void *memory, size_t size);
    void *user;
};

enum rhw_log_level { RHW_LOG_INFO, RHW_LOG_WARNING };

/// Called with one line without a newline, which lives for the call, on the thread that called the library.
typedef void rhw_log_function(void *user, enum rhw_log_level level, const char *message);

/// Called on misuse with a message that says what was wrong, which lives for the call, on the thread that called the
/// library; while a pass is recorded, it ends with the draw, its debug groups and the pass, in brackets. Several
/// threads may be in it at once: of different contexts, and of one that two threads use, which is what it is told
/// then. When it returns, the call that found the misuse returns without doing anything. It may also leave by longjmp
/// or a C++ exception, but not where a shader function calls the library: then frames of the library lie between. It
/// must not destroy the context. The default prints the message to stderr and aborts.
typedef void rhw_assert_function(void *user, const char *message);

#endif
