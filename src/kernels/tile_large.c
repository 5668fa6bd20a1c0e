// SPDX-License-Identifier: MIT
// Triangles of any size are drawn where a pixel has one sample, and shapes other than a triangle where it has any
// number. This file is compiled once per instruction set, and RHW_ISA_SUFFIX names the set.
#include "tile_units.h"
#include "kernels/tile/triangle_large.h"
#include "kernels/tile/triangle_shape.h"

void RHW_ISA_NAME(rhw_draw_spans)(const struct triangle_run *run)
{
    draw_each(run, draw_by_spans);
}

void RHW_ISA_NAME(rhw_draw_large)(const struct triangle_run *run)
{
    draw_each_explained(run, draw_any);
}

void RHW_ISA_NAME(rhw_draw_shape)(const struct triangle_run *run)
{
    draw_each_explained(run, draw_pixel_shape);
}

void RHW_ISA_NAME(rhw_draw_stippled_line)(const struct triangle_run *run)
{
    draw_each_explained(run, draw_stippled);
}
