// SPDX-License-Identifier: MIT
// One-at-a-time functions that use all that the library has for compilers without lanes: compiled with lanes by the test
// that draws with them, and without by no_lanes.c.
#ifndef TEST_ONE_AT_A_TIME_H
#define TEST_ONE_AT_A_TIME_H

#include <rhw/rhw.h>
#include <rhw/shader.h>

enum { ONE_MATHS = 30 };

static inline float one_math(int number, float a, float b)
{
    switch (number) {
    case 0: return rhw_exp2_1(a);
    case 1: return rhw_exp1(a);
    case 2: return rhw_log2_1(a);
    case 3: return rhw_log1(a);
    case 4: return rhw_pow1(a, b);
    case 5: return rhw_sin1(a);
    case 6: return rhw_cos1(a);
    case 7: return rhw_tan1(a);
    case 8: return rhw_asin1(a);
    case 9: return rhw_acos1(a);
    case 10: return rhw_atan1(a);
    case 11: return rhw_atan2_1(a, b);
    case 12: return rhw_sqrt1(a);
    case 13: return rhw_trunc1(a);
    case 14: return rhw_floor1(a);
    case 15: return rhw_ceil1(a);
    case 16: return rhw_round1(a);
    case 17: return rhw_fract1(a);
    case 18: return rhw_smoothstep1(0, b, a);
    case 19: return rhw_float_from_int1(rhw_int_from_float1(a));
    case 20: {
        const float v[3] = {a, b, 1};
        float unit[3];
        rhw_normalize3_1(v, unit);
        return unit[0];
    }
    case 21: return rhw_sinh1(a);
    case 22: return rhw_cosh1(a);
    case 23: return rhw_tanh1(a);
    case 24: return rhw_asinh1(a);
    case 25: return rhw_acosh1(a);
    case 26: return rhw_atanh1(a);
    case 27: return rhw_ldexp1(a, rhw_int_from_float1(b));
    case 28: {
        const float pair[2] = {a, b};
        return rhw_float_from_int1(
            rhw_bit_count1(rhw_divide_int1(rhw_pack_half2x16_1(pair), rhw_bits_from_float1(b))));
    }
    default: {
        float sine, cosine;
        rhw_sincos1(a, &sine, &cosine);
        return sine + cosine;
    }
    }
}

// Attribute 0 is the position, attribute 1 the texture coordinates.
static inline void one_vertex(struct rhw_vertex1 *v)
{
    for (int c = 0; c < 4; c++) {
        v->position[c] = v->attribute[0][c];
        v->varying[c] = v->attribute[1][c];
    }
}

// Slot 0 by the derivatives above, and at level 1.5 below.
static inline void one_fragment(struct rhw_fragment1 *f)
{
    const float gradient[4] = {f->ddx[0], f->ddx[1], f->ddy[0], f->ddy[1]};
    if (f->varying[1] < 0.5f) {
        rhw_sample_grad1(f->bindings, 0, f->varying, gradient, f->color[0]);
    } else {
        rhw_sample_lod1(f->bindings, 0, f->varying, 1.5f, f->color[0]);
    }
    for (int i = 0; i < ONE_MATHS; i++) {
        f->color[0][3] += one_math(i, f->varying[0], f->varying[1]);
    }
}

#endif
