// SPDX-License-Identifier: MIT
// What glTF's extensions lay over and under a surface, on 8 lanes: clearcoat, sheen, anisotropy, a thin film, and light
// that passes through. The formulas are those of the extensions' specifications, and have their names.
#ifndef SCENE_SHADE_LAYERS_H
#define SCENE_SHADE_LAYERS_H

#include "pbr.h"

/// What one fragment reflects. Vectors are unit. Vectors to light and eye point away from the surface.
struct scene_layered {
    rhw_float view[3], normal[3], n_dot_v;
    rhw_float roughness, alpha;
    rhw_float diffuse[3], f0[3], f90;
    bool anisotropic;
    rhw_float tangent[3], bitangent[3], alpha_t, anisotropy;
    bool has_sheen;
    rhw_float sheen_color[3], sheen_roughness,
        under_sheen; // `under_sheen` is the part of the layers below that passes the sheen
    bool has_coat;
    rhw_float coat_normal[3], coat_n_dot_v, coat, coat_roughness, under_coat;
    rhw_float transmission;
};

// Distributions -------------------------------------------------------------------------------------

/// Return GGX of two widths with the shadowing that goes with it: D · V (KHR_materials_anisotropy).
static inline rhw_float scene_anisotropic_ggx(const struct scene_layered *m, const rhw_float light[3],
                                              const rhw_float half[3], rhw_float n_dot_l, rhw_float n_dot_h)
{
    const rhw_float at = m->alpha_t, ab = m->alpha;
    const rhw_float th = rhw_dot3(m->tangent, half) / at, bh = rhw_dot3(m->bitangent, half) / ab;
    const rhw_float f = th * th + bh * bh + n_dot_h * n_dot_h;
    const rhw_float tl = at * rhw_dot3(m->tangent, light), bl = ab * rhw_dot3(m->bitangent, light);
    const rhw_float tv = at * rhw_dot3(m->tangent, m->view), bv = ab * rhw_dot3(m->bitangent, m->view);
    const rhw_float to_view = n_dot_l * rhw_sqrt(tv * tv + bv * bv + m->n_dot_v * m->n_dot_v);
    const rhw_float to_light = m->n_dot_v * rhw_sqrt(tl * tl + bl * bl + n_dot_l * n_dot_l);
    return 0.5f * scene_inverse_pi / (at * ab * f * f * rhw_max(to_view + to_light, 1e-6f));
}

/// Return GGX with Smith's shadowing, D · V, as scene_reflect_light has them.
static inline rhw_float scene_ggx(rhw_float alpha, rhw_float n_dot_l, rhw_float n_dot_v, rhw_float n_dot_h)
{
    const rhw_float alpha2 = alpha * alpha;
    const rhw_float base = 1.0f - n_dot_h * n_dot_h * (1.0f - alpha2);
    return alpha2 * scene_inverse_pi /
           (base * base * scene_smith(n_dot_l, alpha2) * scene_smith(n_dot_v, alpha2));
}

/// Return the sheen of upright fibres, D · V (A. Estevez, C. Kulla 2017; D. Neubelt, M. Pettineo 2013;
/// KHR_materials_sheen).
static inline rhw_float scene_sheen(rhw_float roughness, rhw_float n_dot_l, rhw_float n_dot_v,
                                    rhw_float n_dot_h)
{
    const rhw_float inverse = 1.0f / (roughness * roughness);
    const rhw_float sine2 = rhw_max(1.0f - n_dot_h * n_dot_h, 1e-6f);
    const rhw_float d =
        (2.0f + inverse) * rhw_exp2(0.5f * inverse * rhw_log2(sine2)) * (0.5f * scene_inverse_pi);
    return d / (4.0f * rhw_max(n_dot_l + n_dot_v - n_dot_l * n_dot_v, 1e-4f));
}

/// Return the part of even light that white sheen reflects, at most 1. It was integrated numerically for roughnesses
/// from 0.07 to 1 and square roots of n·v from 0 to 1.
static inline rhw_float scene_sheen_albedo(rhw_float roughness, rhw_float n_dot_v)
{
    enum { SIDE = 9 };
    static const float table[SIDE][SIDE] = {
        {1.0000f, 1.0000f, 1.0000f, 0.3299f, 0.0320f, 0.0007f, 0.0000f, 0.0000f, 0.0000f},
        {1.0000f, 1.0000f, 1.0000f, 0.6971f, 0.3262f, 0.1145f, 0.0253f, 0.0022f, 0.0000f},
        {1.0000f, 1.0000f, 0.9484f, 0.6656f, 0.4203f, 0.2302f, 0.1012f, 0.0291f, 0.0015f},
        {1.0000f, 0.9652f, 0.7897f, 0.6062f, 0.4348f, 0.2852f, 0.1634f, 0.0727f, 0.0143f},
        {0.8859f, 0.8175f, 0.6916f, 0.5578f, 0.4287f, 0.3097f, 0.2039f, 0.1133f, 0.0398f},
        {0.7806f, 0.7267f, 0.6276f, 0.5220f, 0.4186f, 0.3207f, 0.2296f, 0.1457f, 0.0695f},
        {0.7123f, 0.6670f, 0.5840f, 0.4956f, 0.4089f, 0.3257f, 0.2464f, 0.1706f, 0.0975f},
        {0.6657f, 0.6258f, 0.5532f, 0.4762f, 0.4006f, 0.3279f, 0.2578f, 0.1895f, 0.1215f},
        {0.6325f, 0.5963f, 0.5307f, 0.4615f, 0.3939f, 0.3288f, 0.2659f, 0.2040f, 0.1414f},
    };
    const rhw_float x = rhw_min(rhw_sqrt(n_dot_v), 0.9999f) * (SIDE - 1);
    const rhw_float y = rhw_clamp((roughness - 0.07f) * (1.0f / 0.93f), 0.0f, 0.9999f) * (SIDE - 1);
    const rhw_float left = rhw_floor(x), top = rhw_floor(y);
    const rhw_int at = rhw_int_from_float_unchecked(top) * SIDE + rhw_int_from_float_unchecked(left);
    rhw_float corner[4];
    for (int i = 0; i < 4; i++) {
        corner[i] = rhw_gather(table[0], SIDE * SIDE, at + (i & 1) + (i >> 1) * SIDE);
    }
    return rhw_mix(rhw_mix(corner[0], corner[1], x - left), rhw_mix(corner[2], corner[3], x - left), y - top);
}

static inline rhw_float scene_schlick(rhw_float f0, rhw_float f90, rhw_float cosine)
{
    return f0 + (f90 - f0) * scene_pow5(1.0f - cosine);
}

// Thin films ----------------------------------------------------------------------------------------

/// Find what a path difference of `opd` nanometres makes of white light, in XYZ by Gaussians, which become linear sRGB
/// (KHR_materials_iridescence, after L. Belcour, P. Barla 2017).
static inline void scene_film_sensitivity(rhw_float opd, const rhw_float shift[3], rhw_float color[3])
{
    static const float value[4] = {5.4856e-13f, 4.4201e-13f, 5.2481e-13f, 9.7470e-14f};
    static const float place[4] = {1.6810e+06f, 1.7953e+06f, 2.2084e+06f, 2.2399e+06f};
    static const float spread[4] = {4.3278e+09f, 9.3046e+09f, 6.6121e+09f, 4.5282e+09f};
    const float turn = 6.28318530718f;
    const rhw_float phase = turn * 1e-9f * opd;
    rhw_float xyz[3];
    for (int i = 0; i < 4; i++) {
        const float height = value[i] * __builtin_sqrtf(turn * spread[i]) / 1.0685e-7f;
        const rhw_float part =
            height * rhw_cos(place[i] * phase + shift[i % 3]) * rhw_exp(-(phase * phase) * spread[i]);
        xyz[i % 3] = i < 3 ? part : xyz[i % 3] + part;
    }
    color[0] = 3.2404542f * xyz[0] - 1.5371385f * xyz[1] - 0.4985314f * xyz[2];
    color[1] = -0.9692660f * xyz[0] + 1.8760108f * xyz[1] + 0.0415560f * xyz[2];
    color[2] = 0.0556434f * xyz[0] - 0.2040259f * xyz[1] + 1.0572252f * xyz[2];
}

/// Find Fresnel's term of a film of `thickness` nanometres on a surface that reflects f0 head on, seen from air.
static inline void scene_film_fresnel(float film_ior, rhw_float thickness, rhw_float cosine,
                                      const rhw_float f0[3], rhw_float fresnel[3])
{
    const rhw_float faded = rhw_smoothstep(rhw_splat(0.0f), rhw_splat(0.03f), thickness);
    const rhw_float ior = 1.0f + (film_ior - 1.0f) * faded;
    const rhw_float inside2 = rhw_max(1.0f - (1.0f - cosine * cosine) / (ior * ior), 0.0f);
    const rhw_float inside = rhw_sqrt(inside2), outer = (ior - 1.0f) / (ior + 1.0f);
    const rhw_float r12 = scene_schlick(outer * outer, rhw_splat(1.0f), cosine), t121 = 1.0f - r12;
    const float half_turn = 3.14159265359f;
    rhw_float shift[3], rs[3], r123[3], sensitivity[3];
    for (int c = 0; c < 3; c++) {
        const rhw_float root = rhw_sqrt(rhw_clamp(f0[c] + 0.0001f, 0.0f, 0.9999f));
        const rhw_float base = (1.0f + root) / (1.0f - root), r1 = (base - ior) / (base + ior);
        const rhw_float r23 = scene_schlick(r1 * r1, rhw_splat(1.0f), inside);
        shift[c] = half_turn + rhw_select(rhw_less(base, ior), half_turn, 0.0f);
        const rhw_float both = rhw_clamp(r12 * r23, 1e-5f, 0.9999f);
        r123[c] = rhw_sqrt(both);
        rs[c] = t121 * t121 * r23 / (1.0f - both);
        fresnel[c] = r12 + rs[c];
        rs[c] = rs[c] - t121;
    }
    const rhw_float opd = 2.0f * ior * thickness * inside;
    for (int m = 1; m <= 2; m++) {
        const rhw_float turned[3] = {shift[0] * (float)m, shift[1] * (float)m, shift[2] * (float)m};
        scene_film_sensitivity(opd * (float)m, turned, sensitivity);
        for (int c = 0; c < 3; c++) {
            rs[c] = rs[c] * r123[c];
            fresnel[c] += rs[c] * 2.0f * sensitivity[c];
        }
    }
    for (int c = 0; c < 3; c++) {
        fresnel[c] = rhw_saturate(fresnel[c]);
    }
}

/// Return the f0 with which Schlick's term gives `fresnel` at that cosine.
static inline rhw_float scene_schlick_to_f0(rhw_float fresnel, rhw_float cosine)
{
    const rhw_float x5 = rhw_min(scene_pow5(1.0f - cosine), 0.9999f);
    return rhw_saturate((fresnel - x5) / (1.0f - x5));
}

// Light ---------------------------------------------------------------------------------------------

/// Add the light of a lamp, as scene_reflect_light does.
static inline void scene_layers_light(const struct scene_layered *m, const rhw_float to_light[3],
                                      const rhw_float irradiance[3], float size, rhw_float sum[3])
{
    const rhw_float n_dot_l = rhw_saturate(rhw_dot3(m->normal, to_light));
    rhw_float half[3];
    for (int c = 0; c < 3; c++) {
        half[c] = to_light[c] + m->view[c];
    }
    rhw_normalize3(half, half);
    const rhw_float n_dot_h = rhw_saturate(rhw_dot3(m->normal, half)),
                    h_dot_v = rhw_saturate(rhw_dot3(half, m->view));
    const rhw_float specular = m->anisotropic
                                   ? scene_anisotropic_ggx(m, to_light, half, n_dot_l, n_dot_h)
                                   : scene_ggx(rhw_min(m->alpha + size, 1.0f), n_dot_l, m->n_dot_v, n_dot_h);
    const rhw_float sheen =
        m->has_sheen ? scene_sheen(m->sheen_roughness, n_dot_l, m->n_dot_v, n_dot_h) : rhw_splat(0.0f);
    const rhw_float under = m->under_coat * n_dot_l;
    for (int c = 0; c < 3; c++) {
        const rhw_float f = scene_schlick(m->f0[c], m->f90, h_dot_v);
        const rhw_float body =
            (1.0f - f) * (1.0f - m->transmission) * m->diffuse[c] * scene_inverse_pi + f * specular;
        const rhw_float fibres = m->has_sheen ? m->sheen_color[c] * sheen : rhw_splat(0.0f);
        sum[c] += irradiance[c] * under * (body * m->under_sheen + fibres);
    }
    if (m->has_coat) {
        const rhw_float coat_n_dot_l = rhw_saturate(rhw_dot3(m->coat_normal, to_light));
        const rhw_float coat_n_dot_h = rhw_saturate(rhw_dot3(m->coat_normal, half));
        const rhw_float alpha = rhw_min(m->coat_roughness * m->coat_roughness + size, 1.0f);
        const rhw_float f = scene_schlick(rhw_splat(0.04f), rhw_splat(1.0f), h_dot_v);
        const rhw_float shine =
            m->coat * f * coat_n_dot_l * scene_ggx(alpha, coat_n_dot_l, m->coat_n_dot_v, coat_n_dot_h);
        for (int c = 0; c < 3; c++) {
            sum[c] += irradiance[c] * shine;
        }
    }
}

/// Find the direction that a surface mirrors to the eye. A brushed surface mirrors a line across its strokes. The
/// mirror of a normal bent towards the eye stands for that line (KHR_materials_anisotropy).
static inline void scene_layers_mirror(const struct scene_layered *m, rhw_float direction[3])
{
    rhw_float bent[3], incident[3] = {-m->view[0], -m->view[1], -m->view[2]};
    for (int c = 0; c < 3; c++) {
        bent[c] = m->normal[c];
    }
    if (m->anisotropic) {
        rhw_float across[3], upright[3];
        rhw_cross(m->bitangent, m->view, across);
        rhw_cross(across, m->bitangent, upright);
        rhw_normalize3(upright, upright);
        const rhw_float rest = 1.0f - m->anisotropy * (1.0f - m->roughness), rest2 = rest * rest;
        for (int c = 0; c < 3; c++) {
            bent[c] = rhw_mix(upright[c], m->normal[c], rest2 * rest2);
        }
        rhw_normalize3(bent, bent);
    }
    rhw_reflect3(incident, bent, direction);
}

/// Add the surroundings, as scene_reflect_surroundings does, and `behind`, the light that comes through from behind.
static inline void scene_layers_environment(const struct scene_layered *m,
                                            const struct scene_environment_lanes *s,
                                            const struct rhw_bindings *bindings, rhw_float occlusion,
                                            const rhw_float behind[3], rhw_float sum[3])
{
    rhw_float mirrored[3], diffuse[3], direction[3], scale, bias;
    scene_layers_mirror(m, direction);
    scene_environment_reflection(s, bindings, direction, m->alpha, mirrored);
    scene_environment_diffuse(s, m->normal, diffuse);
    scene_environment_brdf(m->roughness, m->n_dot_v, &scale, &bias);
    const rhw_float lost = 1.0f / (scale + bias) - 1.0f;
    const rhw_float mirrors = scene_specular_occlusion(occlusion, m->n_dot_v);
    const rhw_float fibres =
        m->has_sheen ? scene_sheen_albedo(m->sheen_roughness, m->n_dot_v) * occlusion : rhw_splat(0.0f);
    for (int c = 0; c < 3; c++) {
        const rhw_float single = m->f0[c] * scale + m->f90 * bias;
        const rhw_float specular = single * (1.0f + m->f0[c] * lost);
        const rhw_float body = rhw_mix(occlusion * diffuse[c] * m->diffuse[c], behind[c], m->transmission);
        const rhw_float below = mirrors * mirrored[c] * specular + body * (1.0f - rhw_min(single, 1.0f));
        const rhw_float sheen = m->has_sheen ? diffuse[c] * m->sheen_color[c] * fibres : rhw_splat(0.0f);
        sum[c] += m->under_coat * (below * m->under_sheen + sheen);
    }
    if (m->has_coat) {
        const rhw_float incident[3] = {-m->view[0], -m->view[1], -m->view[2]};
        rhw_reflect3(incident, m->coat_normal, direction);
        scene_environment_reflection(s, bindings, direction, m->coat_roughness * m->coat_roughness, mirrored);
        scene_environment_brdf(m->coat_roughness, m->coat_n_dot_v, &scale, &bias);
        const rhw_float shine =
            m->coat * (0.04f * scale + bias) * scene_specular_occlusion(occlusion, m->coat_n_dot_v);
        for (int c = 0; c < 3; c++) {
            sum[c] += mirrored[c] * shine;
        }
    }
}

#endif
