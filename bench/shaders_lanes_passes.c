// SPDX-License-Identifier: MIT
// The shaders that read what earlier passes drew, on 8 lanes, compiled once per instruction set; shaders_glsl_passes.c
// has their twins.
#include "shaders_bench.h"
#include "shaders_lanes.h"

static void lit_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        to_clip(v->uniforms, v->attribute[0], v->position);
        to_world(v->uniforms, v->attribute[0], v->attribute[1], v->varying);
    }
}

static const float (*shared_of(const struct bench_uniforms *u))[4]
{
    return (const float(*)[4])(u + 1);
}

// Shadow map -----------------------------------------------------------------------------------------

// Normal and position in the world, then where that is in the map: u, v and depth.
static void shadowed_vertex(struct rhw_vertex *groups, int count)
{
    lit_vertex(groups, count);
    for (int g = 0; g < count; g++) {
        const float(*const to_map)[4] = shared_of(groups[g].uniforms);
        const rhw_float *const p = groups[g].varying + 3;
        for (int r = 0; r < 3; r++) {
            groups[g].varying[6 + r] =
                to_map[r][0] * p[0] + to_map[r][1] * p[1] + to_map[r][2] * p[2] + to_map[r][3];
        }
    }
}

// The part of the light that arrives: 3 × 3 footprints of 2 × 2 texels, a texel apart.
ALWAYS_INLINE rhw_float lightness(const struct rhw_fragment *f)
{
    const rhw_float *const at = f->varying + 6;
    const rhw_float reference = rhw_min(at[2], rhw_splat(1.0f)); // beyond the map it is light
    const rhw_int first[2] = {rhw_splat_int(-1), rhw_splat_int(-1)};
    const struct rhw_sample_request request = {.coordinates = at, .reference = &reference, .offset = first};
    rhw_float parts[9], sum = rhw_splat(0.0f);
    rhw_sample_compare_window(f->bindings, 0, &request, 3, 3, parts);
    for (int i = 0; i < 9; i++) {
        sum = sum + parts[i];
    }
    return sum * (1.0f / 9.0f);
}

static void shadowed_fragment(struct rhw_fragment *groups, int count)
{
    const struct bench_uniforms *const u = groups->uniforms;
    for (int g = 0; g < count; g++) {
        rhw_float n_dot_l, n_dot_h;
        light(&groups[g], u, &n_dot_l, &n_dot_h);
        const rhw_float lit = lightness(&groups[g]);
        const rhw_float gloss = u->specular * rhw_exp2(u->shininess * rhw_log2(n_dot_h)) * lit;
        const rhw_float diffuse = u->ambient + (1.0f - u->ambient) * n_dot_l * lit;
        for (int c = 0; c < 3; c++) {
            groups[g].color[0][c] = u->color[c] * diffuse + gloss;
        }
        groups[g].color[0][3] = rhw_splat(1.0f);
    }
}

// Reflection -----------------------------------------------------------------------------------------

static void reflect_fragment(struct rhw_fragment *groups, int count)
{
    const struct bench_uniforms *const u = groups->uniforms;
    for (int g = 0; g < count; g++) {
        const rhw_float *const v = groups[g].varying;
        rhw_float normal[3], incident[3], direction[3], texel[4];
        rhw_normalize3(v, normal);
        for (int c = 0; c < 3; c++) {
            incident[c] = v[3 + c] - u->eye[c];
        }
        rhw_reflect3(incident, normal, direction);
        rhw_sample_lod(groups[g].bindings, 0, direction, rhw_splat(0.0f), texel);
        for (int c = 0; c < 3; c++) {
            groups[g].color[0][c] = u->color[c] * texel[c];
        }
        groups[g].color[0][3] = rhw_splat(1.0f);
    }
}

// Deferred -------------------------------------------------------------------------------------------

// The ray of a corner, which the mesh has in the place of a normal.
static void ray_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        to_clip(v->uniforms, v->attribute[0], v->position);
        for (int c = 0; c < 3; c++) {
            v->varying[c] = v->attribute[1][c];
        }
    }
}

// Colour, normal, distance along the view, and the numbers of Blinn-Phong.
static void surface_fragment(struct rhw_fragment *groups, int count)
{
    const struct bench_uniforms *const u = groups->uniforms;
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        const rhw_float distance = 1.0f / f->coord[3];
        rhw_normalize3(f->varying, f->color[1]);
        f->color[1][3] = rhw_splat(0.0f);
        for (int c = 0; c < 4; c++) {
            f->color[0][c] = rhw_splat(u->color[c]);
            f->color[2][c] = distance;
        }
        f->color[3][0] = rhw_splat(u->specular);
        f->color[3][1] = rhw_splat(u->shininess * (1.0f / 256.0f));
        f->color[3][2] = rhw_splat(u->ambient);
        f->color[3][3] = rhw_splat(1.0f);
    }
}

// Groups of one step: few enough to keep what passes between steps near.
enum { STEP = 8 };

// What the first pass left of a group's pixels, and the light that they send.
struct surface {
    rhw_float position[3], normal[3], view[3], albedo[4], material[4], sum[3];
};

ALWAYS_INLINE void fetch_surface(const struct rhw_fragment *f, const struct bench_uniforms *u,
                                 struct surface *s)
{
    const rhw_int at[2] = {rhw_int_from_float_unchecked(f->coord[0]),
                           rhw_int_from_float_unchecked(f->coord[1])};
    const rhw_float *const ray = f->varying; // to distance 1
    rhw_float normal[4], distance[4];
    rhw_sample_fetch(f->bindings, 0, at, NULL, s->albedo);
    rhw_sample_fetch(f->bindings, 1, at, NULL, normal);
    rhw_sample_fetch(f->bindings, 2, at, NULL, distance);
    rhw_sample_fetch(f->bindings, 3, at, NULL, s->material);
    rhw_normalize3(normal, s->normal);
    for (int c = 0; c < 3; c++) {
        s->position[c] = u->eye[c] + ray[c] * distance[0];
        s->view[c] = -ray[c];
        s->sum[c] = s->albedo[c] * s->material[2];
    }
    rhw_normalize3(s->view, s->view);
}

// The least and the greatest position of each lane, over several groups.
struct bounds {
    rhw_float low[3], high[3];
};

ALWAYS_INLINE void bound_surfaces(const struct surface *s, int count, struct bounds *b)
{
    for (int c = 0; c < 3; c++) {
        b->low[c] = rhw_splat(3.4028235e38f);
        b->high[c] = -b->low[c];
    }
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 3; c++) {
            b->low[c] = rhw_min(s[g].position[c], b->low[c]); // NaN changes nothing
            b->high[c] = rhw_max(s[g].position[c], b->high[c]);
        }
    }
}

// What is left of a light at the end of this way to it. Nothing rounds a longer way to more of it.
ALWAYS_INLINE rhw_float light_left(const rhw_float way[3], float inverse_radius2)
{
    return rhw_max(1.0f - rhw_dot3(way, way) * inverse_radius2, rhw_splat(0.0f));
}

// False only if light_left is 0 at every position within the bounds.
ALWAYS_INLINE bool reaches(const struct bounds *b, const float place[4])
{
    rhw_float way[3];
    for (int c = 0; c < 3; c++) {
        const rhw_float beyond = rhw_max(place[c] - b->high[c], b->low[c] - place[c]);
        way[c] = rhw_max(beyond, rhw_splat(0.0f));
    }
    return rhw_any(rhw_less(rhw_splat(0.0f), light_left(way, place[3])));
}

// Adds what one light gives to the groups that it reaches, step by step: a group by itself is one chain of operations.
ALWAYS_INLINE void add_light(struct surface *groups, int count, const float place[4], const float color[4])
{
    rhw_float n_dot_l[STEP], power[STEP], strength[STEP];
    struct surface *lit[STEP];
    int reached = 0;
    for (int g = 0; g < count; g++) {
        struct surface *const s = &groups[g];
        rhw_float to_light[3], half[3];
        for (int c = 0; c < 3; c++) {
            to_light[c] = place[c] - s->position[c];
        }
        const rhw_float left = light_left(to_light, place[3]), zero = rhw_splat(0.0f);
        if (!rhw_any(rhw_less(zero, left))) {
            continue;
        }
        rhw_normalize3(to_light, to_light);
        for (int c = 0; c < 3; c++) {
            half[c] = to_light[c] + s->view[c];
        }
        rhw_normalize3(half, half);
        lit[reached] = s;
        strength[reached] = left * left;
        n_dot_l[reached] = rhw_max(rhw_dot3(s->normal, to_light), zero);
        power[reached] = rhw_max(rhw_dot3(s->normal, half), zero);
        reached++;
    }
    for (int i = 0; i < reached; i++) {
        power[i] = 256.0f * lit[i]->material[1] * rhw_log2(power[i]);
    }
    for (int i = 0; i < reached; i++) {
        struct surface *const s = lit[i];
        const rhw_float gloss = s->material[0] * rhw_exp2(power[i]);
        for (int c = 0; c < 3; c++) {
            s->sum[c] = s->sum[c] + color[c] * strength[i] * (s->albedo[c] * n_dot_l[i] + gloss);
        }
    }
}

static void lights_fragment(struct rhw_fragment *groups, int count)
{
    const struct bench_uniforms *const u = groups->uniforms;
    const float(*const lights)[4] = shared_of(u);
    for (; count > 0; groups += STEP, count -= STEP) {
        const int n = count < STEP ? count : STEP;
        struct surface s[STEP];
        struct bounds bounds;
        for (int g = 0; g < n; g++) {
            fetch_surface(&groups[g], u, &s[g]);
        }
        bound_surfaces(s, n, &bounds);
        for (int i = 0; i < BENCH_LIGHTS; i++) {
            if (reaches(&bounds, lights[2 * i])) {
                add_light(s, n, lights[2 * i], lights[2 * i + 1]);
            }
        }
        for (int g = 0; g < n; g++) {
            for (int c = 0; c < 3; c++) {
                groups[g].color[0][c] = s[g].sum[c];
            }
            groups[g].color[0][3] = rhw_splat(1.0f);
        }
    }
}

const struct bench_shader_table RHW_ISA_NAME(bench_pass_shader_table) = {
    .vertex =
        {
            [BENCH_SHADER_SHADOWED] = shadowed_vertex,
            [BENCH_SHADER_REFLECT] = lit_vertex,
            [BENCH_SHADER_SURFACE] = lit_vertex,
            [BENCH_SHADER_LIGHTS] = ray_vertex,
        },
    .fragment =
        {
            [BENCH_SHADER_SHADOWED] = shadowed_fragment,
            [BENCH_SHADER_REFLECT] = reflect_fragment,
            [BENCH_SHADER_SURFACE] = surface_fragment,
            [BENCH_SHADER_LIGHTS] = lights_fragment,
        },
};
