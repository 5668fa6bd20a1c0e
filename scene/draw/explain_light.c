// SPDX-License-Identifier: MIT
// See explain_light.h. The shader takes 8 fragments at once: all of them are this one.
#include "explain_light.h"

#include "draw/shading/fragment.h"

struct lanes {
    struct rhw_fragment fragment;
    rhw_float varying[RHW_MAX_VARYING_COMPONENTS];
    rhw_float ddx[RHW_MAX_VARYING_COMPONENTS], ddy[RHW_MAX_VARYING_COMPONENTS];
};

static void spread(const struct rhw_explained_fragment *told, struct lanes *lanes)
{
    const float x = (float)(told->sample_x >> 8) + told->place[0],
                y = (float)(told->sample_y >> 8) + told->place[1];
    *lanes = (struct lanes){.fragment = {.varying = lanes->varying,
                                         .ddx = lanes->ddx,
                                         .ddy = lanes->ddy,
                                         .coord = {rhw_splat(x), rhw_splat(y), rhw_splat(told->depth),
                                                   rhw_splat((float)told->inverse_w)},
                                         .bindings = told->bindings,
                                         .mask = rhw_splat_int(-1),
                                         .front_facing = rhw_splat_int(told->front_facing ? -1 : 0)}};
    for (int i = 0; i < told->component_count; i++) {
        lanes->varying[i] = rhw_splat(told->varyings[i]);
        if (told->has_derivatives[i]) {
            lanes->ddx[i] = rhw_splat(told->ddx[i]);
            lanes->ddy[i] = rhw_splat(told->ddy[i]);
        }
    }
}

static void look_at_normal(const struct rhw_fragment *f, const struct scene_surface *s, rhw_float normal[3])
{
    slot_texels texels;
    rhw_float view[3];
    sample_shared(f, 1, s, &texels);
    view_direction(s->frame, &f->varying[s->varying_position], view);
    seen_normal(f, s, s->varying_tangent >= 0, texels, view, normal);
}

static void look_at_light(const struct rhw_fragment *f, const struct scene_surface *s,
                          const struct scene_shader_light *light, const rhw_float normal[3],
                          struct scene_light_look *look)
{
    rhw_float to_light[3], irradiance[3], open[3];
    scene_light_at(light, &f->varying[s->varying_position], to_light, irradiance);
    look->type = light->type;
    look->n_dot_l = rhw_dot3(normal, to_light)[0];
    look->has_shadows = light->map_count > 0;
    for (int c = 0; c < 3; c++) {
        look->direction[c] = to_light[c][0];
        open[c] = rhw_splat(1.0f);
    }
    if (look->has_shadows && look->n_dot_l > 0.0f) {
        shadow_irradiance(f, s, light, f->mask, open);
    }
    look->open = open[0][0];
    const float share = look->n_dot_l > 0.0f ? look->n_dot_l * look->open : 0.0f;
    for (int c = 0; c < 3; c++) {
        look->facing[c] = irradiance[c][0] * scene_inverse_pi;
        look->arrives[c] = look->facing[c] * share;
    }
}

void scene_light_looks(const struct rhw_explained_fragment *fragment, const struct scene_surface *surface,
                       struct scene_light_looks *looks)
{
    *looks = (struct scene_light_looks){.is_lit = fragment->is_shaded && surface->varying_position >= 0 &&
                                                  surface->varying_normal >= 0};
    if (!looks->is_lit) {
        return;
    }
    struct lanes lanes;
    rhw_float normal[3];
    spread(fragment, &lanes);
    looks->is_mapped = surface->varying_tangent >= 0 && surface->slot_varying[SCENE_SLOT_NORMAL] >= 0;
    look_at_normal(&lanes.fragment, surface, normal);
    for (int c = 0; c < 3; c++) {
        looks->normal[c] = normal[c][0];
    }
    looks->has_occlusion = surface->frame->guide.occlusion != NULL;
    if (looks->has_occlusion) {
        const rhw_float *position = &lanes.fragment.varying[surface->varying_position];
        looks->around = ambient_open(&lanes.fragment, surface->frame, position)[0];
    }
    for (int i = 0; i < surface->frame->light_count; i++) {
        struct scene_light_look look;
        look_at_light(&lanes.fragment, surface, &surface->frame->lights[i], normal, &look);
        for (int c = 0; c < 3; c++) {
            looks->sum[c] += look.arrives[c];
        }
        if (i < SCENE_LIGHT_LOOKS) {
            looks->lights[looks->count++] = look;
        } else {
            looks->left_out++;
        }
    }
}
