// SPDX-License-Identifier: MIT
// Reflection and surroundings on 8 lanes. The functions are inline, so that every shader variant keeps only what it
// uses, and so that tests can hold each formula against double precision.
//
// Reflection is that of glTF 2.0, appendix B: GGX distribution, Smith's shadowing in its separable form, Schlick's
// Fresnel term, a Lambertian base. What comes from all around is not sampled but has a closed form: a soft-edged sky
// over a ground, and soft boxes as spherical Gaussians, which a rough surface blurs into wider Gaussians (Wang et al.
// 2009). Metals have something to reflect in this way, and nothing needs a file.
#ifndef SCENE_SHADERS_PBR_H
#define SCENE_SHADERS_PBR_H

#include "rhw/shader.h"
#include "scene_shaders.h"

static const float scene_inverse_pi = 0.31830988618f;

/// What one fragment reflects, before any light is looked at. Vectors are unit and point away from the surface.
struct scene_reflector {
    rhw_float normal[3], view[3];
    rhw_float facing;     // n·v, below 0 where the normal leans away from the eye
    rhw_float n_dot_v;    // `facing`, but at least 1/1024
    rhw_float alpha;      // roughness squared
    rhw_float diffuse[3]; // base colour of what is not metal
    rhw_float f0[3];      // reflectance head on
};

static inline rhw_float scene_pow5(rhw_float a)
{
    const rhw_float square = a * a;
    return square * square * a;
}

/// Return the bits of rhw_exp2 for −126 ≤ a ≤ 127, and NaN for NaN. The argument is not held to bounds, and the power
/// of a whole number is one factor instead of two.
static inline rhw_float scene_exp2(rhw_float a)
{
    const rhw_float n = rhw_round(a);
    return rhw_exp2_fraction(a - n) * rhw_power_of_two(rhw_int_from_float_unchecked(n));
}

/// Return Smith's masking for one direction, without its numerator 2 n·l: n·l + sqrt(α² + (1 − α²)(n·l)²).
static inline rhw_float scene_smith(rhw_float cosine, rhw_float alpha2)
{
    return cosine + rhw_sqrt(alpha2 + (1.0f - alpha2) * (cosine * cosine));
}

/// Fill `reflector` from base colour, metallic and roughness. Normal and view are already in it.
static inline void scene_reflector_set(struct scene_reflector *reflector, const rhw_float base[3],
                                       rhw_float metallic, rhw_float roughness)
{
    const rhw_float dielectric = rhw_splat(0.04f);
    for (int c = 0; c < 3; c++) {
        reflector->diffuse[c] = base[c] * (1.0f - metallic);
        reflector->f0[c] = rhw_mix(dielectric, base[c], metallic);
    }
    // Below 0.045 the highlight of a light without extent is smaller than a pixel and flickers.
    const rhw_float rough = rhw_clamp(roughness, 0.045f, 1.0f);
    reflector->alpha = rough * rough;
    reflector->facing = rhw_dot3(reflector->normal, reflector->view);
    reflector->n_dot_v = rhw_clamp(reflector->facing, 1.0f / 1024.0f, 1.0f);
}

/// Add the light that arrives from `to_light` (unit) to `sum`: irradiance · n·l · ((1 − F) diffuse / π + F D V).
/// `irradiance` is that of a surface that faces the light. `size` is added to alpha.
static inline void scene_reflect_light(const struct scene_reflector *r, const rhw_float to_light[3],
                                       const rhw_float irradiance[3], float size, rhw_float sum[3])
{
    const rhw_float n_dot_l = rhw_saturate(rhw_dot3(r->normal, to_light));
    const rhw_float l_dot_v = rhw_dot3(to_light, r->view);
    // |l + v|² = 2 + 2 l·v gives the cosines of the half vector without the vector.
    const rhw_float h_dot_v = rhw_sqrt(rhw_max(0.5f + 0.5f * l_dot_v, 1e-6f));
    // A normal that leans away from the eye leans away from the half vector too. With n·v held above 0, n·h would come
    // out too large there, up to the peak of the highlight.
    const rhw_float n_dot_h = rhw_clamp((n_dot_l + r->facing) / (2.0f * h_dot_v), 0.0f, 1.0f);
    const rhw_float alpha = rhw_min(r->alpha + size, 1.0f);
    const rhw_float alpha2 = alpha * alpha;
    const rhw_float base = 1.0f - n_dot_h * n_dot_h * (1.0f - alpha2);
    const rhw_float visibility = scene_smith(n_dot_l, alpha2) * scene_smith(r->n_dot_v, alpha2);
    const rhw_float specular = alpha2 * scene_inverse_pi / (base * base * visibility);
    const rhw_float fresnel = scene_pow5(1.0f - h_dot_v);
    for (int c = 0; c < 3; c++) {
        const rhw_float f = r->f0[c] + (1.0f - r->f0[c]) * fresnel;
        sum[c] += irradiance[c] * n_dot_l * ((1.0f - f) * r->diffuse[c] * scene_inverse_pi + f * specular);
    }
}

/// The surroundings with every number in all lanes: an instruction takes one from memory as an operand, where a number
/// by itself has to be loaded into all lanes first. They are set once for the groups of a call.
struct scene_environment_lanes {
    const struct scene_environment *of;
    rhw_float up[3], ground[3], rise[3]; // `rise` leads from the ground's colour to the sky's
    rhw_float lobe_direction[SCENE_LOBES][3], lobe_color[SCENE_LOBES][3];
    rhw_float twice_sharpness, sharpness_log2; // twice the sharpness, and the sharpness over ln 2
    rhw_float diffuse[3];
};

static inline void scene_environment_lanes_set(struct scene_environment_lanes *s,
                                               const struct scene_environment *e)
{
    s->of = e;
    if (e->mapped) {
        return;
    }
    for (int c = 0; c < 3; c++) {
        s->up[c] = rhw_splat(e->up[c]);
        s->ground[c] = rhw_splat(e->ground[c]);
        s->rise[c] = rhw_splat(e->sky[c] - e->ground[c]);
        s->diffuse[c] = rhw_splat(e->diffuse[c]);
        for (int i = 0; i < SCENE_LOBES; i++) {
            s->lobe_direction[i][c] = rhw_splat(e->lobe_direction[i][c]);
            s->lobe_color[i][c] = rhw_splat(e->lobe_color[i][c]);
        }
    }
    s->twice_sharpness = rhw_splat(2.0f * e->sharpness);
    s->sharpness_log2 = rhw_splat(e->sharpness * 1.44269504f);
}

/// Find the radiance that sky and ground send along −direction after a blur by roughness squared `alpha`.
static inline void scene_environment_sky(const struct scene_environment_lanes *s,
                                         const rhw_float direction[3], rhw_float alpha, rhw_float radiance[3])
{
    const rhw_float alpha2 = alpha * alpha;
    const rhw_float height = rhw_dot3(direction, s->up);
    const rhw_float above = 0.5f + 0.5f * height * rhw_rsqrt(height * height + (0.03f + 1.2f * alpha2));
    for (int c = 0; c < 3; c++) {
        radiance[c] = s->ground[c] + s->rise[c] * above;
    }
}

/// Add the radiance of the soft boxes. The normal distribution is close to a Gaussian of sharpness 2 / α², and its
/// reflection is close to one of a fourth of that sharpness. Gaussians convolve into Gaussians: with k = 1 / (1 + 2 λ
/// α²) sharpness and amplitude shrink by k. Directions are about as long as 1, so exponents stay within ±80. For a
/// direction that is not finite the sky's radiance is NaN already.
static inline void scene_environment_lobes(const struct scene_environment_lanes *s,
                                           const rhw_float direction[3], rhw_float alpha,
                                           rhw_float radiance[3])
{
    const rhw_float k = 1.0f / (1.0f + s->twice_sharpness * (alpha * alpha));
    const rhw_float exponent = k * s->sharpness_log2;
    for (int i = 0; i < SCENE_LOBES; i++) {
        const rhw_float cosine = rhw_dot3(direction, s->lobe_direction[i]);
        const rhw_float value = k * scene_exp2(exponent * (cosine - 1.0f));
        for (int c = 0; c < 3; c++) {
            radiance[c] += s->lobe_color[i][c] * value;
        }
    }
}

/// Find the radiance that the panorama sends along −direction after a blur by roughness squared `alpha`.
static inline void scene_environment_panorama(const struct scene_environment_lanes *s,
                                              const struct rhw_bindings *bindings,
                                              const rhw_float direction[3], rhw_float alpha,
                                              rhw_float radiance[3])
{
    rhw_float texel[4];
    rhw_sample_lod(bindings, SCENE_SLOT_ENVIRONMENT, direction, rhw_sqrt(alpha) * s->of->levels, texel);
    for (int c = 0; c < 3; c++) {
        radiance[c] = texel[c] * s->of->strength;
    }
}

/// Find the radiance that the surroundings send along −direction after a blur by roughness squared `alpha`.
static inline void scene_environment_reflection(const struct scene_environment_lanes *s,
                                                const struct rhw_bindings *bindings,
                                                const rhw_float direction[3], rhw_float alpha,
                                                rhw_float radiance[3])
{
    if (s->of->mapped) {
        scene_environment_panorama(s, bindings, direction, alpha, radiance);
        return;
    }
    scene_environment_sky(s, direction, alpha, radiance);
    scene_environment_lobes(s, direction, alpha, radiance);
}

/// Find irradiance / π of a panorama, from spherical harmonics of order 2 (R. Ramamoorthi, P. Hanrahan, "An efficient
/// representation for irradiance environment maps", SIGGRAPH 2001). The harmonics swing below 0 beside a strong light.
static inline void scene_harmonics(const float k[9][3], const rhw_float n[3], rhw_float irradiance[3])
{
    const rhw_float products[8] = {n[0],
                                   n[1],
                                   n[2],
                                   n[0] * n[1],
                                   n[1] * n[2],
                                   n[2] * n[0],
                                   3.0f * n[2] * n[2] - 1.0f,
                                   n[0] * n[0] - n[1] * n[1]};
    for (int c = 0; c < 3; c++) {
        irradiance[c] = rhw_splat(k[0][c]);
        for (int i = 0; i < 8; i++) {
            irradiance[c] += products[i] * k[i + 1][c];
        }
        irradiance[c] = rhw_max(irradiance[c], 0.0f);
    }
}

/// Find irradiance / π of the surroundings on a surface that faces `normal`. Every lobe has zonal harmonics up to order
/// 2. The sky's half of the sphere gives exactly (1 + cos) / 2.
static inline void scene_environment_diffuse(const struct scene_environment_lanes *s,
                                             const rhw_float normal[3], rhw_float irradiance[3])
{
    if (s->of->mapped) {
        scene_harmonics(s->of->irradiance, normal, irradiance);
        return;
    }
    const rhw_float above = 0.5f + 0.5f * rhw_dot3(normal, s->up);
    for (int c = 0; c < 3; c++) {
        irradiance[c] = s->ground[c] + s->rise[c] * above;
    }
    for (int i = 0; i < SCENE_LOBES; i++) {
        const rhw_float t = rhw_dot3(normal, s->lobe_direction[i]);
        const rhw_float value = rhw_max(s->diffuse[0] + t * (s->diffuse[1] + t * s->diffuse[2]), 0.0f);
        for (int c = 0; c < 3; c++) {
            irradiance[c] += s->lobe_color[i][c] * value;
        }
    }
}

/// Find how much of even surroundings a GGX surface mirrors, f0 · scale + bias, by B. Karis's fit ("Physically based
/// shading on mobile", 2014).
static inline void scene_environment_brdf(rhw_float roughness, rhw_float n_dot_v, rhw_float *scale,
                                          rhw_float *bias)
{
    const rhw_float r0 = 1.0f - roughness;
    const rhw_float r1 = 0.0425f - 0.0275f * roughness;
    const rhw_float r2 = 1.04f - 0.572f * roughness;
    const rhw_float r3 = 0.022f * roughness - 0.04f;
    const rhw_float a = rhw_min(r0 * r0, scene_exp2(-9.28f * n_dot_v)) * r0 + r1;
    *scale = r2 - 1.04f * a;
    *bias = 1.04f * a + r3;
}

/// Return how much of the light that a surface mirrors gets past what occludes the surface. It is more than of the
/// light that the surface scatters where it is seen at a slant (S. Lagarde, C. de Rousiers, "Moving Frostbite to
/// physically based rendering", 2014, with an exponent of 2).
static inline rhw_float scene_specular_occlusion(rhw_float occlusion, rhw_float n_dot_v)
{
    const rhw_float sum = n_dot_v + occlusion;
    return rhw_saturate(sum * sum - 1.0f + occlusion);
}

/// Find the direction that a surface mirrors to the eye.
static inline void scene_reflector_mirror(const struct scene_reflector *r, rhw_float direction[3])
{
    const rhw_float incident[3] = {-r->view[0], -r->view[1], -r->view[2]};
    rhw_reflect3(incident, r->normal, direction);
}

/// Add what the surroundings send to the eye, dimmed by `occlusion`: `mirrored` arrives along the mirror's direction,
/// and `diffuse` from all around. Light that bounces between the facets of a rough surface is given back (Turquin
/// 2019), since rough metals would come out too dark.
static inline void scene_reflect_surroundings(const struct scene_reflector *r, rhw_float roughness,
                                              rhw_float occlusion, const rhw_float mirrored[3],
                                              const rhw_float diffuse[3], rhw_float sum[3])
{
    rhw_float scale, bias;
    scene_environment_brdf(roughness, r->n_dot_v, &scale, &bias);
    const rhw_float lost = 1.0f / (scale + bias) - 1.0f;
    const rhw_float mirrors = scene_specular_occlusion(occlusion, r->n_dot_v);
    for (int c = 0; c < 3; c++) {
        const rhw_float single = r->f0[c] * scale + bias;
        const rhw_float specular = single * (1.0f + r->f0[c] * lost);
        sum[c] += mirrors * mirrored[c] * specular + occlusion * diffuse[c] * r->diffuse[c] * (1.0f - single);
    }
}

/// Find the irradiance of a light at `position`, and the unit direction to the light.
static inline void scene_light_at(const struct scene_shader_light *light, const rhw_float position[3],
                                  rhw_float to_light[3], rhw_float irradiance[3])
{
    if (light->type == SCENE_LIGHT_DIRECTIONAL) {
        for (int c = 0; c < 3; c++) {
            to_light[c] = rhw_splat(light->direction[c]);
            irradiance[c] = rhw_splat(light->color[c]);
        }
        return;
    }
    for (int c = 0; c < 3; c++) {
        to_light[c] = light->position[c] - position[c];
    }
    const rhw_float distance2 = rhw_max(rhw_dot3(to_light, to_light), 1e-12f);
    const rhw_float inverse = rhw_rsqrt(distance2);
    for (int c = 0; c < 3; c++) {
        to_light[c] = to_light[c] * inverse;
    }
    const rhw_float ratio2 = distance2 * (light->inverse_range * light->inverse_range);
    rhw_float falloff = rhw_saturate(1.0f - ratio2 * ratio2) / distance2;
    if (light->type == SCENE_LIGHT_SPOT) {
        const rhw_float cosine = -(to_light[0] * light->direction[0] + to_light[1] * light->direction[1] +
                                   to_light[2] * light->direction[2]);
        const rhw_float cone = rhw_saturate(cosine * light->spot_scale + light->spot_offset);
        falloff = falloff * (cone * cone);
    }
    for (int c = 0; c < 3; c++) {
        irradiance[c] = light->color[c] * falloff;
    }
}

#endif
