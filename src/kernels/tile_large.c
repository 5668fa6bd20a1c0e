// SPDX-License-Identifier: MIT
// Triangles of any size where a pixel has one sample, and shapes other than a triangle. Compiled once per instruction
// set, with RHW_ISA_SUFFIX naming it.
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
