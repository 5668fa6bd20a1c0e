// SPDX-License-Identifier: MIT
// The shaders of normal_map.c on 8 lanes, compiled once per instruction set.
#include "normal_map.h"

void RHW_ISA_NAME(normal_map_place)(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        const struct material *material = v->uniforms;
        struct surface *out = RHW_VARYINGS_OUT(struct surface, v->varying);
        memcpy(out->world, v->attribute[0], sizeof out->world);
        memcpy(out->normal, v->attribute[1], sizeof out->normal);
        memcpy(out->tangent, v->attribute[2], sizeof out->tangent);
        memcpy(out->uv, v->attribute[3], sizeof out->uv);
        rhw_mat4_mul_point(material->camera, out->world, v->position);
    }
}

// The normal of the map, out of the space of tangent, bitangent and normal.
static void bent_normal(const struct surface *in, const rhw_float texel[4], rhw_float normal[3])
{
    rhw_float bitangent[3], bend[3];
    rhw_cross(in->normal, in->tangent, bitangent);
    for (int i = 0; i < 3; i++) {
        bend[i] = texel[i] * normal_scale + normal_offset;
        bitangent[i] *= in->tangent[3];
    }
    for (int i = 0; i < 3; i++) {
        normal[i] = bend[0] * in->tangent[i] + bend[1] * bitangent[i] + bend[2] * in->normal[i];
    }
    rhw_normalize3(normal, normal);
}

// Blinn and Phong's: what is between the sun and the eye.
static rhw_float highlight(const struct material *material, const rhw_float world[3],
                           const rhw_float normal[3])
{
    rhw_float half[3];
    for (int i = 0; i < 3; i++) {
        half[i] = material->eye[i] - world[i];
    }
    rhw_normalize3(half, half);
    for (int i = 0; i < 3; i++) {
        half[i] += material->towards[i];
    }
    rhw_normalize3(half, half);
    return material->shine * rhw_pow(rhw_max(rhw_dot3(normal, half), 0), material->sharpness);
}

void RHW_ISA_NAME(normal_map_light)(struct rhw_fragment *groups, int count)
{
    rhw_float texels[RHW_MAX_GROUPS][2][4]; // albedo and normal of each group, sampled together
    rhw_sample_groups(groups, count, 1u << ALBEDO | 1u << NORMALS, RHW_COMPONENT(struct surface, uv),
                      texels[0], 2);
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const struct material *material = f->uniforms;
        const struct surface *in = RHW_VARYINGS(struct surface, f->varying);
        rhw_float normal[3], facing = rhw_splat(0);
        bent_normal(in, texels[g][NORMALS], normal);
        for (int i = 0; i < 3; i++) {
            facing += normal[i] * material->towards[i];
        }
        facing = rhw_max(facing, 0);
        const rhw_float shine = rhw_select(rhw_greater(facing, 0), highlight(material, in->world, normal), 0);
        const rhw_float light = material->ambient + (1 - material->ambient) * facing;
        for (int c = 0; c < 3; c++) {
            f->color[0][c] = texels[g][ALBEDO][c] * light + shine;
        }
        f->color[0][3] = rhw_splat(1);
    }
}
