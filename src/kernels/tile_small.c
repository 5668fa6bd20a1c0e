// SPDX-License-Identifier: MIT
// Tiny and small triangles where a pixel has one sample: what meshes are made of. Compiled once per instruction set,
// with RHW_ISA_SUFFIX naming it.
#include "tile_units.h"
#include "kernels/tile/triangle_small.h"
#include "kernels/tile/triangle_tiny.h"

void RHW_ISA_NAME(rhw_draw_small)(const struct triangle_run *run)
{
    draw_each(run, draw_small_triangle);
}
