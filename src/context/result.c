// SPDX-License-Identifier: MIT
// Words for values: results, the version, instruction sets.
#include "rhw/rhw.h"

#define TEXT_OF(x) #x
#define TEXT(x)    TEXT_OF(x)

const char *rhw_version(void)
{
    return TEXT(RHW_VERSION_MAJOR) "." TEXT(RHW_VERSION_MINOR) "." TEXT(RHW_VERSION_PATCH);
}

const char *rhw_result_string(enum rhw_result result)
{
    switch (result) {
    case RHW_OK: return "No error";
    case RHW_ERROR_OUT_OF_MEMORY: return "Out of memory";
    case RHW_ERROR_UNSUPPORTED: return "This build or this CPU does not support what was asked";
    case RHW_ERROR_THREAD: return "The operating system refused a thread";
    case RHW_ERROR_MISUSE: return "The library was misused; the assert hook received the message";
    case RHW_ERROR_GIVEN_UP: return "Given up, as the program asked";
    }
    return "Unknown result";
}

enum rhw_isa_limit rhw_isa_up_to(enum rhw_isa isa)
{
    return (unsigned)isa < RHW_ISA_COUNT ? (enum rhw_isa_limit)(isa + 1) : RHW_ISA_BEST;
}

const char *rhw_isa_name(enum rhw_isa isa)
{
    switch (isa) {
    case RHW_ISA_BASELINE: return "baseline";
    case RHW_ISA_AVX2: return "avx2";
    case RHW_ISA_AVX512: return "avx512";
    case RHW_ISA_COUNT: break;
    }
    return "unknown";
}
