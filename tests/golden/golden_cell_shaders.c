// SPDX-License-Identifier: MIT
// See golden_cells.h; compiled with RHW_ISA_SUFFIX = baseline, avx2, ...
#include "golden_cells.h"

#include <rhw/shader.h>

static void plain(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        for (int c = 0; c < 4; c++) {
            v->position[c] = v->attribute[0][c];
            v->varying[c] = v->attribute[1][c];
        }
    }
}

static void instanced(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        const rhw_float *p = v->attribute[0], *place = v->attribute[2];
        v->position[0] = p[0] * place[2] + place[0] * p[3];
        v->position[1] = p[1] * place[2] + place[1] * p[3];
        v->position[2] = p[2];
        v->position[3] = p[3];
        for (int c = 0; c < 4; c++) {
            v->varying[c] = v->attribute[1][c] * v->attribute[3][c];
        }
        v->varying[4] = rhw_float_from_int(v->vertex_index);
        v->varying[5] = rhw_float_from_int(v->instance_index);
    }
}

static void screen(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        const rhw_float x = rhw_float_from_int(v->vertex_index & 1) * 2.0f,
                        y = rhw_float_from_int(v->vertex_index & 2);
        v->position[0] = x * 2.0f - 1.0f;
        v->position[1] = 1.0f - y * 2.0f;
        v->position[2] = rhw_splat(0.5f);
        v->position[3] = rhw_splat(1.0f);
        v->varying[0] = x;
        v->varying[1] = y;
        v->varying[2] = v->varying[3] = rhw_splat(0);
    }
}

static void sized(struct rhw_vertex *groups, int count)
{
    plain(groups, count);
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        const rhw_float *p = v->position;
        v->point_size = v->varying[3] * 12.0f;
        v->clip_distance[0] = p[3] * 1.1f - p[0] - p[1];
        v->clip_distance[1] = p[3] * 0.9f + p[0];
        v->cull_distance[0] = p[3] * 0.3f - p[1];
    }
}

static void routed(struct rhw_vertex *groups, int count)
{
    plain(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].layer = groups[g].instance_index;
        groups[g].viewport_index = groups[g].vertex_index & 3;
    }
}

static void route(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const rhw_float factor =
            1.0f - 0.1f * rhw_float_from_int(f->layer) - 0.1f * rhw_float_from_int(f->viewport_index);
        for (int c = 0; c < 4; c++) {
            f->color[0][c] = f->varying[c] * factor;
        }
    }
}

static void covered(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_float factor = rhw_select(groups[g].fully_covered, rhw_splat(1.0f), rhw_splat(0.5f));
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = groups[g].varying[c] * factor;
        }
    }
}

static void point(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        f->color[0][0] = f->varying[0] * f->point_coord[0];
        f->color[0][1] = f->varying[1] * f->point_coord[1];
        f->color[0][2] = f->varying[2];
        f->color[0][3] = rhw_splat(1);
    }
}

static void value(struct rhw_fragment *groups, int count)
{
    const struct golden_cell_uniforms *u = groups->uniforms;
    for (int g = 0; g < count; g++) {
        for (int t = 0; t < u->targets; t++) {
            for (int c = 0; c < 4; c++) {
                groups[g].color[t][c] = groups[g].varying[c];
            }
        }
    }
}

static void facing(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        for (int c = 0; c < 4; c++) {
            f->color[0][c] = rhw_select(f->front_facing, f->varying[c], 1.0f - f->varying[c]);
        }
    }
}

static void texture(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const rhw_float uv[2] = {f->varying[0], f->varying[1]};
        const rhw_float grad[4] = {f->ddx[0], f->ddx[1], f->ddy[0], f->ddy[1]};
        rhw_sample_grad(f->bindings, 0, uv, grad, f->color[0]);
    }
}

static void level(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const rhw_float uv[2] = {f->varying[0], f->varying[1]};
        rhw_sample_lod(f->bindings, 0, uv, f->varying[2], f->color[0]);
    }
}

// As far as half a pixel in x and four in y, smooth and as it were without perspective.
static void offset(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const rhw_float by[2] = {rhw_fract(f->coord[0] * 0.37f) - 0.5f,
                                 rhw_fract(f->coord[1] * 0.29f) * 8.0f - 4.0f};
        f->color[0][0] = rhw_interpolate_at(f, 0, 3, by);
        f->color[0][1] = rhw_interpolate_at(f, 1, 3, by);
        f->color[0][2] = rhw_interpolate_at(f, 2, -1, by);
        f->color[0][3] = rhw_interpolate_at(f, 3, 3, by);
    }
}

// What one group asks of a texture of any kind.
static void ask(const struct golden_kind_uniforms *u, struct rhw_fragment *f)
{
    const rhw_int three = rhw_splat_int(3), offset[3] = {three, -three, rhw_splat_int(1)};
    const rhw_float lod = rhw_abs(f->varying[3]) * 0.5f;
    const rhw_int number = rhw_int_from_float(lod);
    rhw_float gradient[6];
    rhw_int at[4], size[3];
    for (int i = 0; i < u->components; i++) {
        gradient[i] = f->ddx[i];
        gradient[u->components + i] = f->ddy[i];
    }
    for (int i = 0; i < 4; i++) {
        at[i] = rhw_int_from_float(rhw_floor(f->varying[i] * 8.0f));
    }
    struct rhw_sample_request request = {.coordinates = f->varying, .gradient = gradient};
    rhw_float *const color = f->color[0];
    switch (u->question) {
    case GOLDEN_ASK_GRADIENT: rhw_sample(f->bindings, 0, &request, color); break;
    case GOLDEN_ASK_OFFSET:
        request = (struct rhw_sample_request){.coordinates = f->varying, .lod = &lod, .offset = offset};
        rhw_sample(f->bindings, 0, &request, color);
        break;
    case GOLDEN_ASK_FETCH: rhw_sample_fetch(f->bindings, 0, at, &number, color); break;
    case GOLDEN_ASK_GATHER: rhw_sample_gather(f->bindings, 0, &request, 1, color); break;
    default:
        rhw_sample_query_lod(f->bindings, 0, &request, color);
        rhw_sample_size(f->bindings, 0, &number, size);
        color[2] = rhw_float_from_int(size[0] + size[1]) * 0.01f;
        color[3] = rhw_float_from_int(size[2]) * 0.1f;
        break;
    }
}

static void kinds(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        ask(groups->uniforms, &groups[g]);
    }
}

static void ids(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        f->color[0][0] = rhw_float_from_int(f->primitive & 7) * 0.125f + 0.125f;
        f->color[0][1] = rhw_float_from_int(f->instance & 7) * 0.125f + 0.125f;
        f->color[0][2] = rhw_float_from_int(f->draw & 7) * 0.125f + 0.125f;
        f->color[0][3] = rhw_splat(1);
        f->color[1][0] = (rhw_float)f->primitive;
        f->color[2][0] = (rhw_float)f->instance;
        f->color[3][0] = (rhw_float)f->draw;
    }
}

static void builtins(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const rhw_float *const three[4] = {f->barycentric, f->barycentric_noperspective, f->barycentric_ddx,
                                           f->barycentric_ddy};
        for (int c = 0; c < 4; c++) {
            f->color[0][c] = f->coord[c] * (c < 2 ? 1.0f / 128 : 1);
            f->color[5][c] = f->ddx[c] * 16.0f + 0.5f;
            f->color[6][c] = f->ddy[c] * 16.0f + 0.5f;
        }
        for (int i = 0; i < 4; i++) {
            const rhw_float last = rhw_select(f->front_facing, rhw_splat(1), rhw_splat(0.5f));
            for (int c = 0; c < 3; c++) {
                f->color[1 + i][c] = i < 2 ? three[i][c] : three[i][c] * 16.0f + 0.5f;
            }
            f->color[1 + i][3] = last;
        }
        f->color[7][0] = (rhw_float)(f->primitive + f->front_facing * 1000);
    }
}

static void heights(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const rhw_float x = rhw_fract(f->varying[0] * 6.0f) - 0.5f,
                        y = rhw_fract(f->varying[1] * 6.0f) - 0.5f;
        f->depth = f->depth + 0.25f * rhw_sin(f->varying[0] * 9.0f) * rhw_cos(f->varying[1] * 7.0f);
        f->mask &= rhw_less(rhw_splat(0.04f), x * x + y * y);
        const rhw_float slope[3] = {f->ddx[0] + f->ddy[0], f->ddx[1] + f->ddy[1], rhw_splat(0.02f)};
        rhw_float unit[3];
        rhw_normalize3(slope, unit);
        for (int c = 0; c < 3; c++) {
            f->color[0][c] = f->varying[2] * 0.5f + unit[c] * 0.25f + 0.25f;
        }
        f->color[0][2] = f->varying[3];
        f->color[0][3] = rhw_splat(1);
    }
}

// Function `which` of 32; the second argument of those that take two is b.
static rhw_float evaluate(int which, rhw_float a, rhw_float b)
{
    const rhw_float one = rhw_splat(1), zero = rhw_splat(0);
    rhw_float vector[3] = {a, b, one}, result[3];
    switch (which) {
    case 0: return rhw_exp2(a);
    case 1: return rhw_exp(a);
    case 2: return rhw_log2(a);
    case 3: return rhw_log(a);
    case 4: return rhw_pow(a, b);
    case 5: return rhw_sin(a);
    case 6: return rhw_cos(a);
    case 7: return rhw_tan(a);
    case 8: return rhw_atan(a);
    case 9: return rhw_atan2(a, b);
    case 10: return rhw_asin(a);
    case 11: return rhw_acos(a);
    case 12: return rhw_sqrt(a);
    case 13: return rhw_rsqrt(a);
    case 14: return rhw_floor(a);
    case 15: return rhw_ceil(a);
    case 16: return rhw_round(a);
    case 17: return rhw_trunc(a);
    case 18: return rhw_fract(a);
    case 19: return rhw_float_from_int(rhw_int_from_float(a));
    case 20: return rhw_min(a, b);
    case 21: return rhw_max(a, b);
    case 22: return rhw_clamp(a, zero, one);
    case 23: return rhw_saturate(a);
    case 24: return rhw_sign(a);
    case 25: return rhw_copysign(b, a);
    case 26: return rhw_mix(a, b, rhw_splat(0.3f));
    case 27: return rhw_smoothstep(zero, one, a);
    case 28: rhw_normalize3(vector, result); return result[0];
    case 29: rhw_reflect3(vector, vector, result); return result[1];
    case 30: return a / b;
    default: return rhw_length3(vector) - rhw_length2(vector);
    }
}

static void maths(struct rhw_fragment *groups, int count)
{
    const struct golden_cell_uniforms *u = groups->uniforms;
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        // All of a group is in one row; its cells may differ.
        const rhw_float x = f->varying[0] * 8.0f, y = f->varying[1] * 4.0f;
        const rhw_int cell = rhw_int_from_float(x) + 8 * rhw_int_from_float(y);
        rhw_float a = u->low + rhw_fract(x) * (u->high - u->low),
                  b = u->low + rhw_fract(y) * (u->high - u->low);
        if (u->bits) {
            a = (rhw_float)((rhw_int)((rhw_uint)rhw_int_from_float(rhw_fract(x) * 1048576.0f) * 4096u +
                                      1234567u));
            b = (rhw_float)((rhw_int)((rhw_uint)rhw_int_from_float(rhw_fract(y) * 1048576.0f) * 4096u +
                                      7654321u));
        }
        rhw_float result = rhw_splat(0);
        for (int which = 0; which < 32; which++) {
            const rhw_int here = rhw_equal_int(cell, rhw_splat_int(which));
            if (rhw_any(here)) {
                result = rhw_select(here, evaluate(which, a, b), result);
            }
        }
        f->color[0][0] = result;
    }
}

void RHW_ISA_NAME(golden_cells)(struct rhw_program *program, enum rhw_isa isa, enum golden_cell_vertex vertex,
                                enum golden_cell_fragment fragment)
{
    rhw_vertex_function *const vertices[GOLDEN_CELL_VERTICES] = {plain, instanced, screen, sized, routed};
    rhw_fragment_function *const fragments[GOLDEN_CELL_FRAGMENTS] = {
        value, facing, texture, level, ids, builtins, heights, maths, kinds, point, route, covered, offset};
    program->vertex[isa] = vertices[vertex];
    program->fragment[isa] = fragments[fragment];
}
