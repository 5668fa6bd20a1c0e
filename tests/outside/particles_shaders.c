// SPDX-License-Identifier: MIT
// The shaders of particles.c, compiled once per instruction set. Attributes, all per instance: centre, half size,
// colour in 256ths, id. There are no vertices in memory: a corner of the quad follows from its number in the strip.
#include "particles.h"

// Bit 0 of the number is right, bit 1 is up. Pushed apart behind the camera's matrix, corners face it.
void RHW_ISA_NAME(particles_face)(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        const struct lens *lens = v->uniforms;
        struct spark *out = RHW_VARYINGS_OUT(struct spark, v->varying);
        rhw_mat4_mul_point(lens->camera, v->attribute[0], v->position);
        for (int i = 0; i < 2; i++) {
            const rhw_int side = (v->vertex_index >> i & 1) * 2 - 1;
            v->position[i] += rhw_float_from_int(side) * (v->attribute[1][0] * lens->scale[i]);
        }
        for (int c = 0; c < 3; c++) {
            out->color[c] = v->attribute[2][c] / 256;
        }
        out->id = v->attribute[3][0];
    }
}

void RHW_ISA_NAME(particles_solid)(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const struct spark *in = RHW_VARYINGS(struct spark, f->varying);
        for (int c = 0; c < 3; c++) {
            f->color[0][c] = in->color[c];
        }
        f->color[0][3] = rhw_splat(1);
        f->color[1][0] = in->id; // a target of R32_UINT takes the bits
    }
}

// To be added: dimmed for the eye, and in full, with a 1 that counts.
void RHW_ISA_NAME(particles_glow)(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const struct lens *lens = f->uniforms;
        const struct spark *in = RHW_VARYINGS(struct spark, f->varying);
        for (int c = 0; c < 3; c++) {
            f->color[0][c] = in->color[c] * lens->glow;
            f->color[1][c] = in->color[c];
        }
        f->color[0][3] = f->color[1][3] = rhw_splat(1);
    }
}
