// SPDX-License-Identifier: MIT
// Which way the primitives of a run go to the triangles that tiles draw.
#ifndef RHW_PRIMITIVE_SETUP_H
#define RHW_PRIMITIVE_SETUP_H

#include "polygon_setup.h"
#include "triangle_setup.h"

typedef void setup8_function(struct rhw_geometry_scratch *scratch, const struct run_slice *slice,
                             struct rhw_triangle_list *list);

RHW_INLINE void setup_run(struct rhw_geometry_scratch *scratch, uint32_t run_index,
                          struct rhw_triangle_list *list, setup8_function *setup)
{
    const struct rhw_run *const run = &scratch->runs[run_index];
    uint32_t i = 0;
    for (; i + 8 < run->count; i += 8) {
        const struct run_slice slice = {run_index, run->indices + i, run->first_primitive + i, 0xff};
        setup(scratch, &slice, list);
    }
    // The last ones are repeated, so that `setup` reads nothing else behind them.
    uint32_t indices[9][3];
    const uint32_t left = run->count - i;
    for (uint32_t lane = 0; lane < 9; lane++) {
        memcpy(indices[lane], run->indices[i + (lane < left ? lane : left - 1)], sizeof *indices);
    }
    const struct run_slice slice = {run_index, (const uint32_t(*)[3])indices, run->first_primitive + i,
                                    0xffu >> (8 - left)};
    setup(scratch, &slice, list);
}

// Adds what is drawn of the run's primitives to the list, in submission order.
static void setup_primitives(struct rhw_geometry_scratch *scratch, uint32_t run,
                             struct rhw_triangle_list *list)
{
    const int before = list->count;
    switch (scratch->segments[run].draw->state->pipeline->primitive) {
    case RHW_PRIMITIVE_POINTS: setup_run(scratch, run, list, setup_points8); return;
    case RHW_PRIMITIVE_LINES: setup_run(scratch, run, list, setup_lines8); return;
    case RHW_PRIMITIVE_POLYGON_LINES:
    case RHW_PRIMITIVE_POLYGON_POINTS: setup_run(scratch, run, list, setup_polygons8); return;
    case RHW_PRIMITIVE_TRIANGLES: break;
    }
    setup_run(scratch, run, list, setup8);
    scratch->counters.rasterized += (uint64_t)(list->count - before);
}

#endif
