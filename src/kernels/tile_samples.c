// SPDX-License-Identifier: MIT
// Triangles are drawn where a pixel has several samples. This file is compiled once per instruction set, and
// RHW_ISA_SUFFIX names the set.
#include "tile_units.h"
#include "kernels/tile/triangle_large_samples.h"
#include "kernels/tile/triangle_small_samples.h"
#include "kernels/tile/triangle_tiny_samples.h"

void RHW_ISA_NAME(rhw_draw_small_samples)(const struct triangle_run *run)
{
    draw_each(run, draw_small_triangle_samples);
}

void RHW_ISA_NAME(rhw_draw_large_samples)(const struct triangle_run *run)
{
    draw_each_explained(run, draw_any_samples);
}
