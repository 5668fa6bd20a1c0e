// SPDX-License-Identifier: MIT
// The front end, compiled once per instruction set, with RHW_ISA_SUFFIX naming it.
#include "kernel_entries.h"

#include "kernels/geometry/chunk.h"

bool RHW_ISA_NAME(rhw_make_chunk)(struct rhw_pass_state *pass, struct rhw_chunk *chunk, int worker)
{
    return make_chunk(pass, chunk, &pass->workers[worker]);
}

void RHW_ISA_NAME(rhw_shade_shared_part)(struct rhw_pass_state *pass, const struct rhw_shared_part *part,
                                         int worker)
{
    shade_shared_part(pass, part, &pass->workers[worker]);
}
