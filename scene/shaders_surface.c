// SPDX-License-Identifier: MIT
// The built-in shaders of surfaces, lines and points, compiled once per instruction set. One inlined body
// serves all lit variants; its constant arguments drop what a variant does not need.
#include "shaders_guide.h"
#include "shaders_pbr.h"
#include "shaders_shadow.h"
#include "shaders_tone.h"

#define ALWAYS_INLINE static inline __attribute__((always_inline))

// Vertices ------------------------------------------------------------------------------------------

ALWAYS_INLINE void write_position(const struct scene_surface *s, const rhw_float p[3], rhw_float *varying)
{
    if (s->varying_position < 0) {
        return;
    }
    for (int r = 0; r < 3; r++) {
        const float *row = &s->world[4 * r];
        varying[s->varying_position + r] = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
    }
}

ALWAYS_INLINE void write_normal(const struct scene_surface *s, const struct rhw_vertex *v)
{
    if (s->varying_normal < 0) {
        return;
    }
    const rhw_float *n = v->attribute[s->attribute_normal];
    rhw_float turned[3];
    rhw_mat3_mul_vec3(s->normal, n, turned);
    rhw_normalize3(turned, &v->varying[s->varying_normal]);
}

// A tangent lies in the surface, so it goes with the world matrix itself. Its w is turned where the matrix
// mirrors, because a cross product does not mirror with its arguments.
ALWAYS_INLINE void write_tangent(const struct scene_surface *s, const struct rhw_vertex *v)
{
    if (s->varying_tangent < 0) {
        return;
    }
    const rhw_float *t = v->attribute[s->attribute_tangent];
    rhw_float turned[3];
    for (int r = 0; r < 3; r++) {
        const float *row = &s->world[4 * r];
        turned[r] = row[0] * t[0] + row[1] * t[1] + row[2] * t[2];
    }
    rhw_normalize3(turned, &v->varying[s->varying_tangent]);
    v->varying[s->varying_tangent + 3] = t[3] * s->handedness;
}

ALWAYS_INLINE void write_color(const struct scene_surface *s, const struct rhw_vertex *v)
{
    if (s->varying_color < 0) {
        return;
    }
    for (int c = 0; c < 4; c++) {
        v->varying[s->varying_color + c] = v->attribute[s->attribute_color][c];
    }
}

ALWAYS_INLINE void write_uvs(const struct scene_surface *s, const struct rhw_vertex *v)
{
    for (int i = 0; i < s->stream_count; i++) {
        const struct scene_uv_stream *stream = &s->streams[i];
        const float *t = stream->transform;
        rhw_float uv[2] = {rhw_splat(0.0f), rhw_splat(0.0f)};
        if (stream->attribute >= 0) {
            uv[0] = v->attribute[stream->attribute][0];
            uv[1] = v->attribute[stream->attribute][1];
        }
        v->varying[s->varying_uv + 2 * i] = t[0] * uv[0] + t[1] * uv[1] + t[2];
        v->varying[s->varying_uv + 2 * i + 1] = t[3] * uv[0] + t[4] * uv[1] + t[5];
    }
}

static void surface_vertex(struct rhw_vertex *groups, int count)
{
    const struct scene_surface *s = groups->uniforms;
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        const rhw_float *p = v->attribute[0];
        rhw_mat4_mul_point(s->clip, p, v->position);
        write_position(s, p, v->varying);
        write_normal(s, v);
        write_tangent(s, v);
        write_color(s, v);
        write_uvs(s, v);
    }
}

// Vertices 0 and 1 of a quad stand at one end of a line, 2 and 3 at the other; odd vertices on its left hand side as
// seen from the first end.
static void line_vertex(struct rhw_vertex *groups, int count)
{
    const struct scene_surface *s = groups->uniforms;
    const float *pixel = s->frame->pixel;
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        rhw_float own[4], other[4];
        rhw_mat4_mul_point(s->clip, v->attribute[0], own);
        rhw_mat4_mul_point(s->clip, v->attribute[1], other);
        // The end that is nearer than the near plane moves to it: beyond, the direction on the screen turns
        // over. Depth is reversed, so W − Z is the distance to that plane.
        const rhw_float inside = own[3] - own[2], other_inside = other[3] - other[2];
        const rhw_float zero = rhw_splat(0.0f);
        const rhw_int crosses = rhw_less(inside, zero) & rhw_less(zero, other_inside);
        const rhw_int other_crosses = rhw_less(zero, inside) & rhw_less(other_inside, zero);
        const rhw_float t = inside / (inside - other_inside);
        for (int c = 0; c < 4; c++) {
            const rhw_float cut = own[c] + t * (other[c] - own[c]);
            own[c] = rhw_select(crosses, cut, own[c]);
            other[c] = rhw_select(other_crosses, cut, other[c]);
        }
        const rhw_int second = rhw_equal_int(v->vertex_index & 2, 2);
        const rhw_int left = rhw_equal_int(v->vertex_index & 1, 1);
        rhw_float dx = (other[0] / other[3] - own[0] / own[3]) / pixel[0];
        rhw_float dy = (other[1] / other[3] - own[1] / own[3]) / pixel[1];
        const rhw_float length2 = dx * dx + dy * dy;
        const rhw_int visible = rhw_less(1e-12f, length2) & rhw_less(length2, 1e30f);
        const rhw_float scale = rhw_rsqrt(length2);
        dx = rhw_select(visible, dx * scale, 1.0f);
        dy = rhw_select(visible, dy * scale, 0.0f);
        // From this end: sideways by half the width, and outwards by as much, so that lines that meet
        // leave no notch.
        const rhw_float side = rhw_select(second ^ left, s->half_width, -s->half_width);
        const rhw_float out = rhw_splat(s->half_width);
        v->position[0] = own[0] + (-dy * side - dx * out) * pixel[0] * own[3];
        v->position[1] = own[1] + (dx * side - dy * out) * pixel[1] * own[3];
        v->position[2] = own[2];
        v->position[3] = own[3];
        write_position(s, v->attribute[0], v->varying);
        write_normal(s, v);
        write_color(s, v);
    }
}

static void point_vertex(struct rhw_vertex *groups, int count)
{
    const struct scene_surface *s = groups->uniforms;
    const float *pixel = s->frame->pixel;
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        rhw_float clip[4];
        rhw_mat4_mul_point(s->clip, v->attribute[0], clip);
        const rhw_float x = rhw_float_from_int((v->vertex_index & 1) * 2 - 1);
        const rhw_float y = rhw_float_from_int((v->vertex_index & 2) - 1);
        v->position[0] = clip[0] + x * rhw_max(s->half_width * pixel[0] * clip[3], s->disc[0]);
        v->position[1] = clip[1] + y * rhw_max(s->half_width * pixel[1] * clip[3], s->disc[1]);
        v->position[2] = clip[2];
        v->position[3] = clip[3];
        write_position(s, v->attribute[0], v->varying);
        write_normal(s, v);
        write_color(s, v);
        v->varying[s->varying_disc] = x;
        v->varying[s->varying_disc + 1] = y;
    }
}

// Fragments -----------------------------------------------------------------------------------------

ALWAYS_INLINE void sample_slot(const struct rhw_fragment *f, int at, enum scene_slot slot, rhw_float texel[4])
{
    const rhw_float uv[2] = {f->varying[at], f->varying[at + 1]};
    const rhw_float gradient[4] = {f->ddx[at], f->ddx[at + 1], f->ddy[at], f->ddy[at + 1]};
    rhw_sample_grad(f->textures, (int)slot, uv, gradient, texel);
}

// Texels by slot; those of scene_surface.shared_slots, once they have been sampled, wait for their use.
typedef rhw_float slot_texels[SCENE_SLOT_COUNT][4];

ALWAYS_INLINE void sample_shared(const struct rhw_fragment *groups, int count, const struct scene_surface *s,
                                 slot_texels *texels)
{
    if (s->shared_slots) {
        const int at = s->slot_varying[__builtin_ctz(s->shared_slots)];
        rhw_sample_groups(groups, count, s->shared_slots, at, texels[0], SCENE_SLOT_COUNT);
    }
}

ALWAYS_INLINE const rhw_float *slot_texel(const struct rhw_fragment *f, const struct scene_surface *s,
                                          enum scene_slot slot, slot_texels texels)
{
    if (!(s->shared_slots >> slot & 1)) {
        sample_slot(f, s->slot_varying[slot], slot, texels[slot]);
    }
    return texels[slot];
}

// Base colour with alpha; clears the lanes of `mask` that the alpha test or the disc of a point discards.
ALWAYS_INLINE void base_color(struct rhw_fragment *f, const struct scene_surface *s, bool textured,
                              slot_texels texels, rhw_float color[4])
{
    for (int c = 0; c < 4; c++) {
        color[c] = rhw_splat(s->base_color[c]);
    }
    if (s->varying_color >= 0) {
        for (int c = 0; c < 4; c++) {
            color[c] = color[c] * f->varying[s->varying_color + c];
        }
    }
    if (textured && s->slot_varying[SCENE_SLOT_BASE_COLOR] >= 0) {
        const rhw_float *texel = slot_texel(f, s, SCENE_SLOT_BASE_COLOR, texels);
        for (int c = 0; c < 4; c++) {
            color[c] = color[c] * texel[c];
        }
    }
    if (s->alpha_cutoff > 0.0f) {
        f->mask = f->mask & rhw_less_equal(s->alpha_cutoff, color[3]);
    }
    if (s->varying_disc >= 0) {
        const rhw_float *d = &f->varying[s->varying_disc];
        f->mask = f->mask & rhw_less_equal(rhw_dot2(d, d), 1.0f);
    }
    if (s->alpha_mode != SCENE_ALPHA_BLEND) {
        color[3] = rhw_splat(1.0f);
    }
}

// Unit, towards the eye.
ALWAYS_INLINE void view_direction(const struct scene_frame *frame, const rhw_float position[3],
                                  rhw_float view[3])
{
    if (frame->orthographic) {
        for (int c = 0; c < 3; c++) {
            view[c] = rhw_splat(-frame->forward[c]);
        }
        return;
    }
    for (int c = 0; c < 3; c++) {
        view[c] = frame->eye[c] - position[c];
    }
    rhw_normalize3(view, view);
}

// Unit, of the side that is seen.
ALWAYS_INLINE void surface_normal(const struct rhw_fragment *f, const struct scene_surface *s, bool mapped,
                                  slot_texels texels, rhw_float normal[3])
{
    for (int c = 0; c < 3; c++) {
        normal[c] = f->varying[s->varying_normal + c];
    }
    if (mapped && s->slot_varying[SCENE_SLOT_NORMAL] >= 0) {
        const rhw_float *tangent = &f->varying[s->varying_tangent];
        const rhw_float *texel = slot_texel(f, s, SCENE_SLOT_NORMAL, texels);
        rhw_float bitangent[3];
        rhw_cross(normal, tangent, bitangent);
        const rhw_float x = (texel[0] * 2.0f - 1.0f) * s->normal_scale;
        const rhw_float y = (texel[1] * 2.0f - 1.0f) * s->normal_scale * tangent[3];
        const rhw_float z = texel[2] * 2.0f - 1.0f;
        for (int c = 0; c < 3; c++) {
            normal[c] = x * tangent[c] + y * bitangent[c] + z * normal[c];
        }
    }
    rhw_normalize3(normal, normal);
    rhw_int turn = rhw_splat_int(0);
    if (!s->is_triangle) {
        // A line or point has no back: its normal is turned to the eye.
        rhw_float view[3];
        view_direction(s->frame, &f->varying[s->varying_position], view);
        turn = rhw_less(rhw_dot3(normal, view), 0.0f);
    } else if (s->double_sided) {
        turn = ~f->front_facing;
    }
    for (int c = 0; c < 3; c++) {
        normal[c] = (rhw_float)((rhw_int)normal[c] ^ (turn & INT32_MIN));
    }
}

// Lines of the wireframe: the distance to an edge in pixels is its barycentric weight over the weight's
// gradient, exact on the edge and to first order beside it. Where triangles get as small as the lines, the
// lines fade; else a dense mesh would be one blot.
ALWAYS_INLINE void draw_wire(const struct rhw_fragment *f, const struct scene_surface *s, rhw_float color[4])
{
    const struct scene_frame *frame = s->frame;
    rhw_float distance = rhw_splat(1e30f), height = rhw_splat(1e30f);
    for (int i = 0; i < 3; i++) {
        const rhw_float x = f->barycentric_ddx[i], y = f->barycentric_ddy[i];
        const rhw_float per_weight = rhw_rsqrt(rhw_max(x * x + y * y, 1e-30f));
        distance = rhw_min(f->barycentric[i] * per_weight, distance);
        height = rhw_min(per_weight, height);
    }
    const rhw_float cover = rhw_saturate(frame->line_half_width + 0.5f - distance);
    const rhw_float strength = cover * rhw_saturate(height / (8.0f * frame->line_half_width));
    for (int c = 0; c < 3; c++) {
        color[c] = rhw_mix(color[c], frame->line_color[c], strength);
    }
    color[3] = rhw_mix(color[3], 1.0f, strength);
}

// `color` is light that has been tone-mapped, `linear` has not; both not yet premultiplied.
ALWAYS_INLINE void write_output(struct rhw_fragment *f, const struct scene_surface *s, rhw_float color[4],
                                rhw_float linear[4])
{
    if (s->wireframe) {
        draw_wire(f, s, color);
        draw_wire(f, s, linear);
    }
    for (int c = 0; c < 3; c++) {
        f->color[0][c] = color[c] * color[3];
    }
    f->color[0][3] = color[3];
    if (s->frame->write_linear) {
        for (int c = 0; c < 3; c++) {
            f->color[1][c] = linear[c] * linear[3];
        }
        f->color[1][3] = linear[3];
    }
}

ALWAYS_INLINE rhw_float view_distance(const struct rhw_fragment *f, const struct scene_frame *frame,
                                      const rhw_float position[3])
{
    if (!frame->orthographic) {
        return 1.0f / f->coord[3];
    }
    rhw_float sum = rhw_splat(0.0f);
    for (int c = 0; c < 3; c++) {
        sum += (position[c] - frame->eye[c]) * frame->forward[c];
    }
    return sum;
}

ALWAYS_INLINE rhw_float ambient_open(const struct rhw_fragment *f, const struct scene_frame *frame,
                                     const rhw_float position[3])
{
    const float pixels = 1.0f / frame->samples;
    return scene_guide_open(&frame->guide, f->coord[0] * pixels, f->coord[1] * pixels + frame->first_row,
                            view_distance(f, frame, position));
}

// Dims the light of the lanes that it reaches, those that face it.
ALWAYS_INLINE void shadow_irradiance(const struct rhw_fragment *f, const struct scene_surface *s,
                                     const struct scene_shader_light *light, rhw_int facing,
                                     rhw_float irradiance[3])
{
    const int at = s->varying_position;
    const bool plane = s->is_triangle;
    const rhw_float open = scene_shadow(light, &f->varying[at], plane ? &f->ddx[at] : NULL,
                                        plane ? &f->ddy[at] : NULL, f->mask & facing);
    for (int c = 0; c < 3; c++) {
        irradiance[c] = irradiance[c] * open;
    }
}

// `texels` has those of shared slots.
ALWAYS_INLINE void shade_lit(struct rhw_fragment *f, const struct scene_surface *s, bool textured,
                             bool mapped, slot_texels texels)
{
    rhw_float base[4];
    base_color(f, s, textured, texels, base);
    if (!rhw_any(f->mask)) {
        return;
    }
    const struct scene_frame *frame = s->frame;
    rhw_float metallic = rhw_splat(s->metallic), roughness = rhw_splat(s->roughness);
    rhw_float occlusion = rhw_splat(1.0f);
    rhw_float emissive[3] = {rhw_splat(s->emissive[0]), rhw_splat(s->emissive[1]), rhw_splat(s->emissive[2])};
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
                emissive[c] = emissive[c] * texel[c];
            }
        }
    }
    struct scene_reflector reflector;
    const rhw_float *position = &f->varying[s->varying_position];
    view_direction(frame, position, reflector.view);
    surface_normal(f, s, mapped, texels, reflector.normal);
    scene_reflector_set(&reflector, base, metallic, roughness);
    if (frame->guide.occlusion) {
        occlusion = rhw_min(occlusion, ambient_open(f, frame, position));
    }

    rhw_float sum[3] = {emissive[0], emissive[1], emissive[2]};
    scene_reflect_environment(&reflector, &frame->environment, f->textures, roughness, occlusion, sum);
    for (int i = 0; i < frame->light_count; i++) {
        rhw_float to_light[3], irradiance[3];
        scene_light_at(&frame->lights[i], position, to_light, irradiance);
        if (frame->lights[i].map_count > 0) {
            shadow_irradiance(f, s, &frame->lights[i], rhw_less(0.0f, rhw_dot3(reflector.normal, to_light)),
                              irradiance);
        }
        scene_reflect_light(&reflector, to_light, irradiance, frame->lights[i].size, sum);
    }
    rhw_float linear[4] = {sum[0], sum[1], sum[2], base[3]};
    scene_tone_map(frame->tone, sum);
    rhw_float color[4] = {sum[0], sum[1], sum[2], base[3]};
    write_output(f, s, color, linear);
}

static void lit_fragment(struct rhw_fragment *groups, int count)
{
    const struct scene_surface *s = groups->uniforms;
    for (int g = 0; g < count; g++) {
        slot_texels texels;
        shade_lit(&groups[g], s, false, false, texels);
    }
}

// Texels of several groups first, then their light: both are long chains of operations that wait for each other, and
// the shorter a chain, the sooner the next begins beside it.
ALWAYS_INLINE void shade_textured(struct rhw_fragment *groups, int count, bool mapped)
{
    enum { STEP = 8 };
    const struct scene_surface *s = groups->uniforms;
    for (; count > 0; groups += STEP, count -= STEP) {
        const int n = count < STEP ? count : STEP;
        slot_texels texels[STEP];
        sample_shared(groups, n, s, texels);
        for (int g = 0; g < n; g++) {
            shade_lit(&groups[g], s, true, mapped, texels[g]);
        }
    }
}

static void textured_fragment(struct rhw_fragment *groups, int count)
{
    shade_textured(groups, count, false);
}

static void mapped_fragment(struct rhw_fragment *groups, int count)
{
    shade_textured(groups, count, true);
}

// The base colour as it is: neither light nor tone mapping changes it.
static void unlit_fragment(struct rhw_fragment *groups, int count)
{
    const struct scene_surface *s = groups->uniforms;
    for (int g = 0; g < count; g++) {
        slot_texels texels;
        rhw_float color[4], linear[4];
        base_color(&groups[g], s, true, texels, color);
        if (s->frame->plain) {
            for (int c = 0; c < 3; c++) {
                color[c] = rhw_splat(s->frame->plain_color[c]);
            }
            color[3] = rhw_splat(1.0f);
        }
        for (int c = 0; c < 4; c++) {
            linear[c] = color[c];
        }
        write_output(&groups[g], s, color, linear);
    }
}

// Keeps what casts a shadow.
static void shadow_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        slot_texels texels;
        rhw_float color[4];
        base_color(&groups[g], groups->uniforms, true, texels, color);
    }
}

// Data ----------------------------------------------------------------------------------------------

ALWAYS_INLINE void write_vector(struct rhw_fragment *f, int slot, rhw_float x, rhw_float y, rhw_float z)
{
    if (slot >= 0) {
        f->color[slot][0] = x;
        f->color[slot][1] = y;
        f->color[slot][2] = z;
        f->color[slot][3] = rhw_splat(1.0f);
    }
}

ALWAYS_INLINE void write_distance(struct rhw_fragment *f, const struct scene_surface *s)
{
    const struct scene_frame *frame = s->frame;
    const int depth = frame->output_slot[SCENE_DATA_DEPTH],
              distance = frame->output_slot[SCENE_DATA_DISTANCE];
    if (depth >= 0) {
        f->color[depth][0] = 1.0f - f->coord[2];
    }
    if (distance < 0) {
        return;
    }
    f->color[distance][0] = view_distance(f, frame, &f->varying[s->varying_position]);
}

ALWAYS_INLINE void write_ids(struct rhw_fragment *f, const struct scene_surface *s)
{
    const int object = s->frame->output_slot[SCENE_DATA_OBJECT],
              triangle = s->frame->output_slot[SCENE_DATA_TRIANGLE];
    if (object >= 0) {
        f->color[object][0] = (rhw_float)rhw_splat_int((int32_t)s->object);
    }
    if (triangle >= 0) {
        const rhw_int number = f->primitive >> (int32_t)(s->triangles_per_id - 1);
        f->color[triangle][0] = (rhw_float)(number + (int32_t)s->first_triangle);
    }
}

static void data_fragment(struct rhw_fragment *groups, int count)
{
    const struct scene_surface *s = groups->uniforms;
    const int32_t *slots = s->frame->output_slot;
    const rhw_float zero = rhw_splat(0.0f);
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        slot_texels texels;
        if (s->alpha_cutoff > 0.0f || s->varying_disc >= 0) {
            rhw_float color[4];
            base_color(f, s, true, texels, color);
        }
        write_distance(f, s);
        write_ids(f, s);
        rhw_float normal[3] = {zero, zero, zero};
        if (slots[SCENE_DATA_NORMAL] >= 0 && s->varying_normal >= 0) {
            surface_normal(f, s, s->varying_tangent >= 0, texels, normal);
        }
        write_vector(f, slots[SCENE_DATA_NORMAL], normal[0], normal[1], normal[2]);
        const rhw_float *position = &f->varying[s->varying_position];
        write_vector(f, slots[SCENE_DATA_POSITION], position[0], position[1], position[2]);
        if (slots[SCENE_DATA_UV] >= 0) {
            const int at = s->uv_varying;
            write_vector(f, slots[SCENE_DATA_UV], at < 0 ? zero : f->varying[at],
                         at < 0 ? zero : f->varying[at + 1], zero);
        }
        if (slots[SCENE_DATA_BARYCENTRIC] >= 0) {
            const rhw_float *b = f->barycentric;
            const bool inside = s->is_triangle;
            write_vector(f, slots[SCENE_DATA_BARYCENTRIC], inside ? b[0] : zero, inside ? b[1] : zero,
                         inside ? b[2] : zero);
        }
    }
}

const struct scene_surface_shaders RHW_ISA_NAME(scene_surface_shaders) = {
    .vertex = {[SCENE_VERTEX_SURFACE] = surface_vertex,
               [SCENE_VERTEX_LINE] = line_vertex,
               [SCENE_VERTEX_POINT] = point_vertex},
    .fragment = {[SCENE_FRAGMENT_LIT] = lit_fragment,
                 [SCENE_FRAGMENT_TEXTURED] = textured_fragment,
                 [SCENE_FRAGMENT_MAPPED] = mapped_fragment,
                 [SCENE_FRAGMENT_UNLIT] = unlit_fragment,
                 [SCENE_FRAGMENT_DATA] = data_fragment,
                 [SCENE_FRAGMENT_SHADOW] = shadow_fragment},
};
