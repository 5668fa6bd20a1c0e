// SPDX-License-Identifier: MIT
// Derivatives per pixel of what is interpolated in space are d(q/S)/dx = (q_x·S − q·S_x)/S² and d(q/S)/dy. The
// numerators are linear; the first does not depend on x, and the second not on y; so nothing cancels per pixel:
//
//     derivative = (at + step·Δ) · (1/S)²,     Δ: pixels from the anchor, down for d/dx and to the right for d/dy.
//
// All of it is computed in double and rounded once. Numerators of two quantities stand side by side (struct
// derivative_pair).
#ifndef RHW_DERIVATIVE_H
#define RHW_DERIVATIVE_H

#include "kernels/raster/sample_position.h"
#include "kernels/tile_work.h"
#include "kernels/triangle_work.h"

enum derivatives { NO_DERIVATIVES, DERIVATIVES }; // constant where a call names it

// Return the numerator of a derivative at 8 pixels: at + step·Δ.
RHW_INLINE f64x8 numerator8(double at, double step, f64x8 distance)
{
    return f64x8_add(f64x8_splat(at), f64x8_mul(f64x8_splat(step), distance));
}

RHW_INLINE f64x4 numerators(const struct derivative_pair *pair, f64x4 distance)
{
    return pair->at + pair->step * distance;
}

RHW_INLINE f32x8 derivative_of(f64x8 numerator, f64x8 squared)
{
    return f32x8_from_f64x8(f64x8_mul(numerator, squared));
}

// Set the derivatives of b and c, unless planes_homogeneous has set them. With T = e_0·w_0 + e_1·w_1 + e_2·w_2,
// d(e_1·w_1/T)/dx = w_1·(Σ w_i·(a_1·e_i − a_i·e_1))/T². Here a_1·e_0 − a_0·e_1 is 0 at vertex 2, does not depend on x,
// and changes by the area with y, and so on around the triangle: what is left are heights over vertices, which are
// exact.
static void weight_derivatives(struct planes *p, const struct rhw_triangle *t,
                               const struct rhw_vertex_record *const v[3])
{
    if (p->is_homogeneous || p->kind == PLANES_DOUBLE_DOUBLE) {
        return;
    }
    const f64x4 w = f64x4_splat(1) / (f64x4){(double)v[0]->position[3], (double)v[1]->position[3],
                                             (double)v[2]->position[3], 1};
    const i32x4 x = i32x4_load(t->x_24_8), y = i32x4_load(t->y_24_8); // fourth lane of each: another member
    const int32_t anchor_x = (int32_t)sample_of_pixel(p->anchor_x),
                  anchor_y = (int32_t)sample_of_pixel(p->anchor_y);
    const i32x4 anchor = {anchor_y, anchor_x, anchor_y, anchor_x};
    // The heights over one of the other two vertices, and over the other.
    const f64x4 one = f64x4_from_i32x4(anchor - __builtin_shufflevector(x, y, 4, 2, 5, 0));
    const f64x4 other = f64x4_from_i32x4(anchor - __builtin_shufflevector(x, y, 6, 0, 4, 1));
    const f64x4 side = f64x4_from_i32x4(__builtin_shufflevector(x, y, 1, 2, 5, 6) -
                                        __builtin_shufflevector(x, y, 0, 0, 4, 4));
    // The factor is one over the signed area.
    const double factor = side[0] * side[3] < side[1] * side[2] ? -p->inverse_area : p->inverse_area;
    const f64x4 self = __builtin_shufflevector(w, w, 1, 1, 2, 2),
                first = __builtin_shufflevector(w, w, 2, 0, 0, 1),
                second = __builtin_shufflevector(w, w, 0, 2, 1, 0);
    const f64x4 f = f64x4_splat(factor) * self * f64x4_splat(RHW_SUBPIXEL);
    p->weights.at = f * (first * one - second * other);
    p->weights.step = f * (first - second) * f64x4_splat(RHW_SUBPIXEL);
}

// Make the derivatives of smooth components from those of b and c, by the pairs of the pipeline: a component is I_0 +
// b·(I_1 − I_0) + c·(I_2 − I_0).
static void component_derivatives(struct derivative_pair *out, struct triangle_work *triangle,
                                  const struct rhw_pipeline_data *pipeline)
{
    const struct rhw_vertex_record *const *const v = triangle->v;
    weight_derivatives(&triangle->planes, triangle->t, v);
    const f64x4 at = triangle->planes.weights.at, step = triangle->planes.weights.step;
    const f64x4 b_at = __builtin_shufflevector(at, at, 0, 1, 0, 1),
                c_at = __builtin_shufflevector(at, at, 2, 3, 2, 3),
                b_step = __builtin_shufflevector(step, step, 0, 1, 0, 1),
                c_step = __builtin_shufflevector(step, step, 2, 3, 2, 3);
    for (int pair = 0; pair < pipeline->derivative_pairs; pair++) {
        const int i = pipeline->derivative_component[pair][0], k = pipeline->derivative_component[pair][1];
        f64x4 value[3];
        for (int n = 0; n < 3; n++) {
            const double first = (double)v[n]->varyings[i], second = (double)v[n]->varyings[k];
            value[n] = (f64x4){first, first, second, second};
        }
        const f64x4 d1 = value[1] - value[0], d2 = value[2] - value[0];
        out[pair].at = b_at * d1 + c_at * d2;
        out[pair].step = b_step * d1 + c_step * d2;
    }
}

// Set the derivatives of the first quantity (`which` is 0) or the second of a pair, at 8 pixels that are `at` from the
// anchor.
RHW_INLINE void pair_derivatives(const struct derivative_pair *pair, int which,
                                 const struct anchor_offset *at, f64x8 squared, f32x8 *by_x, f32x8 *by_y)
{
    const int x = 2 * which, y = x + 1;
    *by_x = derivative_of(numerator8(pair->at[x], pair->step[x], at->dy), squared);
    *by_y = derivative_of(numerator8(pair->at[y], pair->step[y], at->dx), squared);
}

// Set the derivatives of the smooth components of group g, whose pixels are `at`.
RHW_INLINE void smooth_derivatives(struct fragment_queue *queue, int g,
                                   const struct rhw_pipeline_data *pipeline,
                                   const struct derivative_pair *pairs, const struct anchor_offset *at,
                                   f64x8 squared)
{
    f32x8 *const ddx = queue->ddx + g * pipeline->varying_components;
    f32x8 *const ddy = queue->ddy + g * pipeline->varying_components;
    for (int pair = 0; pair < pipeline->derivative_pairs; pair++) {
        for (int which = 0; which < 2; which++) {
            const int i = pipeline->derivative_component[pair][which];
            pair_derivatives(&pairs[pair], which, at, squared, &ddx[i], &ddy[i]);
        }
    }
}

// The derivative of a component that is interpolated on the screen. It is constant over the triangle.
struct screen_derivative {
    float by_x, by_y;
};

static inline struct screen_derivative screen_derivative(const struct plane *n1, const struct plane *n2,
                                                         const float *const varyings[3], int component)
{
    const double i0 = (double)varyings[0][component], d1 = (double)varyings[1][component] - i0,
                 d2 = (double)varyings[2][component] - i0;
    return (struct screen_derivative){(float)(n1->dx * d1 + n2->dx * d2), (float)(n1->dy * d1 + n2->dy * d2)};
}

// Set the derivatives of the components of `count` groups from `first` on that are not smooth.
static void constant_derivatives(struct fragment_queue *queue, int first, int count,
                                 const struct rhw_pipeline_data *pipeline,
                                 const struct triangle_work *triangle)
{
    const float *const varyings[3] = {triangle->v[0]->varyings, triangle->v[1]->varyings,
                                      triangle->v[2]->varyings};
    const ptrdiff_t components = pipeline->varying_components;
    for (int i = 0; i < components; i++) {
        if (!pipeline->component_derivatives[i] || pipeline->component_qualifier[i] == RHW_SMOOTH) {
            continue;
        }
        struct screen_derivative d = {0, 0};
        if (pipeline->component_qualifier[i] == RHW_NOPERSPECTIVE) {
            d = screen_derivative(&triangle->planes.n1, &triangle->planes.n2, varyings, i);
        }
        for (int g = first; g < first + count; g++) {
            queue->ddx[g * components + i] = f32x8_splat(d.by_x);
            queue->ddy[g * components + i] = f32x8_splat(d.by_y);
        }
    }
}

#endif
