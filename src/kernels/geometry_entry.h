// SPDX-License-Identifier: MIT
// What geometry.c has for the table of kernels.
#ifndef RHW_GEOMETRY_ENTRY_H
#define RHW_GEOMETRY_ENTRY_H

#include <stdbool.h>

#include "rhw/isa.h"

struct rhw_pass_state;
struct rhw_chunk;
struct rhw_shared_part;

// See struct rhw_kernels.
bool RHW_ISA_NAME(rhw_make_chunk)(struct rhw_pass_state *pass, struct rhw_chunk *chunk, int worker);
void RHW_ISA_NAME(rhw_shade_shared_part)(struct rhw_pass_state *pass, const struct rhw_shared_part *part,
                                         int worker);

#endif
