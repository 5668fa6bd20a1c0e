// SPDX-License-Identifier: MIT
// The shaders of game_loop.c, compiled once per instruction set: lit meshes, sparks that face the camera, and the
// rectangles that a HUD is made of. Sparks and rectangles are instances of a strip of 4 vertices.
#include "game_loop.h"

// Attributes: position, normal, texture coordinates.
void RHW_ISA_NAME(game_mesh_place)(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        const struct mesh_uniforms *mesh = v->uniforms;
        struct surface *out = RHW_VARYINGS_OUT(struct surface, v->varying);
        rhw_float world[4];
        rhw_mat4_mul_point(mesh->model, v->attribute[0], world);
        rhw_mat4_mul_point(mesh->clip, world, v->position);
        rhw_mat4_mul_direction(mesh->model, v->attribute[1], out->normal);
        out->uv[0] = v->attribute[2][0];
        out->uv[1] = v->attribute[2][1];
    }
}

void RHW_ISA_NAME(game_mesh_paint)(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const struct mesh_uniforms *mesh = f->uniforms;
        const struct surface *in = RHW_VARYINGS(struct surface, f->varying);
        const struct surface *ddx = RHW_VARYINGS(struct surface, f->ddx);
        const struct surface *ddy = RHW_VARYINGS(struct surface, f->ddy);
        const rhw_float grad[4] = {ddx->uv[0], ddx->uv[1], ddy->uv[0], ddy->uv[1]};
        rhw_float texel[4], normal[3];
        rhw_sample_grad(f->bindings, 0, in->uv, grad, texel);
        rhw_normalize3(in->normal, normal);
        rhw_float facing = rhw_splat(0);
        for (int i = 0; i < 3; i++) {
            facing += normal[i] * mesh->sun[i];
        }
        const rhw_float light = 0.3f + 0.7f * rhw_max(facing, 0);
        for (int c = 0; c < 3; c++) {
            f->color[0][c] = texel[c] * mesh->tint[c] * light;
        }
        f->color[0][3] = rhw_splat(1);
    }
}

// 0 or 1: which corner of a strip of 4, to the right and down.
static void strip_corner(const struct rhw_vertex *v, rhw_float corner[2])
{
    corner[0] = rhw_float_from_int(v->vertex_index & 1);
    corner[1] = rhw_float_from_int(v->vertex_index >> 1);
}

static void pass_color(const struct rhw_vertex *v, int attribute, struct sprite *out)
{
    for (int c = 0; c < 4; c++) {
        out->color[c] = v->attribute[attribute][c];
    }
}

// Attributes: centre and half size; colour. Here uv is −1..1 around the centre.
void RHW_ISA_NAME(game_spark_place)(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        const struct spark_uniforms *spark = v->uniforms;
        struct sprite *out = RHW_VARYINGS_OUT(struct sprite, v->varying);
        rhw_float corner[2], world[3];
        strip_corner(v, corner);
        out->uv[0] = 2 * corner[0] - 1;
        out->uv[1] = 2 * corner[1] - 1;
        for (int i = 0; i < 3; i++) {
            const rhw_float aside = out->uv[0] * spark->right[i] + out->uv[1] * spark->up[i];
            world[i] = v->attribute[0][i] + v->attribute[0][3] * aside;
        }
        rhw_mat4_mul_point(spark->clip, world, v->position);
        pass_color(v, 1, out);
    }
}

// A disc, full to 7/10 of its radius and fading to the edge.
void RHW_ISA_NAME(game_spark_paint)(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const struct sprite *in = RHW_VARYINGS(struct sprite, f->varying);
        const rhw_float full = rhw_saturate(2 - 2 * rhw_dot2(in->uv, in->uv));
        for (int c = 0; c < 4; c++) {
            f->color[0][c] = in->color[c] * full;
        }
    }
}

// Attributes: x, y, width, height in pixels of the window; the same in texels; colour.
void RHW_ISA_NAME(game_hud_place)(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        const struct hud_uniforms *hud = v->uniforms;
        struct sprite *out = RHW_VARYINGS_OUT(struct sprite, v->varying);
        rhw_float corner[2], at[2];
        strip_corner(v, corner);
        for (int i = 0; i < 2; i++) {
            at[i] = (v->attribute[0][i] + corner[i] * v->attribute[0][2 + i]) / hud->window[i];
            out->uv[i] = (v->attribute[1][i] + corner[i] * v->attribute[1][2 + i]) / hud->texture[i];
        }
        v->position[0] = 2 * at[0] - 1;
        v->position[1] = 1 - 2 * at[1];
        v->position[2] = rhw_splat(0);
        v->position[3] = rhw_splat(1);
        pass_color(v, 2, out);
    }
}

void RHW_ISA_NAME(game_hud_paint)(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const struct sprite *in = RHW_VARYINGS(struct sprite, f->varying);
        rhw_float texel[4];
        rhw_sample_lod(f->bindings, 0, in->uv, rhw_splat(0), texel);
        for (int c = 0; c < 4; c++) {
            f->color[0][c] = in->color[c] * texel[c];
        }
    }
}
