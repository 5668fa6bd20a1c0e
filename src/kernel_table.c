// SPDX-License-Identifier: MIT
// Which kernels this build has.
#include <stddef.h>

#include "kernels/kernels.h"

extern const struct rhw_kernels rhw_kernels_baseline;
#ifdef RHW_HAVE_X86_ISAS
extern const struct rhw_kernels rhw_kernels_avx2, rhw_kernels_avx512;
#endif

const struct rhw_kernels *rhw_kernels_for(enum rhw_isa isa)
{
    switch (isa) {
    case RHW_ISA_BASELINE: return &rhw_kernels_baseline;
#ifdef RHW_HAVE_X86_ISAS
    case RHW_ISA_AVX2: return &rhw_kernels_avx2;
    case RHW_ISA_AVX512: return &rhw_kernels_avx512;
#endif
    default: return NULL;
    }
}
