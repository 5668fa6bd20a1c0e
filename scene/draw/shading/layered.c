// SPDX-License-Identifier: MIT
// The fragment function of materials with layers. It multiplies every factor by its texture and sums the light that
// comes from above through each layer.
#include "fragment.h"
#include "shade_layers.h"

// Read the texel of a layer's slot. Return false if there is no texture.
ALWAYS_INLINE bool layer_texel(const struct rhw_fragment *f, const struct scene_surface *s,
                               enum scene_slot slot, rhw_float texel[4])
{
    const int at = s->slot_varying[slot];
    if (at < 0) {
        return false;
    }
    const rhw_float uv[2] = {f->varying[at], f->varying[at + 1]};
    const rhw_float gradient[4] = {f->ddx[at], f->ddx[at + 1], f->ddy[at], f->ddy[at + 1]};
    rhw_sample_grad(f->bindings, s->slot_unit[slot], uv, gradient, texel);
    return true;
}

// Return a factor times one channel of its texture.
ALWAYS_INLINE rhw_float layer_factor(const struct rhw_fragment *f, const struct scene_surface *s,
                                     float factor, enum scene_slot slot, int channel)
{
    rhw_float texel[4];
    return layer_texel(f, s, slot, texel) ? factor * texel[channel] : rhw_splat(factor);
}

ALWAYS_INLINE void layer_color(const struct rhw_fragment *f, const struct scene_surface *s,
                               const float factor[3], enum scene_slot slot, rhw_float color[3])
{
    rhw_float texel[4];
    const bool textured = layer_texel(f, s, slot, texel);
    for (int c = 0; c < 3; c++) {
        color[c] = textured ? factor[c] * texel[c] : rhw_splat(factor[c]);
    }
}

// Set diffuse colour, reflectance and roughness.
static void set_body(struct scene_layered *m, const struct rhw_fragment *f, const struct scene_surface *s,
                     const rhw_float base[4])
{
    const struct scene_layers *l = s->layers;
    rhw_float roughness, texel[4];
    if (l->glossy) {
        const bool textured = layer_texel(f, s, SCENE_SLOT_GLOSS, texel);
        rhw_float strongest = rhw_splat(0.0f);
        for (int c = 0; c < 3; c++) {
            m->f0[c] = textured ? l->gloss_specular[c] * texel[c] : rhw_splat(l->gloss_specular[c]);
            strongest = rhw_max(strongest, m->f0[c]);
        }
        for (int c = 0; c < 3; c++) {
            m->diffuse[c] = base[c] * (1.0f - strongest);
        }
        m->f90 = rhw_splat(1.0f);
        roughness = 1.0f - (textured ? l->glossiness * texel[3] : rhw_splat(l->glossiness));
    } else {
        rhw_float metallic = rhw_splat(s->metallic), specular_color[3];
        roughness = rhw_splat(s->roughness);
        if (layer_texel(f, s, SCENE_SLOT_METALLIC_ROUGHNESS, texel)) {
            roughness = roughness * texel[1];
            metallic = metallic * texel[2];
        }
        const rhw_float specular = layer_factor(f, s, l->specular, SCENE_SLOT_SPECULAR, 3);
        const float step = (l->ior - 1.0f) / (l->ior + 1.0f);
        layer_color(f, s, l->specular_color, SCENE_SLOT_SPECULAR_COLOR, specular_color);
        for (int c = 0; c < 3; c++) {
            const rhw_float dielectric = rhw_min(step * step * specular_color[c], 1.0f) * specular;
            m->f0[c] = rhw_mix(dielectric, base[c], metallic);
            m->diffuse[c] = base[c] * (1.0f - metallic);
        }
        m->f90 = rhw_mix(specular, 1.0f, metallic);
        m->transmission = layer_factor(f, s, l->transmission, SCENE_SLOT_TRANSMISSION, 0) * (1.0f - metallic);
    }
    m->roughness = rhw_clamp(roughness, 0.045f, 1.0f);
    m->alpha = m->roughness * m->roughness;
}

static void set_iridescence(struct scene_layered *m, const struct rhw_fragment *f,
                            const struct scene_surface *s)
{
    const struct scene_layers *l = s->layers;
    const rhw_float factor = layer_factor(f, s, l->iridescence, SCENE_SLOT_IRIDESCENCE, 0);
    rhw_float texel[4], thickness = rhw_splat(l->iridescence_thickness[1]), fresnel[3];
    if (layer_texel(f, s, SCENE_SLOT_IRIDESCENCE_THICKNESS, texel)) {
        thickness = rhw_mix(l->iridescence_thickness[0], l->iridescence_thickness[1], texel[1]);
    }
    scene_film_fresnel(l->iridescence_ior, thickness, m->n_dot_v, m->f0, fresnel);
    for (int c = 0; c < 3; c++) {
        m->f0[c] = rhw_mix(m->f0[c], scene_schlick_to_f0(fresnel[c], m->n_dot_v), factor);
    }
}

static void set_anisotropy(struct scene_layered *m, const struct rhw_fragment *f,
                           const struct scene_surface *s)
{
    const struct scene_layers *l = s->layers;
    rhw_float texel[4], x = rhw_splat(1.0f), y = rhw_splat(0.0f);
    m->anisotropy = rhw_splat(l->anisotropy);
    if (layer_texel(f, s, SCENE_SLOT_ANISOTROPY, texel)) {
        x = texel[0] * 2.0f - 1.0f;
        y = texel[1] * 2.0f - 1.0f;
        m->anisotropy = m->anisotropy * texel[2];
    }
    const float *turn = l->anisotropy_direction;
    const rhw_float *tangent = &f->varying[s->varying_tangent];
    const rhw_float along = x * turn[0] - y * turn[1], across = (x * turn[1] + y * turn[0]) * tangent[3];
    rhw_float side[3];
    rhw_cross(m->normal, tangent, side);
    for (int c = 0; c < 3; c++) {
        m->tangent[c] = tangent[c] * along + side[c] * across;
    }
    // The tangent is turned into the plane of the shaded normal.
    rhw_cross(m->normal, m->tangent, m->bitangent);
    rhw_normalize3(m->bitangent, m->bitangent);
    rhw_cross(m->bitangent, m->normal, m->tangent);
    m->alpha_t = rhw_mix(m->alpha, 1.0f, m->anisotropy * m->anisotropy);
}

static void set_sheen(struct scene_layered *m, const struct rhw_fragment *f, const struct scene_surface *s)
{
    const struct scene_layers *l = s->layers;
    layer_color(f, s, l->sheen_color, SCENE_SLOT_SHEEN_COLOR, m->sheen_color);
    const rhw_float roughness = layer_factor(f, s, l->sheen_roughness, SCENE_SLOT_SHEEN_ROUGHNESS, 3);
    m->sheen_roughness = rhw_max(roughness, 0.07f);
    const rhw_float strongest = rhw_max(m->sheen_color[0], rhw_max(m->sheen_color[1], m->sheen_color[2]));
    m->under_sheen = 1.0f - strongest * scene_sheen_albedo(m->sheen_roughness, m->n_dot_v);
}

static void set_coat(struct scene_layered *m, const struct rhw_fragment *f, const struct scene_surface *s)
{
    const struct scene_layers *l = s->layers;
    rhw_float texel[4];
    const bool mapped = s->varying_tangent >= 0 && layer_texel(f, s, SCENE_SLOT_CLEARCOAT_NORMAL, texel);
    m->coat = layer_factor(f, s, l->clearcoat, SCENE_SLOT_CLEARCOAT, 0);
    m->coat_roughness = rhw_clamp(
        layer_factor(f, s, l->clearcoat_roughness, SCENE_SLOT_CLEARCOAT_ROUGHNESS, 1), 0.045f, 1.0f);
    map_normal(f, s, mapped ? texel : NULL, l->clearcoat_normal_scale, m->coat_normal);
    face_seen_side(f, s, m->coat_normal);
    bend_to_view(s, m->view, m->coat_normal);
    m->coat_n_dot_v = rhw_clamp(rhw_dot3(m->coat_normal, m->view), 1.0f / 1024.0f, 1.0f);
    m->under_coat = 1.0f - m->coat * scene_schlick(rhw_splat(0.04f), rhw_splat(1.0f), m->coat_n_dot_v);
}

// Find the light from behind along the ray that enters with index of refraction `ior`, from where it leaves the volume.
// The surroundings fill what the picture behind does not cover.
static void look_through(const struct rhw_fragment *f, const struct scene_surface *s,
                         const struct scene_environment_lanes *surroundings, const struct scene_layered *m,
                         float ior, rhw_float thickness, rhw_float light[4])
{
    const struct scene_frame *frame = s->frame;
    const float eta = 1.0f / ior;
    const rhw_float inside = rhw_sqrt(rhw_max(1.0f - eta * eta * (1.0f - m->n_dot_v * m->n_dot_v), 0.0f));
    rhw_float direction[3], exit[3], clip[4], around[3];
    for (int c = 0; c < 3; c++) {
        const rhw_float bent = (eta * m->n_dot_v - inside) * m->normal[c] - eta * m->view[c];
        direction[c] = rhw_select(rhw_less(0.0f, thickness), bent, -m->view[c]);
        exit[c] = f->varying[s->varying_position + c] + direction[c] * thickness;
    }
    rhw_mat4_mul_point(frame->view_projection, exit, clip);
    const rhw_float inverse = 1.0f / rhw_max(clip[3], 1e-6f);
    const rhw_float uv[2] = {0.5f + 0.5f * clip[0] * inverse, 0.5f - 0.5f * clip[1] * inverse};
    // A smooth surface of a low index blurs less than its roughness says.
    const float blur = ior > 1.5f ? 1.0f : 2.0f * ior - 2.0f;
    const rhw_float rough = rhw_max(m->roughness - 0.045f, 0.0f) * blur;
    rhw_sample_lod(f->bindings, SCENE_SLOT_BACKDROP, uv, rough * frame->backdrop_levels, light);
    if (rhw_any(f->mask & rhw_less(light[3], 1.0f))) { // where the picture covers all, this adds nothing
        scene_environment_reflection(surroundings, f->bindings, direction, rough * rough, around);
        for (int c = 0; c < 3; c++) {
            light[c] += (1.0f - light[3]) * around[c];
        }
    }
}

static void find_behind(const struct rhw_fragment *f, const struct scene_surface *s,
                        const struct scene_environment_lanes *surroundings, const struct scene_layered *m,
                        rhw_float behind[3])
{
    const struct scene_layers *l = s->layers;
    const rhw_float thickness = layer_factor(f, s, s->thickness, SCENE_SLOT_THICKNESS, 1);
    const float spread = (l->ior - 1.0f) * 0.025f * l->dispersion;
    rhw_float light[4];
    for (int c = 0; c < 3; c++) {
        // Red is bent least, and no light more than in a vacuum.
        if (c == 0 || spread > 0.0f) {
            const float index = l->ior + spread * (float)(c - 1);
            look_through(f, s, surroundings, m, index > 1.0f ? index : 1.0f, thickness, light);
        }
        behind[c] = light[c] * m->diffuse[c] * rhw_exp2(s->attenuation[c] * thickness);
    }
}

ALWAYS_INLINE void shade(struct rhw_fragment *f, const struct scene_surface *s,
                         const struct scene_environment_lanes *surroundings)
{
    slot_texels texels;
    rhw_float base[4], texel[4];
    base_color(f, s, true, texels, base);
    if (!rhw_any(f->mask)) {
        return;
    }
    const struct scene_frame *frame = s->frame;
    const struct scene_layers *l = s->layers;
    const rhw_float *position = &f->varying[s->varying_position], one = rhw_splat(1.0f),
                    zero = rhw_splat(0.0f);
    const bool mapped = s->varying_tangent >= 0;
    struct scene_layered m; // no layer reads what no layer sets
    m.under_sheen = m.under_coat = one;
    m.transmission = zero;
    m.anisotropic = l->anisotropy > 0.0f && mapped;
    m.has_sheen = l->sheen_color[0] > 0.0f || l->sheen_color[1] > 0.0f || l->sheen_color[2] > 0.0f;
    m.has_coat = l->clearcoat > 0.0f;
    view_direction(frame, position, m.view);
    seen_normal(f, s, mapped, texels, m.view, m.normal);
    m.n_dot_v = rhw_clamp(rhw_dot3(m.normal, m.view), 1.0f / 1024.0f, 1.0f);
    set_body(&m, f, s, base);
    if (l->iridescence > 0.0f) {
        set_iridescence(&m, f, s);
    }
    if (m.anisotropic) {
        set_anisotropy(&m, f, s);
    }
    if (m.has_sheen) {
        set_sheen(&m, f, s);
    }
    if (m.has_coat) {
        set_coat(&m, f, s);
    }
    rhw_float occlusion = one, behind[3] = {zero, zero, zero}, sum[3];
    if (layer_texel(f, s, SCENE_SLOT_OCCLUSION, texel)) {
        occlusion = 1.0f + s->occlusion_strength * (texel[0] - 1.0f);
    }
    if (frame->guide.occlusion) {
        occlusion = rhw_min(occlusion, ambient_open(f, frame, position));
    }
    if (l->transmission > 0.0f) {
        find_behind(f, s, surroundings, &m, behind);
    }
    const bool glows = layer_texel(f, s, SCENE_SLOT_EMISSIVE, texel);
    for (int c = 0; c < 3; c++) { // the light comes from beneath the coat
        sum[c] = m.under_coat * (glows ? s->emissive[c] * texel[c] : rhw_splat(s->emissive[c]));
    }
    scene_layers_environment(&m, surroundings, f->bindings, occlusion, behind, sum);
    for (int i = 0; i < frame->light_count; i++) {
        const struct scene_shader_light *light = &frame->lights[i];
        rhw_float to_light[3], irradiance[3];
        scene_light_at(light, position, to_light, irradiance);
        if (light->map_count > 0) {
            shadow_irradiance(f, s, light, rhw_less(0.0f, rhw_dot3(m.normal, to_light)), irradiance);
        }
        scene_layers_light(&m, to_light, irradiance, light->size, sum);
    }
    write_light(f, s, sum, base[3]);
}

static void layered_fragment(struct rhw_fragment *groups, int count)
{
    const struct scene_surface *s = groups->uniforms;
    struct scene_environment_lanes surroundings;
    scene_environment_lanes_set(&surroundings, &s->frame->environment);
    for (int g = 0; g < count; g++) {
        shade(&groups[g], s, &surroundings);
    }
}

const struct scene_layered_shaders RHW_ISA_NAME(scene_layered_shaders) = {.fragment = layered_fragment};
