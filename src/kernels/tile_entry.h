// SPDX-License-Identifier: MIT
// What tile.c has for the table of kernels.
#ifndef RHW_TILE_ENTRY_H
#define RHW_TILE_ENTRY_H

#include "rhw/isa.h"

struct rhw_pass_state;

// See struct rhw_kernels.
void RHW_ISA_NAME(rhw_draw_tile)(struct rhw_pass_state *pass, int tile, int worker);

#endif
