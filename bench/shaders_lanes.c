// SPDX-License-Identifier: MIT
// The benchmark's shaders on 8 lanes, compiled once per instruction set: what a user who cares for speed
// writes. Every formula has its twin in shaders_glsl.c; pow is exp2 of a product, as GLSL defines it.
#include "shaders_bench.h"
#include "shaders_lanes.h"

// Vertices ------------------------------------------------------------------------------------------

static void position_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        to_clip(v->uniforms, v->attribute[0], v->position);
    }
}

static void color_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        to_clip(v->uniforms, v->attribute[0], v->position);
        for (int c = 0; c < 4; c++) {
            v->varying[c] = v->attribute[1][c];
        }
    }
}

// Parts of the colour, the squares of whose weights have the sum of 1364/1369.
static void many_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        to_clip(v->uniforms, v->attribute[0], v->position);
        for (int i = 0; i < BENCH_MANY; i++) {
            for (int c = 0; c < 4; c++) {
                v->varying[4 * i + c] = v->attribute[1][c] * (((float)i + 0.5f) / 37);
            }
        }
    }
}

static void texture_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        to_clip(v->uniforms, v->attribute[0], v->position);
        v->varying[0] = v->attribute[1][0];
        v->varying[1] = v->attribute[1][1];
    }
}

static void lit_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        to_clip(v->uniforms, v->attribute[0], v->position);
        to_world(v->uniforms, v->attribute[0], v->attribute[1], v->varying);
    }
}

static void lit_flat_vertex(struct rhw_vertex *groups, int count)
{
    lit_vertex(groups, count);
    for (int g = 0; g < count; g++) {
        const struct bench_uniforms *const u = groups[g].uniforms;
        for (int c = 0; c < 3; c++) {
            groups[g].varying[6 + c] = rhw_splat(u->color[c]);
        }
    }
}

static void lit_texture_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        to_clip(v->uniforms, v->attribute[0], v->position);
        to_world(v->uniforms, v->attribute[0], v->attribute[1], v->varying);
        v->varying[6] = v->attribute[2][0];
        v->varying[7] = v->attribute[2][1];
    }
}

static void particle_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        const struct bench_uniforms *const u = v->uniforms;
        const rhw_float *const corner = v->attribute[0], *const place = v->attribute[1];
        rhw_float position[3];
        for (int c = 0; c < 3; c++) {
            position[c] = place[c] + (u->world[c] * corner[0] + u->world[4 + c] * corner[1]) * place[3];
        }
        to_clip(u, position, v->position);
        v->varying[0] = corner[0];
        v->varying[1] = corner[1];
        for (int c = 0; c < 4; c++) {
            v->varying[2 + c] = v->attribute[2][c];
        }
    }
}

// What faces away from the light moves with it, by `color` in the model: the mesh becomes its shadow's volume.
static void volume_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        const struct bench_uniforms *const u = v->uniforms;
        const rhw_float *const p = v->attribute[0], *const n = v->attribute[1];
        const rhw_int away =
            rhw_less(rhw_splat(0.0f), n[0] * u->color[0] + n[1] * u->color[1] + n[2] * u->color[2]);
        rhw_float position[3];
        for (int c = 0; c < 3; c++) {
            position[c] = rhw_select(away, p[c] + u->color[c], p[c]);
        }
        to_clip(u, position, v->position);
    }
}

// Fragments -----------------------------------------------------------------------------------------

static void flat_fragment(struct rhw_fragment *groups, int count)
{
    const struct bench_uniforms *const u = groups->uniforms;
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = rhw_splat(u->color[c]);
        }
    }
}

static void literal_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = rhw_splat(0.85f);
        groups[g].color[0][1] = rhw_splat(0.2f);
        groups[g].color[0][2] = rhw_splat(0.15f);
        groups[g].color[0][3] = rhw_splat(1);
    }
}

static void color_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = groups[g].varying[c];
        }
    }
}

// The colour with coordinates added, or derivatives, or both.
ALWAYS_INLINE void add_to_color(struct rhw_fragment *groups, int count, bool coordinates, bool slopes)
{
    const struct bench_uniforms *const u = groups->uniforms;
    for (int g = 0; g < count; g++) {
        const struct rhw_fragment *const f = &groups[g];
        for (int c = 0; c < 4; c++) {
            rhw_float color = f->varying[c];
            if (coordinates) {
                color += f->coord[c] * u->color[c];
            }
            if (slopes) {
                color += (c % 2 ? f->ddy : f->ddx)[c / 2] * u->cutoff;
            }
            groups[g].color[0][c] = color;
        }
    }
}

static void coord_fragment(struct rhw_fragment *groups, int count)
{
    add_to_color(groups, count, true, false);
}

static void slopes_fragment(struct rhw_fragment *groups, int count)
{
    add_to_color(groups, count, false, true);
}

static void coord_slopes_fragment(struct rhw_fragment *groups, int count)
{
    add_to_color(groups, count, true, true);
}

static void discard_fragment(struct rhw_fragment *groups, int count)
{
    const struct bench_uniforms *const u = groups->uniforms;
    color_fragment(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].mask &= rhw_less_equal(u->cutoff, groups[g].varying[0]);
    }
}

static void move_fragment(struct rhw_fragment *groups, int count)
{
    const struct bench_uniforms *const u = groups->uniforms;
    color_fragment(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].depth = groups[g].varying[3] * u->color[3];
    }
}

// The sum of squares. What is linear in varyings could be moved into the vertex function, as Mesa 25 does.
static void many_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_float *const v = groups[g].varying;
        for (int c = 0; c < 4; c++) {
            rhw_float sum = v[c] * v[c];
            for (int i = 1; i < BENCH_MANY; i++) {
                sum += v[4 * i + c] * v[4 * i + c];
            }
            groups[g].color[0][c] = sum;
        }
    }
}

static void input_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_float *const v = groups[g].varying;
        rhw_float *const color = groups[g].color[0];
        const rhw_float rest = 1.0f - v[3];
        for (int c = 0; c < 4; c++) {
            color[c] = v[c] * v[3] + color[c] * rest;
        }
    }
}

static void texture_fragment(struct rhw_fragment *groups, int count)
{
    rhw_sample_groups(groups, count, 1, 0, groups->color, RHW_MAX_COLOR_ATTACHMENTS);
}

static void particle_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_float *const v = groups[g].varying;
        rhw_float *const color = groups[g].color[0];
        for (int c = 0; c < 3; c++) {
            color[c] = v[2 + c];
        }
        color[3] = v[5] * rhw_max(1.0f - (v[0] * v[0] + v[1] * v[1]), rhw_splat(0.0f));
    }
}

// Blinn-Phong with one directional light, step by step over all groups: a group by itself is one long chain of
// operations that wait for each other, and those of the next begin too late to fill the gaps.

// Groups of one step: few enough to keep what passes between steps near.
enum { STEP = 8 };

// `base`: one for each of `count` groups, at most STEP.
ALWAYS_INLINE void shade(struct rhw_fragment *groups, int count, const struct bench_uniforms *u,
                         const rhw_float (*base)[4])
{
    rhw_float n_dot_l[STEP], n_dot_h[STEP];
    for (int g = 0; g < count; g++) {
        light(&groups[g], u, &n_dot_l[g], &n_dot_h[g]);
    }
    for (int g = 0; g < count; g++) {
        n_dot_h[g] = u->shininess * rhw_log2(n_dot_h[g]);
    }
    for (int g = 0; g < count; g++) {
        const rhw_float gloss = u->specular * rhw_exp2(n_dot_h[g]);
        const rhw_float diffuse = u->ambient + (1.0f - u->ambient) * n_dot_l[g];
        rhw_float *const color = groups[g].color[0];
        for (int c = 0; c < 3; c++) {
            color[c] = base[g][c] * diffuse + gloss;
        }
        color[3] = rhw_splat(1.0f);
    }
}

static void lit_fragment(struct rhw_fragment *groups, int count)
{
    const struct bench_uniforms *const u = groups->uniforms;
    rhw_float base[STEP][4];
    for (int g = 0; g < STEP; g++) {
        for (int c = 0; c < 3; c++) {
            base[g][c] = rhw_splat(u->color[c]);
        }
    }
    for (; count > 0; groups += STEP, count -= STEP) {
        shade(groups, count < STEP ? count : STEP, u, (const rhw_float(*)[4])base);
    }
}

// An instance is brighter than the one before it.
static void lit_flat_fragment(struct rhw_fragment *groups, int count)
{
    for (; count > 0; groups += STEP, count -= STEP) {
        const int n = count < STEP ? count : STEP;
        rhw_float base[STEP][4];
        for (int g = 0; g < n; g++) {
            const rhw_float brightness = rhw_float_from_int(groups[g].instance) + 1.0f;
            for (int c = 0; c < 3; c++) {
                base[g][c] = groups[g].varying[6 + c] * brightness;
            }
        }
        shade(groups, n, groups->uniforms, (const rhw_float(*)[4])base);
    }
}

ALWAYS_INLINE void shade_textured(struct rhw_fragment *groups, int count, bool masked)
{
    const struct bench_uniforms *const u = groups->uniforms;
    for (; count > 0; groups += STEP, count -= STEP) {
        const int n = count < STEP ? count : STEP;
        rhw_float texel[STEP][4];
        rhw_sample_groups(groups, n, 1, 6, texel, 1);
        for (int g = 0; g < n; g++) {
            if (masked) {
                groups[g].mask &= rhw_less_equal(u->cutoff, texel[g][3]);
            }
            for (int c = 0; c < 3; c++) {
                texel[g][c] = texel[g][c] * u->color[c];
            }
        }
        shade(groups, n, u, (const rhw_float(*)[4])texel);
    }
}

static void lit_texture_fragment(struct rhw_fragment *groups, int count)
{
    shade_textured(groups, count, false);
}

static void lit_masked_fragment(struct rhw_fragment *groups, int count)
{
    shade_textured(groups, count, true);
}

const struct bench_shader_table RHW_ISA_NAME(bench_shader_table) = {
    .vertex =
        {
            [BENCH_SHADER_FLAT] = position_vertex,
            [BENCH_SHADER_LITERAL] = position_vertex,
            [BENCH_SHADER_COLOR] = color_vertex,
            [BENCH_SHADER_TEXTURE] = texture_vertex,
            [BENCH_SHADER_LIT] = lit_vertex,
            [BENCH_SHADER_LIT_POINT] = lit_vertex,
            [BENCH_SHADER_LIT_FLAT] = lit_flat_vertex,
            [BENCH_SHADER_LIT_TEXTURE] = lit_texture_vertex,
            [BENCH_SHADER_LIT_MASKED] = lit_texture_vertex,
            [BENCH_SHADER_DEPTH] = position_vertex,
            [BENCH_SHADER_PARTICLE] = particle_vertex,
            [BENCH_SHADER_VOLUME] = volume_vertex,
            [BENCH_SHADER_SCREEN] = color_vertex,
            [BENCH_SHADER_COORD] = color_vertex,
            [BENCH_SHADER_SLOPES] = color_vertex,
            [BENCH_SHADER_COORD_SLOPES] = color_vertex,
            [BENCH_SHADER_DISCARD] = color_vertex,
            [BENCH_SHADER_MOVE] = color_vertex,
            [BENCH_SHADER_MANY] = many_vertex,
            [BENCH_SHADER_SAMPLE] = color_vertex,
            [BENCH_SHADER_INPUT] = color_vertex,
        },
    .fragment =
        {
            [BENCH_SHADER_FLAT] = flat_fragment,
            [BENCH_SHADER_LITERAL] = literal_fragment,
            [BENCH_SHADER_COLOR] = color_fragment,
            [BENCH_SHADER_TEXTURE] = texture_fragment,
            [BENCH_SHADER_LIT] = lit_fragment,
            [BENCH_SHADER_LIT_POINT] = lit_fragment,
            [BENCH_SHADER_LIT_FLAT] = lit_flat_fragment,
            [BENCH_SHADER_LIT_TEXTURE] = lit_texture_fragment,
            [BENCH_SHADER_LIT_MASKED] = lit_masked_fragment,
            [BENCH_SHADER_PARTICLE] = particle_fragment,
            [BENCH_SHADER_SCREEN] = color_fragment,
            [BENCH_SHADER_COORD] = coord_fragment,
            [BENCH_SHADER_SLOPES] = slopes_fragment,
            [BENCH_SHADER_COORD_SLOPES] = coord_slopes_fragment,
            [BENCH_SHADER_DISCARD] = discard_fragment,
            [BENCH_SHADER_MOVE] = move_fragment,
            [BENCH_SHADER_MANY] = many_fragment,
            [BENCH_SHADER_SAMPLE] = color_fragment,
            [BENCH_SHADER_INPUT] = input_fragment,
        },
};
