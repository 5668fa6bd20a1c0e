// SPDX-License-Identifier: MIT
// The front end, compiled once per instruction set, which RHW_ISA_SUFFIX names.
#include "kernel_entries.h"

#include "kernels/geometry/chunk.h"

bool RHW_ISA_NAME(rhw_make_chunk)(const struct rhw_wave *wave, struct rhw_chunk *chunk, int worker)
{
    return make_chunk(wave, chunk, &wave->workers[worker]);
}

void RHW_ISA_NAME(rhw_shade_shared_part)(const struct rhw_wave *wave, const struct rhw_shared_part *part,
                                         int worker)
{
    shade_shared_part(wave, part, &wave->workers[worker]);
}
