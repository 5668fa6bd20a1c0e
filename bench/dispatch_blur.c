// SPDX-License-Identifier: MIT
// See dispatch_blur.h. Both functions fetch the same nine texels and add them up in the same order.
#include "dispatch_blur.h"

#include <rhw/shader.h>

void RHW_ISA_NAME(bench_cover)(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_int index = groups[g].vertex_index;
        groups[g].position[0] = rhw_float_from_int((index & 1) * 4 - 1);
        groups[g].position[1] = rhw_float_from_int((index >> 1) * 4 - 1);
        groups[g].position[2] = rhw_splat(0);
        groups[g].position[3] = rhw_splat(1);
    }
}

static void blur_at(const struct rhw_bindings *bindings, rhw_int x, rhw_int y, rhw_float color[4])
{
    for (int c = 0; c < 4; c++) {
        color[c] = rhw_splat(0);
    }
    for (int i = 0; i < 9; i++) {
        const rhw_int at[2] = {x + (i % 3 - 1), y + (i / 3 - 1)};
        rhw_float texel[4];
        rhw_sample_fetch(bindings, 0, at, NULL, texel);
        for (int c = 0; c < 4; c++) {
            color[c] += texel[c] * (1.0f / 9);
        }
    }
}

void RHW_ISA_NAME(bench_blur_fragments)(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        blur_at(groups[g].bindings, rhw_int_from_float(groups[g].coord[0]),
                rhw_int_from_float(groups[g].coord[1]), groups[g].color[0]);
    }
}

void RHW_ISA_NAME(bench_blur_workgroup)(struct rhw_workgroup *w)
{
    for (int g = 0; g < w->count; g++) {
        rhw_float color[4];
        blur_at(w->bindings, w->groups[g].id[0], w->groups[g].id[1], color);
        rhw_image_store(w->bindings, 0, w->groups[g].id, &w->groups[g].mask, color);
    }
}

void RHW_ISA_NAME(bench_do_nothing)(struct rhw_workgroup *w)
{
    (void)w;
}
