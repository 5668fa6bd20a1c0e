// SPDX-License-Identifier: MIT
// A square that leans back, with rings of waves over its texture; 8 vertices or fragments at a time. Compiled once
// per instruction set.
#include "shaders.h"

void RHW_ISA_NAME(place)(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        const struct ripple *ripple = v->uniforms;
        const rhw_float x = v->attribute[0][0], y = v->attribute[0][1];
        v->position[0] = x;
        v->position[1] = y * ripple->cosine;
        v->position[2] = rhw_splat(0);
        v->position[3] = 1.5f + y * ripple->sine;
        v->varying[0] = x;
        v->varying[1] = y;
    }
}

void RHW_ISA_NAME(paint)(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const struct ripple *ripple = f->uniforms;
        const rhw_float *at = f->varying;
        const rhw_float square = rhw_dot2(at, at);
        const rhw_float wave = rhw_sin(square * ripple->frequency + ripple->phase);
        const rhw_float light = 0.75f + 0.25f * wave;
        const rhw_float grad[4] = {f->ddx[0], f->ddx[1], f->ddy[0], f->ddy[1]};
        rhw_float texel[4];
        rhw_sample_grad(f->bindings, 0, at, grad, texel);
        for (int c = 0; c < 3; c++) {
            f->color[0][c] = texel[c] * light;
        }
        f->color[0][3] = rhw_splat(1);
        f->mask &= rhw_less_equal(square, 1); // a disc is left of the square
    }
}
