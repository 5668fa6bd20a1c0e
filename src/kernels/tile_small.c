// SPDX-License-Identifier: MIT
// Tiny and small triangles, which meshes are made of, are drawn where a pixel has one sample. This file is compiled
// once per instruction set, and RHW_ISA_SUFFIX names the set.
#include "tile_units.h"
#include "kernels/tile/triangle_small.h"
#include "kernels/tile/triangle_tiny.h"

void RHW_ISA_NAME(rhw_draw_small)(const struct triangle_run *run)
{
    draw_each(run, draw_small_triangle);
}
