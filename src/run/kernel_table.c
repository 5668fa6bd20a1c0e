// SPDX-License-Identifier: MIT
// This table says which kernels this build has.
#include <stddef.h>

#include "kernels/kernels.h"

static const struct rhw_kernels *const tables[RHW_ISA_COUNT] = RHW_ISA_TABLE(&rhw_kernels);

const struct rhw_kernels *rhw_kernels_for(enum rhw_isa isa)
{
    return (unsigned)isa < RHW_ISA_COUNT ? tables[isa] : NULL;
}
