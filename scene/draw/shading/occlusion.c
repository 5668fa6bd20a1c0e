// SPDX-License-Identifier: MIT
// Ambient occlusion from distances: the horizon of every pixel along a few directions of the screen, and the part of
// the cosine-weighted hemisphere that stays open between two horizons, in closed form (J. Jimenez, X. Wu, A. Pesce, A.
// Jarabo, "Practical Realtime Strategies for Accurate Indirect Occlusion", SIGGRAPH 2016, "GTAO").
//
// Directions and steps follow a pattern of 4 × 4 pixels, so that 16 pixels together look along 32 directions. A blur of
// just that width, which does not mix surfaces, makes them even. A surface under an open sky is to come out as 1 all
// over, since flat ground gets bands otherwise. Directions are therefore spread evenly around the line of sight, not
// over the screen. Two directions may see more than 1, of which the other pixels take their part.
//
// The hemisphere stands on the shading normal, so that facets that stand for a curve do not show. What is a horizon is
// told by the facet: whatever does not stand above its plane is none, although it may stand above the plane across a
// shading normal that leans far from the facet.
//
// What occludes is no black body. It is lit itself, and sends back a part of the light that it keeps away, so that no
// crease is black.
#include "guide_normal.h"
#include "scene_shaders.h"

#include <string.h>

#define ALWAYS_INLINE static inline __attribute__((always_inline))

enum { SLICES = 2, STEPS = 5 };

static const float pi = 3.14159265358979f;

// A thing stands over a surface if it is higher above the facet's plane, in parts of how far away it is, than the
// rounding of normals in 16 bits.
static const float least_height = 1e-3f;

// Part of the light that what occludes sends back.
static const float sent_back = 0.25f;

// A pixel's surface, in view space.
struct seen_surface {
    rhw_float coord[2];
    rhw_float point[3], normal[3], face[3];
    rhw_float view[3];            // unit vector to the eye
    rhw_float right[3], above[3]; // unit vectors across `view`
    rhw_float slope[2];           // slope of the line of sight, by depth
    rhw_float reach;              // reach on the screen, texels
};

// Find where the surface of a texel lies in view space, times the unit. `distance` is as the guide has it.
ALWAYS_INLINE void place(const struct scene_ambient *o, rhw_float x, rhw_float y, rhw_float distance,
                         rhw_float point[3])
{
    const rhw_float scaled = distance * o->unit, scale = o->orthographic ? rhw_splat(o->unit) : scaled;
    point[0] = (x * o->ray[0] + o->ray[1]) * scale;
    point[1] = (y * o->ray[2] + o->ray[3]) * scale;
    point[2] = -scaled;
}

// Return the texels that the radius takes on the screen at a distance.
ALWAYS_INLINE rhw_float radius_texels(const struct scene_ambient *o, rhw_float distance)
{
    return o->orthographic ? rhw_splat(o->texels) : o->texels / distance;
}

// Return the index of a texel of the picture.
ALWAYS_INLINE rhw_int index_of(const struct scene_ambient *o, rhw_float x, rhw_float y)
{
    return rhw_int_from_float_unchecked(y) * o->pitch + rhw_int_from_float_unchecked(x);
}

ALWAYS_INLINE rhw_int texel_index(const struct scene_ambient *o, rhw_float x, rhw_float y)
{
    return index_of(o, rhw_clamp(x, 0.0f, (float)(o->width - 1)), rhw_clamp(y, 0.0f, (float)(o->height - 1)));
}

// Return true if the texels of all lanes follow each other, as they do where a group is a row of pixels.
ALWAYS_INLINE bool is_row(rhw_int index)
{
    const rhw_int lanes = {0, 1, 2, 3, 4, 5, 6, 7};
    return !rhw_any(index != lanes + index[0]);
}

// Return what a plane of the picture has at texels.
ALWAYS_INLINE rhw_float read_plane(const struct scene_ambient *o, const float *plane, rhw_int index,
                                   bool in_row)
{
    if (!in_row) {
        return rhw_gather(plane, o->pitch * o->height, index);
    }
    rhw_float values;
    memcpy(&values, plane + index[0], sizeof values);
    return values;
}

// Fetch the folded normals of the pixel: of the mesh, and of the facet.
ALWAYS_INLINE void fetch_normals(const struct rhw_fragment *f, rhw_float folded[4])
{
    const rhw_int at[2] = {rhw_int_from_float_unchecked(f->coord[0]),
                           rhw_int_from_float_unchecked(f->coord[1])};
    rhw_sample_fetch(f->bindings, 0, at, NULL, folded);
}

// Find a unit normal in view space.
ALWAYS_INLINE void view_normal(const struct scene_ambient *o, const rhw_float folded[2], rhw_float normal[3])
{
    rhw_float world[3];
    scene_normal_unfold(folded, world);
    for (int r = 0; r < 3; r++) {
        normal[r] = world[0] * o->axes[r][0] + world[1] * o->axes[r][1] + world[2] * o->axes[r][2];
    }
}

// Find the line of sight, and two directions across it.
ALWAYS_INLINE void look_along(const struct scene_ambient *o, struct seen_surface *p)
{
    const rhw_float to_eye[3] = {-p->point[0], -p->point[1], -p->point[2]};
    const rhw_float forward[3] = {rhw_splat(0.0f), rhw_splat(0.0f), rhw_splat(1.0f)};
    rhw_normalize3(o->orthographic ? forward : to_eye, p->view);
    const rhw_float across[3] = {p->view[2], rhw_splat(0.0f), -p->view[0]};
    rhw_normalize3(across, p->right);
    rhw_cross(p->view, p->right, p->above);
    for (int c = 0; c < 2; c++) {
        p->slope[c] = o->orthographic ? rhw_splat(0.0f) : p->point[c] / -p->point[2];
    }
}

// Return the highest cosine, towards the eye, of what stands along (dx, dy) within the radius. `lowest` is the cosine
// of the surface's own horizon. What is far from the pixel counts less, so that the radius leaves no edge.
ALWAYS_INLINE rhw_float horizon(const struct scene_ambient *o, const struct seen_surface *p, rhw_float dx,
                                rhw_float dy, rhw_float jitter, rhw_float lowest)
{
    const float inverse_radius2 = 1.0f / (o->radius * o->radius);
    rhw_float highest = lowest;
    for (int k = 0; k < STEPS; k++) {
        const rhw_float along = (jitter + (float)k) * (1.0f / STEPS);
        const rhw_float spread = along * along; // near places matter most
        // A place beyond the picture's edge is moved to the edge, with what is there.
        const rhw_float x = rhw_clamp(rhw_floor(p->coord[0] + dx * spread), 0.0f, (float)(o->width - 1)),
                        y = rhw_clamp(rhw_floor(p->coord[1] + dy * spread), 0.0f, (float)(o->height - 1));
        const rhw_float distance = rhw_gather(o->distance, o->pitch * o->height, index_of(o, x, y));
        rhw_float other[3];
        place(o, x + 0.5f, y + 0.5f, distance, other);
        for (int c = 0; c < 3; c++) {
            other[c] -= p->point[c];
        }
        const rhw_float length2 = rhw_dot3(other, other);
        const rhw_float inverse = rhw_rsqrt(rhw_max(length2, 1e-30f));
        const rhw_float weight = rhw_saturate(1.0f - length2 * inverse_radius2);
        const rhw_float height = rhw_dot3(other, p->face) * inverse;
        const rhw_int real =
            rhw_less(distance, 1e30f) & rhw_less(0.0f, weight) & rhw_less(least_height, height);
        const rhw_float faded = rhw_mix(lowest, rhw_dot3(other, p->view) * inverse, weight);
        highest = rhw_select(real, rhw_max(highest, faded), highest);
    }
    return highest;
}

// Return the open part of one slice of the hemisphere, at the angle `turn` about the line of sight.
ALWAYS_INLINE rhw_float open_part(const struct scene_ambient *o, const struct seen_surface *p, rhw_float turn,
                                  rhw_float jitter)
{
    rhw_float sine, cosine, direction[3], axis[3], projected[3];
    rhw_sincos(turn, &sine, &cosine);
    for (int c = 0; c < 3; c++) {
        direction[c] = cosine * p->right[c] + sine * p->above[c];
    }
    rhw_cross(direction, p->view, axis);
    const rhw_float beside = rhw_dot3(p->normal, axis);
    for (int c = 0; c < 3; c++) {
        projected[c] = p->normal[c] - axis[c] * beside;
    }
    const rhw_float length = rhw_sqrt(rhw_max(rhw_dot3(projected, projected), 1e-12f));
    const rhw_float cos_n = rhw_clamp(rhw_dot3(projected, p->view) / length, -1.0f, 1.0f);
    const rhw_float n = rhw_copysign(rhw_acos(cos_n), rhw_dot3(direction, projected));
    const rhw_float sin_n = rhw_sin(n);
    // The cosines of the surface's own horizons are cos(n ± π/2).
    const rhw_float dx = (direction[0] + direction[2] * p->slope[0]) * p->reach,
                    dy = -(direction[1] + direction[2] * p->slope[1]) * p->reach;
    const rhw_float ahead = horizon(o, p, dx, dy, jitter, -sin_n);
    const rhw_float behind = horizon(o, p, -dx, -dy, jitter, sin_n);
    const rhw_float h1 = rhw_acos(rhw_clamp(ahead, -1.0f, 1.0f));
    const rhw_float h0 = -rhw_acos(rhw_clamp(behind, -1.0f, 1.0f));
    const rhw_float arc0 = cos_n + 2.0f * h0 * sin_n - rhw_cos(2.0f * h0 - n);
    const rhw_float arc1 = cos_n + 2.0f * h1 * sin_n - rhw_cos(2.0f * h1 - n);
    return 0.25f * length * (arc0 + arc1);
}

static void occlusion_fragment(struct rhw_fragment *groups, int count)
{
    const struct scene_ambient *o = groups->uniforms;
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        struct seen_surface p = {.coord = {f->coord[0], f->coord[1]}};
        const rhw_float x = rhw_floor(p.coord[0]), y = rhw_floor(p.coord[1]);
        const rhw_float distance = rhw_gather(o->distance, o->pitch * o->height, texel_index(o, x, y));
        f->color[0][0] = rhw_splat(1.0f);
        const rhw_int some = rhw_less(distance, 1e30f);
        p.reach = rhw_min(radius_texels(o, distance), o->most_texels);
        const rhw_int is_wide = some & rhw_less(1.0f, p.reach);
        if (!rhw_any(f->mask & is_wide)) {
            continue;
        }
        const rhw_float held = rhw_select(some, distance, 1.0f);
        rhw_float sum = rhw_splat(0.0f);
        place(o, p.coord[0], p.coord[1], held, p.point);
        rhw_float folded[4];
        fetch_normals(f, folded);
        view_normal(o, &folded[0], p.normal);
        view_normal(o, &folded[2], p.face);
        look_along(o, &p);
        // 16 directions, and 4 places along them, are spread over 4 × 4 pixels.
        const rhw_int column = rhw_int_from_float_unchecked(x), row = rhw_int_from_float_unchecked(y);
        const rhw_int cell = ((((column + row) & 3) << 2) + (column & 3));
        const rhw_float rotation = rhw_float_from_int(cell) * (1.0f / 16.0f);
        const rhw_float jitter = 0.25f + rhw_float_from_int((row - column) & 3) * 0.25f;
        for (int s = 0; s < SLICES; s++) {
            const rhw_float turn = (rotation + (float)s) * (pi / (float)SLICES);
            sum += open_part(o, &p, turn, jitter);
        }
        f->color[0][0] = rhw_select(is_wide, sum * (1.0f / SLICES), 1.0f);
    }
}

// Return a coordinate inside of the picture that has the place of `x` in the pattern, where `x` is outside.
ALWAYS_INLINE rhw_float within(rhw_float x, float size)
{
    return rhw_select(rhw_less(x, 0.0f), x + 4.0f, rhw_select(rhw_less(size, x), x - 4.0f, x));
}

// Blur five texels in a row or a column, of which the outer ones count half: they are as wide as the pattern. A texel
// counts as far as it lies in the plane of the pixel.
static void blur_fragment(struct rhw_fragment *groups, int count)
{
    const struct scene_ambient *o = groups->uniforms;
    const bool upright = o->step != 1;
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const rhw_float coord[2] = {f->coord[0], f->coord[1]};
        const rhw_int index = texel_index(o, rhw_floor(coord[0]), rhw_floor(coord[1]));
        const rhw_float distance = rhw_gather(o->distance, o->pitch * o->height, index);
        const rhw_int some = rhw_less(distance, 1e30f);
        f->color[0][0] = rhw_splat(1.0f);
        if (!rhw_any(f->mask & some)) {
            continue;
        }
        rhw_float point[3], normal[3], sum = rhw_splat(0.0f), weights = rhw_splat(0.0f);
        const rhw_float held = rhw_select(some, distance, 1.0f);
        place(o, coord[0], coord[1], held, point);
        rhw_float folded[4];
        fetch_normals(f, folded);
        view_normal(o, &folded[2], normal);
        const rhw_float tolerance = o->radius * (0.08f + 2.0f / radius_texels(o, held));
        for (int k = -2; k <= 2; k++) {
            const rhw_float x = upright ? coord[0] : within(coord[0] + (float)k, (float)o->width),
                            y = upright ? within(coord[1] + (float)k, (float)o->height) : coord[1];
            const rhw_int at = texel_index(o, rhw_floor(x), rhw_floor(y));
            const bool in_row = is_row(at);
            const rhw_float there = read_plane(o, o->distance, at, in_row);
            const rhw_float value = read_plane(o, o->source, at, in_row);
            rhw_float other[3];
            place(o, x, y, rhw_min(there, 1e30f), other);
            for (int c = 0; c < 3; c++) {
                other[c] -= point[c];
            }
            const rhw_float off = rhw_abs(rhw_dot3(other, normal));
            const rhw_float weight = (k == -2 || k == 2 ? 0.5f : 1.0f) * rhw_saturate(1.0f - off / tolerance);
            const rhw_int real = rhw_less(there, 1e30f);
            sum += rhw_select(real, weight * value, 0.0f);
            weights += rhw_select(real, weight, 0.0f);
        }
        const rhw_float even = sum / weights;
        const rhw_float open = upright ? rhw_mix(sent_back, 1.0f, rhw_clamp(even, 0.0f, 1.0f)) : even;
        f->color[0][0] = rhw_select(some & rhw_less(0.0f, weights), open, 1.0f);
    }
}

const struct scene_occlusion_shaders RHW_ISA_NAME(scene_occlusion_shaders) = {
    .fragment = {occlusion_fragment, blur_fragment},
};
