// SPDX-License-Identifier: MIT
#include "diff_shaders.h"

#include "rhw/shader.h"

void RHW_ISA_NAME(diff_vertex)(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        const rhw_float *const position = v->attribute[0];
        v->position[0] = position[0];
        v->position[1] = -position[1];
        v->position[2] = position[2];
        v->position[3] = position[3];
        v->varying[0] = position[2];
    }
}

// Leaves out what is not behind the layer before: the depths that were stored are those that come again, bit for bit.
static void peel(struct rhw_fragment *f)
{
    const rhw_int at[2] = {rhw_int_from_float_unchecked(f->coord[0]),
                           rhw_int_from_float_unchecked(f->coord[1])};
    rhw_float before[4];
    rhw_sample_fetch(f->bindings, 0, at, NULL, before);
    f->mask &= f->coord[2] > before[0];
}

void RHW_ISA_NAME(diff_fragment)(struct rhw_fragment *groups, int count)
{
    const struct diff_uniforms *const u = groups->uniforms;
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        if (u->peels) {
            peel(f);
        }
        rhw_float *const values = f->color[0], *const slopes = f->color[1];
        values[0] = f->barycentric[0];
        values[1] = f->barycentric[1];
        values[2] = f->varying[0] * f->coord[3]; // not coord[2], which lies in 0..1 and would lose bits
        values[3] = rhw_float_from_int(f->primitive + (u->first_triangle + 1));
        slopes[0] = f->barycentric_ddx[0];
        slopes[1] = f->barycentric_ddy[0];
        slopes[2] = f->barycentric_ddx[1];
        slopes[3] = f->barycentric_ddy[1];
    }
}
