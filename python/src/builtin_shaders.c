// SPDX-License-Identifier: MIT
#include "builtin_shaders.h"

#include "rhw/shader.h"

void RHW_ISA_NAME(python_vertex)(struct rhw_vertex *groups, int count)
{
    const struct python_layout *const layout = groups->user;
    const struct python_uniforms *const u = groups->uniforms;
    const int32_t *const attribute = layout->attribute, *const varying = layout->varying;
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        const rhw_float *const position =
            v->attribute[attribute[PYTHON_POSITIONS]]; // w is 1 where there are three
        rhw_mat4_mul_vec4(u->clip, position, v->position);
        if (varying[PYTHON_VARYING_COLOR] >= 0) {
            for (int c = 0; c < 4; c++) {
                v->varying[varying[PYTHON_VARYING_COLOR] + c] = v->attribute[attribute[PYTHON_COLORS]][c];
            }
        }
        if (varying[PYTHON_VARYING_UV] >= 0) {
            v->varying[varying[PYTHON_VARYING_UV]] = v->attribute[attribute[PYTHON_UV]][0];
            v->varying[varying[PYTHON_VARYING_UV] + 1] = v->attribute[attribute[PYTHON_UV]][1];
        }
        if (varying[PYTHON_VARYING_NORMAL] >= 0) {
            rhw_mat3_mul_vec3(u->normal, v->attribute[attribute[PYTHON_NORMALS]],
                              &v->varying[varying[PYTHON_VARYING_NORMAL]]);
        }
        if (varying[PYTHON_VARYING_POSITION] >= 0) {
            rhw_float world[4];
            rhw_mat4_mul_vec4(u->world, position, world);
            for (int c = 0; c < 3; c++) {
                v->varying[varying[PYTHON_VARYING_POSITION] + c] = world[c];
            }
        }
    }
}

static void set(rhw_float color[4], rhw_float r, rhw_float g, rhw_float b, rhw_float a)
{
    color[0] = r;
    color[1] = g;
    color[2] = b;
    color[3] = a;
}

static void shade_color(const struct rhw_fragment *f, const struct python_layout *layout,
                        const struct python_uniforms *u, rhw_float color[4])
{
    const int32_t tint = layout->varying[PYTHON_VARYING_COLOR], uv = layout->varying[PYTHON_VARYING_UV];
    for (int c = 0; c < 4; c++) {
        color[c] = tint >= 0 ? f->varying[tint + c] * u->color[c] : rhw_splat(u->color[c]);
    }
    if (layout->is_textured) {
        const rhw_float footprint[4] = {f->ddx[uv], f->ddx[uv + 1], f->ddy[uv], f->ddy[uv + 1]};
        rhw_float texel[4];
        rhw_sample_grad(f->bindings, 0, &f->varying[uv], footprint, texel);
        for (int c = 0; c < 4; c++) {
            color[c] *= texel[c];
        }
    }
}

static void shade(const struct rhw_fragment *f, enum python_output output, const struct python_layout *layout,
                  const struct python_uniforms *u, rhw_float color[4])
{
    const rhw_float none = rhw_splat(0.0f), one = rhw_splat(1.0f);
    const int32_t *const varying = layout->varying;
    rhw_float v[3];
    switch (output) {
    case PYTHON_COLOR: shade_color(f, layout, u, color); break;
    case PYTHON_DEPTH: set(color, f->coord[2], none, none, one); break;
    case PYTHON_DISTANCE: set(color, 1.0f / f->coord[3], none, none, one); break;
    case PYTHON_NORMAL:
        rhw_normalize3(&f->varying[varying[PYTHON_VARYING_NORMAL]], v);
        set(color, v[0], v[1], v[2], one);
        break;
    case PYTHON_POSITION:
        for (int c = 0; c < 3; c++) {
            v[c] = f->varying[varying[PYTHON_VARYING_POSITION] + c];
        }
        set(color, v[0], v[1], v[2], one);
        break;
    case PYTHON_UV_OUTPUT:
        set(color, f->varying[varying[PYTHON_VARYING_UV]], f->varying[varying[PYTHON_VARYING_UV] + 1], none,
            one);
        break;
    case PYTHON_BARYCENTRIC: set(color, f->barycentric[0], f->barycentric[1], f->barycentric[2], one); break;
    case PYTHON_OBJECT: color[0] = rhw_float_from_bits(rhw_splat_int((int32_t)u->object)); break;
    case PYTHON_TRIANGLE: color[0] = rhw_float_from_bits(f->primitive + (int32_t)u->first_triangle); break;
    case PYTHON_OUTPUTS: break;
    }
}

void RHW_ISA_NAME(python_fragment)(struct rhw_fragment *groups, int count)
{
    const struct python_layout *const layout = groups->user;
    const struct python_uniforms *const u = groups->uniforms;
    for (int output = 0; output < PYTHON_OUTPUTS; output++) {
        const int32_t target = layout->target[output];
        for (int g = 0; target >= 0 && g < count; g++) {
            shade(&groups[g], (enum python_output)output, layout, u, groups[g].color[target]);
        }
    }
}
