// SPDX-License-Identifier: MIT
// CPU detection. The compiler's own __builtin_cpu_supports is not used: it keeps global state, and what it knows
// differs between compilers.
#include "cpu.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif
#if defined(__x86_64__)
#include <cpuid.h>

struct cpuid_registers {
    uint32_t eax, ebx, ecx, edx;
};

// Return the registers of a CPUID leaf. All are zero for a leaf that the CPU does not have.
static struct cpuid_registers read_cpuid(uint32_t leaf)
{
    struct cpuid_registers r = {0, 0, 0, 0};
    if (!__get_cpuid_count(leaf, 0, &r.eax, &r.ebx, &r.ecx, &r.edx)) {
        r = (struct cpuid_registers){0, 0, 0, 0};
    }
    return r;
}

// Return XCR0: the register state that the operating system saves. It may be called only where CPUID says that xgetbv
// exists. The instruction is written as bytes, because the intrinsic needs a compiler flag that the baseline does not
// have.
static uint32_t read_xcr0(void)
{
    uint32_t low;
    uint32_t high;
    __asm__ volatile(".byte 0x0f, 0x01, 0xd0" : "=a"(low), "=d"(high) : "c"(0));
    return low;
}

// Bits have the numbers that Intel's manual, volume 2, table 3-8 and AMD's volume 3, appendix E give them.
enum {
    LEAF1_ECX_FMA = 1 << 12,
    LEAF1_ECX_POPCNT = 1 << 23,
    LEAF1_ECX_OSXSAVE = 1 << 27,
    LEAF1_ECX_AVX = 1 << 28,
    LEAF1_ECX_F16C = 1 << 29,
    LEAF7_EBX_BMI1 = 1 << 3,
    LEAF7_EBX_AVX2 = 1 << 5,
    LEAF7_EBX_BMI2 = 1 << 8,
    LEAF7_EBX_AVX512F = 1 << 16,
    LEAF7_EBX_AVX512DQ = 1 << 17,
    LEAF7_EBX_AVX512BW = 1 << 30,
    LEAF81_ECX_LZCNT = 1 << 5,
    XCR0_XMM_YMM = 0x06,
    XCR0_OPMASK_ZMM = 0xe0
};
static const uint32_t leaf7_ebx_avx512vl = 1u << 31;

static bool has_all(uint32_t bits, uint32_t wanted)
{
    return (bits & wanted) == wanted;
}

bool rhw_cpu_supports(enum rhw_isa isa)
{
    if (isa == RHW_ISA_BASELINE) {
        return true; // SSE2 is part of x86-64
    }
    if (isa != RHW_ISA_AVX2 && isa != RHW_ISA_AVX512) {
        return false;
    }

    const struct cpuid_registers leaf1 = read_cpuid(1);
    if (!has_all(leaf1.ecx,
                 LEAF1_ECX_OSXSAVE | LEAF1_ECX_AVX | LEAF1_ECX_F16C | LEAF1_ECX_FMA | LEAF1_ECX_POPCNT)) {
        return false;
    }
    const uint32_t xcr0 = read_xcr0();
    const struct cpuid_registers leaf7 = read_cpuid(7);
    const struct cpuid_registers leaf81 = read_cpuid(0x80000001u);
    const bool avx2 = has_all(xcr0, XCR0_XMM_YMM) && has_all(leaf81.ecx, LEAF81_ECX_LZCNT) &&
                      has_all(leaf7.ebx, LEAF7_EBX_AVX2 | LEAF7_EBX_BMI1 | LEAF7_EBX_BMI2);
    if (isa == RHW_ISA_AVX2) {
        return avx2;
    }
    return avx2 && has_all(xcr0, XCR0_OPMASK_ZMM) && has_all(leaf7.ebx, leaf7_ebx_avx512vl) &&
           has_all(leaf7.ebx, LEAF7_EBX_AVX512F | LEAF7_EBX_AVX512DQ | LEAF7_EBX_AVX512BW);
}

#else

bool rhw_cpu_supports(enum rhw_isa isa)
{
    return isa == RHW_ISA_BASELINE;
}

#endif

#if defined(__SSE2__)

uint64_t rhw_cpu_float_enter(void)
{
    const unsigned saved = _mm_getcsr();
    _mm_setcsr(0x1f80); // the architecture's default: exceptions masked, nearest, no FTZ, no DAZ
    return saved;
}

void rhw_cpu_float_leave(uint64_t saved)
{
    _mm_setcsr((unsigned)saved);
}

#elif defined(__aarch64__)

uint64_t rhw_cpu_float_enter(void)
{
    uint64_t saved;
    const uint64_t plain = 0; // FPCR: nearest, no flush to zero, no default NaN, no traps
    __asm__ volatile("mrs %0, fpcr" : "=r"(saved));
    __asm__ volatile("msr fpcr, %0" : : "r"(plain) : "memory");
    return saved;
}

void rhw_cpu_float_leave(uint64_t saved)
{
    __asm__ volatile("msr fpcr, %0" : : "r"(saved) : "memory");
}

#else

// WebAssembly and other targets without a case above have one floating-point environment.
uint64_t rhw_cpu_float_enter(void)
{
    return 0;
}

void rhw_cpu_float_leave(uint64_t saved)
{
    (void)saved;
}

#endif
