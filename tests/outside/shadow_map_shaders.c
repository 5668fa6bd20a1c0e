// SPDX-License-Identifier: MIT
// The shaders of shadow_map.c, compiled once per instruction set. Attributes: corner and normal of a box; per instance
// its centre, its half size and its colour.
#include "shadow_map.h"

static void world_corner(const struct rhw_vertex *v, rhw_float world[3])
{
    for (int i = 0; i < 3; i++) {
        world[i] = v->attribute[2][i] + v->attribute[0][i] * v->attribute[3][i];
    }
}

// Seen from the sun: positions alone.
void RHW_ISA_NAME(shadow_cast)(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        const struct sun *sun = v->uniforms;
        rhw_float world[3];
        world_corner(v, world);
        rhw_mat4_mul_point(sun->light, world, v->position);
    }
}

void RHW_ISA_NAME(shadow_place)(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        const struct sun *sun = v->uniforms;
        struct ground *out = RHW_VARYINGS_OUT(struct ground, v->varying);
        world_corner(v, out->world);
        for (int i = 0; i < 3; i++) {
            out->normal[i] = v->attribute[1][i];
            out->albedo[i] = v->attribute[4][i];
        }
        rhw_mat4_mul_point(sun->camera, out->world, v->position);
    }
}

// The part of 3 × 3 texels of the map around a point that does not lie before it: percentage-closer filtering.
static rhw_float visible(const struct rhw_fragment *f, const rhw_float world[3])
{
    const struct sun *sun = f->uniforms;
    rhw_float at[4];
    rhw_mat4_mul_point(sun->light, world, at); // a parallel projection: w is 1
    const rhw_float center[2] = {0.5f + 0.5f * at[0], 0.5f - 0.5f * at[1]};
    const rhw_float depth = at[2] - sun->bias;
    rhw_float lit = rhw_splat(0);
    for (int y = -1; y <= 1; y++) {
        for (int x = -1; x <= 1; x++) {
            const rhw_float uv[2] = {center[0] + (float)x * sun->texel, center[1] + (float)y * sun->texel};
            rhw_float nearest[4];
            rhw_sample_lod(f->textures, 0, uv, rhw_splat(0), nearest);
            lit += rhw_select(rhw_less_equal(depth, nearest[0]), 1, 0);
        }
    }
    return lit / 9.0f;
}

void RHW_ISA_NAME(shadow_light)(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const struct sun *sun = f->uniforms;
        const struct ground *in = RHW_VARYINGS(struct ground, f->varying);
        rhw_float facing = rhw_splat(0);
        for (int i = 0; i < 3; i++) {
            facing += in->normal[i] * sun->towards[i];
        }
        facing = rhw_max(facing, 0);
        if (rhw_any(f->mask & rhw_greater(facing, 0))) { // the map is asked only where the sun could shine
            facing *= visible(f, in->world);
        }
        const rhw_float light = sun->ambient + (1 - sun->ambient) * facing;
        for (int c = 0; c < 3; c++) {
            f->color[0][c] = in->albedo[c] * light;
        }
        f->color[0][3] = rhw_splat(1);
    }
}
