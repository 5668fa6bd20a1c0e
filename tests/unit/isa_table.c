// SPDX-License-Identifier: MIT
// Which copies of isa_templates.c this build and this CPU have.
#include "isa_templates.h"

#include <rhw/rhw.h>

extern const struct isa_templates isa_templates_baseline;
#ifdef RHW_HAVE_X86_ISAS
extern const struct isa_templates isa_templates_avx2, isa_templates_avx512;
#endif

const struct isa_templates *isa_templates_for(enum rhw_isa isa)
{
    if (!rhw_isa_supported(isa)) {
        return NULL;
    }
    switch (isa) {
    case RHW_ISA_BASELINE: return &isa_templates_baseline;
#ifdef RHW_HAVE_X86_ISAS
    case RHW_ISA_AVX2: return &isa_templates_avx2;
    case RHW_ISA_AVX512: return &isa_templates_avx512;
#endif
    default: return NULL;
    }
}
