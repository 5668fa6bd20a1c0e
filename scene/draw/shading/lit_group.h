// SPDX-License-Identifier: MIT
// Lit surfaces without layers are shaded 8 groups at a time, a step of all groups before the next step. By itself a
// group is a chain of operations that wait for each other, longer than what a processor looks ahead, while a step of
// the next group waits for nothing. Without a panorama the surroundings are three steps, since one was too long to gain
// anything.
#ifndef SCENE_SHADERS_LIT_GROUP_H
#define SCENE_SHADERS_LIT_GROUP_H

#include "fragment.h"

// A group of fragments on its way through the steps of shading.
struct lit_group {
    struct rhw_fragment *fragment;
    struct scene_reflector reflector;
    rhw_float roughness, occlusion, alpha;
    rhw_float direction[3], mirrored[3], diffuse[3]; // what comes from the surroundings, and where from
    rhw_float sum[3];
};

// Find what a surface reflects. `texels` has the texels of shared slots. Return false if no fragment is left.
ALWAYS_INLINE bool find_reflector(struct lit_group *lit, struct rhw_fragment *f,
                                  const struct scene_surface *s, bool textured, bool mapped,
                                  slot_texels texels)
{
    rhw_float base[4];
    base_color(f, s, textured, texels, base);
    if (!rhw_any(f->mask)) {
        return false;
    }
    const struct scene_frame *frame = s->frame;
    rhw_float metallic = rhw_splat(s->metallic), roughness = rhw_splat(s->roughness);
    rhw_float occlusion = rhw_splat(1.0f);
    for (int c = 0; c < 3; c++) {
        lit->sum[c] = rhw_splat(s->emissive[c]);
    }
    if (textured) {
        if (s->slot_varying[SCENE_SLOT_METALLIC_ROUGHNESS] >= 0) {
            const rhw_float *texel = slot_texel(f, s, SCENE_SLOT_METALLIC_ROUGHNESS, texels);
            roughness = roughness * texel[1];
            metallic = metallic * texel[2];
        }
        if (s->slot_varying[SCENE_SLOT_OCCLUSION] >= 0) {
            const rhw_float *texel = s->occlusion_shared ? texels[SCENE_SLOT_METALLIC_ROUGHNESS]
                                                         : slot_texel(f, s, SCENE_SLOT_OCCLUSION, texels);
            occlusion = 1.0f + s->occlusion_strength * (texel[0] - 1.0f);
        }
        if (s->slot_varying[SCENE_SLOT_EMISSIVE] >= 0) {
            const rhw_float *texel = slot_texel(f, s, SCENE_SLOT_EMISSIVE, texels);
            for (int c = 0; c < 3; c++) {
                lit->sum[c] = lit->sum[c] * texel[c];
            }
        }
    }
    struct scene_reflector *reflector = &lit->reflector;
    const rhw_float *position = &f->varying[s->varying_position];
    view_direction(frame, position, reflector->view);
    seen_normal(f, s, mapped, texels, reflector->view, reflector->normal);
    scene_reflector_set(reflector, base, metallic, roughness);
    if (frame->guide.occlusion) {
        occlusion = rhw_min(occlusion, ambient_open(f, frame, position));
    }
    lit->fragment = f;
    lit->roughness = roughness;
    lit->occlusion = occlusion;
    lit->alpha = base[3];
    return true;
}

// Find what comes from the surroundings.
ALWAYS_INLINE void find_surroundings(struct lit_group *lit, int count,
                                     const struct scene_environment_lanes *around)
{
    if (around->of->mapped) {
        for (int g = 0; g < count; g++) {
            struct lit_group *l = &lit[g];
            scene_reflector_mirror(&l->reflector, l->direction);
            scene_environment_panorama(around, l->fragment->bindings, l->direction, l->reflector.alpha,
                                       l->mirrored);
            scene_harmonics(around->of->irradiance, l->reflector.normal, l->diffuse);
        }
        return;
    }
    for (int g = 0; g < count; g++) {
        struct lit_group *l = &lit[g];
        scene_reflector_mirror(&l->reflector, l->direction);
        scene_environment_sky(around, l->direction, l->reflector.alpha, l->mirrored);
    }
    for (int g = 0; g < count; g++) {
        scene_environment_lobes(around, lit[g].direction, lit[g].reflector.alpha, lit[g].mirrored);
    }
    for (int g = 0; g < count; g++) {
        scene_environment_diffuse(around, lit[g].reflector.normal, lit[g].diffuse);
    }
}

ALWAYS_INLINE void add_light(struct lit_group *l, const struct scene_surface *s,
                             const struct scene_shader_light *light)
{
    struct rhw_fragment *f = l->fragment;
    rhw_float to_light[3], irradiance[3];
    scene_light_at(light, &f->varying[s->varying_position], to_light, irradiance);
    if (light->map_count > 0) {
        shadow_irradiance(f, s, light, rhw_less(0.0f, rhw_dot3(l->reflector.normal, to_light)), irradiance);
    }
    scene_reflect_light(&l->reflector, to_light, irradiance, light->size, l->sum);
}

// Shade groups of which it is known what they reflect.
ALWAYS_INLINE void light_groups(struct lit_group *lit, int count, const struct scene_surface *s,
                                const struct scene_environment_lanes *around)
{
    find_surroundings(lit, count, around);
    for (int g = 0; g < count; g++) {
        struct lit_group *l = &lit[g];
        scene_reflect_surroundings(&l->reflector, l->roughness, l->occlusion, l->mirrored, l->diffuse,
                                   l->sum);
    }
    for (int i = 0; i < s->frame->light_count; i++) {
        for (int g = 0; g < count; g++) {
            add_light(&lit[g], s, &s->frame->lights[i]);
        }
    }
    for (int g = 0; g < count; g++) {
        write_light(lit[g].fragment, s, lit[g].sum, lit[g].alpha);
    }
}

// Sample the texels of several groups first, and light them afterwards.
ALWAYS_INLINE void shade_lit(struct rhw_fragment *groups, int count, bool textured, bool mapped)
{
    enum { STEP = 8 };
    const struct scene_surface *s = groups->uniforms;
    struct scene_environment_lanes around;
    scene_environment_lanes_set(&around, &s->frame->environment);
    for (; count > 0; groups += STEP, count -= STEP) {
        const int n = count < STEP ? count : STEP;
        struct lit_group lit[STEP];
        slot_texels texels[STEP];
        int left = 0;
        if (textured) {
            sample_shared(groups, n, s, texels);
        }
        for (int g = 0; g < n; g++) {
            left += find_reflector(&lit[left], &groups[g], s, textured, mapped, texels[g]);
        }
        light_groups(lit, left, s, &around);
    }
}

#endif
