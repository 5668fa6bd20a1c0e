// SPDX-License-Identifier: MIT
// What the fragment functions of surfaces share: base colour, normal, what light needs, outputs. The functions are
// inlined, so that the constant arguments of a variant drop what it does not need.
#ifndef SCENE_SHADERS_FRAGMENT_H
#define SCENE_SHADERS_FRAGMENT_H

#include "shade_guide.h"
#include "pbr.h"
#include "shade_shadow.h"
#include "tone.h"

#define ALWAYS_INLINE static inline __attribute__((always_inline))

ALWAYS_INLINE void sample_slot(const struct rhw_fragment *f, int at, enum scene_slot slot, rhw_float texel[4])
{
    const rhw_float uv[2] = {f->varying[at], f->varying[at + 1]};
    const rhw_float gradient[4] = {f->ddx[at], f->ddx[at + 1], f->ddy[at], f->ddy[at + 1]};
    rhw_sample_grad(f->bindings, (int)slot, uv, gradient, texel);
}

// Texels by slot. Texels of scene_surface.shared_slots, once they have been sampled, wait here for their use.
typedef rhw_float slot_texels[SCENE_BASE_SLOTS][4];

ALWAYS_INLINE void sample_shared(const struct rhw_fragment *groups, int count, const struct scene_surface *s,
                                 slot_texels *texels)
{
    if (s->shared_slots) {
        const int at = s->slot_varying[__builtin_ctz(s->shared_slots)];
        rhw_sample_groups(groups, count, s->shared_slots, at, texels[0], SCENE_BASE_SLOTS);
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

// Read a texel of a texture that has the pass's pixels and samples.
ALWAYS_INLINE void fetch_here(const struct rhw_fragment *f, int slot, int samples, rhw_float texel[4])
{
    const rhw_int at[2] = {rhw_int_from_float_unchecked(f->coord[0]),
                           rhw_int_from_float_unchecked(f->coord[1])};
    if (samples > 1) {
        rhw_sample_fetch_sample(f->bindings, slot, at, &f->sample_id, texel);
    } else {
        rhw_sample_fetch(f->bindings, slot, at, NULL, texel);
    }
}

// Find the base colour with alpha. Clear the lanes of `mask` that the alpha test, the disc of a point or a layer that
// is peeled discards.
ALWAYS_INLINE void base_color(struct rhw_fragment *f, const struct scene_surface *s, bool textured,
                              slot_texels texels, rhw_float color[4])
{
    if (s->frame->peel_samples > 0) {
        rhw_float behind[4];
        fetch_here(f, s->peel_unit, s->frame->peel_samples, behind);
        const rhw_int nearer = rhw_less(behind[0], f->coord[2]);
        const rhw_int farther = rhw_less(f->coord[2], behind[0]) | rhw_equal(behind[0], 0.0f);
        f->mask = f->mask & (s->frame->peel_behind ? farther : nearer);
    }
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

// Find the unit direction towards the eye.
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
        view[c] = (frame->eye[c] - position[c]) * frame->unit; // squares of it are floats
    }
    rhw_normalize3(view, view);
}

// Find the interpolated normal. If `texel` is not NULL, turn the normal as that texel of a normal map says.
ALWAYS_INLINE void map_normal(const struct rhw_fragment *f, const struct scene_surface *s,
                              const rhw_float *texel, float scale, rhw_float normal[3])
{
    for (int c = 0; c < 3; c++) {
        normal[c] = f->varying[s->varying_normal + c];
    }
    if (texel) {
        const rhw_float *tangent = &f->varying[s->varying_tangent];
        rhw_float bitangent[3];
        rhw_cross(normal, tangent, bitangent);
        const rhw_float x = (texel[0] * 2.0f - 1.0f) * scale;
        const rhw_float y = (texel[1] * 2.0f - 1.0f) * scale * tangent[3];
        const rhw_float z = texel[2] * 2.0f - 1.0f;
        for (int c = 0; c < 3; c++) {
            normal[c] = x * tangent[c] + y * bitangent[c] + z * normal[c];
        }
    }
}

// Make a normal unit and turn it to the side that is seen.
ALWAYS_INLINE void face_seen_side(const struct rhw_fragment *f, const struct scene_surface *s,
                                  rhw_float normal[3])
{
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

// Find the unit normal of the side that is seen.
ALWAYS_INLINE void surface_normal(const struct rhw_fragment *f, const struct scene_surface *s, bool mapped,
                                  slot_texels texels, rhw_float normal[3])
{
    const bool has_map = mapped && s->slot_varying[SCENE_SLOT_NORMAL] >= 0;
    const rhw_float *texel = has_map ? slot_texel(f, s, SCENE_SLOT_NORMAL, texels) : NULL;
    map_normal(f, s, texel, s->normal_scale, normal);
    face_seen_side(f, s, normal);
}

// Bend a normal that leans away from the eye until its surface is just seen. Interpolation and normal maps may lean a
// surface away, which no surface that is seen does. Its highlight and its mirror would be of what is behind it. A mesh
// whose normals are on the other side of its facets is the file's word, which stays: it is shaded as from behind.
ALWAYS_INLINE void bend_to_view(const struct scene_surface *s, const rhw_float view[3], rhw_float normal[3])
{
    const rhw_float lacking = 0.02f - rhw_dot3(normal, view);
    const rhw_int leans = rhw_less(0.0f, lacking);
    if (!rhw_any(leans) || s->inside_out) {
        return;
    }
    rhw_float bent[3];
    for (int c = 0; c < 3; c++) {
        bent[c] = normal[c] + view[c] * lacking;
    }
    rhw_normalize3(bent, bent);
    for (int c = 0; c < 3; c++) {
        normal[c] = rhw_select(leans, bent[c], normal[c]); // a lane's normal must not depend on other lanes
    }
}

// Find the normal that light is summed with.
ALWAYS_INLINE void seen_normal(const struct rhw_fragment *f, const struct scene_surface *s, bool mapped,
                               slot_texels texels, const rhw_float view[3], rhw_float normal[3])
{
    surface_normal(f, s, mapped, texels, normal);
    bend_to_view(s, view, normal);
}

// Draw the lines of the wireframe. The distance to an edge in pixels is its barycentric weight over the weight's
// gradient, exact on the edge and to first order beside it. Lines fade where triangles get as small as the lines, since
// a dense mesh would be one blot.
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

ALWAYS_INLINE void write_premultiplied(const rhw_float color[4], rhw_float out[4])
{
    for (int c = 0; c < 3; c++) {
        out[c] = color[c] * color[3];
    }
    out[3] = color[3];
}

// Write colours that are not premultiplied yet. `color` is light that has been tone-mapped, `linear` is light that has
// not.
ALWAYS_INLINE void write_output(struct rhw_fragment *f, const struct scene_surface *s, rhw_float color[4],
                                rhw_float linear[4])
{
    const struct scene_frame *frame = s->frame;
    if (s->wireframe) {
        draw_wire(f, s, color);
        draw_wire(f, s, linear);
    }
    if (frame->display_slot >= 0) {
        write_premultiplied(color, f->color[frame->display_slot]);
    }
    if (frame->linear_slot >= 0) {
        write_premultiplied(linear, f->color[frame->linear_slot]);
    }
}

// Tone-map the light of a lit surface and write it.
ALWAYS_INLINE void write_light(struct rhw_fragment *f, const struct scene_surface *s,
                               const rhw_float light[3], rhw_float alpha)
{
    rhw_float linear[4] = {light[0], light[1], light[2], alpha};
    rhw_float color[4] = {light[0], light[1], light[2], alpha};
    scene_tone_map(s->frame->tone, color);
    write_output(f, s, color, linear);
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

// Return the distance that the guide has at a fragment. The centre of the guide's texel lies `right` and `down` of the
// fragment's, in pixels of the pass.
ALWAYS_INLINE rhw_float guide_distance(const struct rhw_fragment *f, const struct scene_frame *frame,
                                       rhw_float *right, rhw_float *down)
{
    const struct scene_guide_lookup *guide = &frame->guide;
    const float texels = guide->scale / frame->samples, top = frame->first_row * guide->scale;
    const rhw_float x = rhw_floor(f->coord[0] * texels), y = rhw_floor(f->coord[1] * texels + top);
    const rhw_int column = rhw_int_from_float_unchecked(rhw_clamp(x, 0.0f, (float)guide->width - 1.0f));
    const rhw_int row = rhw_int_from_float_unchecked(rhw_clamp(y, 0.0f, (float)guide->height - 1.0f));
    const rhw_float there =
        rhw_gather(guide->distance, guide->pitch * guide->height, row * guide->pitch + column);
    *right = (x + 0.5f) * (1.0f / texels) - f->coord[0];
    *down = (y + 0.5f - top) * (1.0f / texels) - f->coord[1];
    return there;
}

// Find the place at which the shadow on a fragment is looked up. The values of a fragment are those of its pixel's
// centre, which may lie beyond the edge of a triangle that covers other samples of the pixel. Beyond an inner corner
// the plane goes on behind what it meets there, where no light arrives. The place is therefore moved towards the eye,
// onto what the guide has at the centre, where that lies before the plane by no more than two pixels are wide on the
// plane.
ALWAYS_INLINE void shadow_place(const struct rhw_fragment *f, const struct scene_surface *s,
                                rhw_float place[3])
{
    const struct scene_frame *frame = s->frame;
    const rhw_float *position = &f->varying[s->varying_position];
    const rhw_float *ddx = &f->ddx[s->varying_position], *ddy = &f->ddy[s->varying_position];
    for (int c = 0; c < 3; c++) {
        place[c] = position[c];
    }
    if (!frame->guide.distance || !s->is_triangle) {
        return;
    }
    rhw_float right, down;
    const rhw_float there = guide_distance(f, frame, &right, &down);
    const rhw_float distance = view_distance(f, frame, position);
    rhw_float plane = distance, width = rhw_splat(0.0f);
    for (int c = 0; c < 3; c++) {
        plane += (ddx[c] * right + ddy[c] * down) * frame->forward[c];
        width += rhw_abs(ddx[c]) + rhw_abs(ddy[c]);
    }
    const rhw_float gap = plane - there;
    const rhw_int behind = f->mask & rhw_less(distance * 4e-6f, gap) & rhw_less(gap, width * 2.0f);
    if (!rhw_any(behind)) {
        return;
    }
    const rhw_float part = rhw_select(behind, gap / distance, 0.0f);
    for (int c = 0; c < 3; c++) {
        const rhw_float to_eye =
            frame->orthographic ? -frame->forward[c] * distance : frame->eye[c] - position[c];
        place[c] += to_eye * part;
    }
}

// Dim the light of the lanes that it reaches, which are the lanes that face it.
ALWAYS_INLINE void shadow_irradiance(const struct rhw_fragment *f, const struct scene_surface *s,
                                     const struct scene_shader_light *light, rhw_int facing,
                                     rhw_float irradiance[3])
{
    if (!rhw_any(f->mask & facing)) {
        return;
    }
    const int at = s->varying_position;
    const bool plane = s->is_triangle;
    rhw_float place[3];
    shadow_place(f, s, place);
    struct scene_shadow_curve curve = {.origin = s->frame->eye};
    if (plane) {
        curve.normal = &f->varying[s->varying_normal];
        curve.support = &f->varying[s->varying_support];
        curve.turn = s->double_sided ? ~f->front_facing : rhw_splat_int(0);
    }
    const rhw_float open = scene_shadow(light, place, plane ? &f->ddx[at] : NULL, plane ? &f->ddy[at] : NULL,
                                        plane ? &curve : NULL, s->casts, f->mask & facing);
    for (int c = 0; c < 3; c++) {
        irradiance[c] = irradiance[c] * open;
    }
}

#endif
