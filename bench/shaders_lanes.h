// SPDX-License-Identifier: MIT
// What the benchmark's shaders on 8 lanes have in common; included once per instruction set.
#ifndef BENCH_SHADERS_LANES_H
#define BENCH_SHADERS_LANES_H

#include "bench_scene.h"

#include "rhw/shader.h"

#define ALWAYS_INLINE static inline __attribute__((always_inline))

ALWAYS_INLINE void to_clip(const struct bench_uniforms *u, const rhw_float p[3], rhw_float clip[4])
{
    rhw_mat4_mul_point(u->clip, p, clip);
}

// Normal, then position in the world.
ALWAYS_INLINE void to_world(const struct bench_uniforms *u, const rhw_float p[4], const rhw_float n[4],
                            rhw_float *varying)
{
    for (int r = 0; r < 3; r++) {
        const float *const row = &u->world[4 * r];
        varying[r] = row[0] * n[0] + row[1] * n[1] + row[2] * n[2];
        varying[3 + r] = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
    }
}

// The cosines that Blinn-Phong asks for, of one directional light; the varyings are those of to_world.
ALWAYS_INLINE void light(const struct rhw_fragment *f, const struct bench_uniforms *u, rhw_float *n_dot_l,
                         rhw_float *n_dot_h)
{
    rhw_float normal[3], view[3], half[3];
    rhw_normalize3(f->varying, normal);
    for (int c = 0; c < 3; c++) {
        view[c] = u->eye[c] - f->varying[3 + c];
    }
    rhw_normalize3(view, view);
    for (int c = 0; c < 3; c++) {
        half[c] = view[c] + u->light[c];
    }
    rhw_normalize3(half, half);
    const rhw_float zero = rhw_splat(0.0f);
    *n_dot_l = rhw_max(normal[0] * u->light[0] + normal[1] * u->light[1] + normal[2] * u->light[2], zero);
    *n_dot_h = rhw_max(rhw_dot3(normal, half), zero);
}

#endif
