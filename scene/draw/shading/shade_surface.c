// SPDX-License-Identifier: MIT
// The built-in shaders of surfaces, lines and points, compiled once per instruction set. One inlined body serves all
// lit variants. Its constant arguments drop what a variant does not need.
#include "fragment.h"
#include "guide_normal.h"
#include "lit_group.h"

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

// Write the support, measured from the eye, so that models far from the origin lose no digits.
ALWAYS_INLINE void write_support(const struct scene_surface *s, rhw_float *varying)
{
    if (s->varying_support < 0) {
        return;
    }
    const rhw_float *p = &varying[s->varying_position], *n = &varying[s->varying_normal];
    rhw_float support = rhw_splat(0.0f);
    for (int c = 0; c < 3; c++) {
        support += (p[c] - s->frame->eye[c]) * n[c];
    }
    varying[s->varying_support] = support;
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
        write_support(s, v->varying);
        write_tangent(s, v);
        write_color(s, v);
        write_uvs(s, v);
    }
}

// Vertices 0 and 1 of a quad stand at one end of a line, 2 and 3 at the other. Odd vertices stand on its left hand side
// as seen from the first end.
static void line_vertex(struct rhw_vertex *groups, int count)
{
    const struct scene_surface *s = groups->uniforms;
    const float *pixel = s->frame->pixel;
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        rhw_float own[4], other[4];
        rhw_mat4_mul_point(s->clip, v->attribute[0], own);
        rhw_mat4_mul_point(s->clip, v->attribute[1], other);
        // An end that is nearer than the near plane moves to the plane, since the direction on the screen turns over
        // beyond it. Depth is reversed, so W − Z is the distance to the plane.
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
        // A vertex moves from its end sideways by half the width, and outwards by as much, so that lines that meet
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

// Write how much of the light that a white ground would have is missing. It fades out with the vertex colour's alpha.
ALWAYS_INLINE void shade_ground(struct rhw_fragment *f, const struct scene_surface *s,
                                const struct scene_environment_lanes *around)
{
    const struct scene_frame *frame = s->frame;
    const rhw_float *position = &f->varying[s->varying_position];
    const rhw_float white[4] = {rhw_splat(1.0f), rhw_splat(1.0f), rhw_splat(1.0f), rhw_splat(1.0f)};
    const rhw_float zero = rhw_splat(0.0f);
    struct scene_reflector reflector;
    slot_texels texels;
    view_direction(frame, position, reflector.view);
    surface_normal(f, s, false, texels, reflector.normal);
    scene_reflector_set(&reflector, white, zero, white[0]);
    rhw_float lit[3] = {zero, zero, zero}, open[3] = {zero, zero, zero};
    const rhw_float occlusion = frame->guide.occlusion ? ambient_open(f, frame, position) : white[0];
    rhw_float direction[3], mirrored[3], diffuse[3];
    scene_reflector_mirror(&reflector, direction);
    scene_environment_reflection(around, f->bindings, direction, reflector.alpha, mirrored);
    scene_environment_diffuse(around, reflector.normal, diffuse);
    scene_reflect_surroundings(&reflector, white[0], occlusion, mirrored, diffuse, lit);
    scene_reflect_surroundings(&reflector, white[0], white[0], mirrored, diffuse, open);
    for (int i = 0; i < frame->light_count; i++) {
        rhw_float to_light[3], irradiance[3];
        scene_light_at(&frame->lights[i], position, to_light, irradiance);
        scene_reflect_light(&reflector, to_light, irradiance, frame->lights[i].size, open);
        if (frame->lights[i].map_count > 0) {
            shadow_irradiance(f, s, &frame->lights[i], rhw_less(0.0f, rhw_dot3(reflector.normal, to_light)),
                              irradiance);
        }
        scene_reflect_light(&reflector, to_light, irradiance, frame->lights[i].size, lit);
    }
    // Where an object covers pixels of the pattern that occlusion is made with, the rest is uneven, and that must not
    // show.
    const rhw_float left = (lit[0] + lit[1] + lit[2]) / rhw_max(open[0] + open[1] + open[2], 1e-20f);
    const rhw_float missing = rhw_saturate((0.97f - left) * (1.0f / 0.97f));
    const rhw_float near = f->varying[s->varying_color + 3];
    rhw_float color[4] = {zero, zero, zero, missing * near * near * (3.0f - 2.0f * near)};
    rhw_float linear[4] = {zero, zero, zero, color[3]};
    write_output(f, s, color, linear);
}

static void ground_fragment(struct rhw_fragment *groups, int count)
{
    const struct scene_surface *s = groups->uniforms;
    struct scene_environment_lanes around;
    scene_environment_lanes_set(&around, &s->frame->environment);
    for (int g = 0; g < count; g++) {
        shade_ground(&groups[g], s, &around);
    }
}

static void lit_fragment(struct rhw_fragment *groups, int count)
{
    shade_lit(groups, count, false, false);
}

static void textured_fragment(struct rhw_fragment *groups, int count)
{
    shade_lit(groups, count, true, false);
}

static void mapped_fragment(struct rhw_fragment *groups, int count)
{
    shade_lit(groups, count, true, true);
}

// Write the base colour as it is. Neither light nor tone mapping changes it.
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

// Keep the fragments that cast a shadow.
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
        if (slots[SCENE_DATA_OVERDRAW] >= 0) {
            f->color[slots[SCENE_DATA_OVERDRAW]][0] = rhw_splat(1.0f); // the target adds it to what it has
        }
        if (slots[SCENE_DATA_BARYCENTRIC] >= 0) {
            const rhw_float *b = f->barycentric;
            const bool inside = s->is_triangle;
            write_vector(f, slots[SCENE_DATA_BARYCENTRIC], inside ? b[0] : zero, inside ? b[1] : zero,
                         inside ? b[2] : zero);
        }
    }
}

// Find the unit normal of the facet on the side that is seen, towards the eye. A line or a point faces the eye.
ALWAYS_INLINE void face_normal(const struct rhw_fragment *f, const struct scene_surface *s,
                               const rhw_float view[3], rhw_float face[3])
{
    if (!s->is_triangle) {
        for (int c = 0; c < 3; c++) {
            face[c] = view[c];
        }
        return;
    }
    rhw_float across[3], down[3];
    for (int c = 0; c < 3; c++) {
        across[c] = f->ddx[s->varying_position + c] * s->frame->unit;
        down[c] = f->ddy[s->varying_position + c] * s->frame->unit;
    }
    rhw_normalize3(across, across);
    rhw_normalize3(down, down);
    rhw_cross(across, down, face);
    rhw_normalize3(face, face);
    const rhw_int turn = rhw_less(rhw_dot3(face, view), 0.0f);
    for (int c = 0; c < 3; c++) {
        face[c] = (rhw_float)((rhw_int)face[c] ^ (turn & INT32_MIN));
    }
}

// Write the distance and both normals for scene_guide. The shading normal is that of the side that is seen, and bent
// towards the eye, since occlusion is of that side.
static void guide_fragment(struct rhw_fragment *groups, int count)
{
    const struct scene_surface *s = groups->uniforms;
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const rhw_float *position = &f->varying[s->varying_position];
        slot_texels texels;
        if (s->alpha_cutoff > 0.0f || s->varying_disc >= 0) {
            rhw_float color[4];
            base_color(f, s, true, texels, color);
        }
        rhw_float view[3], face[3], normal[3];
        view_direction(s->frame, position, view);
        face_normal(f, s, view, face);
        if (s->varying_normal >= 0) {
            surface_normal(f, s, false, texels, normal);
            for (int c = 0; c < 3; c++) {
                normal[c] = s->inside_out ? -normal[c] : normal[c];
            }
            bend_to_view(s, view, normal);
        }
        f->color[0][0] = view_distance(f, s->frame, position);
        scene_normal_fold(s->varying_normal >= 0 ? normal : face, &f->color[1][0]);
        scene_normal_fold(face, &f->color[1][2]);
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
                 [SCENE_FRAGMENT_GROUND] = ground_fragment,
                 [SCENE_FRAGMENT_DATA] = data_fragment,
                 [SCENE_FRAGMENT_GUIDE] = guide_fragment,
                 [SCENE_FRAGMENT_SHADOW] = shadow_fragment},
};
