// SPDX-License-Identifier: MIT
// What becomes of groups of fragments: they are shaded, tested late and blended. All of it stands in the headers.
// Compiled once per instruction set, with RHW_ISA_SUFFIX naming it.
#include "tile_units.h"

#include "kernels/fragment/constant_blend.h"
#include "kernels/fragment/queue.h"
