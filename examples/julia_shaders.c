// SPDX-License-Identifier: MIT
// The shaders of lesson 8, compiled once per instruction set: masks, a loop that lanes leave at different times, an
// early return, a table in the uniforms, a texture at coordinates that are computed. Vectors cross functions that may
// not be inlined by pointer alone.
#include "julia.h"

#include <rhw/shader_dual.h>

void RHW_ISA_NAME(julia_vertex)(struct rhw_vertex *groups, int count)
{
    const struct julia *julia = groups->uniforms;
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *v = &groups[g];
        struct floor_point *out = RHW_VARYINGS_OUT(struct floor_point, v->varying);
        out->at[0] = v->attribute[0][0];
        out->at[1] = v->attribute[0][1];
        out->far = v->attribute[0][2];
        const rhw_float on_floor[3] = {out->at[0], rhw_splat(0), out->at[1]};
        rhw_mat4_mul_point(julia->clip, on_floor, v->position);
    }
}

// z ← z² + c until |z| is large, in each lane of `inside` for itself: a lane that leaves is masked out, keeps its z and
// its number of steps, and waits for the others. At the end `inside` has the lanes that never left.
static void iterate(const struct julia *julia, struct rhw_dual z[2], rhw_int *inside, rhw_int *steps)
{
    *steps = rhw_splat_int(0);
    for (int n = 0; n < julia->steps && rhw_any(*inside); n++) {
        const struct rhw_dual x = z[0], y = z[1];
        const struct rhw_dual square = rhw_dual_sub(rhw_dual_mul(x, x), rhw_dual_mul(y, y));
        const struct rhw_dual twice = rhw_dual_scale(rhw_dual_mul(x, y), 2.0f);
        z[0] = rhw_dual_select(*inside, rhw_dual_offset(square, julia->c[0]), x);
        z[1] = rhw_dual_select(*inside, rhw_dual_offset(twice, julia->c[1]), y);
        *steps -= *inside; // a mask is −1
        const rhw_float distance2 = z[0].value * z[0].value + z[1].value * z[1].value;
        *inside &= rhw_less_equal(distance2, julia->escape);
    }
}

// Where z stands in the tile that it left through: the angle, two tiles to a turn, and how far it overshot. One step
// more doubles the angle and the logarithm of |z|, so tiles halve from ring to ring.
static void find_tile(const struct julia *julia, const struct rhw_dual z[2], struct rhw_dual uv[2])
{
    const float ring = rhw_log2_1(rhw_log2_1(julia->escape));
    uv[0] = rhw_dual_scale(rhw_dual_atan2(z[1], z[0]), 0.318309886f); // 1/π
    uv[1] = rhw_dual_offset(rhw_dual_log2(rhw_dual_log2(rhw_dual_dot2(z, z))), -ring);
}

// The colours of this step and the next, mixed. What never left has no entry, −1, and reads as black.
static void mix_palette(const struct julia *julia, rhw_int steps, rhw_int never, rhw_float part,
                        rhw_float color[3])
{
    const rhw_int first = rhw_select_int(never, -1, steps), second = rhw_select_int(never, -1, steps - 1);
    for (int c = 0; c < 3; c++) {
        const float *const table = &julia->palette[0][0];
        color[c] = rhw_mix(rhw_gather(table, 3 * PALETTE, rhw_min_int(first, PALETTE - 1) * 3 + c),
                           rhw_gather(table, 3 * PALETTE, rhw_min_int(second, PALETTE - 1) * 3 + c), part);
    }
}

// The point of the floor as a dual, and where it leaves.
static void leave(struct rhw_fragment *f, struct rhw_dual z[2], rhw_int *inside, rhw_int *steps)
{
    z[0] = rhw_dual_varying(f, 0);
    z[1] = rhw_dual_varying(f, 1);
    *inside = f->mask; // lanes that are not drawn hold rubbish: the loop must not wait for them
    iterate(f->uniforms, z, inside, steps);
}

// 0 at the edge of the set, 1 from a pixel away on: its distance is about |z| ln |z| / |z'|.
static rhw_float soften(const struct rhw_dual z[2])
{
    const rhw_float right[2] = {z[0].ddx, z[1].ddx}, down[2] = {z[0].ddy, z[1].ddy};
    const rhw_float change = rhw_max(rhw_length2(right), rhw_length2(down));
    const rhw_float square = z[0].value * z[0].value + z[1].value * z[1].value;
    return rhw_saturate(0.5f * rhw_sqrt(square) * rhw_log(square) / change);
}

static void shade(struct rhw_fragment *f)
{
    const struct julia *julia = f->uniforms;
    const struct floor_point *in = RHW_VARYINGS(struct floor_point, f->varying);
    const rhw_float haze = in->far * in->far * in->far;
    rhw_float *color = f->color[0];
    struct rhw_dual z[2], uv[2];
    rhw_int inside, steps;
    leave(f, z, &inside, &steps);
    if (!rhw_any(f->mask & ~inside)) { // nobody left: neither tiles nor colours are needed
        for (int c = 0; c < 3; c++) {
            color[c] = rhw_mix(0.0f, julia->sky[c], haze);
        }
        color[3] = rhw_splat(1);
        return;
    }
    find_tile(julia, z, uv);
    if (!julia->duals) { // a branch on a uniform: all lanes go the same way
        for (int i = 0; i < 2; i++) {
            const struct rhw_dual floor = rhw_dual_varying(f, i);
            uv[i].ddx = floor.ddx;
            uv[i].ddy = floor.ddy;
        }
    }
    const rhw_float edge = julia->duals ? soften(z) : rhw_splat(1);
    rhw_float tile[4];
    rhw_sample_dual(f->bindings, 0, uv, tile);
    mix_palette(julia, steps, inside, rhw_saturate(uv[1].value), color);
    for (int c = 0; c < 3; c++) {
        color[c] = rhw_mix(color[c] * tile[c] * edge, julia->sky[c], haze);
    }
    color[3] = rhw_splat(1);
}

void RHW_ISA_NAME(julia_fragment)(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        shade(&groups[g]);
    }
}

void RHW_ISA_NAME(julia_numbers)(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_dual z[2], uv[2];
        rhw_int inside, steps;
        leave(&groups[g], z, &inside, &steps);
        find_tile(groups[g].uniforms, z, uv);
        const rhw_float number[4] = {uv[0].value, uv[1].value, uv[0].ddx, uv[1].ddy};
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = rhw_select(inside, -1.0f, number[c]);
        }
    }
}
