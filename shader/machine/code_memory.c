// SPDX-License-Identifier: MIT
// See code_memory.h.
#include "code_memory.h"

#include <stdlib.h>
#include <string.h>

// Generated code follows the calling convention of the System V ABI.
#if defined(__x86_64__) && !defined(__ILP32__) && !defined(_WIN32)
#include <cpuid.h>

enum { LEAF1_ECX_FMA = 1 << 12, LEAF7_EBX_AVX2 = 1 << 5 }; // Intel's manual, volume 2, table 3-8

// Whether the system saves the registers, librhw asks before it calls anything of this kind.
static bool has_avx2(void)
{
    unsigned eax, ebx = 0, ecx = 0, edx;
    const bool has_fma = __get_cpuid(1, &eax, &ebx, &ecx, &edx) && (ecx & LEAF1_ECX_FMA) != 0;
    return has_fma && __get_cpuid_count(7, 0, &eax, &ebx, &ecx, &edx) && (ebx & LEAF7_EBX_AVX2) != 0;
}
#else
static bool has_avx2(void)
{
    return false;
}
#endif

bool shader_code_is_wanted(void)
{
    const char *const value = getenv("RHW_JIT");
    return has_avx2() && !(value && strcmp(value, "0") == 0);
}
