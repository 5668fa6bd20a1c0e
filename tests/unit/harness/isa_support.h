// SPDX-License-Identifier: MIT
// Which instruction sets there are, for loops that ask at each of a million steps. Each file that has such loops
// asks the processor once: in a virtual machine one CPUID takes as long as hundreds of the calls that are tested.
#ifndef ISA_SUPPORT_H
#define ISA_SUPPORT_H

#include <rhw/rhw.h>

// Return what rhw_isa_supported gives. It is for one thread of a program.
static inline bool isa_is_there(enum rhw_isa isa)
{
    static bool is_asked, there[RHW_ISA_COUNT];
    for (int i = 0; i < RHW_ISA_COUNT && !is_asked; i++) {
        there[i] = rhw_isa_supported((enum rhw_isa)i);
    }
    is_asked = true;
    return there[isa];
}

#endif
