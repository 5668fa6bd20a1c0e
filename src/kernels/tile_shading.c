// SPDX-License-Identifier: MIT
// Groups of fragments are shaded, tested late and blended. All of it stands in the headers. This file is compiled once
// per instruction set, and RHW_ISA_SUFFIX names the set.
#include "tile_units.h"

#include "kernels/fragment/constant_blend.h"
#include "kernels/fragment/queue.h"
