// SPDX-License-Identifier: MIT
// See golden_shaders.h; compiled with RHW_ISA_SUFFIX = baseline, avx2, ...
#include "golden_shaders.h"

#include <rhw/shader.h>

static void transform(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        const struct golden_uniforms *u = v->uniforms;
        const rhw_float *p = v->attribute[0];
        for (int row = 0; row < 4; row++) {
            const float *m = u->matrix + row;
            v->position[row] = p[0] * m[0] + p[1] * m[4] + p[2] * m[8] + m[12];
        }
        for (int c = 0; c < 3; c++) {
            v->varying[c] = p[c];
        }
        for (int c = 0; c < 4; c++) {
            v->varying[3 + c] = v->attribute[1][c];
        }
    }
}

static void lit(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const struct golden_uniforms *u = f->uniforms;
        rhw_float normal[3], view[3], half[3];
        const rhw_float light[3] = {rhw_splat(u->light[0]), rhw_splat(u->light[1]), rhw_splat(u->light[2])};
        rhw_normalize3(f->varying, normal);
        for (int c = 0; c < 3; c++) {
            view[c] = u->eye[c] - f->varying[c];
        }
        rhw_normalize3(view, view);
        for (int c = 0; c < 3; c++) {
            half[c] = view[c] + light[c];
        }
        rhw_normalize3(half, half);
        const rhw_float diffuse = rhw_max(rhw_dot3(normal, light), rhw_splat(0));
        const rhw_float gloss = rhw_pow(rhw_max(rhw_dot3(normal, half), rhw_splat(0)), rhw_splat(48.5f));
        const rhw_float turn = rhw_atan2(normal[2], normal[0]), height = rhw_acos(normal[1]);
        const rhw_float wave = rhw_sin(turn * 12.0f) * rhw_cos(height * 9.0f);
        const rhw_float fog = rhw_exp(-rhw_length3(view) * 0.125f) * rhw_log2(2.0f + rhw_abs(wave));
        const rhw_int ring = rhw_fract(height * 3.0f) > 0.5f;
        f->color[0][0] = diffuse * (0.5f + 0.5f * wave) + gloss;
        f->color[0][1] = diffuse * rhw_select(ring, rhw_splat(0.75f), rhw_splat(0.25f)) + gloss;
        f->color[0][2] = diffuse * fog * rhw_sqrt(rhw_abs(normal[1])) + gloss;
        f->color[0][3] = rhw_splat(1);
    }
}

static void texture(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const rhw_float uv[2] = {f->varying[3], f->varying[4]};
        const rhw_float grad[4] = {f->ddx[3], f->ddx[4], f->ddy[3], f->ddy[4]};
        rhw_sample_grad(f->bindings, 0, uv, grad, f->color[0]);
        f->color[0][2] *= rhw_smoothstep(rhw_splat(-30), rhw_splat(0), f->varying[2]);
    }
}

static void glass(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        for (int c = 0; c < 4; c++) {
            f->color[0][c] = f->varying[3 + c];
        }
        f->mask &= rhw_fract(f->varying[0] * 7.0f + f->varying[1] * 5.0f) > 0.25f;
    }
}

void RHW_ISA_NAME(golden_shaders)(struct rhw_program *program, enum rhw_isa isa, enum golden_shader shader)
{
    rhw_fragment_function *const fragments[GOLDEN_SHADER_COUNT] = {lit, texture, glass};
    program->vertex[isa] = transform;
    program->fragment[isa] = fragments[shader];
}
