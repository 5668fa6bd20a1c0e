// SPDX-License-Identifier: MIT
// The shaders of deferred.c, compiled once per instruction set: two functions for each of its three passes.
#include "deferred.h"

// The first pass. Attributes: corner and normal of a mesh; per instance its centre, its scale and its colour.
void RHW_ISA_NAME(deferred_place)(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        const struct view *view = v->uniforms;
        struct surface *out = RHW_VARYINGS_OUT(struct surface, v->varying);
        rhw_float world[3];
        for (int i = 0; i < 3; i++) {
            world[i] = v->attribute[2][i] + v->attribute[0][i] * v->attribute[3][0];
            out->normal[i] = v->attribute[1][i];
            out->albedo[i] = v->attribute[4][i];
        }
        rhw_mat4_mul_point(view->camera, world, v->position);
    }
}

// Three targets: albedo, normal, depth. The depth is that of the depth buffer, as a colour.
void RHW_ISA_NAME(deferred_store)(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const struct surface *in = RHW_VARYINGS(struct surface, f->varying);
        rhw_float normal[3];
        rhw_normalize3(in->normal, normal);
        for (int i = 0; i < 3; i++) {
            f->color[SLOT_ALBEDO][i] = in->albedo[i];
            f->color[SLOT_NORMAL][i] = normal[i];
        }
        f->color[SLOT_ALBEDO][3] = f->color[SLOT_NORMAL][3] = rhw_splat(1);
        f->color[SLOT_DEPTH][0] = f->coord[2];
    }
}

// The second pass: a cube around each light. Attributes: corner; per instance centre, radius and colour of the light.
void RHW_ISA_NAME(deferred_volume)(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        const struct view *view = v->uniforms;
        struct glow *out = RHW_VARYINGS_OUT(struct glow, v->varying);
        rhw_float world[3];
        for (int i = 0; i < 3; i++) {
            out->center[i] = v->attribute[1][i];
            out->color[i] = v->attribute[3][i];
            world[i] = v->attribute[1][i] + v->attribute[0][i] * v->attribute[2][0];
        }
        out->radius = v->attribute[2][0];
        rhw_mat4_mul_point(view->camera, world, v->position);
    }
}

// What the G-buffer holds at this pixel.
static void fetch(const struct rhw_fragment *f, int slot, rhw_float texel[4])
{
    const struct view *view = f->uniforms;
    const rhw_float uv[2] = {f->coord[0] / view->size[0], f->coord[1] / view->size[1]};
    rhw_sample_lod(f->textures, slot, uv, rhw_splat(0), texel);
}

// One light on one surface: its colour · cosine · (1 − distance² / radius²)², nothing beyond the radius.
void RHW_ISA_NAME(deferred_light)(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const struct view *view = f->uniforms;
        const struct glow *in = RHW_VARYINGS(struct glow, f->varying);
        rhw_float albedo[4], normal[4], depth[4];
        fetch(f, SLOT_ALBEDO, albedo);
        fetch(f, SLOT_NORMAL, normal);
        fetch(f, SLOT_DEPTH, depth);
        // Where the surface is: as far along the ray through this pixel as its depth says.
        const rhw_float far = view->near * view->far / (view->far - depth[0] * (view->far - view->near));
        rhw_float towards[3], direction[3];
        for (int i = 0; i < 3; i++) {
            const rhw_float ray =
                view->corner[i] + f->coord[0] * view->right[i] + f->coord[1] * view->down[i];
            towards[i] = in->center[i] - (view->eye[i] + far * ray);
        }
        rhw_normalize3(towards, direction);
        const rhw_float fade = rhw_max(1 - rhw_dot3(towards, towards) / (in->radius * in->radius), 0);
        const rhw_float light = rhw_max(rhw_dot3(normal, direction), 0) * fade * fade;
        for (int c = 0; c < 3; c++) {
            f->color[0][c] = albedo[c] * in->color[c] * light;
        }
        f->color[0][3] = rhw_splat(1); // counts the lights that were asked
    }
}

// The last pass: one triangle that covers the screen.
void RHW_ISA_NAME(deferred_screen)(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        v->position[0] = rhw_select(rhw_equal_int(v->vertex_index, 1), 3, -1);
        v->position[1] = rhw_select(rhw_equal_int(v->vertex_index, 2), 3, -1);
        v->position[2] = rhw_splat(0);
        v->position[3] = rhw_splat(1);
    }
}

void RHW_ISA_NAME(deferred_resolve)(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const struct view *view = f->uniforms;
        rhw_float albedo[4], light[4];
        fetch(f, SLOT_ALBEDO, albedo);
        fetch(f, SLOT_LIGHT, light);
        for (int c = 0; c < 3; c++) {
            f->color[0][c] = albedo[c] * view->ambient + light[c];
        }
        f->color[0][3] = rhw_splat(1);
    }
}
